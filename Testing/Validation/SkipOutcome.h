// A scene solved with or without skips, for tests that hold both against each other.
#pragma once

#include "RisingProgress.h"
#include "View.h"
#include "WorkCount.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>

namespace smokevis
{

struct Outcome
{
  std::shared_ptr<const Scene> TheScene;
  std::shared_ptr<const LightField> Field;
  double Seconds;

  double Count(const std::string& what) const { return WorkCount(this->Field->Report, what); }
};

inline Outcome Solve(const SceneDescription& description, bool skips, double tolerance = 0.1)
{
  Outcome run;
  run.TheScene = std::make_shared<const Scene>(description);
  LightFieldOptions options;
  options.Tolerance = tolerance;
  options.Skips = skips;
  Progress progress;
  const auto start = std::chrono::steady_clock::now();
  run.Field = std::make_shared<const LightField>(SolveLightField(*run.TheScene, options, progress));
  run.Seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return run;
}

/// Largest change of the direct fluence of smoky cells, over what is there.
inline double LargestChange(const Outcome& skipping, const Outcome& all)
{
  double worst = 0.0;
  for (std::size_t i = 0; i < all.Field->Cells; ++i)
  {
    const double value = all.Field->DirectFluence[i];
    if (value > 0.0 && all.TheScene->Smoke().Extinction(static_cast<std::int64_t>(i)) > 0.0F)
    {
      worst = std::max(worst, std::abs(skipping.Field->DirectFluence[i] - value) / value);
    }
  }
  return worst;
}

} // namespace smokevis
