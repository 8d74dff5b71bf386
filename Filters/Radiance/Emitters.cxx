#include "Emitters.h"

#include "Errors.h"
#include "LightLeaves.h"
#include "LightSight.h"
#include "PolygonClip.h"
#include "SmokeBorders.h"
#include "SurfaceCuts.h"
#include "Triangle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <string>

#include <glm/gtc/constants.hpp>

namespace smokevis
{

namespace
{

/// Share of a cell's size within which two corners are one, but for rounding.
constexpr double RepeatedShare = 1e-12;

void CheckCell(const EmitterCell& cell, std::size_t index, int bands)
{
  const std::string where = "emitter cell " + std::to_string(index);
  const std::size_t count = cell.Vertices.size();
  double longest = 0.0;
  for (std::size_t i = 0; i < count; ++i)
  {
    longest = std::max(longest, glm::length(cell.Vertices[i] - cell.Vertices[(i + 1) % count]));
  }
  const Vec3 area = AreaVector(cell.Vertices);
  if (count < 3 || !(glm::length(area) > 5e-13 * longest * longest))
  {
    throw Error(where, "the polygon has no area", "Remove it or give it three distinct corners");
  }
  const Vec3 normal = glm::normalize(area);
  for (std::size_t i = 0; i < count; ++i)
  {
    const Vec3& a = cell.Vertices[i];
    const Vec3& b = cell.Vertices[(i + 1) % count];
    const Vec3& c = cell.Vertices[(i + 2) % count];
    const double turn = glm::dot(glm::cross(b - a, c - b), normal);
    const double lift = std::abs(glm::dot(a - cell.Vertices[0], normal));
    if (turn < -1e-6 * longest * longest || lift > 1e-3 * longest)
    {
      throw Error(where, "the polygon is not plane and convex", "Triangulate the emitters");
    }
  }
  for (int band = 0; band < bands; ++band)
  {
    if (!(cell.Luminance[band] >= 0.0) || !std::isfinite(cell.Luminance[band]))
    {
      throw Error(where, "the luminance is " + std::to_string(cell.Luminance[band]) + " cd/m2",
        "It must be finite and not negative");
    }
    if (!(cell.Reflectance[band] >= 0.0 && cell.Reflectance[band] <= 1.0))
    {
      throw Error(where, "the reflectance is " + std::to_string(cell.Reflectance[band]),
        "It must lie between 0 and 1");
    }
  }
  if (!(cell.Exponent >= 0.0) || !std::isfinite(cell.Exponent))
  {
    throw Error(where, "the emission exponent is " + std::to_string(cell.Exponent),
      "It must be finite and not negative");
  }
  if (cell.Table && cell.SignId >= 0)
  {
    throw Error(where, "it is part of a sign and has an intensity table",
      "Give signs an emission exponent; tables are for lamps, with a SignId of -1");
  }
}

/// Leaves as they are divided, or all together.
/// @param divider null: none
template <class Divider>
std::vector<std::vector<LightGroup>> DividedBy(
  const Divider* divider, std::vector<LightGroup> leaves)
{
  if (divider)
  {
    return divider->Divide(std::move(leaves));
  }
  std::vector<std::vector<LightGroup>> groups;
  groups.push_back(std::move(leaves));
  return groups;
}

} // namespace

double LightGroup::Distance(const Vec3& point) const
{
  if (this->FirstChild < 0)
  {
    bool inside = true;
    for (std::size_t i = 0; i < this->Corners.size() && inside; ++i)
    {
      const Vec3 edge = this->Corners[(i + 1) % this->Corners.size()] - this->Corners[i];
      inside = glm::dot(glm::cross(edge, point - this->Corners[i]), this->Normal) >= 0.0;
    }
    return inside ? std::abs(glm::dot(point - this->Corners[0], this->Normal))
                  : this->EdgeDistance(point);
  }
  const Vec3 u = this->Corners[1] - this->Corners[0];
  const Vec3 v = this->Corners[3] - this->Corners[0];
  const Vec3 from = point - this->Corners[0];
  const double s = std::clamp(glm::dot(from, u) / glm::dot(u, u), 0.0, 1.0);
  const double t = std::clamp(glm::dot(from, v) / glm::dot(v, v), 0.0, 1.0);
  return glm::length(from - s * u - t * v);
}

double LightGroup::EdgeDistance(const Vec3& point) const
{
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < this->Corners.size(); ++i)
  {
    const Vec3 edge = this->Corners[(i + 1) % this->Corners.size()] - this->Corners[i];
    const Vec3 from = point - this->Corners[i];
    const double square = glm::dot(edge, edge);
    const double share = square > 0.0 ? std::clamp(glm::dot(from, edge) / square, 0.0, 1.0) : 0.0;
    const Vec3 apart = from - share * edge;
    least = std::min(least, glm::dot(apart, apart));
  }
  return std::sqrt(least);
}

