#include "PowerBalance.h"

#include "Errors.h"
#include "FirstSource.h"
#include "LightField.h"
#include "Scene.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

namespace smokevis
{

namespace
{

/// A field is not scaled by more than this at once.
constexpr double SmallestScale = 0.25;
constexpr double LargestScale = 1e3;
/// Standard error of a loss over itself up to which each batch is brought to it even where that
/// brings noise along.
constexpr double LargestLinearError = 0.1;
/// Share of the light sent out that must be lost, or else what leaks through rounded corners
/// decides.
constexpr double SmallestLoss = 1e-5;
/// Share of what is lost that may leave a closed room.
constexpr double LeakShare = 1e-6;
/// Standard errors that what diffusion completes must be off by to be scaled.
constexpr double ClearDeviations = 3.0;
/// Share of the spread of the batches that must be left for them to be scaled there: the balance
/// has noise of its own.
constexpr double ClearShare = 0.5;

double RelativeError(const DoubleLanes& values)
{
  return StandardError(values) / std::abs(Mean(values));
}
/// Share of the light that is emitted by which what is lost may differ from it, where diffusion
/// completes it, and its standard error: else that has gone astray.
constexpr double RoughImbalance = 0.5;
/// Light that is emitted, by so many times of which what is lost may differ from it: what few lines
/// find may be noise, but no more than this.
constexpr double MostImbalance = 1000.0;

DoubleLanes LossesOf(const std::vector<PowerBalance::Powers>& powers)
{
  DoubleLanes losses{};
  std::transform(powers.begin(), powers.end(), losses.begin(),
    [](const PowerBalance::Powers& own) { return own.Lost; });
  return losses;
}

} // namespace

PowerBalance::PowerBalance(
  const Scene& scene, const LightField& field, int band, const Box& outer, tbb::task_arena& arena)
    : Scene_(scene), Arena_(arena), Capture_(field.Cells), Area_(2 * field.Patches),
      Reflectance_(2 * field.Patches), Sky_(scene.Sky() > 0.0)
{
  const Medium& smoke = scene.Smoke();
  for (std::size_t cell = 0; cell < field.Cells; ++cell)
  {
    this->Capture_[cell] = static_cast<float>(
      smoke.Extinction(cell) * scene.ExtinctionScale(band) * smoke.OwnVolume(cell));
  }
  this->HardlyLoses_ =
    1.0 - scene.Albedo() <= SmallestLoss || !(scene.Smoke().MaximumExtinction() > 0.0F);
  for (std::size_t side = 0; side < this->Area_.size(); ++side)
  {
    const double reflectance = scene.PatchReflectance(side / 2)[band];
    const double area = scene.ExposedArea(side / 2, side % 2);
    this->Area_[side] = static_cast<float>(area);
    this->Reflectance_[side] = reflectance;
    this->HardlyLoses_ = this->HardlyLoses_ && (1.0 - reflectance <= SmallestLoss || !(area > 0.0));
  }
  arena.execute([&] { this->Source_ = FirstSource(scene, field, band).Whole(outer); });
}

template <class Body> void PowerBalance::ForEach(std::size_t count, Body&& body) const
{
  this->Arena_.execute(
    [&] { tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) { body(i); }); });
}

std::vector<PowerBalance::Powers> PowerBalance::Of(const std::vector<BatchState>& batches) const
{
  std::vector<Powers> powers(batches.size());
  this->ForEach(batches.size(),
    [&](std::size_t i)
    {
      const BatchState& batch = batches[i];
      double met = 0.0;
      for (std::size_t cell = 0; cell < this->Capture_.size(); ++cell)
      {
        met += this->Capture_[cell] * batch.FluenceSum[cell];
      }
      double reflected = 0.0;
      double taken = (1.0 - this->Scene_.Albedo()) * met;
      for (std::size_t side = 0; side < this->Area_.size(); ++side)
      {
        const double arrives = this->Area_[side] * batch.IlluminanceSum[side];
        reflected += this->Reflectance_[side] * arrives;
        taken += (1.0 - this->Reflectance_[side]) * arrives;
      }
      powers[i] = {(this->Scene_.Albedo() * met + reflected) / batch.Counted,
        reflected / batch.Counted, (batch.EscapedSum + taken) / batch.Counted,
        batch.EscapedSum / batch.Counted};
    });
  return powers;
}

bool PowerBalance::Closed(const std::vector<Powers>& powers)
{
  return std::all_of(powers.begin(), powers.end(),
    [](const Powers& own) { return own.Escaped <= LeakShare * own.Lost; });
}

DoubleLanes PowerBalance::TakenBySurfaces(const LightField& field, int band) const
{
  DoubleLanes taken{};
  const Lanes* const arrives = field.MultipleIlluminance.data() + field.PatchIndex(band, 0, 0);
  for (std::size_t side = 0; side < this->Area_.size(); ++side)
  {
    for (int batch = 0; batch < Batches; ++batch)
    {
      taken[batch] += (1.0 - this->Reflectance_[side]) * this->Area_[side] * arrives[side][batch];
    }
  }
  return taken;
}

void PowerBalance::Restore(
  const std::vector<Powers>& powers, const DoubleLanes& more, LightField& field, int band) const
{
  Lanes factors;
  for (int batch = 0; batch < Batches; ++batch)
  {
    const double lost = powers[batch].Lost;
    factors[batch] = lost > 0.0 && lost + more[batch] > 0.0
                       ? static_cast<float>(lost / (lost + more[batch]))
                       : 1.0F;
  }
  const auto scale = [&](Lanes* values, std::size_t count)
  {
    this->ForEach(count,
      [&](std::size_t i)
      {
        for (int batch = 0; batch < Batches; ++batch)
        {
          values[i][batch] *= factors[batch];
        }
      });
  };
  scale(field.MultipleFluence.data() + field.CellIndex(band, 0), field.Cells);
  scale(field.MultipleIlluminance.data() + field.PatchIndex(band, 0, 0), this->Area_.size());
}

