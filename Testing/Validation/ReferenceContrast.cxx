#include "ReferenceContrast.h"

#include <algorithm>
#include <cmath>

namespace smokevis
{

//--------------------------------------------------------------------------------------------------
Estimate ReferenceContrast(
  const Scene& scene, const Vec3& eye, std::uint64_t samples, std::size_t sign)
{
  const ReferenceIntegrator reference(scene);
  const std::vector<EmitterCell>& cells = scene.Lights().Cells();
  constexpr int Rows = 9;
  constexpr int Columns = 4;
  double sum = 0.0;
  double square = 0.0;
  double noise = 0.0;
  int points = 0;
  for (const std::size_t cell : scene.Lights().Signs()[sign].Cells)
  {
    const std::vector<Vec3>& corner = cells[cell].Vertices;
    for (int point = 0; point < Rows * Columns; ++point, ++points)
    {
      // One point is drawn anywhere in its part of the raster for each sample.
      const auto draw = [&, point](Pcg32& random)
      {
        const double u = (point % Columns + random.Uniform()) / Columns;
        const double v = (point / Columns + random.Uniform()) / Rows;
        const Vec3 at = corner[0] + u * (corner[1] - corner[0]) + v * (corner[3] - corner[0]);
        return Ray{eye, glm::normalize(at - eye)};
      };
      const RayMoments seen =
        reference.MomentsOfRadiance(draw, samples, static_cast<std::uint64_t>(points));
      const double added = seen.Added.StandardError;
      sum += seen.Radiance.Mean;
      square += seen.Square.Mean + seen.Added.Mean * seen.Added.Mean - added * added;
      noise += seen.Radiance.StandardError * seen.Radiance.StandardError;
    }
  }
  const double mean = sum / points;
  const double spread = std::sqrt(std::max(0.0, square / points - mean * mean));
  // The contrast's error is that of the mean, and of the spread, both of independent points.
  const double meanError = std::sqrt(noise) / points;
  const double contrast = spread / mean;
  return {contrast, meanError / mean * std::hypot(1.0, contrast)};
}

} // namespace smokevis
