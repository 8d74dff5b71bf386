// How the ways to a light get deeper from place to place in a smoke cell.
#pragma once

#include "Types.h"

namespace smokevis
{

/// The straight way from the centre of a smoke cell to a light.
struct CellWay
{
  Vec3 Centre;
  /// The cell's edges [m].
  Vec3 Size;
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

  /// Where the smoke is even.
  /// @param light where the ways lead to
  static Deepening Even(const CellWay& cell, const Vec3& light);
  /// By the ways from the cells around a cell: in even smoke the depth goes with the distance; what
  /// it differs by goes with the cell's own smoke, as in layers: behind the border of clear air it
  /// rises the faster the more aslant light comes in.
  /// @param beside from the cells on the low and the high side along each axis; may be null
  /// @param light where the ways lead to
  static Deepening Within(const CellWay& cell,
    const std::array<std::array<const CellWay*, 2>, 3>& beside, const Vec3& light);

  /// Of the ways around a place `step` further.
  /// @param from the light's place to this one
  Deepening Moved(const Vec3& from, const Vec3& step) const;
  /// How much deeper the way is from a place `step` further.
  /// @param from the light's place to this one
  double At(const Vec3& from, const Vec3& step) const;
};

} // namespace smokevis
