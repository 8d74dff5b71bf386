// The contrast of a sign by the reference integrator.
#pragma once

#include "ReferenceIntegrator.h"

namespace smokevis
{

/// Contrast of the first sign by path tracing a raster of points on its plate. Noise adds to the
/// variance of the raster: its expectation, the mean square of the points' standard errors, is
/// taken off.
Estimate ReferenceContrast(const Scene& scene, const Vec3& eye, std::uint64_t samples);

} // namespace smokevis
