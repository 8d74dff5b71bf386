// DirectLight's part for blocks of smoke cells, which share the ways to a light.
#include "DirectLight.h"

#include "ClearBorders.h"
#include "Scene.h"
#include "ToldWays.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace smokevis
{

namespace
{

/// Error of an optical depth that is told so, and that of the weakest lights.
constexpr double WayTolerance = 0.004;
constexpr double RoughWayTolerance = 0.5;
/// A cell whose own smoke is off what the block's corners tell of it is walked where so many cells
/// like it would make more of an error than is allowed, and half of it more than the least.
constexpr double OddCells = 16.0;
/// Share of the fluence of the other lights that all lights left out may add: single precision
/// does not show it.
constexpr double NegligibleShare = 1e-7;
/// Share of the fluence of the other lights, times the number of lights, below which the mean of a
/// light over a cell is taken without Gauss points, to a few percent of itself.
constexpr double WeakShare = 0.05;
constexpr double Infinity = std::numeric_limits<double>::infinity();

/// The smallest block that holds those cells of a block that are asked for, if any are.
Medium::Block BlockOf(const Medium::Block& block, const std::vector<bool>& asked)
{
  std::array<int, 3> low = block.Size;
  std::array<int, 3> high{};
  block.ForEachCell(
    [&](const std::array<int, 3>& place)
    {
      for (int axis = 0; axis < 3 && asked[block.Number(place)]; ++axis)
      {
        low[axis] = std::min(low[axis], place[axis]);
        high[axis] = std::max(high[axis], place[axis] + 1);
      }
    });
  Medium::Block part = block;
  for (int axis = 0; axis < 3; ++axis)
  {
    part.First[axis] += low[axis];
    part.Size[axis] = std::max(0, high[axis] - low[axis]);
  }
  return part;
}

} // namespace

bool DirectLight::Enters(
  const LightGroup& root, const ClearBorders& borders, const Medium::Block& block) const
{
  const Medium& smoke = this->Scene_.Smoke();
  // Where the light reaches.
  Box light{root.Corners[0], root.Corners[0]};
  for (const Vec3& corner : root.Corners)
  {
    light.Add({corner, corner});
  }
  bool enters = false;
  block.ForEachCell(
    [&](const std::array<int, 3>& place)
    {
      if (enters || !borders.Any(block, place))
      {
        return;
      }
      const std::int64_t cell = smoke.Cell(block, place);
      const Box own = smoke.BoxOf(cell);
      const Vec3 way = own.Centre() - root.Centre;
      const Vec3 depth =
        smoke.Extinction(cell) * this->Scene_.LargestScale() * glm::length(way) * own.Size();
      for (int axis = 0; axis < 3 && !enters; ++axis)
      {
        // How much deeper the ways get from the one face to the other.
        const int side = way[axis] > 0.0 ? 0 : 1;
        const bool beyond =
          side == 0 ? light.Lower[axis] < own.Lower[axis] : light.Upper[axis] > own.Upper[axis];
        enters = beyond && depth[axis] > FlatDepth * std::abs(way[axis]) &&
                 borders.Across(block, place, axis, side);
      }
    });
  return enters;
}

double DirectLight::LargestShare(const LightGroup& root, const ClearBorders& borders,
  const Medium::Block& block, const std::vector<bool>& asked, double extinction, double rough,
  const std::vector<Spectrum>& sums) const
{
  if (root.Law.Measured())
  {
    return Infinity;
  }
  const Medium& smoke = this->Scene_.Smoke();
  // No cell gets more than all of the plate would send it from the nearest place of the block.
  const Vec3 low = smoke.CellCentre(smoke.Cell(block, {0, 0, 0}));
  const Vec3 high =
    smoke.CellCentre(smoke.Cell(block, {block.Size[0] - 1, block.Size[1] - 1, block.Size[2] - 1}));
  const double reach = 0.5 * glm::length(high - low) + root.Radius;
  const double distance = glm::length(root.Centre - 0.5 * (low + high)) - reach;
  if (!(distance > reach))
  {
    return Infinity;
  }
  const double depth = extinction * distance - rough;
  Spectrum most{};
  for (int band = 0; band < this->Scene_.Bands(); ++band)
  {
    most[band] = root.Intensity[band] / (distance * distance) *
                 std::exp(-this->Scene_.ExtinctionScale(band) * depth);
  }
  double share = 0.0;
  block.ForEachCell(
    [&](const std::array<int, 3>& place)
    {
      const std::int64_t cell = smoke.Cell(block, place);
      for (int band = 0; asked[block.Number(place)] && band < this->Scene_.Bands(); ++band)
      {
        share = most[band] > 0.0 ? std::max(share, most[band] / sums[cell][band]) : share;
      }
    });
  share *= static_cast<double>(this->Scene_.Lights().Lights().size());
  // Only of a light that is weaker than others it matters whether this bounds it.
  return share < 1.0 && this->Enters(root, borders, block) ? Infinity : share;
}

bool DirectLight::FarFrom(const LightGroup& root, const Medium::Block& block) const
{
  const Medium& smoke = this->Scene_.Smoke();
  const std::int64_t first = smoke.Cell(block, {0, 0, 0});
  const Vec3 low = smoke.CellCentre(first);
  const Vec3 high =
    smoke.CellCentre(smoke.Cell(block, {block.Size[0] - 1, block.Size[1] - 1, block.Size[2] - 1}));
  const double distance =
    glm::length(root.Centre - 0.5 * (low + high)) - 0.5 * glm::length(high - low);
  const double edge = LargestEdge(smoke.CellSize(first)) * root.Law.Sharpness();
  return root.Radius < PathRatio * distance && glm::length(high - low) <= BoxRatio * distance &&
         edge <= 0.5 * BoxRatio * distance;
}

DirectLight::BlockWays DirectLight::Tell(ToldWays& ways, const LightGroup& root,
  const ClearBorders& borders, const Medium::Block& block, const std::vector<bool>& asked,
  const std::vector<Spectrum>& sums) const
{
  BlockWays told;
  if (!ways.WalkCorners())
  {
    return told;
  }
  const auto largest = [&] {
    return this->LargestShare(root, borders, block, asked, ways.Least(), RoughWayTolerance, sums);
  };
  const double share = largest();
  // A weak light may be off by as much of the whole as the strongest; but the share is a bound
  // only where the corners do tell of what lies between.
  const double allowed = std::min(RoughWayTolerance, WayTolerance * std::max(1.0, 1.0 / share));
  told.Tell = ways.CornersTell(allowed);
  if (told.Tell)
  {
    const bool odd = ways.TellRest(std::max(2.0 * WayTolerance, allowed / OddCells));
    told.Rough = ways.Told() > 0 && allowed > WayTolerance;
    told.Share = odd ? largest() : share;
  }
  return told;
}

DirectLight::BlockWork DirectLight::AddBlockFluence(
  std::size_t light, const ClearBorders& borders, bool skips, std::vector<Spectrum>& sums) const
{
  const Medium::Block& block = borders.Block();
  Known known{borders,
    {this->Scene_.Smoke(), this->Scene_.LargestScale(), this->Scene_.Lights().Root(light), block},
    KeptSights(block)};
  return this->AddBlockFluence(light, known, block, skips, sums);
}

DirectLight::BlockWork DirectLight::AddBlockFluence(std::size_t light, Known& known,
  const Medium::Block& block, bool skips, std::vector<Spectrum>& sums) const
{
  const Medium& smoke = this->Scene_.Smoke();
  const LightGroup& root = known.Ways.Light();
  std::optional<ToldWays> ways;
  BlockWays told;
  if (skips && this->FarFrom(root, block))
  {
    ways.emplace(smoke, known.Ways, block);
    told = this->Tell(
      *ways, root, known.Borders, block, std::vector<bool>(block.Cells(), true), sums);
  }
  BlockWork work;
  const int largest = std::max({block.Size[0], block.Size[1], block.Size[2]});
  if (!told.Tell && largest > ToldWays::SmallestBlock)
  {
    const int half = (largest + 1) / 2;
    for (int part = 0; part < 8; ++part)
    {
      Medium::Block child = block;
      bool empty = false;
      for (int axis = 0; axis < 3; ++axis)
      {
        const int first = part >> axis & 1 ? half : 0;
        child.First[axis] += first;
        child.Size[axis] = std::min(half, block.Size[axis] - first);
        empty = empty || child.Size[axis] <= 0;
      }
      if (!empty)
      {
        const BlockWork own = this->AddBlockFluence(light, known, child, skips, sums);
        work.Told += own.Told;
        work.Negligible += own.Negligible;
      }
    }
    return work;
  }
  if (told.Share < NegligibleShare)
  {
    work.Negligible = block.Cells();
    return work;
  }
  const std::vector<double> shown =
    this->ShownIn(light, block, told.Share < WeakShare, known.Sights);
  // Of cells that see nothing of the light no ways are asked for, nor of those it is near to.
  std::vector<bool> asked(block.Cells(), false);
  const auto add = [&](std::int64_t cell, double share, const Spectrum& value)
  {
    for (int band = 0; band < this->Scene_.Bands(); ++band)
    {
      sums[cell][band] += share * value[band];
    }
  };
  block.ForEachCell(
    [&](const std::array<int, 3>& place)
    {
      const std::int64_t cell = smoke.Cell(block, place);
      if (smoke.Parts().Find(cell))
      {
        // The parts of a cell are measured each by itself.
        return;
      }
      // What is kept of a light near to the cell is taken from the sum again, to the same digits.
      if (const std::optional<Spectrum> kept = this->KeptFluence(light, cell))
      {
        add(cell, 1.0, *kept);
        return;
      }
      asked[block.Number(place)] = shown[block.Number(place)] > 0.0;
    });
  const Medium::Block lit = BlockOf(block, asked);
  if (lit.Cells() == 0)
  {
    work.Told = ways ? ways->Told() : 0;
    return work;
  }
  Medium::Block walked = block;
  if (ways && !told.Tell && lit.Cells() < block.Cells())
  {
    // Its corners may lie in or behind a wall: those of what sees the light may tell more.
    std::vector<bool> within(lit.Cells());
    lit.ForEachCell([&](const std::array<int, 3>& place)
      { within[lit.Number(place)] = asked[block.NumberIn(lit, place)]; });
    walked = lit;
    ways.emplace(smoke, known.Ways, lit);
    told = this->Tell(*ways, root, known.Borders, lit, within, sums);
  }
  if (ways && !told.Tell)
  {
    walked = block;
    ways.emplace(smoke, known.Ways, block);
    ways->Walk(asked);
    told.Share = this->LargestShare(root, known.Borders, block, asked, ways->Least(), 0.0, sums);
  }
  if (told.Share < NegligibleShare)
  {
    work.Negligible = lit.Cells();
    return work;
  }
  const bool weak = told.Share < WeakShare;
  std::vector<double> extinction(block.Cells(), std::numeric_limits<double>::quiet_NaN());
  if (ways)
  {
    work.Told = ways->Told();
    walked.ForEachCell([&](const std::array<int, 3>& place)
      { extinction[block.NumberIn(walked, place)] = ways->Extinction()[walked.Number(place)]; });
  }
  const std::vector<Deepening> deepening = known.Ways.DeepeningIn(block, asked, extinction,
    work.Told > 0 ? std::optional(WayTolerance) : std::nullopt, weak || told.Rough);
  block.ForEachCell(
    [&](const std::array<int, 3>& place)
    {
      const std::size_t number = block.Number(place);
      if (asked[number])
      {
        const std::int64_t cell = smoke.Cell(block, place);
        add(cell, shown[number],
          this->CellFluence({light, cell, deepening[number], ways.has_value(), weak}));
      }
    });
  return work;
}

} // namespace smokevis
