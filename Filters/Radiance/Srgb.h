// The encoding of light in 8-bit images, IEC 61966-2-1 (sRGB).
#pragma once

#include <cmath>

namespace smokevis
{

/// The value, 0 to 1, that stands for a share of light, 0 to 1.
inline double EncodeSrgb(double light)
{
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055;
}

/// The inverse of EncodeSrgb.
inline double DecodeSrgb(double value)
{
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

} // namespace smokevis
