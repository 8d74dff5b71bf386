// What smoke that glows brings to its own light.
#pragma once

#include <cstdint>

namespace smokevis
{

class Scene;

/// Light falls off on its way through smoke, so that neighbours tell how light from elsewhere
/// varies in a cell. They tell less of what smoke glows itself, which changes by leaps between
/// cells: of that, what does not leave the cell is taken to be even in it.
class OwnGlow
{
public:
  OwnGlow(const Scene& scene, int band) : Scene_(scene), Band_(band) {}

  /// Fluence that a cell has of light of its own that does not leave it [lx]: 4 pi times the
  /// luminance that it glows with, times the share that it would take up, were it alone in clear
  /// air, of its own light in the end, and times that which it meets on its first way. By Wigner's
  /// rational approximation both are tau / (1 + tau), with the optical depth of absorption and of
  /// extinction on the mean chord.
  double Fluence(std::int64_t cell) const;
  /// Share of a cell's light that varies in it as it does between cells.
  /// @param fluence all of that light [lx], more than 0
  double VaryingShare(std::int64_t cell, double fluence) const
  {
    return ShareBeside(this->Fluence(cell), fluence);
  }
  /// The same where Fluence(cell) is known.
  static double ShareBeside(double own, double fluence)
  {
    return fluence > own ? 1.0 - own / fluence : 0.0;
  }

private:
  const Scene& Scene_;
  int Band_;
};

} // namespace smokevis
