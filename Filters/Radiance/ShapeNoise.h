// The noise that a field's variation inside a cell has of the neighbouring cells.
#pragma once

#include "CellShape.h"
#include "Types.h"

#include <array>
#include <cstdint>
#include <vector>

namespace smokevis
{

class Scene;

/// A cell's own batches do not tell how well the means of its neighbours are known, which its shape
/// comes from. That matters where it is known much better than they are, as the first cell of thick
/// smoke that a lamp shines into; elsewhere its own noise covers theirs, and nothing is added.
class ShapeNoise
{
public:
  /// None.
  ShapeNoise() = default;
  /// @param lanes batches of the field, a value a cell
  /// @param shape from the means of the same
  ShapeNoise(const Scene& scene, const Lanes* lanes, const CellShape& shape);

  /// Adds weight times what the batches of the neighbours change at a point of a cell; their mean
  /// is 0.
  /// @param own batches of the cell, which the weight takes to the point
  void Add(std::int64_t cell, const Vec3& point, double weight, const Lanes& own, Lanes& sum) const
  {
    if (!this->Places_.empty() && this->Places_[cell] >= 0)
    {
      this->AddOf(this->Cells_[this->Places_[cell]], point, weight * Mean(own), sum);
    }
  }

private:
  struct Cell
  {
    /// Where the slopes do not matter, since the cell's mean stays what it is.
    Vec3 Centre;
    /// By what the slopes of the logarithm differ in each batch [1/m].
    std::array<Lanes, 3> Slope;
  };
  static void AddOf(const Cell& cell, const Vec3& point, double weight, Lanes& sum);

  /// Of each cell the place in Cells_, or -1; empty where there are none.
  std::vector<std::int32_t> Places_;
  std::vector<Cell> Cells_;
};

} // namespace smokevis
