// The 8-bit photograph that a camera makes of an image of luminances.
#pragma once

#include "ResponseCurve.h"

#include <cstdint>
#include <vector>

namespace smokevis
{

/// How a camera is set.
struct ExposureSettings
{
  /// Focal length over the diameter of the aperture.
  double FNumber = 2.8;
  /// Size of the image over that of the thing; a lens that is focused nearby stands further from
  /// the sensor and its light spreads over (1 + magnification)^2 times the area.
  double Magnification = 0.0;
  /// Seconds; 0: what a light meter that averages over the picture asks for.
  double Time = 0.0;
  /// Speed, ISO 12232.
  double Iso = 100.0;
  /// Standard deviation of the read noise as a share of the exposure that saturates, 78/ISO lx s.
  double ReadNoise = 0.0;
  std::uint64_t Seed = 1;
};

/// Illuminance of the sensor [lx] behind a lens for a luminance [cd/m2], ISO 12232: E = q L / N^2,
/// q = pi/4 T v cos^4(a) = 0.65 with a transmittance T of 0.9, a vignetting factor v of 0.98 and an
/// angle a of 10 degrees off the axis; the N of a lens that is focused nearby is the f-number times
/// the distance to the image over the focal length, 1 + magnification.
double SensorIlluminance(double luminance, const ExposureSettings& settings);

/// Exposure of the sensor [lx s] for a luminance [cd/m2]: its illuminance times the time [s].
double FocalPlaneExposure(double luminance, const ExposureSettings& settings, double time);

/// Exposure time [s] that a meter for reflected light asks for, t = K N^2 / (L S) with K = 12.5
/// cd s/m2 (ISO 2720), within 1/8000 s and 30 s, the shutter's limits of common cameras.
double MeteredTime(double meanLuminance, const ExposureSettings& settings);

/// The photograph of an image.
struct Photograph
{
  /// As many as the luminances.
  std::vector<std::uint8_t> Values;
  /// Exposure time that was taken [s].
  double Time = 0.0;
};

/// Exposes and develops.
/// @param luminance [cd/m2], `components` (1, or 3 bands) a pixel
Photograph TakePhotograph(const std::vector<float>& luminance, int components,
  const ExposureSettings& settings, const ResponseCurve& curve);

} // namespace smokevis
