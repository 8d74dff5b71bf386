#include "ShapeNoise.h"

#include "ExponentialMean.h"
#include "OpenFaces.h"
#include "Scene.h"

#include <algorithm>
#include <array>
#include <cmath>

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
    : Scene_(&scene), Open_(&scene.Open()), Lanes_(lanes), Means_(&means), Shape_(&shape)
{
}

void ShapeNoise::Add(std::int64_t cell, const Vec3& point, double weight, Lanes& sum) const
{
  const std::vector<float>& means = *this->Means_;
  const Medium& smoke = this->Scene_->Smoke();
  const Vec3 size = smoke.CellSize(cell);
  const Vec3 from = (point - smoke.CellCentre(cell)) / size;
  for (int axis = 0; axis < 3; ++axis)
  {
    std::array<std::int64_t, 2> ends = {cell, cell};
    // In edges of the cell, as if its neighbours were as large.
    int apart = 0;
    for (const int side : {0, 1})
    {
      const std::int64_t other = this->Open_->Neighbour(cell, axis, side);
      if (other >= 0 && means[other] > 0.0F)
      {
        ends[side] = other;
        ++apart;
      }
    }
    // Slopes that are cut off do not follow noise.
    const auto [least, most] = std::minmax(means[ends[0]], means[ends[1]]);
    if (apart > 0 && most < SteepestRatio[apart] * least)
    {
      // The mean over the cell stays what it is, whatever the slope.
      const double half = 0.5 * size[axis] * this->Shape_->LogarithmSlope(cell, axis);
      const double share = weight * means[cell] * (from[axis] - 0.5 * Langevin(half)) / apart;
      smokevis::Add(sum, this->Lanes_[ends[1]], static_cast<float>(share / means[ends[1]]));
      smokevis::Add(sum, this->Lanes_[ends[0]], static_cast<float>(-share / means[ends[0]]));
    }
  }
}

} // namespace smokevis
