// What uneven smoke leaves unknown of a sign's contrast, since each zone of its plate is looked at
// in its middle.
#pragma once

#include "PixelMoments.h"

#include <cstddef>
#include <vector>

namespace smokevis
{

/// What is unknown of a zone, as standard errors.
struct ZoneError
{
  /// Of the optical depth in its middle as that of all of it.
  double Depth = 0.0;
  /// Of the veil there [cd/m2].
  double Veil = 0.0;
};

/// The standard error that this makes of a sign's contrast. The errors of its zones are taken to be
/// independent of each other, which what second differences tell too much of smooth changes makes
/// up for.
class DivisionError
{
public:
  /// Adds a plane part of the sign.
  /// @param blocks of the pattern
  /// @param zoneOf each block
  void Add(const PlatePattern& pattern, const std::vector<SeenBlock>& blocks,
    const std::vector<std::size_t>& zoneOf, const std::vector<ZoneError>& zones);

  /// Of the ratio of the standard deviation to mean and dark luminance.
  /// @param seen weight of all pixels
  double OfRatio(const Moments& moments, double seen, double dark) const;

private:
  /// What an independent error changes of the sums over pixels of luminance and its square.
  struct Change
  {
    double First = 0.0;
    double Second = 0.0;
  };

  std::vector<Change> Changes_;
};

} // namespace smokevis
