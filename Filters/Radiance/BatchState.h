// What one batch of random lines knows of the light field.
#pragma once

#include "Types.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace smokevis
{

/// Sides of patches and cells of smoke that are watched, by number; empty: none.
struct WatchedPlaces
{
  std::vector<std::uint8_t> Sides, Cells;
};

/// Sums over sweeps of the light that watched places send on after they got it from others.
struct WatchedLight
{
  /// Its power where it meets them, before a sweep; what they take up of it or does not come
  /// back to any of them in the sweep; and all other light that meets them [lm].
  double Held = 0.0, Lost = 0.0, Gained = 0.0;
  int Sweeps = 0;
};

/// Light that lines brought to a place: of what watched places sent on, and in all [lm].
struct MetLight
{
  float Watched = 0.0F, All = 0.0F;
};

/// What one batch knows of the light field of one band; indices as in LightField, without the band.
struct BatchState
{
  /// Latest estimate of what is not direct, and the share of a sweep's lines that it is made of.
  std::vector<float> Fluence, Illuminance;
  float Share = 1.0F;
  /// Sum of the estimates that count, one a sweep.
  std::vector<float> FluenceSum, IlluminanceSum;
  /// Sum of what left the scene [lm], and how many sweeps the sums count.
  double EscapedSum = 0.0;
  int Counted = 0;
  /// Of the blocks of DiffusionBlocks, where there are any; of sweeps since it was emptied [lm].
  std::vector<double> Residual;
  /// What sweeps lack of their fluence by that, summed up over sweeps [lx].
  std::vector<double> Lacking;
  /// Sum of the shares of all sweeps so far.
  float Swept = 0.0F;
  WatchedLight Watched;
  /// Over the same sweeps, what met each side of a patch, and each of some cells from one on,
  /// others in each batch; empty: none are watched.
  std::vector<MetLight> AtSides, AtCells;
  std::int64_t FirstCell = 0;

  BatchState() = default;
  BatchState(std::size_t cells, std::size_t sides);
  /// Forgets the sums, not the latest estimate.
  void Restart();
};

/// Means of the sums of a place over the sweeps that each batch counts.
Lanes MeansOf(
  const std::vector<BatchState>& batches, std::vector<float> BatchState::*sums, std::size_t place);

} // namespace smokevis
