// DirectLight's part for smoke cells that the edges of shadows cross.
#include "DirectLight.h"

#include "Sampler.h"
#include "Scene.h"

#include <algorithm>
#include <cmath>

namespace smokevis
{

namespace
{

/// Ways from places in a cell to places of a light that tell the share of it that is not hidden:
/// enough to know it to some 2 % where the edge of a shadow crosses the cell.
constexpr std::uint64_t ShadowWays = 64;
constexpr std::uint64_t ShadowKey = 0x5ad0e;
/// Where a cell is asked what it sees, from its centre in shares of its edges: faces of walls and
/// lights often lie level with centres, and rounding would decide.
constexpr Vec3 OffCentre(0.0137, -0.0211, 0.0173);
/// Optical depth of a cell beyond which its light lies at its faces: weights need not follow it.
constexpr double MostDepth = 4.0;

} // namespace

double DirectLight::ShownShare(std::size_t light, std::int64_t cell, std::uint64_t ways) const
{
  const LightGroup& root = this->Scene_.Lights().Root(light);
  const Medium& smoke = this->Scene_.Smoke();
  const Box box = smoke.BoxOf(cell);
  const double extinction = std::min(
    smoke.Extinction(cell) * this->Scene_.ExtinctionScale(0), MostDepth / LargestEdge(box.Size()));
  const double toCentre = glm::length(box.Centre() - root.Centre);
  const EvenPoints<5> points(ShadowKey);
  double all = 0.0;
  double shown = 0.0;
  for (std::uint64_t way = 0; way < ways; ++way)
  {
    const auto point = points.Point(way);
    const Vec3 place = box.Lower + Vec3(point[0], point[1], point[2]) * box.Size();
    const Vec3 target = root.At(point[3], point[4]);
    const Vec3 from = place - target;
    if (!(glm::dot(from, root.Normal) > 0.0))
    {
      continue;
    }
    const double weight = root.AreaAt(point[3], point[4]) * PointLight(root, from) *
                          std::exp(extinction * (toCentre - glm::length(from)));
    all += weight;
    shown += this->Scene_.Shapes().Visible(place, target) ? weight : 0.0;
  }
  return all > 0.0 ? shown / all : 0.0;
}

std::vector<double> DirectLight::ShownIn(
  std::size_t light, const Medium::Block& block, bool roughly) const
{
  const LightGroup& root = this->Scene_.Lights().Root(light);
  const Medium& smoke = this->Scene_.Smoke();
  const auto sightFrom = [&](std::int64_t cell)
  {
    const Vec3 size = smoke.CellSize(cell);
    const Vec3 centre = smoke.CellCentre(cell) + OffCentre * size;
    // What lies behind the plate gets none of it, seen or not.
    const double height = glm::dot(centre - root.Centre, root.Normal);
    return height < -root.Radius - 0.6 * glm::length(size) ? Sight::Whole
                                                           : this->SightOf(root, centre);
  };
  std::vector<Sight> sights;
  sights.reserve(block.Cells());
  block.ForEachCell([&](const std::array<int, 3>& place)
    { sights.push_back(sightFrom(smoke.Cell(block, place))); });
  // The edge of a shadow lies between the centres of cells that see each other, but not the same of
  // the light.
  const auto differs = [&](std::int64_t cell, const std::array<int, 3>& place, int axis, int side)
  {
    std::array<int, 3> beside = place;
    beside[axis] += side == 0 ? -1 : 1;
    const bool within = beside[axis] >= 0 && beside[axis] < block.Size[axis];
    const std::int64_t other =
      within ? smoke.Cell(block, beside) : smoke.Neighbour(cell, axis, side);
    if (other < 0)
    {
      return false;
    }
    const Sight there = within ? sights[block.Number(beside)] : sightFrom(other);
    return there != sights[block.Number(place)] &&
           this->Scene_.Shapes().Visible(smoke.CellCentre(cell), smoke.CellCentre(other));
  };
  std::vector<double> shares;
  shares.reserve(block.Cells());
  block.ForEachCell(
    [&](const std::array<int, 3>& place)
    {
      const std::int64_t cell = smoke.Cell(block, place);
      const Sight sight = sights[block.Number(place)];
      // Others are measured by themselves.
      const bool asked = !smoke.Parts().Find(cell) && !this->KeptFluence(light, cell);
      bool crossed = asked && sight == Sight::Parted;
      for (int face = 0; face < 6 && asked && !crossed && !roughly; ++face)
      {
        crossed = differs(cell, place, face / 2, face % 2);
      }
      shares.push_back(
        crossed ? this->ShownShare(light, cell, ShadowWays) : (sight == Sight::Whole ? 1.0 : 0.0));
    });
  return shares;
}

} // namespace smokevis
