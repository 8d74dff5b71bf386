// The straight ways from the centres of smoke cells to a light.
#pragma once

#include "Deepening.h"
#include "Emitters.h"
#include "Medium.h"

#include <optional>
#include <vector>

namespace smokevis
{

class LightWays
{
public:
  /// Both must outlive it.
  /// @param scale largest extinction of a band over that at 633 nm
  LightWays(const Medium& smoke, double scale, const LightGroup& light)
      : Smoke_(smoke), Scale_(scale), Light_(light)
  {
  }

  /// Keeps the ways that it walks from the cells of a block and from those around it, so that each
  /// is walked once. It serves one thread, then.
  LightWays(const Medium& smoke, double scale, const LightGroup& light, const Medium::Block& block);

  const LightGroup& Light() const { return this->Light_; }
  /// Largest extinction of a band over that at 633 nm.
  double Scale() const { return this->Scale_; }

  /// Mean extinction along the way from a cell at 633 nm [1/m].
  double Extinction(std::int64_t cell) const;
  /// The same of a cell of a block, which lies within its grid.
  double Extinction(const Medium::Block& block, const std::array<int, 3>& place) const;
  /// Of ways around the centre of a cell.
  Deepening DeepeningOf(std::int64_t cell) const;
  /// The same of the cells of a block that are asked for.
  /// @param asked of each cell of the block, x fastest; others get no more than a Deepening of
  /// zeros
  /// @param extinction means along the ways from its cells [1/m]; NaN: not known
  /// @param allowed by how much optical depths of ways from cells around the block may be off,
  /// where a few of them tell the rest; none: all are walked
  /// @param roughly whether it will do to take smoke for even
  /// @param told to which is added how many of the ways from around the block were told
  std::vector<Deepening> DeepeningIn(const Medium::Block& block, const std::vector<bool>& asked,
    const std::vector<double>& extinction, const std::optional<double>& allowed, bool roughly,
    std::size_t& told) const;

private:
  /// @param extinction mean along the way, if known [1/m]
  CellWay From(std::int64_t cell, const std::optional<double>& extinction = {}) const;
  /// From the cell across a face of a cell, or from as far in the clear air there; none where there
  /// is no cell behind the last one as seen from the light.
  /// @param known(other) mean extinction along the way from that cell, if known [1/m]
  template <class Known>
  std::optional<CellWay> FromBeside(
    std::int64_t cell, const CellWay& way, int axis, int side, Known&& known) const;
  /// Whether a way leads through smoke like that of its cell.
  bool Even(const CellWay& way) const;
  /// @param beside(axis, side) the way from the cell there; on the side behind there may be none
  template <class Beside> Deepening Around(const CellWay& way, Beside&& beside) const;

  const Medium& Smoke_;
  double Scale_;
  const LightGroup& Light_;
  /// The cells whose ways are kept.
  Medium::Block Kept_;
  /// Mean extinction along these; NaN: not walked yet [1/m].
  mutable std::vector<double> Walked_;
};

} // namespace smokevis