void PowerBalance::ExpectLoss(const std::vector<Powers>& powers) const
{
  double loss = 0.0;
  double sent = 0.0;
  for (const Powers& own : powers)
  {
    loss += own.Lost;
    sent += this->Source_ + own.SentAgain;
  }
  if (std::abs(loss) < SmallestLoss * sent && this->HardlyLoses_)
  {
    throw Error("light field",
      "hardly any light is lost anywhere, so that it would grow nearly without end",
      "Give the smoke an albedo, or some surface a reflectance, below 1, or open the scene");
  }
}

bool PowerBalance::Balanced(const DoubleLanes& losses, double imbalance) const
{
  return std::abs(Mean(losses) - this->Source_) <= imbalance * this->Source_ &&
         StandardError(losses) <= imbalance * this->Source_;
}

bool PowerBalance::RoughlyBalanced(const std::vector<Powers>& powers) const
{
  return this->Sky_ || this->Balanced(LossesOf(powers), RoughImbalance);
}

void PowerBalance::ExpectBalance(const std::vector<Powers>& powers) const
{
  const DoubleLanes losses = LossesOf(powers);
  const double lost = Mean(losses);
  if (this->Source_ > 0.0 && !this->Sky_ && !this->Balanced(losses, MostImbalance))
  {
    throw Error("light field",
      "the light did not settle: of " + std::to_string(this->Source_) + " lm that are scattered " +
        std::to_string(lost) + " lm are lost",
      "Give a smaller tolerance, or a finer mesh where the smoke is dense");
  }
}

PowerBalance::Scales PowerBalance::ScalesOf(const std::vector<Powers>& powers) const
{
  DoubleLanes losses;
  DoubleLanes sent;
  for (int batch = 0; batch < Batches; ++batch)
  {
    losses[batch] = powers[batch].Lost;
    sent[batch] = powers[batch].SentAgain;
  }
  Scales scales;
  scales.Spread = RelativeError(sent);
  scales.CommonError = RelativeError(losses);
  const double lost = Mean(losses);
  if (lost > 0.0 && scales.CommonError < 1.0)
  {
    scales.Common = std::clamp(this->Source_ / lost, SmallestScale, LargestScale);
    const double mean = Mean(sent);
    for (int batch = 0; batch < Batches; ++batch)
    {
      scales.Missing[batch] = 1.0 - losses[batch] / lost;
      sent[batch] += scales.Missing[batch] * mean;
    }
  }
  scales.BalancedSpread = RelativeError(sent);
  return scales;
}

double PowerBalance::SentAgain(const std::vector<Powers>& powers, double Powers::*by) const
{
  double later = 0.0;
  double loss = 0.0;
  for (const Powers& own : powers)
  {
    later += own.*by;
    // Much of the sky's light meets nothing on its way through.
    loss += own.Lost - (this->Sky_ ? own.Escaped : 0.0);
  }
  return later > 0.0 && loss > 0.0 ? later / (loss + later) : later > 0.0 ? 1.0 : 0.0;
}

void PowerBalance::ScaleLatest(
  const std::vector<Powers>& powers, std::vector<BatchState>& batches) const
{
  if (this->Sky_)
  {
    return;
  }
  Scales scales = this->ScalesOf(powers);
  if (scales.CommonError >= LargestLinearError && scales.BalancedSpread >= scales.Spread)
  {
    scales.Missing = {};
  }
  this->Scale(scales, &BatchState::Fluence, &BatchState::FluenceSum, batches);
  this->Scale(scales, &BatchState::Illuminance, &BatchState::IlluminanceSum, batches);
}

void PowerBalance::ScaleSums(
  const std::vector<Powers>& powers, std::vector<BatchState>& batches) const
{
  this->ScaleSumsBy(this->ScalesOf(powers), 1.0, Closed(powers), batches);
}

void PowerBalance::ScaleCompleted(
  const std::vector<Powers>& powers, std::vector<BatchState>& batches) const
{
  const Scales scales = this->ScalesOf(powers);
  const bool clear = std::abs(scales.Common - 1.0) > ClearDeviations * scales.CommonError;
  this->ScaleSumsBy(scales, ClearShare, clear || Closed(powers), batches);
}

void PowerBalance::ScaleSumsBy(
  const Scales& scales, double share, bool always, std::vector<BatchState>& batches) const
{
  if (!this->Sky_ && (always || scales.BalancedSpread < share * scales.Spread))
  {
    this->Scale(scales, &BatchState::FluenceSum, &BatchState::FluenceSum, batches);
    this->Scale(scales, &BatchState::IlluminanceSum, &BatchState::IlluminanceSum, batches);
  }
}

void PowerBalance::Scale(const Scales& scales, std::vector<float> BatchState::*values,
  std::vector<float> BatchState::*sums, std::vector<BatchState>& batches) const
{
  const double counted = values == sums ? 1.0 : batches.front().Counted;
  this->ForEach((batches.front().*sums).size(),
    [&](std::size_t i)
    {
      double mean = 0.0;
      for (const BatchState& batch : batches)
      {
        mean += (batch.*sums)[i] / (counted * Batches);
      }
      for (std::size_t batch = 0; batch < batches.size(); ++batch)
      {
        float& value = (batches[batch].*values)[i];
        value = static_cast<float>(scales.Common * (value + scales.Missing[batch] * mean));
      }
    });
}

} // namespace smokevis
