#include "LightLeaves.h"

#include "PlatePattern.h"
#include "PolygonClip.h"
#include "Triangle.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace smokevis
{

namespace
{

/// Least share of the rectangle around a light that the light fills.
constexpr double LeastFilled = 0.25;
/// A cut that does not take this share of the rectangles away is made in the middle.
constexpr double SmallestGain = 0.1;
/// Share of the size of a part of a leaf within which two of its corners are one: single precision
/// knows surfaces no better.
constexpr double RepeatedShare = 1e-6;
/// A light of more leaves is replaced by a lattice.
constexpr std::size_t MostLeaves = 20;
/// Rectangles of a lattice along its longer side, and how often these are halved at most.
constexpr double LatticeAcross = 4.0;
constexpr int Halvings = 2;
/// Share of a rectangle, by the number of halvings left, above which the board counts as filling
/// it.
constexpr std::array<double, Halvings> FullShares = {0.75, 0.95};

/// The plane of a light, with axes along the first edge of a leaf and across it.
class PlateAxes
{
public:
  PlateAxes(const LightGroup& leaf, const Vec3& origin)
      : Origin_(origin), U_(glm::normalize(leaf.Corners[1] - leaf.Corners[0])),
        V_(glm::cross(leaf.Normal, U_))
  {
  }

  glm::dvec2 Place(const Vec3& point) const
  {
    return {glm::dot(point - this->Origin_, this->U_), glm::dot(point - this->Origin_, this->V_)};
  }
  Vec3 Point(const glm::dvec2& place) const
  {
    return this->Origin_ + place.x * this->U_ + place.y * this->V_;
  }

private:
  Vec3 Origin_, U_, V_;
};

/// The rectangle around leaves.
struct Rectangle
{
  glm::dvec2 Low{1e300};
  glm::dvec2 High{-1e300};

  Rectangle() = default;
  Rectangle(const PlateAxes& axes, std::span<const LightGroup> leaves)
  {
    for (const LightGroup& leaf : leaves)
    {
      this->Add(axes, leaf);
    }
  }
  void Add(const PlateAxes& axes, const LightGroup& leaf)
  {
    for (const Vec3& corner : leaf.Corners)
    {
      const glm::dvec2 place = axes.Place(corner);
      this->Low = glm::min(this->Low, place);
      this->High = glm::max(this->High, place);
    }
  }
  glm::dvec2 Size() const { return this->High - this->Low; }
  double Area() const { return this->Size().x * this->Size().y; }
};

/// Orders leaves along the axis across which a cut leaves the least rectangles on both sides, and
/// returns the first leaf behind it.
std::size_t Cut(const PlateAxes& axes, const Rectangle& around, std::vector<LightGroup>& leaves)
{
  const auto order = [&](int axis)
  {
    std::stable_sort(leaves.begin(), leaves.end(),
      [&](const LightGroup& a, const LightGroup& b)
      { return axes.Place(a.Centre)[axis] < axes.Place(b.Centre)[axis]; });
  };
  double least = (1.0 - SmallestGain) * around.Area();
  const glm::dvec2 size = around.Size();
  int best = size.x >= size.y ? 0 : 1;
  std::size_t place = leaves.size() / 2;
  for (const int axis : {0, 1})
  {
    order(axis);
    std::vector<double> behind(leaves.size());
    Rectangle rest;
    for (std::size_t i = leaves.size(); i-- > 1;)
    {
      rest.Add(axes, leaves[i]);
      behind[i] = rest.Area();
    }
    Rectangle before;
    for (std::size_t i = 1; i < leaves.size(); ++i)
    {
      before.Add(axes, leaves[i - 1]);
      if (before.Area() + behind[i] < least)
      {
        least = before.Area() + behind[i];
        best = axis;
        place = i;
      }
    }
  }
  order(best);
  return place;
}

/// The leaves' parts on one side of a plane: its front (1) or its back (-1).
std::vector<LightGroup> PartsOnSide(
  const std::vector<LightGroup>& leaves, const Plane& plane, double side)
{
  std::vector<LightGroup> kept;
  for (const LightGroup& leaf : leaves)
  {
    EmitterCell part;
    KeepSide(
      std::vector<Vec3>(leaf.Corners.begin(), leaf.Corners.end()),
      [&](const Vec3& point) { return side * plane.Height(point); }, part.Vertices);
    // A leaf has axes along its first edge.
    DropRepeated(part.Vertices, RepeatedShare);
    part.SignId = leaf.SignId;
    for (int band = 0; band < MaxBands; ++band)
    {
      part.Luminance[band] = leaf.Intensity[band] / leaf.Area;
    }
    const std::size_t first = kept.size();
    AddLeaves(part, leaf.Normal, leaf.Law, leaf.Area, kept);
    std::for_each(kept.begin() + static_cast<std::ptrdiff_t>(first), kept.end(),
      [&leaf](LightGroup& own) { own.Crossed = leaf.Crossed; });
  }
  return kept;
}

/// A lattice of rectangles that send out what a pattern of many leaves does.
/// @param dark the board's leaves that send out nothing
std::vector<LightGroup> Coarsened(
  const std::vector<LightGroup>& leaves, const std::vector<LightGroup>& dark)
{
  const LightGroup& first = leaves.front();
  const PlateAxes axes(first, first.Centre);
  const Rectangle around(axes, leaves);
  const glm::dvec2 size = around.Size();
  std::vector<PatternCell> cells;
  for (const auto* const group : {&leaves, &dark})
  {
    for (const LightGroup& leaf : *group)
    {
      PatternCell cell;
      for (const Vec3& corner : leaf.Corners)
      {
        cell.Corners.push_back((axes.Place(corner) - around.Low) / size);
      }
      cell.Value[0] = 1.0;
      for (int band = 0; band < MaxBands; ++band)
      {
        cell.Value[1 + band] = leaf.Intensity[band] / leaf.Area;
      }
      cells.push_back(std::move(cell));
    }
  }
  constexpr int Parts = 1 << Halvings;
  const double edge = std::max(size.x, size.y) / LatticeAcross;
  const auto borders = [edge](double length)
  {
    const int count = Parts * std::max(1, static_cast<int>(std::lround(length / edge)));
    std::vector<double> ends;
    for (int i = 0; i <= count; ++i)
    {
      ends.push_back(static_cast<double>(i) / count);
    }
    return ends;
  };
  const std::vector<double> across = borders(size.x);
  const std::vector<double> up = borders(size.y);
  const PlatePattern pattern(cells, PatternAxis(across, 0), PatternAxis(up, 0));
  const auto corner = [&](std::size_t column, std::size_t row)
  { return axes.Point(around.Low + glm::dvec2(across[column], up[row]) * size); };
  std::vector<LightGroup> lattice;
  const auto add = [&](auto&& self, std::size_t column, std::size_t row, int halvings) -> void
  {
    const std::size_t count = std::size_t{1} << halvings;
    PatternVector sum{};
    for (std::size_t j = row; j < row + count; ++j)
    {
      for (std::size_t i = column; i < column + count; ++i)
      {
        const PatternVector& own = pattern.Blocks()[i + j * (across.size() - 1)].Sum;
        for (int value = 0; value <= MaxBands; ++value)
        {
          sum[value] += own[value];
        }
      }
    }
    const double area = (across[column + count] - across[column]) * (up[row + count] - up[row]);
    if (halvings > 0 && sum[0] < FullShares[halvings - 1] * area)
    {
      const std::size_t half = count / 2;
      for (const std::size_t j : {row, row + half})
      {
        for (const std::size_t i : {column, column + half})
        {
          self(self, i, j, halvings - 1);
        }
      }
      return;
    }
    Spectrum luminance{};
    for (int band = 0; band < MaxBands; ++band)
    {
      luminance[band] = sum[1 + band] / area;
    }
    if (*std::max_element(luminance.begin(), luminance.end()) > 0.0)
    {
      lattice.push_back(MakeLeaf(luminance, first.SignId, first.Normal, first.Law,
        {corner(column, row), corner(column + count, row), corner(column + count, row + count),
          corner(column, row + count)}));
    }
  };
  for (std::size_t row = 0; row + 1 < up.size(); row += Parts)
  {
    for (std::size_t column = 0; column + 1 < across.size(); column += Parts)
    {
      add(add, column, row, Halvings);
    }
  }
  return lattice;
}

} // namespace

LightGroup MakeLeaf(const Spectrum& luminance, int signId, const Vec3& normal,
  const EmissionLaw& law, const std::array<Vec3, 4>& corners)
{
  LightGroup leaf;
  leaf.Corners = corners;
  leaf.Normal = normal;
  leaf.Law = law;
  leaf.SignId = signId;
  for (const Triangle& half :
    {Triangle{corners[0], corners[1], corners[2]}, Triangle{corners[0], corners[2], corners[3]}})
  {
    const double area = AreaOf(half);
    leaf.Area += area;
    leaf.Centre += area * (half[0] + half[1] + half[2]);
  }
  leaf.Centre /= 3.0 * leaf.Area;
  for (const Vec3& corner : corners)
  {
    leaf.Radius = std::max(leaf.Radius, glm::length(corner - leaf.Centre));
  }
  for (int band = 0; band < MaxBands; ++band)
  {
    leaf.Intensity[band] = luminance[band] * leaf.Area;
  }
  return leaf;
}

void AddLeaves(const EmitterCell& cell, const Vec3& normal, const EmissionLaw& law, double area,
  std::vector<LightGroup>& leaves)
{
  const std::vector<Vec3>& vertices = cell.Vertices;
  for (std::size_t v = 1; v + 1 < vertices.size(); v += 2)
  {
    const Vec3& last = v + 2 < vertices.size() ? vertices[v + 2] : vertices[v + 1];
    LightGroup leaf = MakeLeaf(
      cell.Luminance, cell.SignId, normal, law, {vertices[0], vertices[v], vertices[v + 1], last});
    if (leaf.Area > 1e-12 * area)
    {
      leaves.push_back(std::move(leaf));
    }
  }
}

std::array<Vec3, 4> RectangleAround(std::span<const LightGroup> leaves, const Vec3& through)
{
  const PlateAxes axes(leaves.front(), through);
  const auto [low, high] = Rectangle(axes, leaves);
  return {
    axes.Point(low), axes.Point({high.x, low.y}), axes.Point(high), axes.Point({low.x, high.y})};
}

std::vector<std::vector<LightGroup>> DivideLeaves(std::vector<LightGroup> leaves,
  const std::function<std::optional<Plane>(const std::vector<LightGroup>&, int)>& find)
{
  struct Group
  {
    std::vector<LightGroup> Leaves;
    int Cuts = 0;
  };
  std::vector<std::vector<LightGroup>> groups;
  std::vector<Group> open;
  open.push_back({std::move(leaves), 0});
  while (!open.empty())
  {
    Group group = std::move(open.back());
    open.pop_back();
    if (group.Leaves.empty())
    {
      continue;
    }
    const std::optional<Plane> plane = find(group.Leaves, group.Cuts);
    if (!plane)
    {
      groups.push_back(std::move(group.Leaves));
      continue;
    }
    for (const double side : {1.0, -1.0})
    {
      open.push_back({PartsOnSide(group.Leaves, *plane, side), group.Cuts + 1});
    }
  }
  return groups;
}

std::vector<std::vector<LightGroup>> GroupLeaves(
  std::vector<LightGroup> leaves, const std::function<bool(const std::vector<LightGroup>&)>& does)
{
  std::vector<std::vector<LightGroup>> groups;
  std::vector<std::vector<LightGroup>> open;
  open.push_back(std::move(leaves));
  while (!open.empty())
  {
    std::vector<LightGroup> group = std::move(open.back());
    open.pop_back();
    if (group.size() == 1 || does(group))
    {
      groups.push_back(std::move(group));
      continue;
    }
    const PlateAxes axes(group.front(), group.front().Centre);
    const std::size_t cut = Cut(axes, Rectangle(axes, group), group);
    open.emplace_back(group.begin() + cut, group.end());
    group.resize(cut);
    open.push_back(std::move(group));
  }
  return groups;
}

std::vector<std::vector<LightGroup>> FilledParts(std::vector<LightGroup> leaves)
{
  return GroupLeaves(std::move(leaves),
    [](const std::vector<LightGroup>& group)
    {
      const double area = std::accumulate(group.begin(), group.end(), 0.0,
        [](double sum, const LightGroup& leaf) { return sum + leaf.Area; });
      const PlateAxes axes(group.front(), group.front().Centre);
      return area >= LeastFilled * Rectangle(axes, group).Area();
    });
}

std::vector<LightGroup> Simplified(std::vector<LightGroup> leaves)
{
  const auto lit = std::stable_partition(leaves.begin(), leaves.end(),
    [](const LightGroup& leaf)
    { return *std::max_element(leaf.Intensity.begin(), leaf.Intensity.end()) <= 0.0; });
  const std::vector<LightGroup> dark(leaves.begin(), lit);
  leaves.erase(leaves.begin(), lit);
  return leaves.size() > MostLeaves && !leaves.front().Crossed ? Coarsened(leaves, dark) : leaves;
}

} // namespace smokevis
