// The ways from the cells of a block to a light, told by a few of them.
#pragma once

#include "LightWays.h"
#include "Medium.h"

#include <array>
#include <vector>

namespace smokevis
{

/// Ways from afar to neighbouring cells are much the same: where those from a block's corners tell
/// of others that are looked at, they tell of all.
class ToldWays
{
public:
  /// Cells along the longest edge of the smallest block in which ways tell of each other.
  static constexpr int SmallestBlock = 4;

  /// All but the block must outlive it.
  ToldWays(const Medium& smoke, const LightWays& ways, const Medium::Block& block);

  /// Walks the ways from the corners; returns whether these may tell of others: solids hold no
  /// smoke, so that ways out of them do not tell of their neighbours, and small blocks are not
  /// worth it.
  bool WalkCorners();
  /// Whether the corners, which were walked, tell of a way from each layer of the block's cells.
  /// @param allowed error of an optical depth
  bool CornersTell(double allowed);
  /// Lets the corners tell of all others but of cells whose own smoke differs from what the corners
  /// tell of it: they may lie in a duct or a post as small as themselves, and are walked where they
  /// are asked for. Returns whether any are.
  /// @param asked of each cell of the block, x fastest
  /// @param odd optical depth along an edge of a cell by which its smoke must differ, at least
  bool TellRest(const std::vector<bool>& asked, double odd);
  /// Walks the ways from the cells that are asked for.
  void Walk(const std::vector<bool>& asked);

  /// Mean extinction along each way at 633 nm, x fastest; NaN: not known [1/m].
  const std::vector<double>& Extinction() const { return this->Extinction_; }
  /// The smallest of those known.
  double Least() const;
  /// Whole cells that are asked for whose ways were told.
  std::size_t Told() const { return this->Told_; }

private:
  double Walk(const std::array<int, 3>& place);
  /// Optical depth over a distance [m].
  double Depth(double extinction, double distance) const;

  const Medium& Smoke_;
  const LightWays& Ways_;
  Medium::Block Block_;
  std::vector<double> Extinction_;
  /// At the corners: means along the ways, and the cells' own [1/m].
  std::array<double, 8> Corners_{}, Own_{};
  std::size_t Told_ = 0;
};

} // namespace smokevis
