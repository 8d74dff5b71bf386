// The perceived contrast that a sign cannot exceed, for skipping those that are not worth a look.
#include "Contrast.h"

#include "GaussNodes.h"
#include "PlateVeil.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/constants.hpp>

namespace smokevis
{

double PerceivedContrastBound(
  const View& view, std::size_t sign, const Vec3& eye, const Observer& observer)
{
  const EmitterSet& lights = view.TheScene().Lights();
  const Sign& plate = lights.Signs()[sign];
  const int bands = view.TheScene().Bands();
  double luminance = 0.0;
  for (const std::size_t cell : plate.Cells)
  {
    if (glm::dot(eye - lights.CellCentre(cell), lights.CellNormal(cell)) <= 0.0)
    {
      continue;
    }
    Spectrum value{};
    for (int band = 0; band < bands; ++band)
    {
      const std::size_t side =
        view.Field().PatchIndex(band, view.TheScene().SurfacePatches() + cell, 0);
      value[band] = lights.Cells()[cell].Luminance[band] +
                    lights.Cells()[cell].Reflectance[band] / glm::pi<double>() *
                      std::max(0.0, view.Field().DirectIlluminance[side] +
                                      Mean(view.Field().MultipleIlluminance[side]));
    }
    luminance = std::max(luminance, Luminance(value, bands));
  }
  double least = 1e300;
  for (const double u : Nodes3)
  {
    for (const double v : Nodes3)
    {
      const Vec3 to = OnPlate(plate, u, v) - eye;
      const double distance = glm::length(to);
      least =
        std::min(least, view.TheScene().Smoke().OpticalDepth(eye, to / distance, 0.0, distance));
    }
  }
  luminance *= std::exp(-view.TheScene().SmallestScale() * least);
  // Luminances between 0 and M, a share p of them at M, deviate most from their mean for the p that
  // maximises sqrt(p (1 - p)) M / (p M + dark): p = 1 / (M / dark + 2).
  if (luminance == 0.0)
  {
    return 0.0;
  }
  const double ratio = luminance / observer.DarkLuminance;
  return 0.5 * ratio / std::sqrt(ratio + 1.0);
}

} // namespace smokevis
