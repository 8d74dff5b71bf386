// What the reference integrator says of a sign.
#pragma once

#include "ReferenceIntegrator.h"

namespace smokevis
{

struct ReferenceSign
{
  /// Standard deviation over mean of the luminance.
  Estimate Contrast;
  /// Mean luminance of cells that emit light, and of those that do not [cd/m2]; not numbers where
  /// there are none.
  Estimate LitLuminance, UnlitLuminance;
};

/// By path tracing a raster of 4 x 9 parts of each of the sign's cells, which count by their solid
/// angle as in an image. What varies within a part counts in the contrast, but for the square of
/// what smoke adds, which takes little part in it and is the noisiest. Noise of that square is
/// taken off, but for a single sample a part, which does not tell it.
/// @param sign its place among the scene's signs
ReferenceSign MeasureByPaths(
  const Scene& scene, const Vec3& eye, std::uint64_t samples, std::size_t sign = 0);

} // namespace smokevis
