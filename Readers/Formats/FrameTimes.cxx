#include "FrameTimes.h"

#include <algorithm>

namespace smokevis
{

//------------------------------------------------------------------------------------------------
void Mix(const FrameMix& mix, const std::vector<float>& second, std::vector<float>& values)
{
  const auto before = static_cast<float>(mix.Weight[0]);
  const auto after = static_cast<float>(mix.Weight[1]);
  std::transform(values.begin(), values.end(), second.begin(), values.begin(),
    [before, after](float a, float b) { return before * a + after * b; });
}

//------------------------------------------------------------------------------------------------
FrameTimes::FrameTimes(const std::vector<double>& times)
{
  frames_.reserve(times.size());
  for (std::size_t frame = 0; frame < times.size(); ++frame)
  {
    frames_.emplace_back(times[frame], frame);
  }
  std::sort(frames_.begin(), frames_.end());
  std::size_t kept = 0;
  for (const auto& one : frames_)
  {
    kept += kept > 0 && frames_[kept - 1].first == one.first ? 0 : 1;
    frames_[kept - 1] = one;
  }
  frames_.resize(kept);
}

//------------------------------------------------------------------------------------------------
FrameMix FrameTimes::At(double time, TimeInterpolation interpolation) const
{
  const auto after = std::lower_bound(
    frames_.begin(), frames_.end(), time, [](const auto& one, double t) { return one.first < t; });
  const auto one = [](const auto& frame) {
    return FrameMix{{frame.second, frame.second}, {1.0, 0.0}, frame.first};
  };
  if (after == frames_.begin() || (after != frames_.end() && after->first == time))
  {
    return one(*after);
  }
  const auto& before = *(after - 1);
  if (after == frames_.end())
  {
    return one(before);
  }
  if (interpolation == TimeInterpolation::Nearest)
  {
    return one(after->first - time < time - before.first ? *after : before);
  }
  const double weight = (time - before.first) / (after->first - before.first);
  return {{before.second, after->second}, {1.0 - weight, weight}, time};
}

//------------------------------------------------------------------------------------------------
std::size_t NearestOf(const std::vector<double>& times, double time)
{
  const auto after = std::lower_bound(times.begin(), times.end(), time);
  if (after == times.begin())
  {
    return 0;
  }
  const auto place = static_cast<std::size_t>(after - times.begin());
  return after != times.end() && *after - time < time - *(after - 1) ? place : place - 1;
}

} // namespace smokevis
