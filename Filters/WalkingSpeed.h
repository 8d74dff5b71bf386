// How smoke slows people down.
#pragma once

#include <algorithm>

namespace smokevis
{

enum class SpeedLaw
{
  /// Smoke does not matter.
  Constant = 0,
  /// H. Frantzich, D. Nilsson, Utrymning genom tät rök, report 3126, Lund University (2003), eq. 3:
  /// 0.706 - 0.057 K [m/s] for K from 1.9 to 7.4 1/m, made a share of the speed in clear air, and
  /// not less than a tenth of it, as FDS+Evac does (T. Korhonen, Technical Reference and User's
  /// Guide, eq. 11).
  FrantzichNilsson = 1,
  /// K. Fridolf, E. Ronchi, D. Nilsson, H. Frantzich, Tunnelling and Underground Space Technology
  /// 90 (2019) 28-41, eq. 7: 0.34 m/s less for each metre that the visibility A/K falls short of 3
  /// m, and not less than 0.2 m/s.
  Fridolf = 2
};

/// Walking speed [m/s] in smoke of an extinction coefficient [1/m].
/// @param clear the speed in clear air [m/s]
/// @param factor Fridolf's A, 2 for what reflects light and 8 for what emits it
inline double WalkingSpeed(SpeedLaw law, double clear, double extinction, double factor)
{
  switch (law)
  {
  case SpeedLaw::FrantzichNilsson:
    return clear * std::max(0.1, 1.0 - 0.057 / 0.706 * extinction);
  case SpeedLaw::Fridolf:
    return extinction * 3.0 <= factor
             ? clear
             : std::min(clear, std::max(0.2, clear - 0.34 * (3.0 - factor / extinction)));
  default:
    return clear;
  }
}

} // namespace smokevis
