// The observer's eye as the properties of the filters describe it.
#pragma once

#include "Eye.h"

namespace smokevis
{

/// Checks the properties that all filters with an eye share and throws Error with the name of the
/// one at fault. Returns the rested eye.
/// @param acuity [minutes of arc]
Observer CheckedEye(double darkLuminance, double acuity, const Adaptation& state);

} // namespace smokevis
