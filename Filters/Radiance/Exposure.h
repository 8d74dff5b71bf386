// How much of each patch light can reach: signs hang on walls, boxes stand on floors, and models
// hold the same wall twice.
#pragma once

#include "Types.h"

#include <vector>

namespace smokevis
{

class Geometry;
struct SurfaceMesh;

/// Area of either side of each patch that nothing touches and covers [m2]: [patch][side], patches
/// of surfaces first. Triangles that repeat others have none. From places on the patches, so that a
/// share between none and all of a patch is known to a percent.
std::vector<double> ExposedAreas(
  const Geometry& shapes, const SurfaceMesh& surfaces, const SurfaceMesh& emitters);

} // namespace smokevis
