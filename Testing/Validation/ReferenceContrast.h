// The contrast of a sign by the reference integrator.
#pragma once

#include "ReferenceIntegrator.h"

namespace smokevis
{

/// Contrast of a sign by path tracing a raster of 4 x 9 parts of each of its cells, which count by
/// their solid angle as in an image. What varies within a part counts, but for the square of what
/// smoke adds, which takes little part in it and is the noisiest. Noise of that square is taken
/// off, but for a single sample a part, which does not tell it.
/// @param sign its place among the scene's signs
Estimate ReferenceContrast(
  const Scene& scene, const Vec3& eye, std::uint64_t samples, std::size_t sign = 0);

} // namespace smokevis
