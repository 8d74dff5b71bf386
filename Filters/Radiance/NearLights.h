// Which lights are near to which smoke cells, and their fluence there.
#pragma once

#include "DirectLight.h"
#include "NearField.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace smokevis
{

/// A light within a few cell edges of a cell counts as near to it: its fluence is too steep there
/// to be interpolated between cells. None where no smoke scatters.
class NearLights
{
public:
  explicit NearLights(const Scene& scene);

  struct Light
  {
    std::uint32_t Index = 0;
    /// Whether the whole cell sees it unhidden.
    bool Clear = false;
  };
  struct Cell
  {
    std::int64_t Index = 0;
    std::vector<Light> Lights;
    /// Whether one is so close that its fluence varies much inside the cell.
    bool Close = false;
  };
  /// Cells that lights are near to.
  const std::vector<Cell>& Cells() const { return this->Cells_; }
  /// Place of a smoke cell among them, or -1.
  int Place(std::int64_t cell) const { return this->Places_.empty() ? -1 : this->Places_[cell]; }
  /// The lattices of a light that is near to some cell; none where it changes too quickly with the
  /// angle, as measured light may.
  const NearField* Field(std::size_t light) const { return this->Fields_[light].get(); }

private:
  /// Finds the cells near to a light; returns how far from it they reach [m].
  double FindCells(std::size_t light);

  const Scene& Scene_;
  DirectLight Direct_;
  std::vector<Cell> Cells_;
  std::vector<std::int32_t> Places_;
  std::vector<std::unique_ptr<NearField>> Fields_;
};

} // namespace smokevis