EmitterSet::EmitterSet(std::vector<EmitterCell> cells, int bands)
    : Bands_(bands), Cells_(std::move(cells))
{
  for (std::size_t index = 0; index < this->Cells_.size(); ++index)
  {
    EmitterCell& cell = this->Cells_[index];
    DropRepeated(cell.Vertices, RepeatedShare);
    CheckCell(cell, index, bands);
    const Vec3 area = AreaVector(cell.Vertices);
    this->Areas_.push_back(glm::length(area));
    this->Normals_.push_back(glm::normalize(area));
    this->Laws_.push_back(cell.Table
                            ? EmissionLaw(*cell.Table, cell.TableAxis, this->Normals_.back())
                            : EmissionLaw(cell.Exponent));
    Vec3 centre(0.0);
    for (std::size_t i = 2; i < cell.Vertices.size(); ++i)
    {
      const Triangle part = {cell.Vertices[0], cell.Vertices[i - 1], cell.Vertices[i]};
      centre += glm::dot(AreaVector(part), this->Normals_.back()) * (part[0] + part[1] + part[2]);
    }
    this->Centres_.push_back(centre / (3.0 * this->Areas_.back()));
  }
  this->FindSigns();
}

double EmitterSet::CellFlux(std::size_t cell, int band) const
{
  return this->Laws_[cell].UnitFlux() * this->Cells_[cell].Luminance[band] * this->Areas_[cell];
}

double EmitterSet::Flux(int band) const
{
  double flux = 0.0;
  for (std::size_t cell = 0; cell < this->Cells_.size(); ++cell)
  {
    flux += this->CellFlux(cell, band);
  }
  return flux;
}

bool EmitterSet::InOnePlane(std::size_t a, std::size_t b) const
{
  constexpr double LargestTilt = 1e-4;
  constexpr double LargestStep = 1e-4;
  const Vec3& normal = this->Normals_[a];
  const double size = std::sqrt(std::max(this->Areas_[a], this->Areas_[b]));
  return glm::length(normal - this->Normals_[b]) <= LargestTilt &&
         std::abs(glm::dot(this->Centres_[a] - this->Centres_[b], normal)) <=
           LargestStep * (size + glm::length(this->Centres_[a] - this->Centres_[b]));
}

