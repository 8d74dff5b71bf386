#include "SkipComparison.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace smokevis::benchmark
{

namespace
{

/// With and without by turns, so often; the shortest of each counts.
constexpr int Turns = 3;

/// Largest difference over the reference value, of values that are at least a millionth of the
/// largest.
double LargestDifference(const Values& values, const Values& reference)
{
  double largest = 0.0;
  for (const double value : reference)
  {
    largest = std::max(largest, value);
  }
  double worst = 0.0;
  for (std::size_t i = 0; i < reference.size(); ++i)
  {
    if (reference[i] > 1e-6 * largest)
    {
      worst = std::max(worst, std::abs(values[i] - reference[i]) / reference[i]);
    }
  }
  return worst;
}

} // namespace

//--------------------------------------------------------------------------------------------------
void Compare(ResultTable& table, const std::string& skip, const std::string& scene,
  const std::function<Values(bool)>& run)
{
  std::array<double, 2> seconds{};
  std::array<Values, 2> values;
  for (int turn = 0; turn < Turns; ++turn)
  {
    for (const bool skips : {true, false})
    {
      const StopWatch watch;
      values[skips ? 0 : 1] = run(skips);
      double& shortest = seconds[skips ? 0 : 1];
      shortest = turn == 0 ? watch.Processors() : std::min(shortest, watch.Processors());
    }
  }
  table.Row({skip, scene, Number(seconds[0]), Number(seconds[1]), Number(seconds[1] / seconds[0]),
    Number(LargestDifference(values[0], values[1]))});
}

} // namespace smokevis::benchmark
