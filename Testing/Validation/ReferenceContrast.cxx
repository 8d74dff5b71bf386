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
  double weight = 0.0;
  int points = 0;
  for (const std::size_t cell : scene.Lights().Signs()[sign].Cells)
  {
    const std::vector<Vec3>& corner = cells[cell].Vertices;
    const Vec3 along = corner[1] - corner[0];
    const Vec3 up = corner[3] - corner[0];
    const auto place = [&](int point, double u, double v) {
      return corner[0] + (point % Columns + u) / Columns * along +
             (point / Columns + v) / Rows * up;
    };
    for (int point = 0; point < Rows * Columns; ++point, ++points)
    {
      // One point is drawn anywhere in its part of the raster for each sample.
      const auto draw = [&, point](Pcg32& random)
      {
        const double u = random.Uniform();
        return Ray{eye, glm::normalize(place(point, u, random.Uniform()) - eye)};
      };
      const RayMoments seen =
        reference.MomentsOfRadiance(draw, samples, static_cast<std::uint64_t>(points));
      const double added = seen.Added.StandardError;
      const Vec3 way = place(point, 0.5, 0.5) - eye;
      const double solid =
        std::abs(glm::dot(glm::cross(along, up), way)) / std::pow(glm::length(way), 3.0);
      weight += solid;
      sum += solid * seen.Radiance.Mean;
      square += solid * (seen.Square.Mean + seen.Added.Mean * seen.Added.Mean - added * added);
      noise += solid * solid * seen.Radiance.StandardError * seen.Radiance.StandardError;
    }
  }
  const double mean = sum / weight;
  const double spread = std::sqrt(std::max(0.0, square / weight - mean * mean));
  // The contrast's error is that of the mean, and of the spread, both of independent points.
  const double meanError = std::sqrt(noise) / weight;
  const double contrast = spread / mean;
  return {contrast, meanError / mean * std::hypot(1.0, contrast)};
}

} // namespace smokevis
