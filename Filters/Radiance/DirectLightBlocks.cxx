// DirectLight's part for blocks of smoke cells, which share the ways to a light.
#include "DirectLight.h"

#include "BlockCorners.h"
#include "CellsAround.h"
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

/// What is said of each cell of a block, of the cells of one that it holds.
std::vector<bool> PartOf(
  const Medium::Block& block, const std::vector<bool>& cells, const Medium::Block& part)
{
  std::vector<bool> own(part.Cells());
  part.ForEachCell([&](const std::array<int, 3>& place)
    { own[part.Number(place)] = cells[block.NumberIn(part, place)]; });
  return own;
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

double DirectLight::LargestShare(const Known& known, const Medium::Block& block,
  const std::vector<bool>& asked, double extinction, double rough,
  const std::vector<Spectrum>& sums) const
{
  const LightGroup& root = known.Ways.Light();
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
  return share < 1.0 && this->Enters(root, known.Borders, block) ? Infinity : share;
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

DirectLight::BlockWays DirectLight::TellWays(const Known& known, const Medium::Block& block,
  const std::vector<bool>& asked, const std::vector<Spectrum>& sums) const
{
  BlockWays told{block};
  ToldWays ways(this->Scene_.Smoke(), known.Ways, block);
  if (!ways.WalkCorners())
  {
    return told;
  }
  const auto share = [&]
  { return this->LargestShare(known, block, asked, ways.Least(), RoughWayTolerance, sums); };
  const double first = share();
  // A weak light may be off by as much of the whole as the strongest; but the share is a bound
  // only where the corners do tell of what lies between.
  const double allowed = std::min(RoughWayTolerance, WayTolerance * std::max(1.0, 1.0 / first));
  told.Tell = ways.CornersTell(allowed);
  told.Smooth = told.Tell && allowed <= this->Bend_;
  if (told.Tell)
  {
    const bool odd = ways.TellRest(asked, std::max(2.0 * WayTolerance, allowed / OddCells));
    told.Told = ways.Told();
    told.Rough = allowed > WayTolerance;
    told.Share = odd ? share() : first;
    told.Extinction = ways.Extinction();
  }
  return told;
}

DirectLight::BlockWays DirectLight::WalkWays(const Known& known, const Medium::Block& block,
  const std::vector<bool>& asked, const std::vector<Spectrum>& sums) const
{
  BlockWays walked{block};
  ToldWays ways(this->Scene_.Smoke(), known.Ways, block);
  ways.Walk(asked);
  walked.Share = this->LargestShare(known, block, asked, ways.Least(), 0.0, sums);
  walked.Extinction = ways.Extinction();
  walked.Smooth = ways.WalkCorners() && ways.CornersTell(this->Bend_);
  return walked;
}

DirectLight::BlockWork DirectLight::AddBlockFluence(std::size_t light, const CellsAround& around,
  const ClearBorders& borders, bool skips, std::vector<Spectrum>& sums) const
{
  const Medium::Block& block = borders.Block();
  Known known{borders,
    {this->Scene_.Smoke(), this->Scene_.LargestScale(), this->Scene_.Lights().Root(light), block},
    around, std::vector<std::optional<Sight>>(around.Count())};
  return this->AddBlockFluence(light, known, block, skips, sums);
}

DirectLight::BlockWork DirectLight::AddPartsFluence(std::size_t light, Known& known,
  const Medium::Block& block, bool skips, std::vector<Spectrum>& sums) const
{
  BlockWork work;
  const int half = (block.LongestEdge() + 1) / 2;
  for (int part = 0; part < 8; ++part)
  {
    Medium::Block child = block;
    for (int axis = 0; axis < 3; ++axis)
    {
      const int first = part >> axis & 1 ? half : 0;
      child.First[axis] += first;
      child.Size[axis] = std::clamp(block.Size[axis] - first, 0, half);
    }
    if (child.Cells() > 0)
    {
      work += this->AddBlockFluence(light, known, child, skips, sums);
    }
  }
  return work;
}

void DirectLight::AddKept(
  std::size_t light, const Medium::Block& block, std::vector<Spectrum>& sums) const
{
  const Medium& smoke = this->Scene_.Smoke();
  block.ForEachCell(
    [&](const std::array<int, 3>& place)
    {
      // The parts of a cell are measured each by itself.
      const std::int64_t cell = smoke.Cell(block, place);
      if (const auto kept =
            smoke.Parts().Find(cell) ? std::nullopt : this->KeptFluence(light, cell))
      {
        Accumulate(sums[cell], *kept);
      }
    });
}

DirectLight::BlockWork DirectLight::AddAsked(std::size_t light, const Known& known,
  const Medium::Block& block, const std::vector<bool>& asked, const std::vector<double>& shown,
  const BlockWays& ways, std::vector<Spectrum>& sums) const
{
  const Medium& smoke = this->Scene_.Smoke();
  const bool far = !ways.Extinction.empty();
  std::vector<double> extinction(block.Cells(), std::numeric_limits<double>::quiet_NaN());
  if (far)
  {
    ways.Cells.ForEachCell(
      [&](const std::array<int, 3>& place) {
        extinction[block.NumberIn(ways.Cells, place)] = ways.Extinction[ways.Cells.Number(place)];
      });
  }
  const bool weak = ways.Share < WeakShare;
  BlockWork work;
  work.Told = ways.Told;
  const std::vector<Deepening> deepening = known.Ways.DeepeningIn(block, asked, extinction,
    ways.Told > 0 ? std::optional(WayTolerance) : std::nullopt, weak || ways.Rough,
    work.ToldAround);
  std::vector<std::optional<BoxLight>> lights(block.Cells());
  block.ForEachCell(
    [&](const std::array<int, 3>& place)
    {
      const std::size_t number = block.Number(place);
      if (asked[number])
      {
        lights[number] = BoxLight{light, smoke.Cell(block, place), deepening[number], far, weak};
      }
    });
  const bool even = weak || !this->UnevenIn(light, block, ways);
  const std::optional<Corrections> uneven =
    even || !ways.Smooth ? std::nullopt : this->TellUneven(block, lights);
  block.ForEachCell(
    [&](const std::array<int, 3>& place)
    {
      const std::size_t number = block.Number(place);
      if (!asked[number])
      {
        return;
      }
      const BoxLight& own = *lights[number];
      Spectrum fluence = this->CellFluence(own, even || uneven);
      const bool told = uneven && !this->KnowsUneven(own);
      work.ToldUneven += told ? 1 : 0;
      for (int band = 0; told && band < this->Scene_.Bands(); ++band)
      {
        fluence[band] *= std::exp(BetweenCorners((*uneven)[band], block, place));
      }
      Accumulate(sums[own.Cell], fluence, shown[number]);
    });
  return work;
}

DirectLight::BlockWork DirectLight::AddBlockFluence(std::size_t light, Known& known,
  const Medium::Block& block, bool skips, std::vector<Spectrum>& sums) const
{
  const LightGroup& root = known.Ways.Light();
  const Medium& smoke = this->Scene_.Smoke();
  Box bounds = smoke.BoxOf(smoke.Cell(block, {0, 0, 0}));
  bounds.Add(
    smoke.BoxOf(smoke.Cell(block, {block.Size[0] - 1, block.Size[1] - 1, block.Size[2] - 1})));
  if (Behind(root, bounds.Centre(), bounds.Size()))
  {
    return {.Unseen = block.Cells()};
  }
  const bool far = skips && this->FarFrom(root, block);
  BlockWays ways{block};
  if (far)
  {
    ways = this->TellWays(known, block, std::vector<bool>(block.Cells(), true), sums);
  }
  if (!ways.Tell && block.LongestEdge() > ToldWays::SmallestBlock)
  {
    return this->AddPartsFluence(light, known, block, skips, sums);
  }
  if (ways.Share < NegligibleShare)
  {
    return {.Negligible = block.Cells()};
  }
  const std::vector<double> shown = this->ShownIn(light, block, ways.Share < WeakShare, known);
  std::vector<bool> asked(shown.size());
  std::transform(
    shown.begin(), shown.end(), asked.begin(), [](double share) { return share > 0.0; });
  const Medium::Block lit = BlockOf(block, asked);
  if (far && !ways.Tell && lit.Cells() > 0)
  {
    if (lit.Cells() < block.Cells())
    {
      // The block's corners may lie in or behind a wall: those of what sees the light may tell.
      ways = this->TellWays(known, lit, PartOf(block, asked, lit), sums);
    }
    if (!ways.Tell)
    {
      ways = this->WalkWays(known, block, asked, sums);
    }
  }
  // What is kept of a light near to a cell is taken from the sum again, to the same digits.
  this->AddKept(light, block, sums);
  const auto seeing = static_cast<std::size_t>(std::count(asked.begin(), asked.end(), true));
  BlockWork work;
  work.Unseen = block.Cells() - seeing;
  if (ways.Share < NegligibleShare)
  {
    work.Negligible = seeing;
  }
  else if (seeing > 0)
  {
    work += this->AddAsked(light, known, block, asked, shown, ways, sums);
  }
  return work;
}

} // namespace smokevis
