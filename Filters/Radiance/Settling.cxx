#include "Settling.h"

#include <algorithm>
#include <cmath>

namespace smokevis
{

namespace
{

/// Few blocks are known well; more would only show how noise differs from place to place.
constexpr std::size_t MostBlocks = 16;
/// Share of the mean light of all blocks that a dark block is given, so that it need not be known
/// to a share of next to nothing.
constexpr double DarkShare = 0.1;

double MeanOf(const std::vector<double>& values)
{
  double sum = 0.0;
  for (const double value : values)
  {
    sum += value;
  }
  return sum / static_cast<double>(values.size());
}

/// Variance of the mean.
double VarianceOf(const std::vector<double>& values, double mean)
{
  double squares = 0.0;
  for (const double value : values)
  {
    squares += (value - mean) * (value - mean);
  }
  const auto count = static_cast<double>(values.size());
  return squares / (count * (count - 1.0));
}

} // namespace

BlockMeans::BlockMeans(
  const std::vector<BatchState>& batches, const Scene& scene, const LightField& field, int band)
{
  // Light counts by the power that is sent on of it [lm]; that on black surfaces counts a little.
  const Medium& smoke = scene.Smoke();
  std::vector<float> weights(field.Cells);
  for (std::size_t cell = 0; cell < field.Cells; ++cell)
  {
    const Vec3 size = smoke.CellSize(static_cast<std::int64_t>(cell));
    weights[cell] =
      static_cast<float>(scene.Albedo() * smoke.Extinction(static_cast<std::int64_t>(cell)) *
                         size.x * size.y * size.z);
  }
  this->Add(batches, &BatchState::FluenceSum, field.DirectFluence.data() + field.CellIndex(band, 0),
    weights);
  weights.resize(2 * field.Patches);
  for (std::size_t side = 0; side < weights.size(); ++side)
  {
    weights[side] = static_cast<float>(scene.ExposedArea(side / 2, side % 2) *
                                       std::max(DarkShare, scene.PatchReflectance(side / 2)[band]));
  }
  this->Add(batches, &BatchState::IlluminanceSum,
    field.DirectIlluminance.data() + field.PatchIndex(band, 0, 0), weights);
  double all = 0.0;
  for (const Block& block : this->Blocks_)
  {
    all += block.Direct + MeanOf(block.Multiple);
  }
  for (Block& block : this->Blocks_)
  {
    block.Direct += DarkShare * all / static_cast<double>(this->Blocks_.size());
  }
}

void BlockMeans::Add(const std::vector<BatchState>& batches, std::vector<float> BatchState::*sums,
  const float* direct, const std::vector<float>& weights)
{
  const std::size_t count = weights.size();
  const std::size_t parts = std::min(MostBlocks, count);
  for (std::size_t part = 0; part < parts; ++part)
  {
    Block block;
    block.Multiple.assign(batches.size(), 0.0);
    for (std::size_t i = count * part / parts; i < count * (part + 1) / parts; ++i)
    {
      block.Direct += weights[i] * direct[i];
      for (std::size_t batch = 0; batch < batches.size(); ++batch)
      {
        block.Multiple[batch] +=
          weights[i] * (batches[batch].*sums)[i] / std::max(1, batches[batch].Counted);
      }
    }
    this->Blocks_.push_back(std::move(block));
  }
}

BlockMeans::Drift BlockMeans::DriftSince(const BlockMeans& earlier, double resolution) const
{
  double signal = 0.0;
  double noise = 0.0;
  double spread = 0.0;
  double weights = 0.0;
  for (std::size_t index = 0; index < this->Blocks_.size(); ++index)
  {
    const Block& block = this->Blocks_[index];
    const std::vector<double>& before = earlier.Blocks_[index].Multiple;
    const double now = MeanOf(block.Multiple);
    const double then = MeanOf(before);
    const double all = std::max(0.0, now) + block.Direct;
    if (!(all > 0.0))
    {
      continue;
    }
    // Blocks count by how well they are known, those known better than asked for all alike.
    const double variance =
      (VarianceOf(block.Multiple, now) + VarianceOf(before, then)) / (all * all);
    const double weight = 1.0 / std::max(variance, resolution * resolution);
    weights += weight;
    signal += weight * (now - then) * (now - then) / (all * all);
    noise += weight * variance;
    spread += weight * variance * weight * variance;
  }
  if (weights == 0.0)
  {
    return {};
  }
  // Noise alone makes the signal the sum of the weighted variances (times 15/13, since they come
  // from 16 batches), give or take the root of twice the sum of their squares.
  constexpr double excess = (Batches - 1.0) / (Batches - 3.0);
  const double known = std::max(0.0, signal - excess * noise);
  return {std::sqrt(known / weights), std::sqrt((known + 2.0 * std::sqrt(2.0 * spread)) / weights)};
}

} // namespace smokevis