std::vector<int> EmitterSet::JoinCells(bool samePlane) const
{
  // Cells of signs join in all of a board. Lamps' cells join where they share a corner: a ceiling's
  // lamps stay apart, the pieces of a luminous panel do not.
  std::map<int, std::vector<std::size_t>> boards;
  using Key = std::array<double, 7>;
  std::map<Key, std::size_t> firstCells;
  std::vector<int> parent;
  const auto find = [&parent](int light)
  {
    while (parent[light] != light)
    {
      light = parent[light] = parent[parent[light]];
    }
    return light;
  };
  std::vector<int> lightOf(this->Cells_.size(), -1);
  for (std::size_t i = 0; i < this->Cells_.size(); ++i)
  {
    const EmitterCell& cell = this->Cells_[i];
    if (*std::max_element(cell.Luminance.begin(), cell.Luminance.begin() + this->Bands_) <= 0.0)
    {
      continue;
    }
    lightOf[i] = static_cast<int>(parent.size());
    parent.push_back(lightOf[i]);
    const Vec3& n = this->Normals_[i];
    const auto join = [&](const Vec3& place)
    {
      const auto round = [](double value, double step) { return std::round(value / step) * step; };
      const double grid = 1e-4 * std::sqrt(this->Areas_[i]);
      const double step = std::exp2(std::ceil(std::log2(grid)));
      const Key key = {samePlane ? cell.Exponent : 0.0, samePlane ? round(n.x, 1e-5) : 0.0,
        samePlane ? round(n.y, 1e-5) : 0.0, samePlane ? round(n.z, 1e-5) : 0.0,
        round(place.x, step), round(place.y, step), round(place.z, step)};
      const std::size_t first = firstCells.try_emplace(key, i).first->second;
      if (first != i && (!samePlane || this->Laws_[first] == this->Laws_[i]))
      {
        parent[find(lightOf[i])] = find(lightOf[first]);
      }
    };
    if (cell.SignId >= 0)
    {
      std::vector<std::size_t>& own = boards[cell.SignId];
      const auto board = std::find_if(own.begin(), own.end(),
        [&](std::size_t first) {
          return !samePlane || (this->Laws_[i] == this->Laws_[first] && this->InOnePlane(i, first));
        });
      if (board == own.end())
      {
        own.push_back(i);
      }
      else
      {
        parent[lightOf[i]] = find(lightOf[*board]);
      }
      continue;
    }
    for (const Vec3& vertex : cell.Vertices)
    {
      join(vertex);
    }
  }
  for (int& light : lightOf)
  {
    light = light < 0 ? -1 : find(light);
  }
  return lightOf;
}

void EmitterSet::FormLights(
  double largestLight, const SmokeBorders* borders, const SurfaceCuts* cuts)
{
  const std::vector<int> lightOf = this->JoinCells(true);
  const std::vector<int> bodyOf = this->JoinCells(false);
  // The first cell of each light, and its leaves.
  std::map<int, std::pair<std::size_t, std::vector<LightGroup>>> lights;
  std::map<int, double> areas;
  this->LeftToLines_.assign(this->Cells_.size(), false);
  for (std::size_t i = 0; i < this->Cells_.size(); ++i)
  {
    if (lightOf[i] < 0)
    {
      continue;
    }
    areas[bodyOf[i]] += this->Areas_[i];
  }
  for (std::size_t i = 0; i < this->Cells_.size(); ++i)
  {
    this->LeftToLines_[i] = lightOf[i] >= 0 && areas[bodyOf[i]] > largestLight;
    if (lightOf[i] >= 0 && !this->LeftToLines_[i])
    {
      auto& light = lights.try_emplace(lightOf[i], i, std::vector<LightGroup>()).first->second;
      this->AddLeavesOf(i, light.second);
    }
  }
  for (auto& [number, light] : lights)
  {
    auto& [first, leaves] = light;
    this->AddDarkLeaves(first, leaves);
    for (std::vector<LightGroup>& piece : DividedBy(cuts, std::move(leaves)))
    {
      for (std::vector<LightGroup>& group : DividedBy(borders, std::move(piece)))
      {
        for (std::vector<LightGroup>& part : FilledParts(std::move(group)))
        {
          this->AddLight(std::move(part));
        }
      }
    }
  }
}

void EmitterSet::AddLight(std::vector<LightGroup> leaves)
{
  leaves = Simplified(std::move(leaves));
  if (!leaves.empty())
  {
    this->Lights_.push_back(static_cast<int>(this->Groups_.size()));
    this->Groups_.emplace_back();
    this->FillGroup(this->Lights_.back(), leaves, 0, leaves.size());
    this->Strips_.emplace_back(this->Groups_[this->Lights_.back()].Corners, leaves, this->Bands_);
  }
}

