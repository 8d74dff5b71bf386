#include "CellSteps.h"

#include "CellLoops.h"
#include "Scene.h"

#include <array>
#include <cmath>

namespace smokevis
{

namespace
{

/// Power of the albedo that the latest light's weight is: in soot the mean has less noise.
constexpr float LatestPower = 4.0F;

} // namespace

CellSteps::CellSteps(const Scene& scene, const std::vector<float>& extinction,
  const std::vector<float>& meetings, bool often)
    : Albedo_(static_cast<float>(scene.Albedo())),
      Latest_(often ? 1.0F : std::pow(Albedo_, LatestPower))
{
  // Weights, and their sum over steps.
  using Sums = std::array<double, 2>;
  const auto [weights, sum] = ReduceCells(
    extinction.size(), Sums{},
    [&](Sums& sums, std::int64_t cell)
    {
      const double weight = extinction[cell] * scene.Smoke().OwnVolume(cell);
      sums[0] += weight;
      sums[1] += weight * this->Step(meetings[cell], meetings[cell]);
    },
    [](const Sums& a, const Sums& b) {
      return Sums{a[0] + b[0], a[1] + b[1]};
    });
  this->MeanStep_ = weights > 0.0 ? sum / weights : 1.0;
}

} // namespace smokevis
