#include "ClearBorders.h"

#include "CellsAround.h"
#include "Deepening.h"

namespace smokevis
{

ClearBorders::ClearBorders(const Medium& smoke, const CellsAround& around) : Block_(around.Block())
{
  this->Faces_.reserve(this->Block_.Cells());
  for (std::size_t number = 0; number < this->Block_.Cells(); ++number)
  {
    const double extinction = smoke.Extinction(around.Cell(number));
    unsigned faces = 0;
    for (int face = 0; face < 6 && extinction > 0.0; ++face)
    {
      const std::uint32_t before = around.Beside(number)[face];
      const double beforeExtinction =
        before == CellsAround::None ? 0.0 : smoke.Extinction(around.Cell(before));
      faces |= Deepening::ClearBefore(beforeExtinction, extinction) ? 1U << face : 0U;
    }
    this->Faces_.push_back(static_cast<std::uint8_t>(faces));
  }
}

} // namespace smokevis
