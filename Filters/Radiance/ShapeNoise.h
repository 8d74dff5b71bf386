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
class SlopeWeights;

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
  /// @param band that the field is of
  /// @param lanes batches of the field, a value a cell; must outlive this
  /// @param means of the batches, 0 in cells that shapes leave out
  /// @param shape from those means
  ShapeNoise(const Scene& scene, int band, const Lanes* lanes, const std::vector<float>& means,
    const CellShape& shape);

  /// Adds weight times what the batches of the neighbours change at a point of a cell.
  void Add(std::int64_t cell, const Vec3& point, double weight, Lanes& sum) const
  {
    const Response& own = this->Responses_[cell];
    const Vec3 from = point - this->Lower_;
    float itself = 0.0F;
    for (int axis = 0; axis < 3; ++axis)
    {
      const auto away = static_cast<float>(weight * (from[axis] - own.Still[axis]));
      for (const int side : {0, 1})
      {
        const float share = away * own.Rise[axis][side];
        if (share != 0.0F)
        {
          const std::int64_t other = this->Open_->Neighbour(cell, axis, side);
          smokevis::Add(sum, this->Lanes_[other], share * this->InverseMeans_[other]);
          itself += share;
        }
      }
    }
    if (itself != 0.0F)
    {
      smokevis::Add(sum, this->Lanes_[cell], -itself * this->InverseMeans_[cell]);
    }
  }

private:
  /// How the field in a cell follows the relative noise of the neighbours along each axis.
  struct Response
  {
    /// For that on the low and the high side; 0 where there is none with light, and where the slope
    /// is cut off: it does not follow noise [lx/m].
    std::array<std::array<float, 2>, 3> Rise{};
    /// Where it has no effect, from the smoke's lower corner [m].
    std::array<float, 3> Still{};
  };

  /// @param mean of what varies in the cell as between cells
  Response Find(const Scene& scene, std::int64_t cell, const SlopeWeights& weights, double mean,
    const CellShape& shape) const;

  const OpenFaces* Open_ = nullptr;
  const Lanes* Lanes_ = nullptr;
  /// 0 where there is no light.
  std::vector<float> InverseMeans_;
  std::vector<Response> Responses_;
  Vec3 Lower_{0.0};
};

} // namespace smokevis
