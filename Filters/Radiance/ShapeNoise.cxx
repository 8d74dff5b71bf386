#include "ShapeNoise.h"

#include "ExponentialMean.h"
#include "Scene.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

namespace smokevis
{

namespace
{

/// Ratio of the means of cells so many places apart above which their slope is cut off.
const std::array<double, 3> SteepestRatio = {
  1.0, std::exp(CellShape::SteepestChange), std::exp(2.0 * CellShape::SteepestChange)};

} // namespace

ShapeNoise::ShapeNoise(
  const Scene& scene, const Lanes* lanes, const std::vector<float>& means, const CellShape& shape)
    : Open_(&scene.Open()), Lanes_(lanes), InverseMeans_(means.size()), Responses_(means.size()),
      Lower_(scene.Smoke().Lower())
{
  tbb::parallel_for(std::size_t{0}, means.size(),
    [&](std::size_t cell)
    {
      const float inverse = 1.0F / means[cell];
      this->InverseMeans_[cell] = means[cell] > 0.0F && std::isfinite(inverse) ? inverse : 0.0F;
    });
  tbb::parallel_for(std::size_t{0}, means.size(),
    [&](std::size_t cell)
    {
      // Only scattering cells are asked for.
      if (this->InverseMeans_[cell] > 0.0F &&
          scene.Smoke().Extinction(static_cast<std::int64_t>(cell)) > 0.0F)
      {
        this->Responses_[cell] = this->Find(scene, static_cast<std::int64_t>(cell), means, shape);
      }
    });
}

ShapeNoise::Response ShapeNoise::Find(const Scene& scene, std::int64_t cell,
  const std::vector<float>& means, const CellShape& shape) const
{
  const Vec3 centre = scene.Smoke().CellCentre(cell);
  const Vec3 size = scene.Smoke().CellSize(cell);
  Response response;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto ends = this->Ends(cell, axis);
    // In edges of the cell, as if its neighbours were as large.
    const int apart = (ends[0] != cell ? 1 : 0) + (ends[1] != cell ? 1 : 0);
    // Slopes that are cut off do not follow noise.
    const auto [least, most] = std::minmax(means[ends[0]], means[ends[1]]);
    if (apart > 0 && most < SteepestRatio[apart] * least)
    {
      response.Slope[axis] = static_cast<float>(means[cell] / (apart * size[axis]));
      // The mean over the cell stays what it is, whatever the slope.
      const double half = 0.5 * size[axis] * shape.LogarithmSlope(cell, axis);
      const double still = centre[axis] - this->Lower_[axis] + 0.5 * size[axis] * Langevin(half);
      response.Offset[axis] = static_cast<float>(-response.Slope[axis] * still);
    }
  }
  return response;
}

} // namespace smokevis
