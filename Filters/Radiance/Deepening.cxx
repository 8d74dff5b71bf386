#include "Deepening.h"

#include <algorithm>
#include <cmath>

namespace smokevis
{

namespace
{

/// Mean extinction between the centres of two cells [1/m].
double Between(const CellWay& cell, const CellWay& other, int axis)
{
  return (cell.Extinction * cell.Size[axis] + other.Extinction * other.Size[axis]) /
         (cell.Size[axis] + other.Size[axis]);
}

/// The derivative that the way from one cell beside another tells, and how far from the cell's
/// centre that is met: in the middle of half of the cell and half of the other, each by its smoke.
struct SlopeBeside
{
  double Slope, Place;

  /// @param even the derivative in even smoke
  SlopeBeside(const CellWay& cell, const CellWay& other, int axis, double even)
  {
    const double between = Between(cell, other, axis);
    const double share = between > 0.0 ? cell.Extinction / between : 1.0;
    const double excess = cell.Depth - other.Depth - between * (cell.Distance - other.Distance);
    this->Slope = even + share * excess / (cell.Centre[axis] - other.Centre[axis]);
    const double weight = between > 0.0 ? other.Extinction / between : 1.0;
    this->Place = 0.25 * (cell.Size[axis] + weight * other.Size[axis]);
  }
};

/// None at the light's own place, which all ways lead away from.
Vec3 DirectionOf(const Vec3& way)
{
  const double distance = glm::length(way);
  return distance > 0.0 ? way / distance : Vec3(0.0);
}

} // namespace

Deepening Deepening::Even(const CellWay& cell, const Vec3& light)
{
  const double mean = cell.Distance > 0.0 ? cell.Depth / cell.Distance : cell.Extinction;
  return {mean, cell.Extinction * DirectionOf(cell.Centre - light)};
}

CellWay Deepening::Onwards(const CellWay& cell, const CellWay& before, const Vec3& light, int axis)
{
  CellWay behind = before;
  behind.Centre[axis] = 2.0 * cell.Centre[axis] - before.Centre[axis];
  behind.Distance = glm::length(light - behind.Centre);
  const double between = Between(cell, before, axis);
  behind.Depth = 2.0 * cell.Depth - before.Depth -
                 between * (2.0 * cell.Distance - before.Distance - behind.Distance);
  return behind;
}

Deepening Deepening::Within(
  const CellWay& cell, const std::array<std::array<CellWay, 2>, 3>& beside, const Vec3& light)
{
  Deepening result = Even(cell, light);
  for (int axis = 0; axis < 3; ++axis)
  {
    double& slope = result.Slope[axis];
    const int lit = LitSide(cell, light, axis);
    const CellWay& before = beside[axis][lit];
    result.Border =
      std::max(result.Border, std::abs(cell.Extinction - before.Extinction) * cell.Size[axis]);
    const SlopeBeside below(cell, beside[axis][0], axis, slope);
    const SlopeBeside above(cell, beside[axis][1], axis, slope);
    if (ClearBefore(before.Extinction, cell.Extinction))
    {
      result.Entry[axis] = std::abs(lit == 0 ? below.Slope : above.Slope);
    }
    const double change = (above.Slope - below.Slope) / (below.Place + above.Place);
    slope = below.Slope + change * below.Place;
    // Where the two differ much, one crosses a border that the cell lies beside.
    const double least = below.Slope * above.Slope > 0.0
                           ? std::min(std::abs(below.Slope), std::abs(above.Slope))
                           : 0.0;
    const double share =
      least > 0.0 ? std::clamp(2.0 * (2.0 - std::abs(slope) / least), 0.0, 1.0) : 0.0;
    slope = std::copysign(std::min(std::abs(slope), 2.0 * least), slope);
    // No bend turns the slope within the cell.
    const double along = (cell.Centre[axis] - light[axis]) / cell.Distance;
    const double most = 2.0 * std::abs(slope) / cell.Size[axis];
    const double bend =
      change + (cell.Extinction - result.Mean) * (1.0 - along * along) / cell.Distance;
    result.Bend[axis] = share * std::clamp(bend, -most, most);
  }
  return result;
}

Deepening Deepening::Moved(const Vec3& from, const Vec3& step) const
{
  Deepening moved = *this;
  moved.Slope += this->Bend * step + this->Mean * (DirectionOf(from + step) - DirectionOf(from));
  return moved;
}

double Deepening::At(const Vec3& from, const Vec3& step) const
{
  return glm::dot(this->Slope + 0.5 * this->Bend * step, step) +
         this->Mean *
           (glm::length(from + step) - glm::length(from) - glm::dot(DirectionOf(from), step));
}

} // namespace smokevis
