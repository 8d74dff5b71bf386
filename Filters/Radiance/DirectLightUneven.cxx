// DirectLight's part for far plates that smoke dims unevenly: beside the border of a layer ways to
// the upper and to the lower edge of a sign differ much, however far it is.
#include "DirectLight.h"

#include "BlockCorners.h"
#include "GaussNodes.h"
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
/// to some. By how many times this the corners themselves may differ.
constexpr double EvenBend = 0.03;
constexpr double MostBend = 0.2;
constexpr double SpanOverBend = 20.0;
/// The same of what a parabola through them follows: so many times as much.
constexpr double SmoothTimes = 2.0;
/// In smoke like noise ways differ by so many times this at most, and along one edge no less than
/// by this share of what they do along the other.
constexpr double ScatteredTimes = 10.0;
constexpr double ScatteredShare = 1.0 / 3.0;
/// Optical depth over the plate below which two strips count together, and along its strips below
/// which their middles stand for them.
constexpr double PairedSpan = 3.0;
constexpr double LittleAside = 0.2;
/// Share of a plate's radius up to which a cell's edge is so short that its centre tells of it.
constexpr double SmallEdge = 0.5;
/// Share of EvenBend to MostBend by which the logarithm of what uneven smoke makes of the light may
/// be off where cells of a block tell of others.
constexpr double ToldShare = 0.3;
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

bool DirectLight::Far(const LightGroup& root, const Vec3& point)
{
  return root.Radius * root.Law.Sharpness() < PathRatio * glm::length(root.Centre - point);
}

std::optional<DirectLight::Across> DirectLight::WaysAcross(
  std::size_t light, const Vec3& point, const std::optional<double>& extinction) const
{
  const LightGroup& root = this->Scene_.Lights().Root(light);
  const Medium& smoke = this->Scene_.Smoke();
  if (!Far(root, point) || (smoke.EvenAt(point) && smoke.EvenAt(root.Centre)))
  {
    return std::nullopt;
  }
  Receiver receiver{point, std::nullopt};
  receiver.Extinction = extinction;
  Across ways{this->Depth(receiver, root.Centre), {}};
  receiver.Extinction.reset();
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

bool DirectLight::Scattered(const Across& ways) const
{
  const auto [least, most] = std::minmax_element(ways.Corners.begin(), ways.Corners.end());
  const double span = std::max(*most, ways.Centre) - std::min(*least, ways.Centre);
  const auto [less, more] = std::minmax({ways.Along(), ways.Up()});
  return less > ScatteredShare * more &&
         span * this->Scene_.LargestScale() < ScatteredTimes * this->Bend_;
}

std::vector<DirectLight::DimmedPart> DirectLight::PartsAcross(
  std::size_t light, const Vec3& point, const Across& ways, const std::optional<int>& line) const
{
  const int edge = ways.Along() > ways.Up() ? 0 : 1;
  const auto& strips = this->Scene_.Lights().Strips(light).Along(edge);
  const bool smooth = this->Smooth(ways);
  const double span = 0.5 * std::max(ways.Along(), ways.Up()) * this->Scene_.LargestScale();
  const std::size_t together = !smooth && span < PairedSpan ? 2 : 1;
  const double begin = 0.5 * (ways.Corners[0] + ways.Corners[edge == 0 ? 3 : 1]);
  const double end = 0.5 * (ways.Corners[2] + ways.Corners[edge == 0 ? 1 : 3]);
  const double bend = 0.5 * (begin + end) - ways.Centre;
  std::vector<DimmedPart> parts(strips.size() / together);
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    const PlateStrips::Strip& first = strips[together * i];
    const PlateStrips::Strip& last = strips[together * i + together - 1];
    parts[i].Share = first.Share;
    if (together > 1)
    {
      Accumulate(parts[i].Share, last.Share);
    }
    if (smooth)
    {
      const double t = (static_cast<double>(i) + 0.5) / static_cast<double>(parts.size());
      parts[i].Depth = begin + t * (end - begin) - 4.0 * t * (1.0 - t) * bend;
    }
    else
    {
      const Vec3 place = 0.5 * (first.Places[line.value_or(0)] + last.Places[line.value_or(1)]);
      parts[i].Depth = this->Depth({point, std::nullopt}, place);
    }
  }
  return parts;
}

Spectrum DirectLight::Unevenness(std::size_t light, const Vec3& point, const Across& ways) const
{
  Spectrum ratio{};
  if (this->Scattered(ways))
  {
    for (int band = 0; band < this->Scene_.Bands(); ++band)
    {
      const double extinction = this->Scene_.ExtinctionScale(band);
      double sum = 1.0;
      for (const double depth : ways.Corners)
      {
        sum += std::exp(-extinction * (depth - ways.Centre));
      }
      ratio[band] = sum / (1.0 + static_cast<double>(ways.Corners.size()));
    }
    return ratio;
  }
  const auto add = [&](const std::optional<int>& line, double weight)
  {
    const std::vector<DimmedPart> parts = this->PartsAcross(light, point, ways, line);
    for (std::size_t i = 0; i < parts.size(); ++i)
    {
      const std::size_t before = i == 0 ? 0 : i - 1;
      const std::size_t behind = std::min(i + 1, parts.size() - 1);
      const double change =
        (parts[behind].Depth - parts[before].Depth) / static_cast<double>(behind - before);
      for (int band = 0; band < this->Scene_.Bands(); ++band)
      {
        // The mean of an exponential along the part's width.
        const double extinction = this->Scene_.ExtinctionScale(band);
        const double half = std::min(MostHalf, 0.5 * extinction * std::abs(change));
        const double mean = half > 1e-4 ? std::sinh(half) / half : 1.0;
        ratio[band] += weight * parts[i].Share[band] * mean *
                       std::exp(-extinction * (parts[i].Depth - ways.Centre));
      }
    }
  };
  const double aside = 0.5 * std::min(ways.Along(), ways.Up()) * this->Scene_.LargestScale();
  if (this->Smooth(ways) || aside <= LittleAside)
  {
    add(std::nullopt, 1.0);
  }
  else
  {
    add(0, 0.5);
    add(1, 0.5);
  }
  return ratio;
}

