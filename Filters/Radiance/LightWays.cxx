#include "LightWays.h"

#include <algorithm>
#include <cmath>

namespace smokevis
{

namespace
{

/// Optical depth along an edge of a cell by which the smoke on a way may differ from the cell's and
/// still count as even.
constexpr double EvenDepth = 0.1;

} // namespace

double LightWays::Extinction(std::int64_t cell) const
{
  const Vec3 from = this->Smoke_.CellCentre(cell);
  const Vec3 to = this->Light_.Centre - from;
  const double distance = glm::length(to);
  return distance > 0.0 ? this->Smoke_.OpticalDepth(from, to / distance, 0.0, distance) / distance
                        : this->Smoke_.Extinction(cell);
}

CellWay LightWays::From(std::int64_t cell, const std::optional<double>& extinction) const
{
  CellWay way{
    this->Smoke_.CellCentre(cell), this->Smoke_.CellSize(cell), this->Smoke_.Extinction(cell)};
  way.Distance = glm::length(this->Light_.Centre - way.Centre);
  way.Depth = way.Distance * (extinction ? *extinction : this->Extinction(cell));
  return way;
}

CellWay LightWays::FromBeside(std::int64_t cell, const CellWay& way, int axis, int side) const
{
  if (const std::int64_t other = this->Smoke_.Neighbour(cell, axis, side); other >= 0)
  {
    return this->From(other);
  }
  // Outside of all meshes there is clear air.
  CellWay outside{way.Centre, way.Size};
  outside.Centre[axis] += (side == 0 ? -1.0 : 1.0) * way.Size[axis];
  const Vec3 to = this->Light_.Centre - outside.Centre;
  outside.Distance = glm::length(to);
  outside.Depth = outside.Distance > 0.0 ? this->Smoke_.OpticalDepth(outside.Centre,
                                             to / outside.Distance, 0.0, outside.Distance)
                                         : 0.0;
  return outside;
}

bool LightWays::Even(const CellWay& way) const
{
  return std::abs(way.Depth - way.Extinction * way.Distance) * LargestEdge(way.Size) *
           this->Scale_ <=
         EvenDepth * way.Distance;
}

template <class Beside>
Deepening LightWays::Around(std::int64_t cell, const CellWay& way, Beside&& beside) const
{
  if (this->Even(way))
  {
    return Deepening::Even(way, this->Light_.Centre);
  }
  std::array<std::array<CellWay, 2>, 3> ways;
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int side = 0; side < 2; ++side)
    {
      const CellWay* const known = beside(axis, side);
      ways[axis][side] = known ? *known : this->FromBeside(cell, way, axis, side);
    }
  }
  return Deepening::Within(way, ways, this->Light_.Centre);
}

Deepening LightWays::DeepeningOf(std::int64_t cell) const
{
  return this->Around(cell, this->From(cell), [](int, int) -> const CellWay* { return nullptr; });
}

std::vector<Deepening> LightWays::DeepeningIn(
  const Medium::Block& block, const std::vector<double>& extinction, bool roughly) const
{
  std::vector<CellWay> ways;
  ways.reserve(block.Cells());
  block.ForEachCell(
    [&](const std::array<int, 3>& place)
    {
      ways.push_back(this->From(this->Smoke_.Cell(block, place),
        extinction.empty() ? std::nullopt : std::optional(extinction[ways.size()])));
    });
  std::vector<Deepening> result;
  result.reserve(ways.size());
  block.ForEachCell(
    [&](const std::array<int, 3>& place)
    {
      if (roughly)
      {
        result.push_back(Deepening::Even(ways[result.size()], this->Light_.Centre));
        return;
      }
      result.push_back(this->Around(this->Smoke_.Cell(block, place), ways[result.size()],
        [&](int axis, int side) -> const CellWay*
        {
          std::array<int, 3> other = place;
          other[axis] += side == 0 ? -1 : 1;
          return other[axis] < 0 || other[axis] >= block.Size[axis] ? nullptr
                                                                    : &ways[block.Number(other)];
        }));
    });
  return result;
}

} // namespace smokevis