void EmitterSet::MarkCrossed(const LightSight& sight)
{
  std::vector<int> open;
  std::copy_if(this->Lights_.begin(), this->Lights_.end(), std::back_inserter(open),
    [&](int root) { return sight.Crossed(this->Groups_[root]); });
  while (!open.empty())
  {
    LightGroup& group = this->Groups_[open.back()];
    open.pop_back();
    group.Crossed = true;
    if (group.FirstChild >= 0)
    {
      open.insert(open.end(), {group.FirstChild, group.FirstChild + 1});
    }
  }
}

void EmitterSet::AddLeavesOf(std::size_t cell, std::vector<LightGroup>& leaves) const
{
  AddLeaves(
    this->Cells_[cell], this->Normals_[cell], this->Laws_[cell], this->Areas_[cell], leaves);
}

void EmitterSet::AddDarkLeaves(std::size_t cell, std::vector<LightGroup>& leaves) const
{
  const int id = this->Cells_[cell].SignId;
  const auto sign = std::find_if(
    this->Signs_.begin(), this->Signs_.end(), [id](const Sign& one) { return one.Id == id; });
  if (id < 0 || sign == this->Signs_.end())
  {
    return;
  }
  for (const std::size_t other : sign->Cells)
  {
    const Spectrum& luminance = this->Cells_[other].Luminance;
    if (*std::max_element(luminance.begin(), luminance.begin() + this->Bands_) <= 0.0 &&
        this->InOnePlane(other, cell))
    {
      const std::size_t first = leaves.size();
      this->AddLeavesOf(other, leaves);
      std::for_each(
        leaves.begin() + first, leaves.end(), [](LightGroup& leaf) { leaf.Intensity = {}; });
    }
  }
}

void EmitterSet::FillGroup(
  int group, std::vector<LightGroup>& leaves, std::size_t begin, std::size_t end)
{
  if (end - begin == 1)
  {
    this->Groups_[group] = leaves[begin];
    return;
  }
  LightGroup all = leaves[begin];
  all.Intensity = {};
  all.Area = 0.0;
  Vec3 sum(0.0);
  double weight = 0.0;
  Vec3 low(1e300);
  Vec3 high(-1e300);
  for (std::size_t i = begin; i < end; ++i)
  {
    double total = 0.0;
    for (int band = 0; band < this->Bands_; ++band)
    {
      all.Intensity[band] += leaves[i].Intensity[band];
      total += leaves[i].Intensity[band];
    }
    all.Area += leaves[i].Area;
    sum += total * leaves[i].Centre;
    weight += total;
    low = glm::min(low, leaves[i].Centre);
    high = glm::max(high, leaves[i].Centre);
  }
  all.Centre = sum / weight;
  all.Radius = 0.0;
  for (std::size_t i = begin; i < end; ++i)
  {
    for (const Vec3& corner : leaves[i].Corners)
    {
      all.Radius = std::max(all.Radius, glm::length(corner - all.Centre));
      all.Depth = std::max(all.Depth, glm::dot(all.Centre - corner, all.Normal));
    }
  }
  const std::span<const LightGroup> own = std::span(leaves).subspan(begin, end - begin);
  all.Corners = RectangleAround(own, all.Centre);
  if (!all.Law.Measured() && all.Plane())
  {
    all.Stencil = std::make_shared<PlateStencil>(all.Corners, own, this->Bands_);
  }
  const Vec3 extent = high - low;
  const int axis =
    extent.x >= extent.y ? (extent.x >= extent.z ? 0 : 2) : (extent.y >= extent.z ? 1 : 2);
  const std::size_t middle = begin + (end - begin) / 2;
  std::nth_element(leaves.begin() + begin, leaves.begin() + middle, leaves.begin() + end,
    [axis](const LightGroup& a, const LightGroup& b) { return a.Centre[axis] < b.Centre[axis]; });
  all.FirstChild = static_cast<int>(this->Groups_.size());
  this->Groups_[group] = all;
  this->Groups_.resize(this->Groups_.size() + 2);
  this->FillGroup(all.FirstChild, leaves, begin, middle);
  this->FillGroup(all.FirstChild + 1, leaves, middle, end);
}

} // namespace smokevis
