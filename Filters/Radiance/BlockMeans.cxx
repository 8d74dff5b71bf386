#include "BlockMeans.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <tbb/parallel_for.h>

namespace smokevis
{

namespace
{

/// Cells count by where they lie, so that it does not matter how meshes part the smoke. Few blocks
/// do not show a drift that is little of their light, as that of a white room in a large scene;
/// still more would only show how noise differs from place to place.
constexpr std::array<int, 3> CellBlocks = {4, 4, 4};
/// First of the fronts, then of the backs of patches.
constexpr std::size_t MostPatchBlocks = 64;
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

BlockMeans::BlockMeans(const std::vector<BatchState>& batches, const Scene& scene,
  const LightField& field, int band, tbb::task_arena& arena)
    : Counted_(batches.front().Counted)
{
  // Light counts by the power that is sent on of it [lm]; that on black surfaces counts a little,
  // and so does that in the air where nothing scatters at all.
  const Medium& smoke = scene.Smoke();
  const double least = scene.Albedo() * smoke.MaximumExtinction() > 0.0
                         ? 0.0
                         : DarkShare / glm::length(scene.Upper() - scene.Lower());
  std::vector<Share> shares(field.Cells);
  const Vec3 extent = glm::max(smoke.Upper() - smoke.Lower(), Vec3(1e-300));
  const auto share = [&](std::size_t i)
  {
    const auto cell = static_cast<std::int64_t>(i);
    const Vec3 place = (smoke.CellCentre(cell) - smoke.Lower()) / extent;
    std::size_t block = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      const int count = CellBlocks[axis];
      block = block * count + std::clamp(static_cast<int>(count * place[axis]), 0, count - 1);
    }
    shares[i] = {
      block, std::max(least, scene.Albedo() * smoke.Extinction(cell)) * smoke.OwnVolume(cell)};
  };
  arena.execute(
    [&]
    {
      tbb::parallel_for(std::size_t{0}, shares.size(), share);
      this->Add(batches, &BatchState::FluenceSum,
        field.DirectFluence.data() + field.CellIndex(band, 0), 4.0, shares);
    });
  shares.resize(2 * field.Patches);
  const std::size_t patchBlocks = std::min(MostPatchBlocks, shares.size());
  for (std::size_t side = 0; side < shares.size(); ++side)
  {
    const std::size_t place = (side % 2) * field.Patches + side / 2;
    shares[side] = {place * patchBlocks / shares.size(),
      scene.ExposedArea(side / 2, side % 2) *
        std::max(DarkShare, scene.PatchReflectance(side / 2)[band])};
  }
  arena.execute(
    [&]
    {
      this->Add(batches, &BatchState::IlluminanceSum,
        field.DirectIlluminance.data() + field.PatchIndex(band, 0, 0), 1.0, shares);
    });
  double all = 0.0;
  for (const Block& block : this->Blocks_)
  {
    all += block.Direct + MeanOf(block.Multiple);
  }
  this->Floor_ = DarkShare * all / static_cast<double>(this->Blocks_.size());
  for (Block& block : this->Blocks_)
  {
    // What holds no light at all is known perfectly, which tells nothing of the rest.
    block.Lit = block.Direct > 0.0 || std::any_of(block.Multiple.begin(), block.Multiple.end(),
                                        [](double value) { return value != 0.0; });
    block.Direct += this->Floor_;
  }
}

void BlockMeans::Add(const std::vector<BatchState>& batches, std::vector<float> BatchState::*values,
  const float* direct, double unit, const std::vector<Share>& shares)
{
  std::size_t count = 0;
  for (const Share& share : shares)
  {
    count = std::max(count, share.Block + 1);
  }
  const std::size_t first = this->Blocks_.size();
  this->Blocks_.resize(
    first + count, Block{0.0, 0.0, std::vector<double>(batches.size(), 0.0), false});
  for (const Share& share : shares)
  {
    this->Blocks_[first + share.Block].Size += unit * share.Weight;
  }
  const auto sums = [&](const float* light)
  {
    std::vector<double> sum(count, 0.0);
    for (std::size_t i = 0; i < shares.size(); ++i)
    {
      sum[shares[i].Block] += shares[i].Weight * light[i];
    }
    return sum;
  };
  // Each by one thread: the sums do not depend on the threads.
  tbb::parallel_for(std::size_t{0}, batches.size() + 1,
    [&](std::size_t batch)
    {
      const bool all = batch == batches.size();
      const std::vector<double> sum = sums(all ? direct : (batches[batch].*values).data());
      for (std::size_t block = 0; block < count; ++block)
      {
        Block& own = this->Blocks_[first + block];
        (all ? own.Direct : own.Multiple[batch]) =
          all ? sum[block] : sum[block] / std::max(1, batches[batch].Counted);
      }
    });
}

double BlockMeans::DarkestShare() const
{
  double all = 0.0;
  double sizes = 0.0;
  double darkest = std::numeric_limits<double>::infinity();
  for (const Block& block : this->Blocks_)
  {
    if (block.Lit && block.Size > 0.0)
    {
      const double light = block.Direct - this->Floor_ + std::max(0.0, MeanOf(block.Multiple));
      all += light;
      sizes += block.Size;
      darkest = std::min(darkest, light / block.Size);
    }
  }
  return all > 0.0 ? std::clamp(darkest * sizes / all, DarkShare, 1.0) : 1.0;
}

BlockMeans BlockMeans::Since(const BlockMeans& earlier) const
{
  BlockMeans since = *this;
  since.Counted_ = this->Counted_ - earlier.Counted_;
  for (std::size_t index = 0; index < since.Blocks_.size(); ++index)
  {
    for (std::size_t batch = 0; batch < since.Blocks_[index].Multiple.size(); ++batch)
    {
      since.Blocks_[index].Multiple[batch] =
        (this->Counted_ * this->Blocks_[index].Multiple[batch] -
          earlier.Counted_ * earlier.Blocks_[index].Multiple[batch]) /
        since.Counted_;
    }
  }
  return since;
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
  return {root(square), root(std::max(0.0, square) + deviation)};
}

} // namespace smokevis
