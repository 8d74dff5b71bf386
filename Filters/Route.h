// A way that somebody walks: its places, and when they are reached.
#pragma once

#include "Types.h"

#include <cstddef>
#include <vector>

namespace smokevis
{

/// Places on the floor along a way, close enough to each other for what is seen to be taken as
/// linear between them.
struct Route
{
  std::vector<Vec3> Place;
  /// Length of the way up to each place [m].
  std::vector<double> Distance;
  /// When each is reached [s]; as many as are known.
  std::vector<double> Time;
  /// True where the times are given, false where they follow from the walking speed.
  bool TimesGiven = false;
};

/// Puts places between the corners of a way, at most a spacing [m] apart; with times, also at most
/// an interval [s]. Corners that repeat are left out. Throws Error where coordinates or times are
/// not finite, or times fall, or one time has two places.
/// @param times when each corner is reached [s]; empty: not known
Route SampleRoute(const std::vector<Vec3>& corners, const std::vector<double>& times,
  double spacing, double interval);

/// What is seen at each place of a route, in the order of its places.
struct RouteSight
{
  /// Largest perceived contrast of all signs.
  std::vector<double> Visibility;
  /// Whether a sign is in view: 0 or 1, so that several threads may write.
  std::vector<unsigned char> InView;
};

/// A route in short. Between its places the contrast is taken as linear; a sign is visible where it
/// is in view and its contrast at least the threshold.
struct RouteSummary
{
  double Length = 0.0, Duration = 0.0;
  /// Time and length of the way without a visible sign, and the longest such time without a break.
  double InvisibleTime = 0.0, InvisibleDistance = 0.0, LongestInvisibleTime = 0.0;
  /// When and where no sign is visible for the first time; NaN where one always is.
  double FirstLossTime = 0.0, FirstLossDistance = 0.0;
  Vec3 FirstLossPlace{0.0};
  double LeastVisibility = 0.0;
};

RouteSummary Summarize(const Route& route, const RouteSight& sight, double threshold);

} // namespace smokevis
