// Closed forms for the light of a uniform polygon.
#pragma once

#include "Types.h"

#include <array>

namespace smokevis
{

/// Solid angle of a triangle seen from a point [sr], 0 to 2 pi (van Oosterom and Strackee 1983).
double SolidAngle(const Vec3& point, const Vec3& a, const Vec3& b, const Vec3& c);
/// The same of a plane quadrilateral; the last corner may repeat the one before.
double SolidAngle(const Vec3& point, const std::array<Vec3, 4>& corners);

/// Illuminance on a plane at a point, over luminance, of a quadrilateral of uniform luminance,
/// clipped at the plane's horizon (Lambert's formula) [sr]. The last corner may repeat the one
/// before.
double ProjectedSolidAngle(
  const Vec3& point, const Vec3& normal, const std::array<Vec3, 4>& corners);

} // namespace smokevis
