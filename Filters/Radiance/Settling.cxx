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
    const auto own = static_cast<std::int64_t>(cell);
    weights[cell] =
      static_cast<float>(scene.Albedo() * smoke.Extinction(own) * smoke.CellVolume(own));
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
    // What holds no light at all is known perfectly, which tells nothing of the rest.
    block.Lit = block.Direct > 0.0 || std::any_of(block.Multiple.begin(), block.Multiple.end(),
                                        [](double value) { return value != 0.0; });
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
  // The square of the mean drift, without its noise, is the mean over pairs of batches of the
  // product of their drifts. That over all pairs, and over those without each of the batches:
  double weights = 0.0;
  double square = 0.0;
  std::vector<double> without(Batches, 0.0);
  std::vector<double> drifts(Batches);
  for (std::size_t index = 0; index < this->Blocks_.size(); ++index)
  {
    const Block& block = this->Blocks_[index];
    const double all = std::max(0.0, MeanOf(block.Multiple)) + block.Direct;
    if (!block.Lit || !(all > 0.0))
    {
      continue;
    }
    double sum = 0.0;
    double squares = 0.0;
    for (std::size_t batch = 0; batch < drifts.size(); ++batch)
    {
      drifts[batch] = (block.Multiple[batch] - earlier.Blocks_[index].Multiple[batch]) / all;
      sum += drifts[batch];
      squares += drifts[batch] * drifts[batch];
    }
    // Blocks count by how well they are known, those known better than asked for all alike.
    const double weight =
      1.0 / std::max(VarianceOf(drifts, sum / Batches), resolution * resolution);
    weights += weight;
    square += weight * (sum * sum - squares) / (Batches * (Batches - 1.0));
    for (std::size_t batch = 0; batch < drifts.size(); ++batch)
    {
      const double rest = sum - drifts[batch];
      const double restSquares = squares - drifts[batch] * drifts[batch];
      without[batch] += weight * (rest * rest - restSquares) / ((Batches - 1.0) * (Batches - 2.0));
    }
  }
  if (weights == 0.0)
  {
    return {};
  }
  // Blocks drift together: how far noise moves the estimate is told by a jackknife over batches.
  const double deviation = (Batches - 1.0) * std::sqrt(VarianceOf(without, MeanOf(without)));
  const auto root = [weights](double value) { return std::sqrt(std::max(0.0, value) / weights); };
  return {root(square - deviation), root(square), root(std::max(0.0, square) + deviation)};
}

} // namespace smokevis
