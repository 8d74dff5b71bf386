#include "ShapeNoise.h"

#include "ExponentialMean.h"
#include "OwnGlow.h"
#include "Scene.h"
#include "SlopeWeights.h"

#include <cmath>

#include <tbb/parallel_for.h>

namespace smokevis
{

namespace
{

/// Change of the logarithm of a field across a cell above which its slope is cut off, but for
/// rounding.
constexpr double SteepestChange = (1.0 - 1e-6) * CellShape::SteepestChange;

} // namespace

ShapeNoise::ShapeNoise(const Scene& scene, int band, const Lanes* lanes,
  const std::vector<float>& means, const CellShape& shape)
    : Open_(&scene.Open()), Lanes_(lanes), InverseMeans_(means.size()), Responses_(means.size()),
      Lower_(scene.Smoke().Lower())
{
  tbb::parallel_for(std::size_t{0}, means.size(),
    [&](std::size_t cell)
    {
      const float inverse = 1.0F / means[cell];
      this->InverseMeans_[cell] = means[cell] > 0.0F && std::isfinite(inverse) ? inverse : 0.0F;
    });
  const SlopeWeights weights(scene);
  const OwnGlow glow(scene, band);
  tbb::parallel_for(std::size_t{0}, means.size(),
    [&](std::size_t cell)
    {
      // Only scattering cells are asked for.
      if (this->InverseMeans_[cell] > 0.0F &&
          scene.Smoke().Extinction(static_cast<std::int64_t>(cell)) > 0.0F)
      {
        const auto index = static_cast<std::int64_t>(cell);
        const double varying = means[cell] * glow.VaryingShare(index, means[cell]);
        this->Responses_[cell] = this->Find(scene, index, weights, varying, shape);
      }
    });
}

ShapeNoise::Response ShapeNoise::Find(const Scene& scene, std::int64_t cell,
  const SlopeWeights& weights, double mean, const CellShape& shape) const
{
  const Vec3 centre = scene.Smoke().CellCentre(cell);
  const Vec3 size = scene.Smoke().CellSize(cell);
  Response response;
  for (int axis = 0; axis < 3; ++axis)
  {
    std::array<std::int64_t, 2> beside = {-1, -1};
    for (const int side : {0, 1})
    {
      const std::int64_t other = this->Open_->Neighbour(cell, axis, side);
      beside[side] = other >= 0 && this->InverseMeans_[other] > 0.0F ? other : -1;
    }
    const double change = shape.LogarithmSlope(cell, axis) * size[axis];
    if (std::abs(change) < SteepestChange)
    {
      const auto factors = weights.Of(cell, axis, beside);
      response.Rise[axis] = {
        static_cast<float>(-mean * factors[0]), static_cast<float>(mean * factors[1])};
      // The mean over the cell stays what it is, whatever the slope.
      response.Still[axis] = static_cast<float>(
        centre[axis] - this->Lower_[axis] + 0.5 * size[axis] * Langevin(0.5 * change));
    }
  }
  return response;
}

} // namespace smokevis
