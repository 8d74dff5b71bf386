// Light that goes to and fro between bright places for longer than sweeps would last.
#pragma once

#include "Types.h"

#include <vector>

namespace smokevis
{

class LineSweep;
class Scene;
struct BatchState;
struct WatchedPlaces;

/// Brings light that grows on and on, as in a closed white box around a lamp, to where it gains
/// what it loses. The balance of the scene as a whole does not help where little of its light is
/// there.
///
/// Surfaces whose light still grows between two windows of sweeps are watched, and with them the
/// smoke whose light does: of the light that they send on, sweeps tally what they take up at once
/// and what does not come back to any of them, and of all other light what comes to them. The
/// first is in proportion to what they hold, so that the latter tells how much that is in the end.
/// It holds for whatever places are watched; those that are not are one way for light to leave.
class SlowLight
{
public:
  SlowLight(const Scene& scene, LineSweep& sweep, int band);

  /// Watches the places whose light has grown since the window before, if that of any surface has.
  /// @param grows whether they may be looked for at all
  void Watch(std::vector<BatchState>& batches, bool grows);
  /// Watches what was seen to get most of its light from watched places, and nothing else: noise
  /// hides how small places grow, such as a lamp in a white box, and feigns it of others.
  /// @return whether that changes much: sweeps have to show anew
  bool Refine(std::vector<BatchState>& batches);
  enum class Outcome
  {
    /// Too little of their light was seen.
    Unknown,
    /// They held much less or more, and are watched on.
    Scaled,
    /// They held about what they should: they are watched no longer.
    Balanced
  };
  /// Scales the latest estimates of the watched places, each batch by what it found itself.
  Outcome Balance(std::vector<BatchState>& batches);
  /// What they lost in a sweep of what they held, when they were balanced last.
  double LossShare() const { return this->LossShare_; }
  /// Watches nothing from now on.
  void Stop(std::vector<BatchState>& batches);

private:
  /// Watches these from now on.
  void Watch(std::vector<BatchState>& batches, WatchedPlaces places);

  const Scene& Scene_;
  LineSweep& Sweep_;
  int Band_;
  /// Illuminance of each side, by each batch, and fluence of each cell in the window before; empty:
  /// there was none.
  std::vector<Lanes> EarlierSides_;
  std::vector<float> EarlierCells_;
  /// How often the watched places were chosen anew.
  int Refinements_ = 0;
  double LossShare_ = 1.0;
};

} // namespace smokevis
