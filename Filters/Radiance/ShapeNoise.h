// The noise that a field's variation inside a cell has of the neighbouring cells.
#pragma once

#include "CellShape.h"
#include "OpenFaces.h"
#include "Types.h"

#include <array>
#include <cstdint>
#include <vector>

namespace smokevis
{

class Scene;

/// The shape of a cell comes from the means of its neighbours, noise and all. The mean over the
/// batches stays what it is if each has slopes of its own, to first order, and their spread then
/// tells that noise too. It is alike in many rays, so that it counts most where they are averaged;
/// and where a cell is known better than its neighbours, as the first one of thick smoke that a
/// lamp shines into, it is all there is.
class ShapeNoise
{
public:
  /// None.
  ShapeNoise() = default;
  /// @param scene must outlive this
  /// @param lanes batches of the field, a value a cell; must outlive this
  /// @param means of the batches, 0 in cells that shapes leave out
  /// @param shape from those means
  ShapeNoise(const Scene& scene, const Lanes* lanes, const std::vector<float>& means,
    const CellShape& shape);

  /// Adds weight times what the batches of the neighbours change at a point of a cell.
  void Add(std::int64_t cell, const Vec3& point, double weight, Lanes& sum) const
  {
    const Response& own = this->Responses_[cell];
    const Vec3 from = point - this->Lower_;
    for (int axis = 0; axis < 3; ++axis)
    {
      const auto share =
        static_cast<float>(weight * (own.Slope[axis] * from[axis] + own.Offset[axis]));
      if (share != 0.0F)
      {
        const auto [low, high] = this->Ends(cell, axis);
        smokevis::Add(sum, this->Lanes_[high], share * this->InverseMeans_[high]);
        smokevis::Add(sum, this->Lanes_[low], -share * this->InverseMeans_[low]);
      }
    }
  }

private:
  /// How the field in a cell follows the relative noise of the neighbours along each axis: nothing
  /// where their slope is cut off.
  struct Response
  {
    /// A metre [lx/m].
    std::array<float, 3> Slope{};
    /// Continued to the smoke's lower corner [lx].
    std::array<float, 3> Offset{};
  };

  /// Cells whose means tell the slope of a cell: its neighbours on the low and high side, or itself
  /// where there is none with light.
  std::array<std::int64_t, 2> Ends(std::int64_t cell, int axis) const
  {
    std::array<std::int64_t, 2> ends = {cell, cell};
    for (const int side : {0, 1})
    {
      const std::int64_t other = this->Open_->Neighbour(cell, axis, side);
      if (other >= 0 && this->InverseMeans_[other] > 0.0F)
      {
        ends[side] = other;
      }
    }
    return ends;
  }
  Response Find(const Scene& scene, std::int64_t cell, const std::vector<float>& means,
    const CellShape& shape) const;

  const OpenFaces* Open_ = nullptr;
  const Lanes* Lanes_ = nullptr;
  /// 0 where there is no light.
  std::vector<float> InverseMeans_;
  std::vector<Response> Responses_;
  Vec3 Lower_{0.0};
};

} // namespace smokevis
