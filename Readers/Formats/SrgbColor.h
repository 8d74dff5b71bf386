// From colours as screens show them to reflectances.
#pragma once

#include <cmath>

namespace smokevis
{

/// Linear reflectance of an sRGB colour part (IEC 61966-2-1).
inline double LinearFromSrgb(double part)
{
  return part <= 0.04045 ? part / 12.92 : std::pow((part + 0.055) / 1.055, 2.4);
}

} // namespace smokevis
