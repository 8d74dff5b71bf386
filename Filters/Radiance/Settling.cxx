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

BlockMeans::BlockMeans(const std::vector<BatchState>& batches, const LightField& field, int band)
{
  this->Add(
    batches, &BatchState::FluenceSum, field.DirectFluence.data() + field.CellIndex(band, 0));
  this->Add(batches, &BatchState::IlluminanceSum,
    field.DirectIlluminance.data() + field.PatchIndex(band, 0, 0));
}

void BlockMeans::Add(
  const std::vector<BatchState>& batches, std::vector<float> BatchState::*sums, const float* direct)
{
  const std::size_t count = (batches.front().*sums).size();
  const std::size_t parts = std::min(MostBlocks, count);
  const std::size_t first = this->Blocks_.size();
  double mean = 0.0;
  for (std::size_t part = 0; part < parts; ++part)
  {
    Block block;
    block.Multiple.assign(batches.size(), 0.0);
    for (std::size_t i = count * part / parts; i < count * (part + 1) / parts; ++i)
    {
      block.Direct += direct[i];
      for (std::size_t batch = 0; batch < batches.size(); ++batch)
      {
        block.Multiple[batch] += (batches[batch].*sums)[i] / std::max(1, batches[batch].Counted);
      }
    }
    mean += (block.Direct + MeanOf(block.Multiple)) / static_cast<double>(parts);
    this->Blocks_.push_back(std::move(block));
  }
  for (std::size_t block = first; block < this->Blocks_.size(); ++block)
  {
    this->Blocks_[block].Direct += DarkShare * mean;
  }
}

double BlockMeans::DriftSince(const BlockMeans& earlier, double resolution) const
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
    return 0.0;
  }
  // Noise alone makes the signal the sum of the weighted variances (times 15/13, since they come
  // from 16 batches), give or take the root of twice the sum of their squares.
  constexpr double excess = (Batches - 1.0) / (Batches - 3.0);
  const double known = std::max(0.0, signal - excess * noise);
  return std::sqrt((known + 2.0 * std::sqrt(2.0 * spread)) / weights);
}

} // namespace smokevis
