// Planes in space.
#pragma once

#include "Types.h"

namespace smokevis
{

/// Points with dot(Normal, point) above Offset lie in front. The normal has unit length.
struct Plane
{
  Vec3 Normal{0.0};
  double Offset = 0.0;

  double Height(const Vec3& point) const { return glm::dot(this->Normal, point) - this->Offset; }
};

} // namespace smokevis
