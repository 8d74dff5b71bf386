// What the cells at the corners of a block tell of those between them.
#pragma once

#include "Medium.h"

#include <array>

namespace smokevis
{

/// The cell at a corner of a block (0 to 7), first axis fastest.
std::array<int, 3> CornerOf(const Medium::Block& block, int index);

/// The cell of a block so many steps along a diagonal that winds around the block, and so passes
/// through each layer of cells across each axis, at most in as many steps as its longest edge has
/// cells: a gap between layers of smoke may be one cell thick.
/// @param diagonal which of the block's four (0 to 3)
std::array<int, 3> PlaceOnDiagonal(const Medium::Block& block, int steps, int diagonal = 0);

/// Value in a cell of a block between those at its corners: linear along each axis.
double BetweenCorners(const std::array<double, 8>& corners, const Medium::Block& block,
  const std::array<int, 3>& place);

} // namespace smokevis
