// DirectLight's part for smoke cells that the edges of shadows cross.
#include "DirectLight.h"

#include "CellsAround.h"
#include "Sampler.h"
#include "Scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

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
/// Optical depth of a cell beyond which its light lies at its faces, where few ways would begin.
constexpr double MostDepth = 4.0;

/// A place in boxes for three numbers from 0 to 1, even over their volume.
Vec3 PlaceIn(const std::vector<Box>& boxes, Vec3 share)
{
  double volume = 0.0;
  for (const Box& box : boxes)
  {
    volume += box.Volume();
  }
  double before = share.x * volume;
  std::size_t number = 0;
  for (; number + 1 < boxes.size() && before >= boxes[number].Volume(); ++number)
  {
    before -= boxes[number].Volume();
  }
  const Box& box = boxes[number];
  share.x = std::clamp(before / box.Volume(), 0.0, 1.0);
  return box.Lower + share * box.Size();
}

double Strength(const LightGroup& group)
{
  return std::accumulate(group.Intensity.begin(), group.Intensity.end(), 0.0);
}

/// The leaf of a light on which a number from 0 to 1 falls, as often as it has a share in the
/// light, and where in the leaf's part of it the number lies.
std::pair<const LightGroup*, double> LeafOf(
  const std::vector<LightGroup>& groups, const LightGroup& root, double share)
{
  const LightGroup* group = &root;
  while (group->FirstChild >= 0)
  {
    const LightGroup& first = groups[group->FirstChild];
    const LightGroup& second = groups[group->FirstChild + 1];
    const double part = Strength(first) / (Strength(first) + Strength(second));
    const bool within = share < part;
    share = within ? share / part : (share - part) / (1.0 - part);
    group = within ? &first : &second;
  }
  return {group, std::clamp(share, 0.0, 1.0)};
}

} // namespace

double DirectLight::ShownShare(std::size_t light, std::int64_t cell, std::uint64_t ways) const
{
  struct Way
  {
    Vec3 Place, Target;
    double Weight;
    double Depth;
  };
  const std::vector<LightGroup>& groups = this->Scene_.Lights().Groups();
  const LightGroup& root = this->Scene_.Lights().Root(light);
  const Medium& smoke = this->Scene_.Smoke();
  const Box box = smoke.BoxOf(cell);
  std::vector<Box> parts;
  if (smoke.Covered(cell))
  {
    parts = smoke.OwnBoxes(cell);
  }
  if (parts.empty())
  {
    parts.push_back(box);
  }
  const double scale = this->Scene_.ExtinctionScale(0);
  const double extinction = smoke.Extinction(cell);
  // In thicker cells all places count.
  const double beyond = std::max(0.0, extinction - MostDepth / (scale * LargestEdge(box.Size())));
  // What lies between the cell and a light that is far dims all ways alike.
  const bool far = root.Radius < PathRatio * glm::length(box.Centre() - root.Centre);
  const bool even =
    smoke.EvenAt(box.Centre()) && smoke.EvenAt(root.Corners[0]) && smoke.EvenAt(root.Corners[2]);
  const EvenPoints<5> points(ShadowKey);
  std::vector<Way> lit;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint64_t number = 0; number < ways; ++number)
  {
    const auto point = points.Point(number);
    const auto [leaf, share] = LeafOf(groups, root, point[3]);
    Way way{PlaceIn(parts, {point[0], point[1], point[2]}), leaf->At(share, point[4]), 0.0, 0.0};
    const Vec3 from = way.Place - way.Target;
    if (!(glm::dot(from, leaf->Normal) > 0.0))
    {
      continue;
    }
    way.Weight = leaf->AreaAt(share, point[4]) / leaf->Area * PointLight(*leaf, from);
    const double length = glm::length(from);
    const Vec3 direction = -from / length;
    double begin = 0.0;
    double end = length;
    const double own = box.Clip(way.Place, 1.0 / direction, begin, end) ? end - begin : 0.0;
    const double depth = far    ? extinction * own
                         : even ? extinction * length
                                : smoke.OpticalDepth(way.Place, direction, 0.0, length);
    way.Depth = scale * (depth - beyond * own);
    least = std::min(least, way.Depth);
    lit.push_back(way);
  }
  std::vector<LineOfSight> lines;
  lines.reserve(lit.size());
  for (const Way& way : lit)
  {
    lines.push_back({way.Place, way.Target});
  }
  const std::vector<bool> seen = this->Scene_.Shapes().Visible(lines);
  double all = 0.0;
  double shown = 0.0;
  for (std::size_t i = 0; i < lit.size(); ++i)
  {
    const double weight = lit[i].Weight * std::exp(least - lit[i].Depth);
    all += weight;
    shown += seen[i] ? weight : 0.0;
  }
  return all > 0.0 ? shown / all : 0.0;
}

