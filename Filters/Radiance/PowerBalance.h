// Holds a light field to the conservation of power: what is lost must be what is emitted.
#pragma once

#include <vector>

namespace smokevis
{

class LineSweep;
class Scene;
struct BatchState;

/// Scales the light of each batch to be in balance as a whole, which sums the series of reflections
/// of its slowest mode at once. Each batch for itself, so that their spread shows how well the
/// scale is known. With a sky nothing is scaled: light that goes straight out again tells nothing
/// about the rest.
class PowerBalance
{
public:
  PowerBalance(const Scene& scene, const LineSweep& sweep, int band);

  /// Scales the latest estimates by the means of the sweeps that count. Throws an error where
  /// hardly any light is ever lost.
  void ScaleLatest(std::vector<BatchState>& batches) const;
  /// Scales the sums where that makes the batches agree better: where light leaves the scene, the
  /// loss may be known less well than the light itself.
  void ScaleSums(std::vector<BatchState>& batches) const;

private:
  double Scale(const BatchState& batch) const;

  const LineSweep& Sweep_;
  /// What lines carry before any of it was tallied [lm].
  double Source_;
  bool Sky_;
  /// Whether neither smoke nor surfaces take light away; it may still leave the scene.
  bool HardlyLoses_;
};

} // namespace smokevis