void DirectLight::DimUnevenly(std::size_t light, const Receiver& receiver, Spectrum& value) const
{
  if (!IsLit(value))
  {
    return;
  }
  const Vec3& point = receiver.Point;
  if (const auto ways = this->WaysAcross(light, point, receiver.Extinction))
  {
    const Spectrum ratio = this->Unevenness(light, point, *ways);
    std::transform(value.begin(), value.end(), ratio.begin(), value.begin(), std::multiplies<>());
  }
}

bool DirectLight::UnevenIn(
  std::size_t light, const Medium::Block& block, const BlockWays& told) const
{
  // A weak light may be off by as much of the whole as the strongest.
  if (told.Share * MostBend < this->Bend_)
  {
    return false;
  }
  if (told.Told == 0)
  {
    return true;
  }
  const Medium& smoke = this->Scene_.Smoke();
  // Its middle, and corners of which no two share an edge.
  const std::array<int, 3> last = {block.Size[0] - 1, block.Size[1] - 1, block.Size[2] - 1};
  const std::array<std::array<int, 3>, 5> places = {{{last[0] / 2, last[1] / 2, last[2] / 2},
    {0, 0, 0}, {last[0], last[1], 0}, {last[0], 0, last[2]}, {0, last[1], last[2]}}};
  return std::any_of(places.begin(), places.end(),
    [&](const std::array<int, 3>& place) {
      return this->WaysAcross(light, smoke.CellCentre(smoke.Cell(block, place)), {}).has_value();
    });
}

std::optional<DirectLight::Corrections> DirectLight::TellUneven(
  const Medium::Block& block, const std::vector<std::optional<BoxLight>>& asked) const
{
  const int bands = this->Scene_.Bands();
  // Logarithms of the correction of a cell.
  const auto look = [&](const std::array<int, 3>& place) -> std::optional<Spectrum>
  {
    const std::optional<BoxLight>& light = asked[block.Number(place)];
    if (!light || this->KnowsUneven(*light))
    {
      return std::nullopt;
    }
    const Spectrum fluence = this->CellFluence(*light, true);
    const Spectrum corrected = this->UnevenFluence(*light, fluence);
    Spectrum logarithms{};
    for (int band = 0; band < bands; ++band)
    {
      logarithms[band] = std::log(corrected[band] / fluence[band]);
    }
    return logarithms;
  };
  Corrections corners{};
  for (int corner = 0; corner < 8; ++corner)
  {
    const std::optional<Spectrum> own = look(CornerOf(block, corner));
    if (!own)
    {
      return std::nullopt;
    }
    for (int band = 0; band < bands; ++band)
    {
      corners[band][corner] = (*own)[band];
    }
  }
  // Large blocks along four diagonals, small ones along two.
  const int longest = block.LongestEdge();
  const int diagonals = std::min(4, longest / 2);
  for (int i = 0; i < diagonals * longest; ++i)
  {
    const std::array<int, 3> place = PlaceOnDiagonal(block, i / diagonals, i % diagonals);
    const std::optional<Spectrum> own = look(place);
    for (int band = 0; band < bands; ++band)
    {
      // None where there is no light to correct.
      if (!own || !(std::abs(BetweenCorners(corners[band], block, place) - (*own)[band]) <=
                    ToldShare * this->Bend_))
      {
        return std::nullopt;
      }
    }
  }
  return corners;
}

bool DirectLight::KnowsUneven(const BoxLight& light) const
{
  const Medium& smoke = this->Scene_.Smoke();
  const Vec3 size = smoke.CellSize(light.Cell);
  const LightGroup& root = this->Scene_.Lights().Root(light.Index);
  // In dense cells the mean is of what comes in through their faces, not of their centres; where
  // places in a cell have ways of their own, those are corrected already.
  return !light.Far || this->BoxDepth(light.Cell, size) >= FlatDepth ||
         (this->BehindBorder(light) && LargestEdge(size) * root.Law.Sharpness() >
                                         FlatRatio * root.Distance(smoke.CellCentre(light.Cell)));
}

Spectrum DirectLight::UnevenFluence(const BoxLight& light, const Spectrum& fluence) const
{
  const Medium& smoke = this->Scene_.Smoke();
  const Vec3 centre = smoke.CellCentre(light.Cell);
  const Vec3 size = smoke.CellSize(light.Cell);
  if (!IsLit(fluence) || this->KnowsUneven(light))
  {
    return fluence;
  }
  const auto ways = this->WaysAcross(light.Index, centre, light.Ways.Mean);
  if (!ways)
  {
    return fluence;
  }
  Spectrum mean{};
  const LightGroup& root = this->Scene_.Lights().Root(light.Index);
  if (this->Smooth(*ways) || this->Scattered(*ways) || LargestEdge(size) <= SmallEdge * root.Radius)
  {
    mean = this->Unevenness(light.Index, centre, *ways);
    std::transform(mean.begin(), mean.end(), fluence.begin(), mean.begin(), std::multiplies<>());
    return mean;
  }
  // Two places on a diagonal follow what changes across the cell as a cubic does along it.
  for (const double at : Nodes2)
  {
    Accumulate(mean, this->Fluence(light.Index, centre + (at - 0.5) * size, true), 0.5);
  }
  return mean;
}

} // namespace smokevis
