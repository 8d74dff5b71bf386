// Triangles in space.
#pragma once

#include "Box.h"
#include "Types.h"

#include <algorithm>
#include <array>

namespace smokevis
{

/// Its corners [m].
using Triangle = std::array<Vec3, 3>;

/// Points to where the corners turn counterclockwise, and is as long as the area [m2].
inline Vec3 AreaVector(const Triangle& corners)
{
  return 0.5 * glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
}

inline double AreaOf(const Triangle& corners)
{
  return glm::length(AreaVector(corners));
}

inline Vec3 CentreOf(const Triangle& corners)
{
  return (corners[0] + corners[1] + corners[2]) / 3.0;
}

/// Distance of the farthest corner from the centre [m].
inline double ReachOf(const Triangle& corners)
{
  const Vec3 centre = CentreOf(corners);
  return std::max({glm::length(corners[0] - centre), glm::length(corners[1] - centre),
    glm::length(corners[2] - centre)});
}

inline Box BoundsOf(const Triangle& corners)
{
  return Box::Around(corners);
}

} // namespace smokevis
