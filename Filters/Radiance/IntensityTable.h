// Measured spread of a lamp's light over the directions before its plate.
#pragma once

#include "Types.h"

#include <string>
#include <vector>

namespace smokevis
{

/// Luminous intensity over the half-sphere before a plate, interpolated bilinearly in the two
/// angles, and scaled so that it integrates to pi, as the cosine of a Lambertian plate does.
class IntensityTable
{
public:
  /// Throws Error for angles that do not ascend over the whole half-sphere, for intensities that
  /// are negative or not finite, and where all are 0.
  /// @param polar angles from the plate's normal, from 0 to 90 [degrees]
  /// @param azimuth angles around the normal, from 0 to 360 [degrees]; or 0 alone, where the light
  /// is the same all around
  /// @param intensity [azimuth][polar], in any unit
  /// @param where what the table belongs to, for error messages
  IntensityTable(std::vector<double> polar, std::vector<double> azimuth,
    std::vector<double> intensity, const std::string& where = "intensity table");

  const std::vector<double>& Polar() const { return this->Polar_; }
  const std::vector<double>& Azimuth() const { return this->Azimuth_; }
  const std::vector<double>& Intensity() const { return this->Intensity_; }

  /// Scaled intensity in a direction.
  /// @param x, y, z the direction's parts along the axis where the azimuth is 0, along that where
  /// it is 90 degrees, and along the normal
  double Value(double x, double y, double z) const;
  /// Largest scaled intensity.
  double Largest() const { return this->Largest_; }
  /// Largest slope over the angle, as a share of the largest value [1/rad].
  double Sharpness() const { return this->Sharpness_; }

  /// Integral over the half-sphere of an intensity given like the constructor's: its flux [lm] for
  /// intensities in cd. Exact for the bilinear interpolation.
  static double Flux(const std::vector<double>& polar, const std::vector<double>& azimuth,
    const std::vector<double>& intensity);

  bool operator==(const IntensityTable&) const = default;

private:
  void Check(const std::string& where) const;

  std::vector<double> Polar_, Azimuth_, Intensity_;
  double Largest_ = 1.0;
  double Sharpness_ = 1.0;
};

} // namespace smokevis
