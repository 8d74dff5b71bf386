// DirectLight's part for far plates that smoke dims unevenly: beside the border of a layer ways to
// the upper and to the lower edge of a sign differ much, however far it is.
#include "DirectLight.h"

#include "Scene.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace smokevis
{

namespace
{

/// Optical depth by which the mean of the ways to a plate's corners may differ from the way to its
/// centre, at a small tolerance and at a large one: that way stands for all then, to a percent or
/// to three. By how many times this the corners themselves may differ.
constexpr double EvenBend = 0.03;
constexpr double MostBend = 0.1;
constexpr double SpanOverBend = 15.0;
/// The same of what a parabola through them follows: so many times as much.
constexpr double SmoothTimes = 2.0;
/// Optical depth over the plate below which half of the strips do.
constexpr double PairedSpan = 3.0;
/// Optical depth over half of a strip's width that counts at most: beyond, light ends within it.
constexpr double MostHalf = 2.0;

/// Whether ways to two opposite corners of a plate and to its centre differ by no more than these.
bool Within(const std::array<double, 2>& corners, double centre, double bend)
{
  return std::abs(corners[0] - corners[1]) <= SpanOverBend * bend &&
         std::abs(0.5 * (corners[0] + corners[1]) - centre) <= bend;
}

} // namespace

double DirectLight::BendFor(double tolerance)
{
  return std::clamp(tolerance, EvenBend, MostBend);
}

std::optional<DirectLight::Across> DirectLight::WaysAcross(
  std::size_t light, const Vec3& point) const
{
  const LightGroup& root = this->Scene_.Lights().Root(light);
  const Medium& smoke = this->Scene_.Smoke();
  const double distance = glm::length(root.Centre - point);
  if (!(root.Radius * root.Law.Sharpness() < PathRatio * distance) ||
      (smoke.EvenAt(point) && smoke.EvenAt(root.Centre)))
  {
    return std::nullopt;
  }
  const Receiver receiver{point, std::nullopt};
  Across ways{this->Depth(receiver, root.Centre), {}};
  if (ways.Centre * this->Scene_.SmallestScale() > DeepestDepth)
  {
    return std::nullopt;
  }
  const double scale = this->Scene_.LargestScale();
  const auto walk = [&](int corner)
  { ways.Corners[corner] = this->Depth(receiver, root.Corners[corner]); };
  walk(0);
  walk(2);
  // One diagonal tells of both where smoke lies in layers.
  if (Within({ways.Corners[0], ways.Corners[2]}, ways.Centre, this->Bend_ / scale))
  {
    return std::nullopt;
  }
  walk(1);
  walk(3);
  return ways;
}

bool DirectLight::Smooth(const Across& ways) const
{
  const double scale = this->Scene_.LargestScale();
  const auto within = [&](int first, int second)
  {
    return Within(
      {ways.Corners[first], ways.Corners[second]}, ways.Centre, SmoothTimes * this->Bend_ / scale);
  };
  return within(0, 2) && within(1, 3);
}

Spectrum DirectLight::Unevenness(std::size_t light, const Vec3& point, const Across& ways) const
{
  const std::array<double, 4>& corners = ways.Corners;
  const double along = std::abs(corners[1] - corners[0]) + std::abs(corners[2] - corners[3]);
  const double up = std::abs(corners[3] - corners[0]) + std::abs(corners[2] - corners[1]);
  const int edge = along > up ? 0 : 1;
  const auto& strips = this->Scene_.Lights().Strips(light).Along(edge);
  const double begin = 0.5 * (corners[0] + corners[edge == 0 ? 3 : 1]);
  const double end = 0.5 * (corners[2] + corners[edge == 0 ? 1 : 3]);
  const bool smooth = this->Smooth(ways);
  // Along the strips one line does where ways change little there.
  const double scale = this->Scene_.LargestScale();
  const std::size_t lines =
    smooth || std::min(along, up) * scale <= SpanOverBend * EvenBend ? 1 : 2;
  // So do two strips together where they change little across.
  const std::size_t wide = !smooth && std::max(along, up) * scale < 2.0 * PairedSpan ? 2 : 1;
  constexpr std::size_t most = PlateStrips::Count;
  const std::size_t count = most / wide;
  Spectrum ratio{};
  for (std::size_t line = 0; line < lines; ++line)
  {
    std::array<double, most> depths;
    for (std::size_t i = 0; i < count; ++i)
    {
      const double t = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
      const auto& first = strips[wide * i].Places;
      const auto& last = strips[wide * i + wide - 1].Places;
      const std::size_t other = lines == 1 ? 1 : line;
      depths[i] = smooth ? begin + t * (end - begin) -
                             4.0 * t * (1.0 - t) * (0.5 * (begin + end) - ways.Centre)
                         : this->Depth({point, std::nullopt}, 0.5 * (first[line] + last[other]));
    }
    for (std::size_t i = 0; i < count; ++i)
    {
      const std::size_t before = i == 0 ? 0 : i - 1;
      const std::size_t behind = std::min(i + 1, count - 1);
      const double change =
        (depths[behind] - depths[before]) / static_cast<double>(behind - before);
      for (int band = 0; band < this->Scene_.Bands(); ++band)
      {
        // The mean of an exponential along the strip's width.
        const double extinction = this->Scene_.ExtinctionScale(band);
        const double half = std::min(MostHalf, 0.5 * extinction * std::abs(change));
        const double mean = half > 1e-4 ? std::sinh(half) / half : 1.0;
        const double share =
          strips[wide * i].Share[band] + (wide == 2 ? strips[2 * i + 1].Share[band] : 0.0);
        ratio[band] += share / static_cast<double>(lines) * mean *
                       std::exp(-extinction * (depths[i] - ways.Centre));
      }
    }
  }
  return ratio;
}

void DirectLight::DimUnevenly(std::size_t light, const Vec3& point, Spectrum& value) const
{
  if (const auto ways = this->WaysAcross(light, point))
  {
    const Spectrum ratio = this->Unevenness(light, point, *ways);
    std::transform(value.begin(), value.end(), ratio.begin(), value.begin(), std::multiplies<>());
  }
}

std::vector<Spectrum> DirectLight::UnevennessIn(
  std::size_t light, const Medium::Block& block, const std::vector<bool>& asked, bool far) const
{
  const Medium& smoke = this->Scene_.Smoke();
  std::array<Spectrum, 8> corners;
  bool even = far;
  bool smooth = far;
  for (std::size_t corner = 0; far && corner < corners.size(); ++corner)
  {
    std::array<int, 3> place;
    for (int axis = 0; axis < 3; ++axis)
    {
      place[axis] = corner >> axis & 1 ? block.Size[axis] - 1 : 0;
    }
    const Vec3 point = smoke.CellCentre(smoke.Cell(block, place));
    const auto ways = this->WaysAcross(light, point);
    even = even && !ways;
    smooth = smooth && (!ways || this->Smooth(*ways));
    corners[corner].fill(1.0);
    if (ways && smooth)
    {
      corners[corner] = this->Unevenness(light, point, *ways);
    }
  }
  std::vector<Spectrum> ratios;
  if (even)
  {
    return ratios;
  }
  Spectrum one;
  one.fill(1.0);
  ratios.assign(block.Cells(), one);
  block.ForEachCell(
    [&](const std::array<int, 3>& place)
    {
      const std::size_t number = block.Number(place);
      if (!asked[number])
      {
        return;
      }
      if (!smooth)
      {
        this->DimUnevenly(light, smoke.CellCentre(smoke.Cell(block, place)), ratios[number]);
        return;
      }
      ratios[number] = {};
      for (std::size_t corner = 0; corner < corners.size(); ++corner)
      {
        double weight = 1.0;
        for (int axis = 0; axis < 3; ++axis)
        {
          const double t =
            block.Size[axis] > 1 ? static_cast<double>(place[axis]) / (block.Size[axis] - 1) : 0.0;
          weight *= corner >> axis & 1 ? t : 1.0 - t;
        }
        Accumulate(ratios[number], corners[corner], weight);
      }
    });
  return ratios;
}

} // namespace smokevis
