// How a field that is known by its cell means varies inside the cells.
#pragma once

#include "Box.h"
#include "ExponentialMean.h"
#include "SmokePiece.h"
#include "Types.h"

#include <cmath>
#include <functional>
#include <vector>

namespace smokevis
{

class Scene;

/// Light falls off exponentially in smoke, so that the logarithm of a field is taken to vary
/// linearly between the centres of neighbouring cells. The mean over a cell stays what it is.
class CellShape
{
public:
  /// Most change of the logarithm of a field across a cell.
  static constexpr double SteepestChange = 4.0;
  /// Largest value over the mean where it changes so along three axes: (4 / (1 - exp(-4)))^3.
  static constexpr double LargestOfAll = 67.7;
  /// Mean of the field in the second cell, as the first, its neighbour, sees it; 0: not known.
  using Means = std::function<float(std::int64_t, std::int64_t)>;

  /// Whether a field comes to an end in a plane close to a side of a cell, 0: low, 1: high, of an
  /// axis, as the light of a plate does in the plate's plane.
  using Ends = std::function<bool(std::int64_t, int, int)>;

  /// A field that does not vary.
  CellShape() = default;
  /// @param ends none: nowhere
  CellShape(const Scene& scene, const Means& means, const Ends& ends = nullptr);

  /// Has the processor fetch what Value() reads.
  void Fetch(std::int64_t cell) const
  {
    if (!this->Slopes_.empty())
    {
      __builtin_prefetch(&this->Slopes_[cell]);
    }
  }

  /// Value at a point of a cell over the mean there, as exactly as slopes are kept.
  double Value(std::int64_t cell, const Vec3& point) const
  {
    if (this->Slopes_.empty())
    {
      return 1.0;
    }
    const Slope& slope = this->Slopes_[cell];
    const Vec3 from = point - this->Lower_;
    return std::exp(static_cast<float>(
      slope.Offset + slope.Slope[0] * from.x + slope.Slope[1] * from.y + slope.Slope[2] * from.z));
  }

  /// Largest value in a cell over the mean there, at most LargestOfAll.
  double Largest(std::int64_t cell, const Box& bounds) const
  {
    Vec3 corner;
    for (int axis = 0; axis < 3; ++axis)
    {
      corner[axis] =
        this->LogarithmSlope(cell, axis) > 0.0 ? bounds.Upper[axis] : bounds.Lower[axis];
    }
    return this->Value(cell, corner);
  }

  /// What a field of mean 1 in the cell, as a source, sends out of a piece of a ray at its
  /// beginning; one of 1 everywhere sends 1 - exp(-depth).
  double Emerging(const SmokePiece& piece) const
  {
    double rise = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      rise += this->LogarithmSlope(piece.Cell, axis) * piece.Step[axis];
    }
    // Cheaper where little changes along the piece, by the second moment around the mean place; of
    // higher ones 1e-4 is left.
    constexpr double Small = 0.5;
    return std::abs(rise) < Small && piece.Depth < Small
             ? piece.Lost * this->Value(piece.Cell, piece.Middle) * (1.0 + rise * rise / 24.0)
             : piece.Depth * this->Value(piece.Cell, piece.Begin) *
                 MeanOfExponential(piece.Depth - rise);
  }

  /// Slope of the logarithm along an axis in a cell [1/m].
  double LogarithmSlope(std::int64_t cell, int axis) const
  {
    return this->Slopes_.empty() ? 0.0 : this->Slopes_[cell].Slope[axis];
  }

private:
  struct Slope
  {
    /// Of the logarithm [1/m].
    std::array<float, 3> Slope{};
    /// Logarithm of the value over the mean, continued to the smoke's lower corner.
    float Offset = 0.0F;
  };
  std::vector<Slope> Slopes_;
  Vec3 Lower_{0.0};
};

} // namespace smokevis
