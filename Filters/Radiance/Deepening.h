// How the ways to a light get deeper from place to place in a smoke cell.
#pragma once

#include "Types.h"

namespace smokevis
{

/// The straight way from the centre of a smoke cell to a light.
struct CellWay
{
  Vec3 Centre{0.0};
  /// The cell's edges [m].
  Vec3 Size{0.0};
  /// The cell's own at 633 nm [1/m].
  double Extinction = 0.0;
  /// Length of the way [m].
  double Distance = 0.0;
  /// Optical depth of the way at 633 nm.
  double Depth = 0.0;
};

/// Optical depth, at 633 nm, of the ways to a light from the places around one.
struct Deepening
{
  /// Mean extinction along the way, by which depths go with the distance but for what follows
  /// [1/m].
  double Mean = 0.0;
  /// Derivatives of the depth [1/m].
  Vec3 Slope{0.0};
  /// Its second derivatives along the axes, without those of the distance [1/m2].
  Vec3 Bend{0.0};
  /// Sizes of its derivatives in the half of a cell that light comes into from clear air; those
  /// above hold no more than is found in the other half, too [1/m]. 0 across other faces.
  Vec3 Entry{0.0};
  /// By how much the depth along an edge of a cell differs at most from that in the smoke that
  /// light comes from; 0 where smoke is even.
  double Border = 0.0;

  /// Whether smoke of one extinction counts as clear air before that of another.
  static bool ClearBefore(double before, double extinction)
  {
    return before < ClearShare * extinction;
  }
  /// The side of a cell along an axis that light comes from: low (0) or high (1).
  static int LitSide(const CellWay& cell, const Vec3& light, int axis)
  {
    return cell.Centre[axis] > light[axis] ? 0 : 1;
  }
  /// The way from as far behind a cell as another lies before it, if ways get deeper behind it as
  /// they do before it.
  static CellWay Onwards(const CellWay& cell, const CellWay& before, const Vec3& light, int axis);
  /// Where the smoke is even.
  /// @param light where the ways lead to
  static Deepening Even(const CellWay& cell, const Vec3& light);
  /// By the ways from the cells around a cell: in even smoke the depth goes with the distance; what
  /// it differs by goes with the cell's own smoke, as in layers: behind the border of clear air it
  /// rises the faster the more aslant light comes in.
  /// @param beside from the cells on the low and the high side along each axis
  /// @param light where the ways lead to
  static Deepening Within(
    const CellWay& cell, const std::array<std::array<CellWay, 2>, 3>& beside, const Vec3& light);

  /// Of the ways around a place `step` further.
  /// @param from the light's place to this one
  Deepening Moved(const Vec3& from, const Vec3& step) const;
  /// How much deeper the way is from a place `step` further.
  /// @param from the light's place to this one
  double At(const Vec3& from, const Vec3& step) const;

private:
  /// Smoke of less than this share of a cell's extinction counts as clear air beside it.
  static constexpr double ClearShare = 0.25;
};

} // namespace smokevis
