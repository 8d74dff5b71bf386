#include "CellShape.h"

#include "CellLoops.h"
#include "OpenFaces.h"
#include "Scene.h"
#include "SlopeWeights.h"

#include <algorithm>
#include <cmath>

namespace smokevis
{

namespace
{

/// Least slope of the logarithm of a field that falls off to nothing at the end of a cell [1/m]:
/// what the smoke takes away, and beyond that a straight line, of which the exponential has the
/// mean place. 0 where the smoke alone takes away as much.
/// @param ratio of its mean in the next cell to its own
/// @param apart the cells' centres [m], @param size of the cell [m]
double SlopeToEnd(double ratio, double extinction, double apart, double size)
{
  // Over the cell, of the mean there; twice that begins with nothing at its end.
  constexpr double FromNothing = 2.0;
  const double rise = (ratio * std::exp(-extinction * apart) - 1.0) * size / apart;
  return rise > 0.0 ? extinction + 2.0 / size * InverseLangevin(std::min(rise, FromNothing) / 6.0)
                    : 0.0;
}

} // namespace

CellShape::CellShape(const Scene& scene, const Means& means, const Ends& ends)
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
      std::array<double, 2> there{};
      for (const int side : {0, 1})
      {
        const std::int64_t other = open.Neighbour(cell, axis, side);
        const float light = other < 0 ? 0.0F : means(cell, other);
        if (light > 0.0F)
        {
          beside[side] = other;
          there[side] = light;
          rise[side] = (side == 0 ? -1.0 : 1.0) * std::log(light / own);
        }
      }
      if (beside[0] >= 0 || beside[1] >= 0)
      {
        const auto factors = weights.Of(cell, axis, beside);
        const double steepest = SteepestChange / size[axis];
        double slope = factors[0] * rise[0] + factors[1] * rise[1];
        const int only = beside[0] >= 0 ? 0 : 1;
        if (ends && beside[1 - only] < 0 && there[only] > own && ends(cell, axis, 1 - only))
        {
          const double apart = std::abs(smoke.CellCentre(beside[only])[axis] - centre[axis]);
          const double least = SlopeToEnd(
            there[only] / own, scene.LargestScale() * smoke.Extinction(cell), apart, size[axis]);
          slope = only == 0 ? std::min(slope, -least) : std::max(slope, least);
        }
        slope = std::clamp(slope, -steepest, steepest);
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
