#include "ReferenceSign.h"

#include <algorithm>
#include <cmath>

namespace smokevis
{

namespace
{

/// Sums over points of a sign, which count by their solid angle.
struct PartSums
{
  double Weight = 0.0;
  /// Of the luminance and its square, and of the square of its standard error.
  double Sum = 0.0;
  double Square = 0.0;
  double Noise = 0.0;

  Estimate Mean() const
  {
    return {this->Sum / this->Weight, std::sqrt(this->Noise) / this->Weight};
  }
  PartSums operator+(const PartSums& other) const
  {
    return {this->Weight + other.Weight, this->Sum + other.Sum, this->Square + other.Square,
      this->Noise + other.Noise};
  }
};

} // namespace

//--------------------------------------------------------------------------------------------------
ReferenceSign MeasureByPaths(
  const Scene& scene, const Vec3& eye, std::uint64_t samples, std::size_t sign)
{
  const ReferenceIntegrator reference(scene);
  const std::vector<EmitterCell>& cells = scene.Lights().Cells();
  constexpr int Rows = 9;
  constexpr int Columns = 4;
  PartSums lit;
  PartSums unlit;
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
      PartSums& part = cells[cell].Luminance[0] > 0.0 ? lit : unlit;
      part.Weight += solid;
      part.Sum += solid * seen.Radiance.Mean;
      part.Square += solid * (seen.Square.Mean + seen.Added.Mean * seen.Added.Mean - added * added);
      part.Noise += solid * solid * seen.Radiance.StandardError * seen.Radiance.StandardError;
    }
  }
  const PartSums all = lit + unlit;
  const Estimate mean = all.Mean();
  const double spread = std::sqrt(std::max(0.0, all.Square / all.Weight - mean.Mean * mean.Mean));
  // The contrast's error is that of the mean, and of the spread, both of independent points.
  const double contrast = spread / mean.Mean;
  return {{contrast, mean.StandardError / mean.Mean * std::hypot(1.0, contrast)}, lit.Mean(),
    unlit.Mean()};
}

} // namespace smokevis
