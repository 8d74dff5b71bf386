// Holds a light field to the conservation of power: what is lost must be what is emitted.
#pragma once

#include "LineSweep.h"

#include <vector>

#include <tbb/task_arena.h>

namespace smokevis
{

class Scene;

/// Scales light to be in balance as a whole, which sums the series of reflections of its slowest
/// mode at once. Each batch for itself where that makes them agree better; where light leaves the
/// scene, its loss may be known less well than the light itself. With a sky nothing is scaled:
/// light that goes straight out again tells nothing about the rest.
class PowerBalance
{
public:
  /// @param arena whose threads work on the batches; must outlive this
  PowerBalance(const Scene& scene, const LineSweep& sweep, int band, tbb::task_arena& arena);

  /// Share of the light that smoke and surfaces take up or let go which they send on again: its
  /// power to n is about the share that is sent on more than n times.
  double SentAgain(const std::vector<BatchState>& batches) const;
  /// Scales the latest estimates by the means of the sweeps that count, the batches alike where
  /// they do not agree better each for itself. Throws an error where hardly any light is ever lost.
  void ScaleLatest(std::vector<BatchState>& batches) const;
  /// Scales the sums where the batches then agree better.
  void ScaleSums(std::vector<BatchState>& batches) const;

private:
  struct Scales
  {
    /// Of each batch, and of all alike.
    std::vector<double> Own;
    double Common = 1.0;
    /// Whether the batches agree better each with its own.
    bool Agree = false;
  };

  std::vector<LineSweep::Powers> PowersOf(const std::vector<BatchState>& batches) const;
  Scales ScalesOf(const std::vector<BatchState>& batches) const;
  double ScaleFor(double loss) const;

  const LineSweep& Sweep_;
  tbb::task_arena& Arena_;
  /// What lines carry before any of it was tallied [lm].
  double Source_;
  bool Sky_;
  /// Whether neither smoke nor surfaces take light away; it may still leave the scene.
  bool HardlyLoses_;
};

} // namespace smokevis
