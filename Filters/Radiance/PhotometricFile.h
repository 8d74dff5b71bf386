// Luminous intensity distributions of fittings as their makers publish them: IES LM-63 files.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace smokevis
{

/// Intensities over a half-sphere, in the form that IntensityTable takes.
struct PhotometricHalf
{
  /// [degrees]
  std::vector<double> Polar, Azimuth;
  /// [azimuth][polar], in cd; empty: no light goes to this side.
  std::vector<double> Candela;
  /// [lm]
  double Flux = 0.0;
};

/// A luminaire's file of ANSI/IESNA LM-63-1986 to -2002 or ANSI/IES LM-63-19, type C photometry:
/// vertical angles count from straight down (nadir), horizontal angles counter-clockwise from
/// above. What symmetry leaves out of the file is filled in.
class PhotometricFile
{
public:
  /// Throws Error, with the number of the line, for what is damaged, incomplete or not supported.
  static PhotometricFile Read(const std::string& fileName);
  /// @param where what the text is from, for error messages
  static PhotometricFile Parse(const std::string& text, const std::string& where);

  /// Vertical angles, from 0 or 90 to 90 or 180, and horizontal angles, from 0 to 360 or 0 alone
  /// [degrees].
  std::vector<double> Vertical, Horizontal;
  /// [horizontal][vertical], with all factors of the file [cd].
  std::vector<double> Candela;
  /// Luminous flux of the bare lamps [lm]; negative where the file is of absolute photometry, which
  /// does not give one.
  double RatedFlux = -1.0;
  /// Luminous opening across the plane of horizontal angles 0 and 180, along it, and upwards [m]; a
  /// round one is replaced by a rectangle of the same area; 0 for a point.
  double Width = 0.0;
  double Length = 0.0;
  double Height = 0.0;

  /// Luminous flux of the luminaire, the integral of its intensity [lm].
  double Flux() const;
  /// What goes down and up; azimuths count as IntensityTable's do for a plate that faces that way.
  PhotometricHalf Down() const;
  PhotometricHalf Up() const;

private:
  PhotometricHalf Half(bool up) const;
  double At(std::size_t plane, double vertical) const;
};

} // namespace smokevis
