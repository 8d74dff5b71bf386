// Which cells of smoke lie beside one another in a block.
#pragma once

#include "Medium.h"

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace smokevis
{

/// The cells of a block and those across their faces, found once for all lights that shine into it.
/// Both have numbers: first the cells of the block, x fastest.
class CellsAround
{
public:
  static constexpr std::uint32_t None = std::numeric_limits<std::uint32_t>::max();

  CellsAround(const Medium& smoke, const Medium::Block& block);

  const Medium::Block& Block() const { return this->Block_; }
  std::size_t Count() const { return this->Cells_.size(); }
  std::int64_t Cell(std::size_t number) const { return this->Cells_[number]; }
  /// What it fills.
  const Box& Bounds(std::size_t number) const { return this->Bounds_[number]; }
  /// Numbers of the cells across the faces of a cell of the block: low and high along x, along y,
  /// along z; None where there is none.
  /// @param number of the cell
  const std::array<std::uint32_t, 6>& Beside(std::size_t number) const
  {
    return this->Beside_[number];
  }

private:
  Medium::Block Block_;
  std::vector<std::int64_t> Cells_;
  std::vector<Box> Bounds_;
  /// Of the cells of the block.
  std::vector<std::array<std::uint32_t, 6>> Beside_;
};

} // namespace smokevis