std::vector<Sight> DirectLight::SightsFrom(
  const LightGroup& root, const CellsAround& around, std::span<const std::size_t> cells) const
{
  // What lies behind the plate gets none of it, seen or not.
  std::vector<Sight> sights(cells.size(), Sight::Whole);
  std::vector<Vec3> places;
  places.reserve(cells.size());
  Box all = Box::Nothing();
  bool small = true;
  for (const std::size_t cell : cells)
  {
    const Box& box = around.Bounds(cell);
    const Vec3& place = places.emplace_back(box.Centre() + OffCentre * box.Size());
    all.Add({place, place});
    small = small && LightSight::Small(root, place);
  }
  // Many lines lead to a close light.
  if (!small && root.Plane() && this->Scene_.Shapes().Free({root.Corners, root.Normal, all}))
  {
    return sights;
  }
  std::vector<LineOfSight> lines;
  std::vector<std::size_t> ofLine;
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    const Vec3& place = places[i];
    const double height = glm::dot(place - root.Centre, root.Normal);
    if (height < -root.Radius - 0.6 * glm::length(around.Bounds(cells[i]).Size()))
    {
      continue;
    }
    if (small || LightSight::Small(root, place))
    {
      lines.push_back({place, root.Centre});
      ofLine.push_back(i);
    }
    else
    {
      sights[i] = this->Sight_.OfAll(root, place);
    }
  }
  const std::vector<bool> seen = this->Scene_.Shapes().Visible(lines);
  for (std::size_t line = 0; line < lines.size(); ++line)
  {
    sights[ofLine[line]] = seen[line] ? Sight::Whole : Sight::None;
  }
  return sights;
}

std::vector<double> DirectLight::ShownIn(
  std::size_t light, const Medium::Block& block, bool roughly, Known& known) const
{
  const Medium& smoke = this->Scene_.Smoke();
  const CellsAround& around = known.Around;
  std::vector<std::size_t> own;
  own.reserve(block.Cells());
  block.ForEachCell(
    [&](const std::array<int, 3>& place) { own.push_back(around.Block().NumberIn(block, place)); });
  std::vector<std::size_t> unknown;
  const auto ask = [&](std::size_t number)
  {
    if (!known.Sights[number])
    {
      // Nothing yet, but asked.
      known.Sights[number] = Sight::None;
      unknown.push_back(number);
    }
  };
  std::for_each(own.begin(), own.end(), ask);
  for (const std::size_t number : own)
  {
    for (const std::uint32_t other : around.Beside(number))
    {
      if (!roughly && other != CellsAround::None)
      {
        ask(other);
      }
    }
  }
  const LightGroup& root = this->Scene_.Lights().Root(light);
  const std::vector<Sight> answers = this->SightsFrom(root, around, unknown);
  for (std::size_t answer = 0; answer < answers.size(); ++answer)
  {
    known.Sights[unknown[answer]] = answers[answer];
  }
  std::vector<double> shares;
  shares.reserve(block.Cells());
  for (const std::size_t number : own)
  {
    const std::int64_t cell = around.Cell(number);
    const Box& bounds = around.Bounds(number);
    const Sight seen = *known.Sights[number];
    // The edge of a shadow lies between the centres of cells that see each other, but not the same
    // of the light.
    const auto differs = [&](std::uint32_t other)
    {
      return other != CellsAround::None && *known.Sights[other] != seen &&
             this->Scene_.Shapes().Visible(bounds.Centre(), around.Bounds(other).Centre());
    };
    // Others are measured by themselves, or get nothing.
    const bool asked = !smoke.Parts().Find(cell) && !this->KeptFluence(light, cell) &&
                       !Behind(root, bounds.Centre(), bounds.Size());
    const auto& beside = around.Beside(number);
    const bool crossed =
      asked &&
      (seen == Sight::Parted || (!roughly && std::any_of(beside.begin(), beside.end(), differs)));
    shares.push_back(crossed ? this->ShownShare(light, cell, ShadowWays)
                             : (asked && seen == Sight::Whole ? 1.0 : 0.0));
  }
  return shares;
}

} // namespace smokevis
