// DirectLight's part for blocks of smoke cells, which share the ways to a light.
#include "DirectLight.h"

#include "Scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace smokevis
{

namespace
{

/// Cells along the edges of the smallest block in which ways tell of each other, error of an
/// optical depth that is told so, and that of the weakest lights.
constexpr int SmallestBlock = 4;
constexpr double WayTolerance = 0.004;
constexpr double RoughWayTolerance = 0.5;
/// A cell whose own smoke is off what the block's corners tell of it may lie in a duct or a post as
/// small as itself: its own way is walked where so many cells like it would make more of an error
/// than is allowed, and half of it more than the least.
constexpr double OddCells = 16.0;
/// Where ways are looked at: along a diagonal that winds around the block, and so passes through
/// each layer of cells across each axis: a gap between layers of smoke may be one cell thick. Where
/// it begins, as shares of the block's edges, and which way it runs.
constexpr std::array<double, 3> DiagonalBegin = {0.5, 0.25, 0.75};
constexpr std::array<int, 3> DiagonalStep = {1, 1, -1};
/// Share of the fluence of the other lights that all lights left out may add: single precision
/// does not show it.
constexpr double NegligibleShare = 1e-7;
/// Share of the fluence of the other lights, times the number of lights, below which the mean of a
/// light over a cell is taken without Gauss points, to a few percent of itself.
constexpr double WeakShare = 0.05;
constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr double Unknown = std::numeric_limits<double>::quiet_NaN();

/// Where a cell lies between the first and the last of its block, 0 to 1.
Vec3 BlockShare(const Medium::Block& block, const std::array<int, 3>& place)
{
  Vec3 share(0.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    share[axis] =
      block.Size[axis] > 1 ? static_cast<double>(place[axis]) / (block.Size[axis] - 1) : 0.0;
  }
  return share;
}

/// The cell of a block so many steps along the diagonal.
std::array<int, 3> PlaceOnDiagonal(const Medium::Block& block, int steps)
{
  std::array<int, 3> place;
  for (int axis = 0; axis < 3; ++axis)
  {
    const int size = block.Size[axis];
    const int begin = static_cast<int>(DiagonalBegin[axis] * size);
    place[axis] = ((begin + DiagonalStep[axis] * steps) % size + size) % size;
  }
  return place;
}

/// Value between those at the corners of a box, first axis fastest.
double Trilinear(const std::array<double, 8>& corners, const Vec3& share)
{
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner)
  {
    sum += corners[corner] * (corner & 1 ? share.x : 1.0 - share.x) *
           (corner & 2 ? share.y : 1.0 - share.y) * (corner & 4 ? share.z : 1.0 - share.z);
  }
  return sum;
}

} // namespace

bool DirectLight::Enters(const LightGroup& root, const Medium::Block& block) const
{
  const Medium& smoke = this->Scene_.Smoke();
  // Where the cells' faces lie along each axis, and the light reaches.
  std::array<std::vector<Box>, 3> rows;
  Box light{root.Corners[0], root.Corners[0]};
  for (const Vec3& corner : root.Corners)
  {
    light.Add({corner, corner});
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    std::array<int, 3> place{};
    for (; place[axis] < block.Size[axis]; ++place[axis])
    {
      rows[axis].push_back(smoke.BoxOf(smoke.Cell(block, place)));
    }
  }
  bool enters = false;
  block.ForEachCell(
    [&](const std::array<int, 3>& place)
    {
      const std::int64_t cell = smoke.Cell(block, place);
      const double extinction = smoke.Extinction(cell);
      if (enters || !(extinction > 0.0))
      {
        return;
      }
      Box own;
      for (int axis = 0; axis < 3; ++axis)
      {
        const Box& row = rows[axis][place[axis]];
        own.Lower[axis] = row.Lower[axis];
        own.Upper[axis] = row.Upper[axis];
      }
      const Vec3 way = own.Centre() - root.Centre;
      const Vec3 depth = extinction * this->Scene_.LargestScale() * glm::length(way) * own.Size();
      for (int axis = 0; axis < 3 && !enters; ++axis)
      {
        // How much deeper the ways get from the one face to the other.
        const int side = way[axis] > 0.0 ? 0 : 1;
        const bool beyond =
          side == 0 ? light.Lower[axis] < own.Lower[axis] : light.Upper[axis] > own.Upper[axis];
        if (beyond && depth[axis] > FlatDepth * std::abs(way[axis]))
        {
          const std::int64_t before = smoke.Neighbour(cell, axis, side);
          enters = Deepening::ClearBefore(before < 0 ? 0.0 : smoke.Extinction(before), extinction);
        }
      }
    });
  return enters;
}

double DirectLight::LargestShare(const LightGroup& root, const Medium::Block& block,
  double extinction, double rough, const std::vector<Spectrum>& sums) const
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
      for (int band = 0; band < this->Scene_.Bands(); ++band)
      {
        share = most[band] > 0.0 ? std::max(share, most[band] / sums[cell][band]) : share;
      }
    });
  share *= static_cast<double>(this->Scene_.Lights().Lights().size());
  // Only of a light that is weaker than others it matters whether this bounds it.
  return share < 1.0 && this->Enters(root, block) ? Infinity : share;
}

