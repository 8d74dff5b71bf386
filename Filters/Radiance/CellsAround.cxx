#include "CellsAround.h"

#include <unordered_map>

namespace smokevis
{

CellsAround::CellsAround(const Medium& smoke, const Medium::Block& block)
    : Block_(block), Beside_(block.Cells())
{
  this->Cells_.reserve(block.Enlarged().Cells());
  block.ForEachCell(
    [&](const std::array<int, 3>& place) { this->Cells_.push_back(smoke.Cell(block, place)); });
  std::unordered_map<std::int64_t, std::uint32_t> outside;
  block.ForEachCell(
    [&](const std::array<int, 3>& place)
    {
      for (int face = 0; face < 6; ++face)
      {
        const int axis = face / 2;
        const std::int64_t other = smoke.Neighbour(block, place, axis, face % 2);
        std::array<int, 3> next = place;
        next[axis] += face % 2 == 0 ? -1 : 1;
        std::uint32_t number = None;
        if (next[axis] >= 0 && next[axis] < block.Size[axis] && smoke.Cell(block, next) == other)
        {
          number = static_cast<std::uint32_t>(block.Number(next));
        }
        else if (other >= 0)
        {
          const auto [found, added] =
            outside.try_emplace(other, static_cast<std::uint32_t>(this->Cells_.size()));
          number = found->second;
          if (added)
          {
            this->Cells_.push_back(other);
          }
        }
        this->Beside_[block.Number(place)][face] = number;
      }
    });
  this->Bounds_.reserve(this->Cells_.size());
  for (const std::int64_t cell : this->Cells_)
  {
    this->Bounds_.push_back(smoke.CellBounds(cell));
  }
}

} // namespace smokevis
