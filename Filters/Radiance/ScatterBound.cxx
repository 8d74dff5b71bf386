#include "ScatterBound.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/gtc/constants.hpp>

namespace smokevis
{

//--------------------------------------------------------------------------------------------------
std::optional<ScatterBound> ScatterBound::Of(const Scene& scene, int band)
{
  const EmitterSet& lights = scene.Lights();
  bool known = !scene.Smoke().Emits() && !(scene.Sky() > 0.0);
  for (std::size_t cell = 0; cell < lights.Cells().size() && known; ++cell)
  {
    known = !lights.LeftToLines(cell) && !lights.CellLaw(cell).Measured();
  }
  if (!known)
  {
    return std::nullopt;
  }
  const ScatterBound bound(scene, band);
  return bound.Holds_ ? std::optional(bound) : std::nullopt;
}

//--------------------------------------------------------------------------------------------------
ScatterBound::ScatterBound(const Scene& scene, int band) : Scene_(scene), Band_(band)
{
  constexpr double pi = glm::pi<double>();
  const Medium& smoke = scene.Smoke();
  for (const EmitterCell& cell : scene.Lights().Cells())
  {
    this->Brightest_ = std::max(this->Brightest_, cell.Luminance[band]);
  }
  double reflectance = 0.0;
  for (std::size_t patch = 0; patch < scene.Patches(); ++patch)
  {
    reflectance = std::max(reflectance, scene.PatchReflectance(patch)[band]);
  }
  const double extinction = smoke.MaximumExtinction() * scene.ExtinctionScale(band);
  const double lost = -std::expm1(-extinction * glm::length(smoke.Upper() - smoke.Lower()));
  const double sent = scene.Albedo() * lost + reflectance;
  this->Holds_ = sent < 1.0;
  if (!this->Holds_)
  {
    return;
  }
  this->Scattered_ = scene.Albedo() * extinction * 0.5 * (0.5 * pi + 1.0);
  double closest = 0.0;
  for (const int light : scene.Lights().Lights())
  {
    const double intensity = scene.Lights().Groups()[light].Intensity[band];
    closest += 2.0 * std::sqrt(pi * intensity * this->Brightest_);
  }
  const double scattered = this->Scattered_ * closest;
  const double reflected = reflectance > 0.0 ? this->ReflectedOnce() : 0.0;
  // The highest luminances that are sent on of that, and all that follows.
  const double bySmoke = scene.Albedo() * (scattered / (4.0 * pi) + reflected);
  const double bySurfaces = reflectance * (scattered / pi + reflected);
  const double later = (lost * bySmoke + bySurfaces) / (1.0 - sent);
  this->Everywhere_ = 4.0 * pi * (reflected + later);
  this->Illuminance_ = scattered + pi * (reflected + later);
}

//--------------------------------------------------------------------------------------------------
double ScatterBound::Closeness(const Vec3& place, double within) const
{
  double sum = 0.0;
  for (const int light : this->Scene_.Lights().Lights())
  {
    const LightGroup& root = this->Scene_.Lights().Groups()[light];
    const double intensity = root.Intensity[this->Band_];
    const double nearest = 2.0 * std::sqrt(glm::pi<double>() * intensity * this->Brightest_);
    const double distance = glm::length(place - root.Centre) - root.Radius - within;
    sum += distance > 0.0 ? std::min(nearest, intensity / distance) : nearest;
  }
  return sum;
}

//--------------------------------------------------------------------------------------------------
double ScatterBound::ReflectedOnce() const
{
  constexpr double pi = glm::pi<double>();
  double highest = 0.0;
  this->Scene_.ForEachTriangle(
    [&](std::size_t patch, const Triangle& corners)
    {
      const double reflectance = this->Scene_.PatchReflectance(patch)[this->Band_];
      if (reflectance == 0.0)
      {
        return;
      }
      const Vec3 centre = CentreOf(corners);
      const double reach = ReachOf(corners);
      double illuminance = 0.0;
      for (const int light : this->Scene_.Lights().Lights())
      {
        const LightGroup& root = this->Scene_.Lights().Groups()[light];
        const double distance = glm::length(centre - root.Centre) - root.Radius - reach;
        const double nearest = pi * this->Brightest_;
        illuminance += distance > 0.0
                         ? std::min(nearest, root.Intensity[this->Band_] / (distance * distance))
                         : nearest;
      }
      highest = std::max(highest, reflectance * illuminance / pi);
    });
  return highest;
}

//--------------------------------------------------------------------------------------------------
double ScatterBound::Fluence(std::int64_t cell) const
{
  const Medium& smoke = this->Scene_.Smoke();
  // A part of a cell lies within the cell.
  const std::int64_t whole = smoke.Parts().CellOf(cell);
  const Box box = smoke.BoxOf(whole);
  return this->Everywhere_ + this->Scattered_ * this->Closeness(0.5 * (box.Lower + box.Upper),
                                                  0.5 * glm::length(box.Upper - box.Lower));
}

} // namespace smokevis