std::optional<DirectLight::BlockWays> DirectLight::WaysFrom(const LightGroup& root,
  const Medium::Block& block, bool whole, const std::vector<Spectrum>& sums) const
{
  const Medium& smoke = this->Scene_.Smoke();
  const auto corner = [&](int index)
  {
    return std::array<int, 3>{index & 1 ? block.Size[0] - 1 : 0, index & 2 ? block.Size[1] - 1 : 0,
      index & 4 ? block.Size[2] - 1 : 0};
  };
  const Vec3 low = smoke.CellCentre(smoke.Cell(block, corner(0)));
  const Vec3 high = smoke.CellCentre(smoke.Cell(block, corner(7)));
  const double distance =
    glm::length(root.Centre - 0.5 * (low + high)) - 0.5 * glm::length(high - low);
  const Vec3 size = smoke.CellSize(smoke.Cell(block, corner(0)));
  const double edge = LargestEdge(size) * root.Law.Sharpness();
  if (!(root.Radius < PathRatio * distance) || glm::length(high - low) > BoxRatio * distance ||
      edge > 0.5 * BoxRatio * distance)
  {
    return std::nullopt;
  }
  const LightWays toLight(smoke, this->Scene_.LargestScale(), root);
  BlockWays ways;
  ways.Extinction.assign(block.Cells(), Unknown);
  const auto walk = [&](const std::array<int, 3>& place)
  {
    double& extinction = ways.Extinction[block.Number(place)];
    if (std::isnan(extinction))
    {
      extinction = toLight.Extinction(smoke.Cell(block, place));
    }
    return extinction;
  };
  std::array<double, 8> corners;
  std::array<double, 8> smokeAt;
  // Solids hold no smoke, so that ways out of them do not tell of their neighbours.
  bool told = std::max({block.Size[0], block.Size[1], block.Size[2]}) >= SmallestBlock;
  for (int index = 0; index < 8 && told; ++index)
  {
    smokeAt[index] = smoke.Extinction(smoke.Cell(block, corner(index)));
    told = smokeAt[index] > 0.0 || smoke.MaximumExtinction() == 0.0F;
    corners[index] = told ? walk(corner(index)) : 0.0;
  }
  double allowed = 0.0;
  if (told)
  {
    ways.Share = this->LargestShare(
      root, block, *std::min_element(corners.begin(), corners.end()), RoughWayTolerance, sums);
    // A weak light may be off by as much of the whole as the strongest; but the share is a bound
    // only where the corners do tell of what lies between.
    allowed = std::min(RoughWayTolerance, WayTolerance * std::max(1.0, 1.0 / ways.Share));
    const auto tells = [&](const std::array<int, 3>& place)
    {
      const double interpolated = Trilinear(corners, BlockShare(block, place));
      const double way = glm::length(root.Centre - smoke.CellCentre(smoke.Cell(block, place)));
      return std::abs(interpolated - walk(place)) * way * this->Scene_.LargestScale() <= allowed;
    };
    const int layers = std::max({block.Size[0], block.Size[1], block.Size[2]});
    for (int i = 0; i < layers && told; ++i)
    {
      told = tells(PlaceOnDiagonal(block, i));
    }
  }
  if (!told && !whole)
  {
    return std::nullopt;
  }
  const double oddStep = std::max(2.0 * WayTolerance, allowed / OddCells) /
                         (LargestEdge(size) * std::max(this->Scene_.LargestScale(), 1e-300));
  bool odd = false;
  block.ForEachCell(
    [&](const std::array<int, 3>& place)
    {
      const std::int64_t cell = smoke.Cell(block, place);
      const Vec3 share = BlockShare(block, place);
      if (told && std::abs(smoke.Extinction(cell) - Trilinear(smokeAt, share)) <= oddStep)
      {
        double& extinction = ways.Extinction[block.Number(place)];
        ways.Told += std::isnan(extinction) && !smoke.Parts().Find(cell) ? 1 : 0;
        extinction = Trilinear(corners, share);
      }
      else
      {
        walk(place);
        odd = true;
      }
    });
  ways.Rough = ways.Told > 0 && allowed > WayTolerance;
  if (odd)
  {
    ways.Share = this->LargestShare(root, block,
      *std::min_element(ways.Extinction.begin(), ways.Extinction.end()),
      told ? RoughWayTolerance : 0.0, sums);
  }
  return ways;
}

DirectLight::BlockWork DirectLight::AddBlockFluence(
  std::size_t light, const Medium::Block& block, bool skips, std::vector<Spectrum>& sums) const
{
  const Medium& smoke = this->Scene_.Smoke();
  const LightGroup& root = this->Scene_.Lights().Root(light);
  const int largest = std::max({block.Size[0], block.Size[1], block.Size[2]});
  const bool parts = largest > SmallestBlock;
  const std::optional<BlockWays> ways =
    skips ? this->WaysFrom(root, block, !parts, sums) : std::nullopt;
  BlockWork work;
  if (!ways && parts)
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
        const BlockWork own = this->AddBlockFluence(light, child, skips, sums);
        work.Told += own.Told;
        work.Negligible += own.Negligible;
      }
    }
    return work;
  }
  if (ways && ways->Share < NegligibleShare)
  {
    work.Negligible = block.Cells();
    return work;
  }
  const bool weak = ways && ways->Share < WeakShare;
  const std::vector<Deepening> deepening = this->CellWays(light).DeepeningIn(
    block, ways ? ways->Extinction : std::vector<double>(), weak || (ways && ways->Rough));
  const std::vector<double> shown = this->ShownIn(light, block, weak);
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
      const std::optional<Spectrum> kept = this->KeptFluence(light, cell);
      const double share = kept ? 1.0 : shown[block.Number(place)];
      if (share == 0.0)
      {
        return;
      }
      const Spectrum value = kept ? *kept
                                  : this->CellFluence({light, cell, deepening[block.Number(place)],
                                      ways.has_value(), weak});
      for (int band = 0; band < this->Scene_.Bands(); ++band)
      {
        sums[cell][band] += share * value[band];
      }
    });
  work.Told = ways ? ways->Told : 0;
  return work;
}

} // namespace smokevis
