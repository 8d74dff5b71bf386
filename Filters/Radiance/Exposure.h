// How much of each patch light can reach: signs hang on walls, boxes stand on floors, and models
// hold the same wall twice.
#pragma once

#include "Types.h"

#include <vector>

namespace smokevis
{

class Bodies;
class Geometry;
struct SurfaceMesh;

/// Areas of either side of each patch [m2]: [patch][side], patches of surfaces first. From places
/// on the patches, so that a share between none and all of a patch is known to a percent.
struct Exposure
{
  /// What nothing touches and covers. Triangles that repeat others have none.
  std::vector<double> Exposed;
  /// What a closed solid with a face of its own there stands on: it is dark.
  std::vector<double> Enclosed;

  bool AnyEnclosed() const;
};

/// @param bodies of the surfaces
Exposure FindExposure(const Geometry& shapes, const Bodies& bodies, const SurfaceMesh& surfaces,
  const SurfaceMesh& emitters);

} // namespace smokevis
