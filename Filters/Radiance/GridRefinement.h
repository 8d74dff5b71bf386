// Smoke grids whose cells are too thick for light to vary little inside them, on finer nodes.
#pragma once

#include "Medium.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace smokevis
{

struct SceneDescription;

/// Into how many cells each cell of a grid is cut.
struct GridRefinement
{
  /// Along each axis, a number of even parts for each interval between nodes; none: the grid stays
  /// as it is.
  std::array<std::vector<int>, 3> Parts;

  bool operator==(const GridRefinement&) const = default;
  bool None() const { return this->Parts[0].empty(); }
  /// Cells of the finer grid.
  std::size_t Cells() const;
  /// The cell of the grid that each cell of the finer one lies in.
  std::vector<std::int64_t> Parents() const;
};

/// Share of a grid's smoke that may be too thick before anything is done about it, such as the
/// cells of flames.
inline constexpr double TolerableThickShare = 0.01;

/// The same smoke in smaller cells. Where it overlaps others, the grid counts as before.
SmokeGrid Refined(const SmokeGrid& grid, const GridRefinement& refinement);

/// What is found to be thick in a scene, and what may be done about it.
struct ThickSmoke
{
  /// Of each grid; all none where nothing is to be refined.
  std::vector<GridRefinement> Refinements;
  /// Cells that are too thick, those that jut out of a cloud and are too thick for that, and those
  /// that are next to opaque, in grids where more than a tolerable share is.
  std::size_t Thick = 0, Jutting = 0, Opaque = 0;
  /// Cells that the grids with such ones are to have; where that would be too many, what the
  /// coarsest refinement would take.
  std::size_t Cells = 0;
  /// Optical depth of scattering along the edges of these, where twenty parts of a cell do for it;
  /// of cells that jut out, infinite where they were left.
  double Depth = 0.0, JuttingDepth = 0.0;

  bool IsRefined() const;
};

/// Finds how to refine the grids of a scene so that light changes little inside a cell. Light that
/// is scattered many times falls off to walls and away from lights within a mean free path or two;
/// in cells of two up to half of it is lost, in cells of four nearly twice as much comes through
/// (`ThickSmoke.DarkBarsInADuct`). Cells that scatter more than three quarters of a depth become
/// cells of half of one where that takes an eighth of the cells that there may be at most, and
/// otherwise of three quarters, one, one and a half or two, or a twentieth of their own. Soot
/// counts as if it scattered four fifths: what little it sends on is the veil. Cells that jut out
/// of a cloud, with smoke of less than half as much extinction beside them along two axes or three,
/// are lit from several sides, so that light falls off in no one direction: those that scatter more
/// than 0.3 depths become cells of 0.25, or else of 0.4, where that takes an eighth of all cells at
/// most (`RandomClouds.DarkBarsInCoarseCells`) and a tolerance of 0.02 or less is asked for: above
/// it noise is more than this mends, and finer cells have more of it. Cells that scatter more than
/// fifteen along their shortest edge are left: no sign is seen through one, and the light that gets
/// through several comes out many times too bright. What is blanked has no smoke and counts as
/// clear air; beyond the borders of a grid nothing is known to jut out. Throws Error for grids that
/// are not usable.
/// @param most cells that the grids to be refined may have in all
ThickSmoke FindThickSmoke(const SceneDescription& scene, std::size_t most, double tolerance = 0.01);

/// Refines grids, one by one.
void Refine(std::vector<SmokeGrid>& grids, const std::vector<GridRefinement>& refinements);

} // namespace smokevis
