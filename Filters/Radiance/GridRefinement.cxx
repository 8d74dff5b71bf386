#include "GridRefinement.h"

#include "GridChecks.h"
#include "Places.h"
#include "Scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace smokevis
{

namespace
{

/// Optical depth of scattering along the longest edge of a cell above which it is too thick; along
/// the shortest one that above which it is next to opaque, and would need so many finer cells that
/// they take minutes; and that along the longest one below which it counts as clear air.
constexpr double ThickDepth = 0.75;
constexpr double OpaqueDepth = 15.0;
constexpr double TraceDepth = 0.01 * ThickDepth;
/// The first of these for cells that jut out of a cloud, so many axes along which smoke beside them
/// is thinner than so large a share of theirs, and the tolerance up to which they count.
constexpr double JuttingDepth = 0.3;
constexpr int JuttingAxes = 2;
constexpr double JuttingTolerance = 0.02;
constexpr float ThinnerShare = 0.5F;
/// Share of a depth that is rounding, of extinctions in single precision and of nodes far off.
constexpr double Rounding = 1e-4;
/// Depths that are aimed at, best first, and the share of the cells that there may be which each
/// may take. Cells that jut out are refined where that is cheap.
struct Aim
{
  double Depth, JuttingDepth, Share;
};
constexpr double Any = std::numeric_limits<double>::infinity();
constexpr std::array<Aim, 7> Aims = {{{0.5, 0.25, 0.125}, {0.5, 0.4, 0.125}, {0.5, Any, 0.125},
  {0.75, Any, 1.0}, {1.0, Any, 1.0}, {1.5, Any, 1.0}, {2.0, Any, 1.0}}};
/// Most parts that a cell is cut into along an edge.
constexpr int MostParts = 20;
/// Soot of a lower albedo counts as if it had this one: light falls off in it all the same.
constexpr double LeastAlbedo = 0.8;

std::array<int, 3> SizeOf(const SmokeGrid& grid)
{
  std::array<int, 3> size;
  std::transform(grid.Nodes.begin(), grid.Nodes.end(), size.begin(),
    [](const std::vector<double>& nodes) { return static_cast<int>(nodes.size()) - 1; });
  return size;
}

double Edge(const SmokeGrid& grid, int axis, int interval)
{
  return grid.Nodes[axis][interval + 1] - grid.Nodes[axis][interval];
}

/// Cells that are too thick, or jut out and are too thick for that.
struct CellsToCut
{
  std::size_t Cells = 0;
  /// Their largest optical depth of scattering in each interval, along each axis.
  std::array<std::vector<double>, 3> Deepest;

  explicit CellsToCut(const std::array<int, 3>& size)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Deepest[axis].assign(size[axis], 0.0);
    }
  }

  void Add(const std::array<int, 3>& place, const std::array<double, 3>& depths)
  {
    ++this->Cells;
    for (int axis = 0; axis < 3; ++axis)
    {
      double& deepest = this->Deepest[axis][place[axis]];
      deepest = std::max(deepest, depths[axis]);
    }
  }
};

/// Smoke of a grid by how thick it is.
struct SmokeOfGrid
{
  CellsToCut Thick, Jutting;
  std::size_t Smoky = 0, Opaque = 0;

  explicit SmokeOfGrid(const std::array<int, 3>& size) : Thick(size), Jutting(size) {}

  /// So many cells, or none where they are few.
  std::size_t Much(std::size_t cells) const
  {
    return static_cast<double>(cells) > TolerableThickShare * static_cast<double>(this->Smoky)
             ? cells
             : 0;
  }
  /// None where few cells are to be cut, or all of them are thin enough for the aim.
  GridRefinement RefinementTo(const Aim& aim) const;
};

GridRefinement SmokeOfGrid::RefinementTo(const Aim& aim) const
{
  GridRefinement refinement;
  bool whole = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    for (std::size_t interval = 0; interval < this->Thick.Deepest[axis].size(); ++interval)
    {
      double parts = 1.0;
      for (const auto& [cells, depth] :
        {std::pair(&this->Thick, aim.Depth), {&this->Jutting, aim.JuttingDepth}})
      {
        if (this->Much(cells->Cells) > 0)
        {
          parts = std::max(parts, std::ceil(cells->Deepest[axis][interval] / depth));
        }
      }
      refinement.Parts[axis].push_back(static_cast<int>(std::min<double>(parts, MostParts)));
      whole = whole && parts == 1.0;
    }
  }
  return whole ? GridRefinement() : refinement;
}

/// Whether light comes into a cell of a cloud from clearer air on several sides: it does not fall
/// off evenly there, and less deep inside.
bool JutsOut(const SmokeGrid& grid, const std::array<int, 3>& size, const std::array<int, 3>& place)
{
  const float thinner = ThinnerShare * grid.Extinction[PlaceNumber(size, place)];
  int axes = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto thinAt = [&](int step)
    {
      std::array<int, 3> beside = place;
      beside[axis] += step;
      return beside[axis] >= 0 && beside[axis] < size[axis] &&
             grid.Extinction[PlaceNumber(size, beside)] < thinner;
    };
    axes += thinAt(-1) || thinAt(1) ? 1 : 0;
  }
  return axes >= JuttingAxes;
}

