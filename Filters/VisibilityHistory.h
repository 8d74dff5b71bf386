// What a series of floor maps says of each place: how long a sign can be seen from there.
#pragma once

#include <cstddef>
#include <vector>

namespace smokevis
{

/// How a place fares between the first and the last map.
enum class PlaceOutcome : signed char
{
  /// A sign is visible all the time.
  Kept = 0,
  /// A sign is visible at some time, none at the end.
  Lost = 1,
  /// A sign is visible at the end, none at some time before.
  Interrupted = 2,
  /// Signs are in view, and none is ever visible.
  NeverVisible = 3,
  /// No sign is ever in view.
  NoSignInView = 4,
  /// The place lies inside a solid all the time.
  InsideSolid = 5
};

/// One map of the series, values a place.
struct VisibilityFrame
{
  double Time = 0.0;
  /// Largest perceived contrast, and the id of its sign, -1: no sign is in view.
  std::vector<float> Visibility;
  std::vector<int> BestSign;
  /// Whether the place lies inside a solid.
  std::vector<bool> InsideSolid;
};

/// Follows the maps one by one and keeps only the last, so that memory does not grow with their
/// number. A sign is visible where the largest perceived contrast is at least the threshold;
/// between two maps that contrast is taken as linear in time, 0 where no sign is in view.
class VisibilityHistory
{
public:
  /// @param threshold perceived contrast below which a sign counts as invisible
  VisibilityHistory(std::size_t places, double threshold);

  /// Takes the next map; throws Error where its time is not after the last one's, or its number of
  /// places differs.
  void Add(VisibilityFrame frame);

  /// Values a place; times are NaN where the outcome is NoSignInView or InsideSolid.
  struct Summary
  {
    std::vector<PlaceOutcome> Outcome;
    /// First time at which no sign is visible; the last map's where one always is.
    std::vector<double> AvailableTime;
    /// Time from which on none is visible; the last map's where one is visible at the end.
    std::vector<double> FinalLossTime;
    /// Interval between the two maps that AvailableTime lies between, 0 where it is no crossing.
    std::vector<double> AvailableTimeInterval;
    /// Time without a visible sign, all together.
    std::vector<double> InvisibleTime;
    /// Best sign in the first and the last map in which one is visible, -1: none.
    std::vector<int> FirstSign, LastSign;
    /// Smallest value of the largest perceived contrast.
    std::vector<float> LeastVisibility;
  };
  Summary Finish() const;

  std::size_t Frames() const { return this->Frames_; }
  double FirstTime() const { return this->FirstTime_; }
  double LastTime() const { return this->Last_.Time; }

private:
  bool Visible(const VisibilityFrame& frame, std::size_t place) const
  {
    return frame.BestSign[place] >= 0 && frame.Visibility[place] >= this->Threshold_;
  }
  void AddPlace(std::size_t place, const VisibilityFrame& frame, bool first);

  double Threshold_;
  std::size_t Frames_ = 0;
  double FirstTime_ = 0.0;
  VisibilityFrame Last_;
  Summary Sums_;
  /// Whether a sign was ever in view, ever visible, and ever invisible; whether the place was ever
  /// outside of solids.
  std::vector<bool> InView_, Seen_, Missed_, Free_;
};

} // namespace smokevis
