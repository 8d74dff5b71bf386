// The contrast of a sign by the reference integrator.
#pragma once

#include "ReferenceIntegrator.h"

namespace smokevis
{

/// Contrast of a sign by path tracing a raster of 4 x 9 points on each of its cells. Noise adds to
/// the variance of the raster: its expectation, the mean square of the points' standard errors, is
/// taken off, but for a single sample a point, which does not tell it.
/// @param sign its place among the scene's signs
Estimate ReferenceContrast(
  const Scene& scene, const Vec3& eye, std::uint64_t samples, std::size_t sign = 0);

} // namespace smokevis
