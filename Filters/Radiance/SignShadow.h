// Whether surfaces stand before all of a sign.
#pragma once

#include "Types.h"

namespace smokevis
{

struct Sign;
class View;

/// Whether triangles of surfaces hide all of a sign from an eye, at the cost of few rays: one leads
/// to a place on the plate, and the triangle that it meets casts its shadow, beyond which the next
/// place is looked for. False where a ray meets no surface, or one right before the plate or the
/// eye, and where that is not told quickly.
bool InShadowOfSurfaces(const View& view, const Sign& sign, const Vec3& eye);

} // namespace smokevis
