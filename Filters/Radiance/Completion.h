// Brings batches of sweeps to where diffusion says that they would come in the end.
#pragma once

#include "BatchState.h"

#include <vector>

namespace smokevis
{

class DiffusionBlocks;

/// Completes by DiffusionBlocks what sweeps find: the sums of each batch by what it lacks itself,
/// so that the spread of the batches tells the error of it, and the light that they go on from by
/// what all lack together, once that stands out of noise, which would grow otherwise.
class Completion
{
public:
  /// Prepares the batches. The blocks must outlive this.
  Completion(const DiffusionBlocks& blocks, std::vector<BatchState>& batches);

  /// Completes the sums of a batch by its sweeps since the last time.
  void CompleteSums(BatchState& batch) const;
  /// Completes the latest light, if what it lacks is clear, when the sums of all are completed.
  /// @param sweeps since the last time
  void CompleteLatest(int sweeps, std::vector<BatchState>& batches);

  /// What the latest light may still lack, over the mean fluence of the smoke.
  double MayLack() const { return this->MayLack_; }
  /// Whether what is completed comes back with the other sign again and again, or without bounds:
  /// diffusion does not describe this light, and completes it ever further away.
  bool Diverges() const { return this->Step_ < SmallestStep; }
  /// Share of what light lacks that it still lacks a sweep later. In uniform smoke it would be 0.23
  /// (Adams and Larsen 2002).
  double Left() const { return 1.0 - this->Step_ * (1.0 - LeftShare); }

private:
  /// Share that is left where all is completed that is found.
  static constexpr double LeftShare = 0.6;
  static constexpr double SmallestStep = 0.1;

  const DiffusionBlocks& Blocks_;
  /// Sweeps that the batches' Lacking adds up.
  int Sweeps_ = 0;
  double MayLack_ = 0.0;
  /// What was completed last [lx], and the share of what is found lacking that is completed.
  std::vector<double> Completed_;
  double Step_ = 1.0;
};

} // namespace smokevis
