#include "ClearBorders.h"

#include "Deepening.h"

namespace smokevis
{

ClearBorders::ClearBorders(const Medium& smoke, const Medium::Block& block) : Block_(block)
{
  this->Faces_.reserve(block.Cells());
  block.ForEachCell(
    [&](const std::array<int, 3>& place)
    {
      const double extinction = smoke.Extinction(smoke.Cell(block, place));
      unsigned faces = 0;
      for (int face = 0; face < 6 && extinction > 0.0; ++face)
      {
        const std::int64_t before = smoke.Neighbour(block, place, face / 2, face % 2);
        const bool clear =
          Deepening::ClearBefore(before < 0 ? 0.0 : smoke.Extinction(before), extinction);
        faces |= clear ? 1U << face : 0U;
      }
      this->Faces_.push_back(static_cast<std::uint8_t>(faces));
    });
}

} // namespace smokevis
