// Where cells of smoke lie behind clear air.
#pragma once

#include "Medium.h"

#include <cstdint>
#include <vector>

namespace smokevis
{

class CellsAround;

/// Of the cells of a block: across which of their faces there is air that counts as clear before
/// their own smoke (Deepening::ClearBefore). All lights that shine into the block ask for it.
class ClearBorders
{
public:
  ClearBorders(const Medium& smoke, const CellsAround& around);

  const Medium::Block& Block() const { return this->Block_; }
  /// @param part a block within this one
  /// @param place of a cell in that
  bool Across(const Medium::Block& part, const std::array<int, 3>& place, int axis, int side) const
  {
    return (this->Faces_[this->Block_.NumberIn(part, place)] >> (2 * axis + side) & 1) != 0;
  }
  /// Across any face.
  bool Any(const Medium::Block& part, const std::array<int, 3>& place) const
  {
    return this->Faces_[this->Block_.NumberIn(part, place)] != 0;
  }

private:
  Medium::Block Block_;
  /// A bit a face, x fastest.
  std::vector<std::uint8_t> Faces_;
};

} // namespace smokevis