/// @param scattering coefficient over the extinction coefficient
/// @param jutting whether cells that jut out count
SmokeOfGrid LookAtSmoke(const SmokeGrid& grid, double scattering, bool jutting)
{
  const std::array<int, 3> size = SizeOf(grid);
  SmokeOfGrid found(size);
  ForEachPlace(size,
    [&](const std::array<int, 3>& place)
    {
      const double scattered =
        (1.0 - Rounding) * scattering * grid.Extinction[PlaceNumber(size, place)];
      std::array<double, 3> depths;
      for (int axis = 0; axis < 3; ++axis)
      {
        depths[axis] = scattered * Edge(grid, axis, place[axis]);
      }
      const auto [shortest, longest] = std::minmax_element(depths.begin(), depths.end());
      found.Smoky += *longest > TraceDepth ? 1 : 0;
      if (*shortest > OpaqueDepth)
      {
        ++found.Opaque;
        return;
      }
      if (*longest > ThickDepth)
      {
        found.Thick.Add(place, depths);
      }
      if (jutting && *longest > JuttingDepth && JutsOut(grid, size, place))
      {
        found.Jutting.Add(place, depths);
      }
    });
  return found;
}

/// For each interval of the finer grid along an axis, that of the grid.
std::vector<int> ParentIntervals(const std::vector<int>& parts)
{
  std::vector<int> parents;
  for (std::size_t interval = 0; interval < parts.size(); ++interval)
  {
    parents.insert(parents.end(), parts[interval], static_cast<int>(interval));
  }
  return parents;
}

} // namespace

std::size_t GridRefinement::Cells() const
{
  std::size_t cells = 1;
  for (const std::vector<int>& parts : this->Parts)
  {
    std::size_t along = 0;
    for (const int part : parts)
    {
      along += static_cast<std::size_t>(part);
    }
    cells *= along;
  }
  return cells;
}

std::vector<std::int64_t> GridRefinement::Parents() const
{
  std::array<std::vector<int>, 3> intervals;
  std::array<int, 3> fine;
  std::array<int, 3> coarse;
  for (int axis = 0; axis < 3; ++axis)
  {
    intervals[axis] = ParentIntervals(this->Parts[axis]);
    fine[axis] = static_cast<int>(intervals[axis].size());
    coarse[axis] = static_cast<int>(this->Parts[axis].size());
  }
  std::vector<std::int64_t> parents;
  parents.reserve(this->Cells());
  ForEachPlace(fine,
    [&](const std::array<int, 3>& place)
    {
      parents.push_back(PlaceNumber(
        coarse, {intervals[0][place[0]], intervals[1][place[1]], intervals[2][place[2]]}));
    });
  return parents;
}

SmokeGrid Refined(const SmokeGrid& grid, const GridRefinement& refinement)
{
  SmokeGrid fine;
  fine.Name = grid.Name;
  fine.Fineness = FinenessOf(grid);
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::vector<double>& nodes = grid.Nodes[axis];
    for (std::size_t interval = 0; interval + 1 < nodes.size(); ++interval)
    {
      const int parts = refinement.Parts[axis][interval];
      for (int part = 0; part < parts; ++part)
      {
        fine.Nodes[axis].push_back(
          std::lerp(nodes[interval], nodes[interval + 1], static_cast<double>(part) / parts));
      }
    }
    fine.Nodes[axis].push_back(nodes.back());
  }
  const std::vector<std::int64_t> parents = refinement.Parents();
  const auto take = [&parents](const std::vector<float>& values)
  {
    std::vector<float> taken(values.empty() ? 0 : parents.size());
    std::transform(parents.begin(), parents.begin() + static_cast<std::ptrdiff_t>(taken.size()),
      taken.begin(), [&values](std::int64_t parent) { return values[parent]; });
    return taken;
  };
  fine.Extinction = take(grid.Extinction);
  fine.EmittedLuminance = take(grid.EmittedLuminance);
  return fine;
}

bool ThickSmoke::IsRefined() const
{
  return std::any_of(this->Refinements.begin(), this->Refinements.end(),
    [](const GridRefinement& refinement) { return !refinement.None(); });
}

ThickSmoke FindThickSmoke(const SceneDescription& scene, std::size_t most, double tolerance)
{
  ThickSmoke result;
  result.Refinements.resize(scene.Grids.size());
  if (scene.Albedo == 0.0)
  {
    return result;
  }
  const double scattering =
    std::max(LeastAlbedo, scene.Albedo) *
    *std::max_element(scene.ExtinctionScale.begin(), scene.ExtinctionScale.begin() + scene.Bands);
  std::vector<SmokeOfGrid> grids;
  for (const SmokeGrid& grid : scene.Grids)
  {
    CheckGrid(grid);
    const SmokeOfGrid& own =
      grids.emplace_back(LookAtSmoke(grid, scattering, tolerance <= JuttingTolerance));
    result.Thick += own.Much(own.Thick.Cells);
    result.Jutting += own.Much(own.Jutting.Cells);
    result.Opaque += own.Much(own.Opaque);
  }
  for (const Aim& aim : Aims)
  {
    ThickSmoke found = result;
    found.Depth = aim.Depth;
    found.JuttingDepth = aim.JuttingDepth;
    found.Cells = 0;
    for (std::size_t i = 0; i < grids.size(); ++i)
    {
      GridRefinement& own = found.Refinements[i];
      own = grids[i].RefinementTo(aim);
      found.Cells += own.None() ? 0 : own.Cells();
    }
    if (!found.IsRefined())
    {
      // A coarser aim would not do either.
      break;
    }
    if (static_cast<double>(found.Cells) <= aim.Share * static_cast<double>(most))
    {
      return found;
    }
    result.Cells = found.Cells;
  }
  return result;
}

void Refine(std::vector<SmokeGrid>& grids, const std::vector<GridRefinement>& refinements)
{
  for (std::size_t i = 0; i < grids.size(); ++i)
  {
    if (!refinements[i].None())
    {
      grids[i] = Refined(grids[i], refinements[i]);
    }
  }
}

} // namespace smokevis
