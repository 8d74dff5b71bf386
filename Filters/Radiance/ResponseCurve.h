// What pixel value a camera makes of an exposure.
#pragma once

#include <string>
#include <vector>

namespace smokevis
{

/// The response curve of a camera at ISO 100: pixel value, 0 to 255, over the exposure of the
/// sensor [lx s]. At another speed S an exposure counts S/100 times.
class ResponseCurve
{
public:
  /// A film-like curve, 255 sRGB(1 - exp(-H / H0)): what reaches the film exposes ever fewer grains
  /// that are not yet exposed (the shoulder), and sRGB's encoding (IEC 61966-2-1) makes the toe. H0
  /// is such that 10/S lx s give 118, which is how ISO 12232 defines the standard output
  /// sensitivity S.
  ResponseCurve() = default;

  /// Reads a curve from a CSV file with the header `exposure,pixel_value`: exposures [lx s] from 0,
  /// rising; pixel values 0 to 255, not falling. Empty lines and lines that start with # are
  /// skipped. Throws Error with the line that is wrong.
  static ResponseCurve Read(const std::string& fileName);

  /// Pixel value, 0 to 255, not rounded. Between the points of a file it is linear in the logarithm
  /// of the exposure (from an exposure of 0 on: in the exposure); beyond them it stays the same.
  double Value(double exposure) const;

private:
  struct Point
  {
    double Exposure;
    double Value;
  };
  /// Empty: the film-like curve.
  std::vector<Point> Points_;
};

} // namespace smokevis
