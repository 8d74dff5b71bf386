#include "LightWays.h"

#include "ToldWays.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace smokevis
{

namespace
{

/// Optical depth along an edge of a cell by which the smoke on a way may differ from the cell's and
/// still count as even.
constexpr double EvenDepth = 0.1;

/// Ways from the layer of cells across a face of a block.
class LayerWays
{
public:
  /// @param allowed error of an optical depth where ways tell of others; none: all are walked
  LayerWays(const Medium& smoke, const LightWays& ways, const Medium::Block& block, int axis,
    int side, const std::optional<double>& allowed)
      : Smoke_(smoke), Ways_(ways), Block_(block), Axis_(axis)
  {
    this->Block_.First[axis] += side == 0 ? -1 : block.Size[axis];
    this->Block_.Size[axis] = 1;
    this->There_ = smoke.Holds(this->Block_);
    ToldWays told(smoke, ways, this->Block_);
    if (allowed && this->There_ && told.WalkCorners() && told.CornersTell(*allowed))
    {
      told.TellRest(std::vector<bool>(this->Block_.Cells(), true), 2.0 * *allowed);
      this->Extinction_ = told.Extinction();
      this->Told_ = told.Told();
    }
  }

  /// How many ways were told.
  std::size_t Told() const { return this->Told_; }

  /// Mean along the way from a cell beside one of the block [1/m]; none where that is not one of
  /// the layer, but of another grid, or a part of a cell.
  std::optional<double> Extinction(std::array<int, 3> place, std::int64_t beside) const
  {
    place[this->Axis_] = 0;
    if (!this->There_ || this->Smoke_.Cell(this->Block_, place) != beside)
    {
      return std::nullopt;
    }
    return this->Extinction_.empty() ? this->Ways_.Extinction(this->Block_, place)
                                     : this->Extinction_[this->Block_.Number(place)];
  }

private:
  const Medium& Smoke_;
  const LightWays& Ways_;
  Medium::Block Block_;
  int Axis_;
  bool There_ = false;
  /// Told means along the ways [1/m]; empty: they are walked.
  std::vector<double> Extinction_;
  std::size_t Told_ = 0;
};

} // namespace

LightWays::LightWays(
  const Medium& smoke, double scale, const LightGroup& light, const Medium::Block& block)
    : Smoke_(smoke), Scale_(scale), Light_(light), Kept_(block.Enlarged())
{
  this->Walked_.assign(this->Kept_.Cells(), std::numeric_limits<double>::quiet_NaN());
}

double LightWays::Extinction(const Medium::Block& block, const std::array<int, 3>& place) const
{
  std::array<int, 3> kept;
  bool within = !this->Walked_.empty() && block.Grid == this->Kept_.Grid;
  for (int axis = 0; axis < 3; ++axis)
  {
    kept[axis] = block.First[axis] + place[axis] - this->Kept_.First[axis];
    within = within && kept[axis] >= 0 && kept[axis] < this->Kept_.Size[axis];
  }
  const std::int64_t cell = this->Smoke_.Cell(block, place);
  if (!within)
  {
    return this->Extinction(cell);
  }
  double& walked = this->Walked_[this->Kept_.Number(kept)];
  if (std::isnan(walked))
  {
    walked = this->Extinction(cell);
  }
  return walked;
}

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
  const Box box = this->Smoke_.CellBounds(cell);
  CellWay way{box.Centre(), box.Size(), this->Smoke_.Extinction(cell)};
  way.Distance = glm::length(this->Light_.Centre - way.Centre);
  way.Depth = way.Distance * (extinction ? *extinction : this->Extinction(cell));
  return way;
}

template <class Known>
std::optional<CellWay> LightWays::FromBeside(
  std::int64_t cell, const CellWay& way, int axis, int side, Known&& known) const
{
  if (const std::int64_t other = this->Smoke_.Neighbour(cell, axis, side); other >= 0)
  {
    return this->From(other, known(other));
  }
  if (side != Deepening::LitSide(way, this->Light_.Centre, axis) &&
      this->Smoke_.Neighbour(cell, axis, 1 - side) >= 0)
  {
    return std::nullopt;
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

template <class Beside> Deepening LightWays::Around(const CellWay& way, Beside&& beside) const
{
  if (this->Even(way))
  {
    return Deepening::Even(way, this->Light_.Centre);
  }
  std::array<std::array<CellWay, 2>, 3> ways;
  for (int axis = 0; axis < 3; ++axis)
  {
    // Behind the last cell it gets deeper as it does before it.
    const int lit = Deepening::LitSide(way, this->Light_.Centre, axis);
    ways[axis][lit] = *beside(axis, lit);
    const std::optional<CellWay> behind = beside(axis, 1 - lit);
    ways[axis][1 - lit] =
      behind ? *behind : Deepening::Onwards(way, ways[axis][lit], this->Light_.Centre, axis);
  }
  return Deepening::Within(way, ways, this->Light_.Centre);
}

Deepening LightWays::DeepeningOf(std::int64_t cell) const
{
  const CellWay way = this->From(cell);
  return this->Around(way,
    [&](int axis, int side)
    {
      return this->FromBeside(
        cell, way, axis, side, [](std::int64_t) { return std::optional<double>(); });
    });
}

std::vector<Deepening> LightWays::DeepeningIn(const Medium::Block& block,
  const std::vector<bool>& asked, const std::vector<double>& extinction,
  const std::optional<double>& allowed, bool roughly, std::size_t& told) const
{
  // The ways from its cells, once they are asked for.
  std::vector<std::optional<CellWay>> ways(block.Cells());
  const auto wayFrom = [&](const std::array<int, 3>& place) -> const CellWay&
  {
    const std::size_t number = block.Number(place);
    if (!ways[number])
    {
      const bool known = !std::isnan(extinction[number]);
      ways[number] = this->From(this->Smoke_.Cell(block, place),
        known ? extinction[number] : this->Extinction(block, place));
    }
    return *ways[number];
  };
  // The layers of cells across the block's faces.
  std::array<std::optional<LayerWays>, 6> layers;
  std::vector<Deepening> result(block.Cells());
  block.ForEachCell(
    [&](const std::array<int, 3>& place)
    {
      Deepening& deepening = result[block.Number(place)];
      if (!asked[block.Number(place)])
      {
        return;
      }
      const CellWay& way = wayFrom(place);
      if (roughly)
      {
        deepening = Deepening::Even(way, this->Light_.Centre);
        return;
      }
      const std::int64_t cell = this->Smoke_.Cell(block, place);
      deepening = this->Around(way,
        [&](int axis, int side) -> std::optional<CellWay>
        {
          std::array<int, 3> other = place;
          other[axis] += side == 0 ? -1 : 1;
          const bool outside = other[axis] < 0 || other[axis] >= block.Size[axis];
          // Where a finer grid lies over that cell, or walls part it, another is beside this one,
          // unless that is covered itself.
          if (!outside && (this->Smoke_.Neighbour(block, place, axis, side) ==
                              this->Smoke_.Cell(block, other) ||
                            this->Smoke_.Covered(cell)))
          {
            return wayFrom(other);
          }
          std::optional<LayerWays>& layer = layers[2 * axis + side];
          if (outside && !layer)
          {
            layer.emplace(this->Smoke_, *this, block, axis, side, allowed);
            told += layer->Told();
          }
          return this->FromBeside(cell, way, axis, side,
            [&](std::int64_t beside)
            { return outside ? layer->Extinction(place, beside) : std::optional<double>(); });
        });
    });
  return result;
}

} // namespace smokevis
