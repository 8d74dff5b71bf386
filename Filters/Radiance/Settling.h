// Whether a light field that is built up sweep by sweep still drifts.
#pragma once

#include "LineSweep.h"

#include <vector>

namespace smokevis
{

/// Means of a light field over blocks of its cells and patches, a value a batch. Comparing those of
/// two windows of sweeps tells drift from noise, since the noise shows in the spread of the
/// batches.
class BlockMeans
{
public:
  BlockMeans() = default;
  /// From the running means of the batches; the direct light of the band is what it adds to.
  BlockMeans(const std::vector<BatchState>& batches, const LightField& field, int band);

  /// Upper estimate of the root mean square, over the blocks, of the drift from an earlier window
  /// to this one over all light of the block (or over a floor where a block lies in the dark),
  /// noise taken out.
  /// @param resolution relative error that need not be resolved
  double DriftSince(const BlockMeans& earlier, double resolution) const;

private:
  struct Block
  {
    double Direct = 0.0;
    /// A value a batch.
    std::vector<double> Multiple;
  };

  void Add(const std::vector<BatchState>& batches, std::vector<float> BatchState::*sums,
    const float* direct);

  /// Of the fluence, then of the illuminance; all blocks of one kind hold about as many values.
  std::vector<Block> Blocks_;
};

} // namespace smokevis
