// A piece of a ray inside one cell of the smoke.
#pragma once

#include "Types.h"

#include <cmath>
#include <cstdint>

namespace smokevis
{

struct SmokePiece
{
  /// @param begin where the piece begins, and the step from there to its end [m]
  /// @param depth optical depth along it
  SmokePiece(std::int64_t cell, const Vec3& begin, const Vec3& step, double depth)
      : Cell(cell), Begin(begin), Step(step), Depth(depth)
  {
    // Both shares to their last digits, where one is small too.
    const bool thin = depth < 0.1;
    const double smaller = thin ? -std::expm1(-depth) : std::exp(-depth);
    this->Lost = thin ? smaller : 1.0 - smaller;
    this->Passed = thin ? 1.0 - smaller : smaller;
    const double share =
      depth < 1e-4 ? 0.5 - depth / 12.0 : 1.0 / depth - this->Passed / this->Lost;
    this->Middle = begin + share * step;
  }

  std::int64_t Cell;
  Vec3 Begin, Step;
  /// Where a source that varies linearly along the piece takes its mean, as seen from its
  /// beginning.
  Vec3 Middle;
  double Depth;
  /// Shares of the light from behind that are lost and that get through.
  double Lost, Passed;
};

} // namespace smokevis
