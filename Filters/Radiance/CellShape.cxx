#include "CellShape.h"

#include "CellLoops.h"
#include "OpenFaces.h"
#include "Scene.h"
#include "SlopeWeights.h"

#include <algorithm>
#include <cmath>

namespace smokevis
{

CellShape::CellShape(const Scene& scene, const Means& means)
{
  const OpenFaces& open = scene.Open();
  const Medium& smoke = scene.Smoke();
  const SlopeWeights weights(scene);
  this->Slopes_.resize(smoke.Cells());
  this->Lower_ = smoke.Lower();
  const auto find = [&](std::int64_t cell, double own)
  {
    const Box bounds = smoke.CellBounds(cell);
    const Vec3 centre = bounds.Centre();
    const Vec3 size = bounds.Size();
    double logarithm = 0.0;
    double offset = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      std::array<std::int64_t, 2> beside = {-1, -1};
      std::array<double, 2> rise{};
      for (const int side : {0, 1})
      {
        const std::int64_t other = open.Neighbour(cell, axis, side);
        const float there = other < 0 ? 0.0F : means(cell, other);
        if (there > 0.0F)
        {
          beside[side] = other;
          rise[side] = (side == 0 ? -1.0 : 1.0) * std::log(there / own);
        }
      }
      if (beside[0] >= 0 || beside[1] >= 0)
      {
        const auto factors = weights.Of(cell, axis, beside);
        const double steepest = SteepestChange / size[axis];
        const double slope =
          std::clamp(factors[0] * rise[0] + factors[1] * rise[1], -steepest, steepest);
        this->Slopes_[cell].Slope[axis] = static_cast<float>(slope);
        offset -= static_cast<float>(slope) * (centre[axis] - this->Lower_[axis]);
        logarithm += LogarithmOfMean(0.5 * slope * size[axis]);
      }
    }
    this->Slopes_[cell].Offset = static_cast<float>(offset - logarithm);
  };
  ForEachCell(smoke.Cells(),
    [&](std::int64_t cell)
    {
      const float own = means(cell, cell);
      // Only scattering cells are asked for.
      if (own > 0.0F && smoke.Extinction(cell) > 0.0F)
      {
        find(cell, own);
      }
    });
}

} // namespace smokevis
