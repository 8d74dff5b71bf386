// Which frames of a file hold at a time.
#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace smokevis
{

/// How values between two frames come about.
enum class TimeInterpolation
{
  /// The frame nearest in time, the earlier of two equally near.
  Nearest,
  /// Linear between the frames before and after; beyond the ends the end frames.
  Linear
};

/// One or two frames whose weighted sum is wanted.
struct FrameMix
{
  std::array<std::size_t, 2> Frame{};
  /// Adds up to 1; the second is 0 where one frame is all.
  std::array<double, 2> Weight{1.0, 0.0};
  /// The time that the mix stands for [s].
  double Time = 0.0;
};

/// Mixes the values of the second frame into those of the first.
void Mix(const FrameMix& mix, const std::vector<float>& second, std::vector<float>& values);

/// The frames of a file by time. A restarted run writes some times again: the later writing holds.
class FrameTimes
{
public:
  /// @param times of the frames in the order of the file [s]; at least one
  explicit FrameTimes(const std::vector<double>& times);

  FrameMix At(double time, TimeInterpolation interpolation) const;

private:
  std::vector<std::pair<double, std::size_t>> frames_;
};

/// The position in increasing @p times of the one nearest to @p time, the earlier of two.
std::size_t NearestOf(const std::vector<double>& times, double time);

} // namespace smokevis
