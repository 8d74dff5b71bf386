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

  /// Mean extinction along the way from a cell at 633 nm [1/m].
  double Extinction(std::int64_t cell) const;
  /// Of ways around the centre of a cell.
  Deepening DeepeningOf(std::int64_t cell) const;
  /// The same of all cells of a block.
  /// @param extinction means along the ways from its cells [1/m]; empty: not known
  /// @param roughly whether it will do to take smoke for even
  std::vector<Deepening> DeepeningIn(
    const Medium::Block& block, const std::vector<double>& extinction, bool roughly) const;

private:
  /// @param extinction mean along the way, if known [1/m]
  CellWay From(std::int64_t cell, const std::optional<double>& extinction = {}) const;
  /// From the cell across a face of a cell, or from as far in the clear air there.
  CellWay FromBeside(std::int64_t cell, const CellWay& way, int axis, int side) const;
  /// Whether a way leads through smoke like that of its cell.
  bool Even(const CellWay& way) const;
  /// @param beside(axis, side) the way from the cell there if that is known already, else null
  template <class Beside>
  Deepening Around(std::int64_t cell, const CellWay& way, Beside&& beside) const;

  const Medium& Smoke_;
  double Scale_;
  const LightGroup& Light_;
};

} // namespace smokevis
