#include "SharedCorners.h"

#include <algorithm>
#include <cmath>

namespace smokevis
{

namespace
{

/// Share of the scene's size that corners which are one may lie apart.
constexpr double SameCorner = 1e-7;

} // namespace

SharedCorner MakeSharedCorner(
  std::uint32_t kind, const Vec3& place, std::uint32_t shape, double sceneSize)
{
  const Vec3 steps = place / (SameCorner * sceneSize);
  return {kind, {std::llround(steps.x), std::llround(steps.y), std::llround(steps.z)}, shape};
}

void UniteAtCorners(std::vector<SharedCorner>& corners, boost::disjoint_sets_with_storage<>& shapes)
{
  std::sort(corners.begin(), corners.end());
  for (std::size_t i = 1; i < corners.size(); ++i)
  {
    if (corners[i].Kind == corners[i - 1].Kind && corners[i].Place == corners[i - 1].Place)
    {
      shapes.union_set(corners[i - 1].Shape, corners[i].Shape);
    }
  }
}

} // namespace smokevis
