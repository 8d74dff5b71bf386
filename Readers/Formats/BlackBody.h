// How bright a black body looks.
#pragma once

namespace smokevis
{

/// Luminance of a black body [cd/m2]: 683 lm/W times the integral over the wavelength of Planck's
/// radiance weighted by the photopic efficiency V, here the fit of the CIE 1931 observer by two
/// Gaussians of Wyman, Sloan and Shirley (J. Computer Graphics Techniques 2, 2013), which is within
/// 1 % of the tables in such integrals. 0 below 500 C, where nothing glows visibly.
/// @param celsius temperature [C]
double BlackBodyLuminance(double celsius);

} // namespace smokevis
