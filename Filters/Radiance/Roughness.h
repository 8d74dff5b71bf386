// How rough smoke is before a sign.
#pragma once

#include "SignVeil.h"

#include <vector>

namespace smokevis
{

/// Root mean square, weighted as the eye sees the places, of what is left of values at places of a
/// plate beside the quadratic over the plate that is closest to them.
double Roughness(const std::vector<SeenPlace>& places, const std::vector<double>& values);

} // namespace smokevis
