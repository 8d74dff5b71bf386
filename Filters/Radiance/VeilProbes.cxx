#include "VeilProbes.h"

#include "Sampler.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/constants.hpp>

namespace smokevis
{

namespace
{

constexpr int MostProbes = 64;
/// Share of the way to a wall at which the eye is.
constexpr double EyeShare = 0.98;
/// Farther than this optical depth from a sign, no one asks for it.
constexpr double FarthestDepth = 12.0;
/// Light fainter than this share of the brightest emitter need not be known to a share of itself.
constexpr double FaintestShare = 1e-7;
/// Where there are no signs, neither need the light be known to a share of itself that is fainter
/// than this share of the mean.
constexpr double DarkShare = 0.1;

} // namespace

VeilProbes::VeilProbes(
  const Scene& scene, const LightField& field, int band, std::uint64_t seed, Lines lines)
    : Black_(!scene.SendsOn(band))
{
  const EvenPoints points(Mix(seed) + 17);
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector<Sign>& signs = scene.Lights().Signs();
  double brightest = scene.Sky();
  for (const EmitterCell& cell : scene.Lights().Cells())
  {
    brightest = std::max(brightest, cell.Luminance[band]);
  }
  this->Floor_ = FaintestShare * brightest;
  const bool anywhere = this->Black_ || signs.empty() || lines == Lines::Anywhere;
  this->MeanShare_ = anywhere ? DarkShare : 0.0;
  const double size = glm::length(scene.Upper() - scene.Lower());
  for (int i = 0; i < MostProbes; ++i)
  {
    const auto random = points.Point(i);
    if (anywhere)
    {
      const Vec3 eye =
        scene.Lower() + Vec3(random[0], random[1], Mix(i + seed) / 1.8446744073709552e19) *
                          (scene.Upper() - scene.Lower());
      this->Add(scene, field, band, eye, SphereDirection(random[2], random[3]), infinity);
      continue;
    }
    const Sign& sign = signs[i % signs.size()];
    const Vec3 start = sign.Centre + 10.0 * scene.Shapes().Tolerance() * sign.Normal;
    // Towards a place anywhere in the scene: signs are looked for from afar.
    Vec3 way = scene.Lower() +
               Vec3(random[0], random[1], random[2]) * (scene.Upper() - scene.Lower()) - start;
    way -= std::min(0.0, 2.0 * glm::dot(way, sign.Normal)) * sign.Normal;
    const Vec3 away = glm::normalize(way);
    double farthest =
      std::min(scene.Shapes().Intersect(start, away, 0.0, size).Distance, glm::length(way));
    std::vector<Segment> segments;
    scene.Smoke().WalkSmoke(start, away, 0.0, farthest, segments);
    double depth = 0.0;
    for (const Segment& segment : segments)
    {
      const double extinction =
        scene.Smoke().Extinction(segment.Cell) * scene.ExtinctionScale(band);
      const double left = FarthestDepth - depth;
      depth += extinction * (segment.End - segment.Begin);
      if (depth > FarthestDepth)
      {
        farthest = segment.Begin + left / extinction;
        break;
      }
    }
    // No eye lies on a wall.
    const double reach = EyeShare * farthest;
    this->Add(scene, field, band, start + reach * away, -away, reach);
  }
}

void VeilProbes::Add(const Scene& scene, const LightField& field, int band, const Vec3& eye,
  const Vec3& direction, double reach)
{
  Probe probe;
  const Hit end = scene.Shapes().Intersect(eye, direction, 0.0, 2.0 * reach);
  const double length = std::min(reach, end.Distance);
  std::vector<Segment> segments;
  scene.Smoke().WalkSmoke(eye, direction, 0.0, length, segments);
  double transmittance = 1.0;
  const double scatter = (this->Black_ ? 1.0 : scene.Albedo()) / (4.0 * glm::pi<double>());
  for (const Segment& segment : segments)
  {
    const double depth = scene.Smoke().Extinction(segment.Cell) * scene.ExtinctionScale(band) *
                         (segment.End - segment.Begin);
    const double lost = -std::expm1(-depth) * transmittance;
    const double weight = scatter * lost;
    probe.Pieces.push_back({segment.Cell, weight});
    probe.Direct += weight * field.DirectFluence[field.CellIndex(band, segment.Cell)] +
                    (1.0 - scene.Albedo()) * lost * scene.Smoke().EmittedLuminance(segment.Cell);
    transmittance -= lost;
  }
  if (end.Found() && length == end.Distance)
  {
    const std::size_t patch = scene.Patch(end);
    probe.Side = 2 * patch + end.Side;
    const double reflectance = this->Black_ ? 1.0 : scene.PatchReflectance(patch)[band];
    probe.SurfaceWeight = transmittance * reflectance / glm::pi<double>();
    probe.Direct +=
      probe.SurfaceWeight * field.DirectIlluminance[field.PatchIndex(band, patch, end.Side)];
  }
  this->Probes_.push_back(std::move(probe));
}

std::vector<Lanes> VeilProbes::LightOf(const std::vector<BatchState>& batches) const
{
  std::vector<Lanes> lights;
  for (const Probe& probe : this->Probes_)
  {
    Lanes light;
    for (int batch = 0; batch < Batches; ++batch)
    {
      const BatchState& state = batches[batch];
      double later = 0.0;
      for (const Piece& piece : probe.Pieces)
      {
        later += piece.Weight * state.FluenceSum[piece.Cell];
      }
      if (probe.SurfaceWeight > 0.0)
      {
        later += probe.SurfaceWeight * state.IlluminanceSum[probe.Side];
      }
      light[batch] = static_cast<float>(probe.Direct + later / std::max(1, state.Counted));
    }
    lights.push_back(light);
  }
  return lights;
}

std::vector<double> VeilProbes::Compared(const std::vector<Lanes>& lights) const
{
  std::vector<double> means;
  double sum = 0.0;
  for (const Lanes& light : lights)
  {
    means.push_back(std::max(0.0, Mean(light)));
    sum += means.back();
  }
  const double floor =
    this->Floor_ + this->MeanShare_ * sum / static_cast<double>(this->Probes_.size());
  for (double& mean : means)
  {
    mean += floor;
  }
  return means;
}

double VeilProbes::RelativeError(const std::vector<BatchState>& batches) const
{
  const std::vector<Lanes> lights = this->LightOf(batches);
  const std::vector<double> compared = this->Compared(lights);
  double squares = 0.0;
  int used = 0;
  for (std::size_t probe = 0; probe < lights.size(); ++probe)
  {
    if (compared[probe] > 0.0)
    {
      const double relative = StandardError(lights[probe]) / compared[probe];
      squares += relative * relative;
      ++used;
    }
  }
  return used > 0 ? std::sqrt(squares / used) : 0.0;
}

std::vector<float> VeilProbes::Weights(const std::vector<BatchState>& batches) const
{
  std::vector<float> weights(batches.front().FluenceSum.size(), 0.0F);
  const std::vector<double> compared = this->Compared(this->LightOf(batches));
  for (std::size_t probe = 0; probe < this->Probes_.size(); ++probe)
  {
    for (const Piece& piece : this->Probes_[probe].Pieces)
    {
      if (compared[probe] > 0.0)
      {
        const double share = piece.Weight / compared[probe];
        weights[piece.Cell] += static_cast<float>(share * share);
      }
    }
  }
  return weights;
}

double VeilProbes::WholeError(const std::vector<BatchState>& batches) const
{
  double errors = 0.0;
  double squares = 0.0;
  for (const Lanes& light : this->LightOf(batches))
  {
    const double mean = Mean(light);
    const double error = StandardError(light);
    squares += mean * mean;
    errors += error * error;
  }
  // What is no number must not pass for light that is known.
  return squares == 0.0 ? 0.0 : std::sqrt(errors / squares);
}

double VeilProbes::LargestShare(
  const std::function<double(std::int64_t)>& fluence, double illuminance) const
{
  double largest = 0.0;
  for (const Probe& probe : this->Probes_)
  {
    double later = probe.SurfaceWeight * illuminance;
    for (const Piece& piece : probe.Pieces)
    {
      later += piece.Weight * fluence(piece.Cell);
    }
    if (later > 0.0)
    {
      largest = std::max(largest, later / probe.Direct);
    }
  }
  return largest;
}

} // namespace smokevis
