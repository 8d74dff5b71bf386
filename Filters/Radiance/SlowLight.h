// Light that goes to and fro between bright surfaces for longer than sweeps would last.
#pragma once

#include <vector>

namespace smokevis
{

class LineSweep;
class Scene;
struct BatchState;

/// Brings light that grows on and on, as in a closed white box around a lamp, to where it gains
/// what it loses. The balance of the scene as a whole does not help where little of its light is
/// there.
///
/// Surfaces whose light still grows between two windows of sweeps are watched: of the light that
/// they send on, sweeps tally what they take up at once and what does not come back to any of them,
/// and of all other light what comes to them. The first is in proportion to what they hold, so that
/// the latter tells how much that is in the end. It holds for whatever surfaces are watched; those
/// that are not are one way for light to leave.
class SlowLight
{
public:
  SlowLight(const Scene& scene, LineSweep& sweep, int band);

  /// Watches the sides of patches whose light has grown since the window before, if any has.
  /// @param grows whether they may be looked for at all
  void Watch(std::vector<BatchState>& batches, bool grows);
  /// Scales the latest estimates of the watched sides, each batch by what it found itself.
  /// @return whether enough of their light was seen for that
  bool Balance(std::vector<BatchState>& batches);

private:
  const Scene& Scene_;
  LineSweep& Sweep_;
  int Band_;
  /// Of each side in the window before.
  std::vector<float> Earlier_;
};

} // namespace smokevis
