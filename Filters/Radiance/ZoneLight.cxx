#include "ZoneLight.h"

#include <algorithm>

namespace smokevis
{

ZoneLight::ZoneLight(
  const View& view, const SignSight& sight, const SignSight::Part& part, const ZoneChanges& changes)
{
  if (std::none_of(part.Zones.begin(), part.Zones.end(),
        [](const SignSight::Zone& zone) { return zone.Reflects; }))
  {
    return;
  }
  const Scene& scene = view.TheScene();
  std::array<std::vector<double>, MaxBands> smooth;
  for (const SignSight::Zone& zone : part.Zones)
  {
    const Vec3& middle = sight.Places()[zone.Place].Point;
    const Spectrum direct = view.DirectIlluminance(middle, part.Front.Normal);
    const std::size_t patch = scene.SurfacePatches() + zone.Cell;
    for (int band = 0; band < scene.Bands(); ++band)
    {
      const Lanes multiple = view.MultipleIlluminance(patch, 0, middle, band);
      // What is known of each cell by itself differs between them by noise.
      const bool even = view.Field().GradientOn(band, patch) == Vec3(0.0);
      smooth[band].push_back(direct[band] + (even ? 0.0 : Mean(multiple)));
      const double all = std::max(0.0, direct[band] + Mean(multiple));
      this->Bands_[band].push_back({all - Mean(multiple), multiple});
    }
  }
  for (int band = 0; band < scene.Bands(); ++band)
  {
    const std::vector<glm::dvec2> own = changes.Of(smooth[band]);
    for (std::size_t zone = 0; zone < own.size(); ++zone)
    {
      Illuminance& light = this->Bands_[band][zone];
      const double all = light.Direct + Mean(light.Multiple);
      light.Change = all > 0.0 ? own[zone] / all : glm::dvec2(0.0);
    }
  }
}

} // namespace smokevis
