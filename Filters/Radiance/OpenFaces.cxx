#include "OpenFaces.h"

#include "Scene.h"

#include <algorithm>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace smokevis
{

namespace
{

/// Share of the cells' edges that the line between two centres is moved by: walls and edges of
/// plates often lie right in the planes of the centres, where rounding would decide.
const Vec3 Aside(0.0137, 0.0091, 0.0113);

} // namespace

OpenFaces::OpenFaces(const Scene& scene)
{
  const Medium& smoke = scene.Smoke();
  const Geometry& shapes = scene.Shapes();
  // Only cells that the box around a triangle touches, or whose neighbour's it does, can be parted
  // from a neighbour.
  std::vector<unsigned char> touched(smoke.Cells(), 0);
  const double gap = 4.0 * shapes.Tolerance();
  scene.ForEachTriangle(
    [&](std::size_t, const Triangle& corners)
    {
      const Box bounds = BoundsOf(corners);
      smoke.ForCellsIn(bounds.Lower - gap, bounds.Upper + gap,
        [&touched](std::int64_t cell) { touched[cell] = 1; });
    });
  this->Neighbours_.assign(smoke.Cells(), {-1, -1, -1, -1, -1, -1});
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, smoke.Cells(), 1024),
    [&](const tbb::blocked_range<std::size_t>& range)
    {
      for (std::size_t cell = range.begin(); cell < range.end(); ++cell)
      {
        const Vec3 centre = smoke.CellCentre(static_cast<std::int64_t>(cell));
        for (int axis = 0; axis < 3; ++axis)
        {
          for (int side = 0; side < 2; ++side)
          {
            const std::int64_t other = smoke.Neighbour(static_cast<std::int64_t>(cell), axis, side);
            if (other < 0)
            {
              continue;
            }
            bool open = touched[cell] == 0 && touched[other] == 0;
            if (!open)
            {
              Vec3 target = centre;
              target[axis] = smoke.CellCentre(other)[axis];
              double length = std::abs(target[axis] - centre[axis]);
              if (smoke.Parts().Find(static_cast<std::int64_t>(cell)) || smoke.Parts().Find(other))
              {
                target = smoke.CellCentre(other);
                length = std::max(glm::distance(target, centre), 1e-300);
              }
              const Vec3 shift = Aside * glm::min(smoke.CellSize(static_cast<std::int64_t>(cell)),
                                           smoke.CellSize(other));
              open = !shapes.Occluded(centre + shift, (target - centre) / length, 0.0, length);
            }
            this->Neighbours_[cell][2 * axis + side] = open ? static_cast<std::int32_t>(other) : -1;
          }
        }
      }
    });
}

} // namespace smokevis
