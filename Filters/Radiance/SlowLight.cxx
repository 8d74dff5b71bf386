#include "SlowLight.h"

#include "LineSweep.h"
#include "Scene.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace smokevis
{

namespace
{

/// Growth from window to window, the later twice as long, of light that has yet to grow much, and
/// how many standard errors it must be. Where that is sure of some sides, it need be less so of
/// others: a small one that is left out, such as the lamp's in a white box, is known poorly, and
/// takes away most of what the box would come to.
constexpr double LeastGrowth = 0.1;
constexpr double Deviations = 3.0;
constexpr double CompanyDeviations = 1.0;
/// Light on darker surfaces than this settles by itself.
constexpr double LeastReflectance = 0.5;
/// Standard error that what the light grows to may have. It shows in the spread of the batches.
constexpr double LargestError = 0.3;
/// A batch does not leave the mean by more than this factor, nor change at once by more than that.
constexpr double LargestSpread = 4.0;
constexpr double LargestScale = 1e4;

} // namespace

//--------------------------------------------------------------------------------------------------
SlowLight::SlowLight(const Scene& scene, LineSweep& sweep, int band)
    : Scene_(scene), Sweep_(sweep), Band_(band)
{
}

//--------------------------------------------------------------------------------------------------
void SlowLight::Watch(std::vector<BatchState>& batches, bool grows)
{
  const std::size_t sides = batches.front().IlluminanceSum.size();
  std::vector<float> now(sides);
  std::vector<bool> watched(sides, false);
  bool any = false;
  for (std::size_t side = 0; side < sides; ++side)
  {
    Lanes lanes;
    for (int batch = 0; batch < Batches; ++batch)
    {
      lanes[batch] = batches[batch].IlluminanceSum[side] /
                     static_cast<float>(std::max(1, batches[batch].Counted));
    }
    now[side] = static_cast<float>(Mean(lanes));
    if (grows && !this->Earlier_.empty() &&
        this->Scene_.PatchReflectance(side / 2)[this->Band_] > LeastReflectance)
    {
      const double growth = now[side] - this->Earlier_[side];
      if (growth > LeastGrowth * std::max(0.0F, this->Earlier_[side]))
      {
        watched[side] = growth > CompanyDeviations * StandardError(lanes);
        any = any || growth > Deviations * StandardError(lanes);
      }
    }
  }
  this->Earlier_ = std::move(now);
  for (BatchState& batch : batches)
  {
    batch.Watched = {};
  }
  this->Sweep_.Watch(any ? std::move(watched) : std::vector<bool>());
}

//--------------------------------------------------------------------------------------------------
bool SlowLight::Balance(std::vector<BatchState>& batches)
{
  const std::vector<bool>& watched = this->Sweep_.Watched();
  if (watched.empty())
  {
    return false;
  }
  WatchedLight mean;
  for (const BatchState& batch : batches)
  {
    mean.Held += batch.Watched.Held / Batches;
    mean.Lost += batch.Watched.Lost / Batches;
    mean.Gained += batch.Watched.Gained / Batches;
  }
  if (!(mean.Held > 0.0 && mean.Lost > 0.0 && mean.Gained > 0.0))
  {
    return false;
  }
  // A ratio of sums over all batches has little bias; to first order its error is the spread of
  // what each batch changes of it.
  std::vector<double> changes;
  double squares = 0.0;
  for (const BatchState& batch : batches)
  {
    changes.push_back(batch.Watched.Gained / mean.Gained + batch.Watched.Held / mean.Held -
                      batch.Watched.Lost / mean.Lost - 1.0);
    squares += changes.back() * changes.back();
  }
  if (squares > LargestError * LargestError * Batches * (Batches - 1.0))
  {
    return false;
  }
  const double held =
    mean.Gained * mean.Held / mean.Lost / std::max(1, batches.front().Watched.Sweeps);
  for (std::size_t i = 0; i < batches.size(); ++i)
  {
    BatchState& batch = batches[i];
    double latest = 0.0;
    for (std::size_t side = 0; side < watched.size(); ++side)
    {
      latest += watched[side]
                  ? this->Scene_.ExposedArea(side / 2, side % 2) * batch.Illuminance[side]
                  : 0.0;
    }
    const double wanted = held * std::clamp(1.0 + changes[i], 1.0 / LargestSpread, LargestSpread);
    const double scale =
      latest > 0.0 ? std::clamp(wanted / latest, 1.0 / LargestScale, LargestScale) : 1.0;
    for (std::size_t side = 0; side < watched.size(); ++side)
    {
      batch.Illuminance[side] *= watched[side] ? static_cast<float>(scale) : 1.0F;
    }
  }
  return true;
}

} // namespace smokevis
