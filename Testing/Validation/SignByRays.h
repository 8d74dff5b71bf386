// What a view shows of a sign, by many rays.
#pragma once

#include "View.h"

namespace smokevis
{

struct SignByRays
{
  double Contrast = 0.0;
  /// Mean luminance of cells that emit light, and of those that do not [cd/m2]; not numbers where
  /// there are none.
  double LitLuminance = 0.0;
  double UnlitLuminance = 0.0;
};

/// Of the first sign of a scene, which nothing hides, without an observer's own noise and acuity.
/// @param steps of equal length over each of its cells, along both edges
SignByRays MeasureByRays(const View& view, const Vec3& eye, const glm::ivec2& steps);

} // namespace smokevis
