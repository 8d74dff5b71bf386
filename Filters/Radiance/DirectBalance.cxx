#include "DirectBalance.h"

#include "LightField.h"
#include "NearLights.h"
#include "ReduceCells.h"
#include "Sampler.h"
#include "Scene.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace smokevis
{

namespace
{

/// Rays from all lights, and from each at least and at most.
constexpr std::size_t AllRays = 16384;
constexpr std::size_t FewestRays = 64;
constexpr std::size_t MostRays = 1024;

/// What cells that lights are near to get of these [lx].
float NearFluence(const NearLights& lights, std::size_t place, int band)
{
  double sum = 0.0;
  for (std::size_t light = 0; light < lights.Cells()[place].Lights.size(); ++light)
  {
    sum += lights.Mean(place, light, band);
  }
  return static_cast<float>(sum);
}

} // namespace

bool DirectBalance::Closed() const
{
  const std::vector<int>& lights = this->Scene_.Lights().Lights();
  if (lights.empty())
  {
    return false;
  }
  const Geometry& shapes = this->Scene_.Shapes();
  const std::size_t rays = std::clamp(AllRays / lights.size(), FewestRays, MostRays);
  for (std::size_t light = 0; light < lights.size(); ++light)
  {
    const LightGroup& root = this->Scene_.Lights().Root(light);
    const Vec3 along = glm::normalize(root.Corners[1] - root.Corners[0]);
    const EvenPoints points(Mix(light));
    for (std::size_t i = 0; i < rays; ++i)
    {
      const auto random = points.Point(i);
      const Hit hit =
        shapes.Intersect(root.At(random[0], random[1]) + 10.0 * shapes.Tolerance() * root.Normal,
          LambertianDirection(root.Normal, along, random[2], random[3]), 0.0,
          std::numeric_limits<double>::infinity());
      // Of what is dark, since it lies in a solid, nothing is known.
      if (!hit.Found() || this->Scene_.ExposedArea(this->Scene_.Patch(hit), hit.Side) == 0.0)
      {
        return false;
      }
    }
  }
  return true;
}

double DirectBalance::CaptureOf(std::int64_t cell, int band) const
{
  const Medium& smoke = this->Scene_.Smoke();
  return smoke.Extinction(cell) * this->Scene_.ExtinctionScale(band) * smoke.OwnVolume(cell);
}

std::optional<double> DirectBalance::Scale(int band) const
{
  const Scene& scene = this->Scene_;
  double emitted = 0.0;
  for (std::size_t cell = 0; cell < scene.Lights().Cells().size(); ++cell)
  {
    emitted += scene.Lights().LeftToLines(cell) ? 0.0 : scene.Lights().CellFlux(cell, band);
  }
  float* const fluence = this->Field_.DirectFluence.data() + this->Field_.CellIndex(band, 0);
  double rest = ReduceCells(
    this->Field_.Cells, 0.0,
    [&](double& sum, std::int64_t cell) { sum += this->CaptureOf(cell, band) * fluence[cell]; },
    std::plus<>());
  float* const illuminance =
    this->Field_.DirectIlluminance.data() + this->Field_.PatchIndex(band, 0, 0);
  const std::size_t sides = 2 * this->Field_.Patches;
  for (std::size_t side = 0; side < sides; ++side)
  {
    rest += scene.ExposedArea(side / 2, side % 2) * illuminance[side];
  }
  // What is known from close to the lights stays as it is.
  const NearLights& lights = scene.Near();
  std::vector<float> near(lights.Cells().size());
  double known = 0.0;
  for (std::size_t place = 0; place < near.size(); ++place)
  {
    const std::int64_t cell = lights.Cells()[place].Index;
    near[place] = std::min(fluence[cell], NearFluence(lights, place, band));
    known += this->CaptureOf(cell, band) * near[place];
  }
  const double scale = (emitted - known) / (rest - known);
  if (!(std::abs(scale - 1.0) < MostChange))
  {
    return std::nullopt;
  }
  const auto factor = static_cast<float>(scale);
  for (std::size_t cell = 0; cell < this->Field_.Cells; ++cell)
  {
    const int place = lights.Place(static_cast<std::int64_t>(cell));
    const float kept = place < 0 ? 0.0F : near[place];
    fluence[cell] = kept + factor * (fluence[cell] - kept);
  }
  std::transform(illuminance, illuminance + sides, illuminance,
    [factor](float value) { return factor * value; });
  return scale;
}

} // namespace smokevis
