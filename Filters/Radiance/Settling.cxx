#include "Settling.h"

#include <algorithm>
#include <cmath>

namespace smokevis
{

namespace
{

/// Few blocks are known well; more would only show how noise differs from place to place.
constexpr std::size_t MostBlocks = 16;

void AddBlocks(const std::vector<BatchState>& batches, std::vector<float> BatchState::*values,
  std::vector<std::vector<double>>& blocks)
{
  const std::size_t count = (batches.front().*values).size();
  const std::size_t parts = std::min(MostBlocks, count);
  for (std::size_t part = 0; part < parts; ++part)
  {
    std::vector<double> block(batches.size(), 0.0);
    for (std::size_t batch = 0; batch < batches.size(); ++batch)
    {
      const std::vector<float>& sums = batches[batch].*values;
      for (std::size_t i = count * part / parts; i < count * (part + 1) / parts; ++i)
      {
        block[batch] += sums[i];
      }
      block[batch] /= std::max(1, batches[batch].Counted);
    }
    blocks.push_back(std::move(block));
  }
}

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

BlockMeans::BlockMeans(const std::vector<BatchState>& batches)
{
  AddBlocks(batches, &BatchState::FluenceSum, this->Blocks_);
  AddBlocks(batches, &BatchState::IlluminanceSum, this->Blocks_);
}

double BlockMeans::DriftSince(const BlockMeans& earlier) const
{
  double signal = 0.0;
  double weights = 0.0;
  int used = 0;
  for (std::size_t block = 0; block < this->Blocks_.size(); ++block)
  {
    const double now = MeanOf(this->Blocks_[block]);
    const double then = MeanOf(earlier.Blocks_[block]);
    if (!(now > 0.0))
    {
      continue;
    }
    const double variance =
      VarianceOf(this->Blocks_[block], now) + VarianceOf(earlier.Blocks_[block], then);
    // Blocks count by how well they are known.
    const double weight = now * now / std::max(variance, 1e-12 * now * now);
    weights += weight;
    signal += weight * (now - then) * (now - then) / (now * now);
    ++used;
  }
  if (used == 0)
  {
    return 0.0;
  }
  // Noise alone makes the signal `used` (times 15/13, since its variance comes from 16 batches), give or
  // take the root of twice that.
  constexpr double spread = (Batches - 1.0) / (Batches - 3.0);
  const double known = std::max(0.0, signal - spread * used);
  return std::sqrt((known + 2.0 * std::sqrt(2.0 * used)) / weights);
}

} // namespace smokevis
