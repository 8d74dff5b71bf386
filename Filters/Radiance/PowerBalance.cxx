#include "PowerBalance.h"

#include "Errors.h"
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
/// Share of the light sent out that must be lost, or else what leaks through rounded corners
/// decides.
constexpr double SmallestLoss = 1e-5;

void Multiply(std::vector<float>& values, double scale)
{
  for (float& value : values)
  {
    value *= static_cast<float>(scale);
  }
}

bool HardlyLoses(const Scene& scene, int band)
{
  if (1.0 - scene.Albedo() > SmallestLoss && scene.Smoke().MaximumExtinction() > 0.0F)
  {
    return false;
  }
  for (std::size_t patch = 0; patch < scene.Patches(); ++patch)
  {
    const double exposed = scene.ExposedArea(patch, 0) + scene.ExposedArea(patch, 1);
    if (1.0 - scene.PatchReflectance(patch)[band] > SmallestLoss && exposed > 0.0)
    {
      return false;
    }
  }
  return true;
}

} // namespace

PowerBalance::PowerBalance(
  const Scene& scene, const LineSweep& sweep, int band, tbb::task_arena& arena)
    : Sweep_(sweep), Arena_(arena), Source_(sweep.FirstSource()), Sky_(scene.Sky() > 0.0),
      HardlyLoses_(HardlyLoses(scene, band))
{
}

std::vector<LineSweep::Powers> PowerBalance::PowersOf(const std::vector<BatchState>& batches) const
{
  std::vector<LineSweep::Powers> powers(batches.size());
  this->Arena_.execute(
    [&]
    {
      tbb::parallel_for(std::size_t{0}, batches.size(),
        [&](std::size_t i) { powers[i] = this->Sweep_.PowersOf(batches[i]); });
    });
  return powers;
}

PowerBalance::Scales PowerBalance::ScalesOf(const std::vector<BatchState>& batches) const
{
  Scales scales;
  double loss = 0.0;
  double sent = 0.0;
  double sum = 0.0;
  double squares = 0.0;
  double scaledSum = 0.0;
  double scaledSquares = 0.0;
  for (const auto& [later, own] : this->PowersOf(batches))
  {
    scales.Own.push_back(this->ScaleFor(own));
    loss += own;
    sent += this->Source_ + later;
    const double scaled = later * scales.Own.back();
    sum += later;
    squares += later * later;
    scaledSum += scaled;
    scaledSquares += scaled * scaled;
  }
  scales.Agree = scaledSquares * sum * sum < squares * scaledSum * scaledSum;
  scales.Common = this->ScaleFor(loss / static_cast<double>(batches.size()));
  if (std::abs(loss) < SmallestLoss * sent && this->HardlyLoses_)
  {
    throw Error("light field",
      "hardly any light is lost anywhere, so that it would grow nearly without end",
      "Give the smoke an albedo, or some surface a reflectance, below 1, or open the scene");
  }
  return scales;
}

double PowerBalance::ScaleFor(double loss) const
{
  return loss > 0.0 ? std::clamp(this->Source_ / loss, SmallestScale, LargestScale) : LargestScale;
}

double PowerBalance::SentAgain(const std::vector<BatchState>& batches) const
{
  double later = 0.0;
  double loss = 0.0;
  for (const auto& [own, lost] : this->PowersOf(batches))
  {
    later += own;
    loss += lost;
  }
  for (const BatchState& batch : batches)
  {
    // Much of the sky's light meets nothing on its way through.
    loss -= this->Sky_ ? batch.EscapedSum / batch.Counted : 0.0;
  }
  return later > 0.0 && loss > 0.0 ? later / (loss + later) : later > 0.0 ? 1.0 : 0.0;
}

void PowerBalance::ScaleLatest(std::vector<BatchState>& batches) const
{
  if (this->Sky_)
  {
    return;
  }
  const Scales scales = this->ScalesOf(batches);
  this->Arena_.execute(
    [&]
    {
      tbb::parallel_for(std::size_t{0}, batches.size(),
        [&](std::size_t i)
        {
          const double scale = scales.Agree ? scales.Own[i] : scales.Common;
          Multiply(batches[i].Fluence, scale);
          Multiply(batches[i].Illuminance, scale);
        });
    });
}

void PowerBalance::ScaleSums(std::vector<BatchState>& batches) const
{
  if (this->Sky_)
  {
    return;
  }
  const Scales scales = this->ScalesOf(batches);
  if (!scales.Agree)
  {
    return;
  }
  this->Arena_.execute(
    [&]
    {
      tbb::parallel_for(std::size_t{0}, batches.size(),
        [&](std::size_t i)
        {
          Multiply(batches[i].FluenceSum, scales.Own[i]);
          Multiply(batches[i].IlluminanceSum, scales.Own[i]);
        });
    });
}

} // namespace smokevis
