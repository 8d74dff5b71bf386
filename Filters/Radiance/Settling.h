// Whether a light field that is built up sweep by sweep still drifts.
#pragma once

#include "LineSweep.h"

#include <vector>

namespace smokevis
{

/// Means of a light field over blocks of its cells and patches, a value a batch. Comparing those of two
/// windows of sweeps tells drift from noise, since the noise shows in the spread of the batches.
class BlockMeans
{
public:
  BlockMeans() = default;
  /// From the running means of the batches.
  explicit BlockMeans(const std::vector<BatchState>& batches);

  /// Upper estimate of the root mean square, over the blocks, of the relative drift from an earlier
  /// window to this one, noise taken out.
  double DriftSince(const BlockMeans& earlier) const;

private:
  /// [block][batch].
  std::vector<std::vector<double>> Blocks_;
};

} // namespace smokevis
