#include "SlopeWeights.h"

#include "Scene.h"

#include <algorithm>
#include <cmath>

namespace smokevis
{

namespace
{

/// By how much light falls off without any smoke, over the diagonal of the scene, from the start.
constexpr double GeometricFall = 1.0;
/// Share of a slope by which that between two cells differs from such a line, as it also does in
/// even smoke.
constexpr double Difference = 0.1;

} // namespace

SlopeWeights::SlopeWeights(const Scene& scene) : Scene_(scene)
{
  const double fall = GeometricFall / glm::length(scene.Upper() - scene.Lower());
  this->Geometric_ = fall * fall;
}

std::array<double, 2> SlopeWeights::Of(
  std::int64_t cell, int axis, const std::array<std::int64_t, 2>& beside) const
{
  const Medium& smoke = this->Scene_.Smoke();
  const double own = smoke.Extinction(cell);
  const Box bounds = smoke.CellBounds(cell);
  const double place = bounds.Centre()[axis];
  const double half = 0.5 * bounds.Size()[axis];
  // Between the cell and each of the others, in the mean.
  std::array<double, 2> extinction{};
  std::array<double, 2> distance{};
  for (const int side : {0, 1})
  {
    if (beside[side] >= 0)
    {
      const double apart = std::abs(smoke.CellCentre(beside[side])[axis] - place);
      const double inside = std::min(half, apart);
      extinction[side] = (inside * own + (apart - inside) * smoke.Extinction(beside[side])) / apart;
      distance[side] = apart;
    }
  }
  // Covariances of the slopes between cells with each other and with that in the cell.
  const auto covariance = [this](double a, double b) { return this->Geometric_ + a * b; };
  const std::array<double, 2> with = {
    covariance(own, extinction[0]), covariance(own, extinction[1])};
  for (const int side : {0, 1})
  {
    if (distance[1 - side] == 0.0)
    {
      std::array<double, 2> alone{};
      if (distance[side] > 0.0)
      {
        alone[side] = with[side] / covariance(extinction[side], extinction[side]) / distance[side];
      }
      return alone;
    }
  }
  const double mean = 0.5 * (extinction[0] + extinction[1]);
  const double noise = Difference * Difference * covariance(mean, mean);
  const std::array<double, 2> variance = {covariance(extinction[0], extinction[0]) + noise,
    covariance(extinction[1], extinction[1]) + noise};
  const double both = covariance(extinction[0], extinction[1]);
  // Even smoke is to come out as it is.
  const double scale =
    (1.0 + 0.5 * Difference * Difference) / (variance[0] * variance[1] - both * both);
  return {scale * (variance[1] * with[0] - both * with[1]) / distance[0],
    scale * (variance[0] * with[1] - both * with[0]) / distance[1]};
}

} // namespace smokevis
