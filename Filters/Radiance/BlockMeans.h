// Mean light of blocks of a scene, by which drift from sweep to sweep is told from noise.
#pragma once

#include "BatchState.h"
#include "LightField.h"

#include <vector>

#include <tbb/task_arena.h>

namespace smokevis
{

/// Power that blocks of cells and of patches send on [lm], a value a batch. Comparing those of
/// two windows of sweeps tells drift from noise, since the noise shows in the spread of the
/// batches.
class BlockMeans
{
public:
  BlockMeans() = default;
  /// From the running means of the batches; the direct light of the band is what it adds to.
  /// @param arena whose threads work on the batches
  BlockMeans(const std::vector<BatchState>& batches, const Scene& scene, const LightField& field,
    int band, tbb::task_arena& arena);

  /// Those of the sweeps since earlier means of the same sums were taken.
  BlockMeans Since(const BlockMeans& earlier) const;

  /// Root mean square, over the blocks, of a drift over all light of the block (or over a floor
  /// where a block lies in the dark).
  struct Drift
  {
    /// Noise taken out; the bound is a standard error above it.
    double Estimate = 0.0;
    double UpperBound = 0.0;

    /// Whether it is above a limit, by so many standard errors of its square.
    bool Exceeds(double limit, double errors) const
    {
      const double square = this->Estimate * this->Estimate;
      return square - errors * (this->UpperBound * this->UpperBound - square) > limit * limit;
    }
    /// Whether its square is less than a standard error of that.
    bool IsNoise() const
    {
      return 2.0 * this->Estimate * this->Estimate < this->UpperBound * this->UpperBound;
    }
  };
  /// Drift from an earlier window to this one.
  /// @param resolution relative error that need not be resolved
  Drift DriftSince(const BlockMeans& earlier, double resolution) const;

  /// Mean light of the block that is darkest over that of all, no less than a tenth: light that
  /// has yet to build up counts for more there.
  double DarkestShare() const;

private:
  struct Block
  {
    /// What light would add up to that is 1 lx on each surface, from all sides, everywhere.
    double Size = 0.0;
    /// Of direct light, and a floor.
    double Direct = 0.0;
    /// A value a batch.
    std::vector<double> Multiple;
    bool Lit = false;
  };

  /// Which block a value belongs to, and what it counts there.
  struct Share
  {
    std::size_t Block = 0;
    double Weight = 0.0;
  };
  /// @param unit of the values where 1 lx comes to each surface from all sides
  void Add(const std::vector<BatchState>& batches, std::vector<float> BatchState::*values,
    const float* direct, double unit, const std::vector<Share>& shares);

  /// Of the fluence in scattering cells, then of the illuminance of reflecting patches.
  std::vector<Block> Blocks_;
  /// Sweeps that they are means of.
  int Counted_ = 0;
  /// Light that each of them is given besides its own.
  double Floor_ = 0.0;
};

} // namespace smokevis
