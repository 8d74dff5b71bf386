#include "SlowLight.h"

#include "BatchState.h"
#include "CellLoops.h"
#include "LineSweep.h"
#include "Scene.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace smokevis
{

namespace
{

/// Growth from window to window, the later twice as long, of light that has yet to grow much, and
/// how many standard errors it must be. Where that is sure of some sides, it need be less so of
/// others: a small one that is left out, such as the lamp's in a white box, is known poorly, and
/// takes away most of what the box would come to.
constexpr double LeastGrowth = 0.03;
constexpr double Deviations = 3.0;
constexpr double CompanyDeviations = 1.0;
/// Light on darker surfaces than this, or in darker smoke, settles by itself.
constexpr double LeastReflectance = 0.5;
/// Share of the light that meets a place that must come from watched ones for it to be one of them:
/// light that has grown for eight sweeps is more than that where next to none is lost. Light that
/// was told apart wrongly, over all that the watched places lose, below which that does not matter,
/// and how often places may be chosen anew.
constexpr double LeastOwn = 0.75;
constexpr double LeastChange = 0.1;
constexpr int MostRefinements = 2;
/// Standard error that what the light grows to may have. It shows in the spread of the batches.
constexpr double LargestError = 0.3;
/// How far off 1 it must be over what they held, in all and in standard errors, to be off at all.
constexpr double LeastScaled = 0.05;
constexpr double ScaledErrors = 2.0;
/// A batch does not leave the mean by more than this factor, nor change at once by more than that.
constexpr double LargestSpread = 4.0;
constexpr double LargestScale = 1e4;

void Scale(const std::vector<std::uint8_t>& places, float scale, std::vector<float>& light)
{
  for (std::size_t place = 0; place < places.size(); ++place)
  {
    light[place] *= places[place] ? scale : 1.0F;
  }
}

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
  const std::size_t cells = batches.front().FluenceSum.size();
  const bool compares = grows && !this->EarlierSides_.empty();
  this->EarlierSides_.resize(sides);
  this->EarlierCells_.resize(cells);
  WatchedPlaces watched{std::vector<std::uint8_t>(sides), std::vector<std::uint8_t>(cells)};
  bool any = false;
  for (std::size_t side = 0; side < sides; ++side)
  {
    const Lanes now = MeansOf(batches, &BatchState::IlluminanceSum, side);
    Lanes& earlier = this->EarlierSides_[side];
    if (compares && this->Scene_.PatchReflectance(side / 2)[this->Band_] > LeastReflectance)
    {
      // A batch may be brighter than others all the time.
      Lanes rises = now;
      Add(rises, earlier, -1.0F);
      const double rise = Mean(rises);
      const double error = StandardError(rises);
      const bool large = rise > LeastGrowth * std::max(0.0, Mean(earlier));
      watched.Sides[side] = large && rise > CompanyDeviations * error;
      any = any || (large && rise > Deviations * error);
    }
    earlier = now;
  }
  ForEachCell(cells,
    [&](std::int64_t cell)
    {
      const Lanes lanes = MeansOf(batches, &BatchState::FluenceSum, cell);
      const double now = Mean(lanes);
      const double rise = now - this->EarlierCells_[cell];
      watched.Cells[cell] = this->Scene_.Albedo() > LeastReflectance &&
                            this->Scene_.Smoke().Extinction(cell) > 0.0 &&
                            rise > LeastGrowth * std::max(0.0F, this->EarlierCells_[cell]) &&
                            rise > CompanyDeviations * StandardError(lanes);
      this->EarlierCells_[cell] = static_cast<float>(now);
    });
  this->Refinements_ = 0;
  this->Watch(batches, any ? std::move(watched) : WatchedPlaces());
}

//--------------------------------------------------------------------------------------------------
void SlowLight::Watch(std::vector<BatchState>& batches, WatchedPlaces places)
{
  const auto first = [&](std::size_t batch)
  { return static_cast<std::int64_t>(batch * places.Cells.size() / batches.size()); };
  for (std::size_t batch = 0; batch < batches.size(); ++batch)
  {
    BatchState& state = batches[batch];
    state.Watched = {};
    state.AtSides.assign(places.Sides.size(), {});
    state.FirstCell = first(batch);
    state.AtCells.assign(first(batch + 1) - first(batch), {});
  }
  this->Sweep_.Watch(std::move(places));
}

//--------------------------------------------------------------------------------------------------
void SlowLight::Stop(std::vector<BatchState>& batches)
{
  this->Watch(batches, WatchedPlaces());
}

//--------------------------------------------------------------------------------------------------
bool SlowLight::Refine(std::vector<BatchState>& batches)
{
  if (!this->Sweep_.Watches() || this->Refinements_ == MostRefinements)
  {
    return false;
  }
  WatchedPlaces places = this->Sweep_.Watched();
  double changed = 0.0;
  bool any = false;
  const auto decide = [&](std::uint8_t& watched, const MetLight& met)
  {
    const bool belongs = met.Watched > LeastOwn * met.All;
    if (belongs != (watched != 0))
    {
      changed += belongs ? met.Watched : met.All - met.Watched;
      watched = belongs;
    }
    any = any || belongs;
  };
  std::vector<float> own(places.Sides.size(), 0.0F);
  std::vector<float> all(places.Sides.size(), 0.0F);
  for (const BatchState& batch : batches)
  {
    for (std::size_t side = 0; side < own.size(); ++side)
    {
      own[side] += batch.AtSides[side].Watched;
      all[side] += batch.AtSides[side].All;
    }
  }
  // Those that share what lines bring them are watched together.
  this->Sweep_.Groups().Average(own);
  this->Sweep_.Groups().Average(all);
  for (std::size_t side = 0; side < own.size(); ++side)
  {
    decide(places.Sides[side], {own[side], all[side]});
  }
  double lost = 0.0;
  for (const BatchState& batch : batches)
  {
    for (std::size_t i = 0; i < batch.AtCells.size(); ++i)
    {
      // Of one batch, so that it stands for all.
      decide(places.Cells[batch.FirstCell + static_cast<std::int64_t>(i)],
        {Batches * batch.AtCells[i].Watched, Batches * batch.AtCells[i].All});
    }
    lost += batch.Watched.Lost;
  }
  if (!(changed > LeastChange * lost))
  {
    return false;
  }
  ++this->Refinements_;
  this->Watch(batches, any ? std::move(places) : WatchedPlaces());
  return true;
}

//--------------------------------------------------------------------------------------------------
SlowLight::Outcome SlowLight::Balance(std::vector<BatchState>& batches)
{
  if (!this->Sweep_.Watches())
  {
    return Outcome::Unknown;
  }
  const WatchedPlaces& watched = this->Sweep_.Watched();
  WatchedLight mean;
  for (const BatchState& batch : batches)
  {
    mean.Held += batch.Watched.Held / Batches;
    mean.Lost += batch.Watched.Lost / Batches;
    mean.Gained += batch.Watched.Gained / Batches;
  }
  if (!(mean.Held > 0.0 && mean.Lost > 0.0 && mean.Gained > 0.0))
  {
    return Outcome::Unknown;
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
    return Outcome::Unknown;
  }
  const double held =
    mean.Gained * mean.Held / mean.Lost / std::max(1, batches.front().Watched.Sweeps);
  for (std::size_t i = 0; i < batches.size(); ++i)
  {
    BatchState& batch = batches[i];
    const double latest = this->Sweep_.HeldByWatched(batch).Power;
    const double wanted = held * std::clamp(1.0 + changes[i], 1.0 / LargestSpread, LargestSpread);
    const double scale =
      latest > 0.0 ? std::clamp(wanted / latest, 1.0 / LargestScale, LargestScale) : 1.0;
    Scale(watched.Sides, static_cast<float>(scale), batch.Illuminance);
    Scale(watched.Cells, static_cast<float>(scale), batch.Fluence);
  }
  // Noise may feign a change, of which a share of one is none.
  const double error = std::sqrt(squares / (Batches * (Batches - 1.0)));
  if (std::abs(mean.Gained / mean.Lost - 1.0) < std::max(LeastScaled, ScaledErrors * error))
  {
    this->LossShare_ = mean.Lost / mean.Held;
    this->Stop(batches);
    return Outcome::Balanced;
  }
  this->Refinements_ = 0;
  this->Watch(batches, this->Sweep_.Watched());
  return Outcome::Scaled;
}

} // namespace smokevis
