// The smoke: rectilinear grids of constant-extinction cells, and the exact walk of a ray through
// them.
#pragma once

#include "Box.h"
#include "CellParts.h"
#include "ClearBricks.h"
#include "Places.h"
#include "Types.h"

#include <string>
#include <vector>

namespace smokevis
{

/// Smoke behind this optical depth adds less to what is seen than single precision shows.
inline constexpr double DeepestVeil = 60.0;

/// One rectilinear grid of smoke, for example one FDS mesh.
struct SmokeGrid
{
  /// Named in error messages.
  std::string Name;
  /// Node coordinates along x, y, z [m], strictly increasing, at least two each.
  std::array<std::vector<double>, 3> Nodes;
  /// Extinction coefficient of each cell at 633 nm [1/m], x fastest; an optical depth of 1e12
  /// across the cell at most.
  std::vector<float> Extinction;
  /// Luminance that the cell's absorption would emit in equilibrium [cd/m2]; empty: none.
  std::vector<float> EmittedLuminance;
  /// Volume of the cells by which the grid counts where it overlaps others; 0: FinenessOf(*this)
  /// [m3].
  double Fineness = 0.0;

  bool operator==(const SmokeGrid&) const = default;
};

/// Volume of a cell with the shortest edges that a grid has [m3], or what it says itself.
double FinenessOf(const SmokeGrid& grid);

/// A piece of a ray inside one cell.
struct Segment
{
  /// Index over the cells of all grids.
  std::int64_t Cell;
  /// Distances along the ray where the piece begins and ends [m].
  double Begin;
  double End;
};

/// All smoke of a scene. Cells are numbered through, grid after grid as given, x fastest. Where
/// grids overlap, the one with the smaller cells counts; outside all grids there is no smoke.
/// Of a cell that walls cut, each part counts as a cell: the first keeps the number, the others
/// have numbers behind those of all grids.
class Medium
{
public:
  Medium() = default;
  /// Checks the grids; throws Error for bad nodes, sizes, NaN or negative extinction.
  /// @param leaps whether rays that only meet smoke leap over clear bricks of cells
  explicit Medium(std::vector<SmokeGrid> grids, bool leaps = true);

  /// Parts the cells that walls cut.
  void Divide(CellParts parts);

  std::size_t Cells() const { return this->Extinction_.size(); }
  /// Those of the grids alone.
  std::size_t GridCells() const { return this->Cells() - this->Parts_.Added(); }
  const CellParts& Parts() const { return this->Parts_; }
  bool Empty() const { return this->Extinction_.empty(); }
  /// Extinction coefficient at 633 nm [1/m].
  float Extinction(std::int64_t cell) const { return this->Extinction_[cell]; }
  float MaximumExtinction() const { return this->MaximumExtinction_; }
  /// Whether any cell emits light of its own.
  bool Emits() const { return !this->EmittedLuminance_.empty(); }
  float EmittedLuminance(std::int64_t cell) const
  {
    return this->EmittedLuminance_.empty() ? 0.0F : this->EmittedLuminance_[cell];
  }
  Vec3 CellCentre(std::int64_t cell) const;
  /// Edges; of a part those of a box that is as far spread along each axis.
  Vec3 CellSize(std::int64_t cell) const;
  double CellVolume(std::int64_t cell) const;
  /// Volume without what finer grids lie over, but for a millionth: what rays meet of a cell.
  double OwnVolume(std::int64_t cell) const;
  /// That of a whole cell of a grid, as boxes beside one another.
  std::vector<Box> OwnBoxes(std::int64_t cell) const;
  /// Mean length of the isotropic chords of a convex cell, 4 V / S (Cauchy) [m].
  double MeanChord(std::int64_t cell) const;
  /// Whether a finer grid lies over a part of the cell.
  bool Covered(std::int64_t cell) const;
  /// Of a whole cell of a grid.
  Box BoxOf(std::int64_t cell) const;
  /// Around a cell, or part of one, of its size.
  Box CellBounds(std::int64_t cell) const
  {
    const CellPart* const part = this->Parts_.Find(cell);
    return part ? Box{part->Centre - 0.5 * part->Size, part->Centre + 0.5 * part->Size}
                : this->BoxOf(cell);
  }
  /// The cell that holds a point, or -1 outside all smoke.
  std::int64_t Locate(const Vec3& point) const;
  /// Whether faces of cells across an axis lie in the plane through a coordinate, but for a
  /// millionth of an edge.
  bool FacesAt(int axis, double coordinate) const;
  /// The cell across the face of `cell` along `axis` (0..2), on the low (0) or high (1) side; it
  /// may lie in another grid; -1 where there is none.
  std::int64_t Neighbour(std::int64_t cell, int axis, int side) const;

  /// A box of cells of one grid, for work that neighbours share.
  struct Block
  {
    std::size_t Grid = 0;
    /// First cell and number of cells along each axis.
    std::array<int, 3> First{}, Size{};

    std::size_t Cells() const
    {
      return static_cast<std::size_t>(this->Size[0]) * this->Size[1] * this->Size[2];
    }
    int LongestEdge() const { return std::max({this->Size[0], this->Size[1], this->Size[2]}); }
    /// With a layer of cells more across each face, in or out of the grid.
    Block Enlarged() const
    {
      Block larger = *this;
      for (int axis = 0; axis < 3; ++axis)
      {
        larger.First[axis] -= 1;
        larger.Size[axis] += 2;
      }
      return larger;
    }
    /// Of a cell within the block, x fastest.
    std::size_t Number(const std::array<int, 3>& place) const
    {
      return static_cast<std::size_t>(PlaceNumber(this->Size, place));
    }
    /// Of a cell of another block that it holds.
    std::size_t NumberIn(const Block& part, std::array<int, 3> place) const
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        place[axis] += part.First[axis] - this->First[axis];
      }
      return this->Number(place);
    }
    /// Calls visit(place) for all its cells in the order of these numbers.
    template <class Visit> void ForEachCell(Visit&& visit) const
    {
      ForEachPlace(this->Size, visit);
    }
  };
  /// Blocks of at most `edge` cells along each axis that hold every cell once.
  std::vector<Block> Blocks(int edge) const;
  /// Whether a block lies in its grid.
  bool Holds(const Block& block) const;
  /// A cell of a block, counted from the block's first.
  std::int64_t Cell(const Block& block, const std::array<int, 3>& place) const
  {
    return this->Grids_[block.Grid].Cell(
      {block.First[0] + place[0], block.First[1] + place[1], block.First[2] + place[2]});
  }
  /// Neighbour of a cell of a block.
  std::int64_t Neighbour(
    const Block& block, const std::array<int, 3>& place, int axis, int side) const
  {
    std::array<int, 3> next = place;
    next[axis] += side == 0 ? -1 : 1;
    const int index = block.First[axis] + next[axis];
    if (!this->Overlap_ && index >= 0 && index < this->Grids_[block.Grid].Size[axis])
    {
      const std::int64_t cell = this->Cell(block, next);
      if (!this->Parts_.Find(cell))
      {
        return cell;
      }
    }
    return this->Neighbour(this->Cell(block, place), axis, side);
  }

  /// Calls visit(cell) for the cells of all grids that reach into a box.
  template <class Visit> void ForCellsIn(const Vec3& low, const Vec3& high, Visit&& visit) const
  {
    for (std::size_t number = 0; number < this->Grids_.size(); ++number)
    {
      const Grid& grid = this->Grids_[number];
      if (glm::any(glm::lessThan(high, grid.Bounds.Lower)) ||
          glm::any(glm::greaterThan(low, grid.Bounds.Upper)))
      {
        continue;
      }
      Block block{number};
      for (int axis = 0; axis < 3; ++axis)
      {
        block.First[axis] = grid.Index(axis, low[axis]);
        block.Size[axis] = grid.Index(axis, high[axis]) - block.First[axis] + 1;
      }
      block.ForEachCell([&](const std::array<int, 3>& place)
        { this->Parts_.ForEachPart(this->Cell(block, place), visit); });
    }
  }
  /// Longest edge of any cell [m].
  double LargestEdge() const { return this->LargestEdge_; }

  const Vec3& Lower() const { return this->Lower_; }
  const Vec3& Upper() const { return this->Upper_; }

  /// Finds the pieces of the ray between two distances that lie in smoke, in order; `pieces` is
  /// overwritten. Adjoining pieces share their ends, so that lengths add up to rounding.
  void Walk(const Vec3& origin, const Vec3& direction, double begin, double end,
    std::vector<Segment>& pieces) const;

  /// The same without the pieces in clear air, most of which are leapt over, as OpticalDepth does.
  /// Air counts as clear where the smoke in it adds up to an optical depth of 1e-10 at most.
  void WalkSmoke(const Vec3& origin, const Vec3& direction, double begin, double end,
    std::vector<Segment>& pieces) const;
  /// Cells that they leap over.
  std::int64_t LeaptCells() const;

  /// Whether a point lies in smoke that is the same all over the one grid there is. Between two
  /// such points the extinction is MaximumExtinction().
  bool EvenAt(const Vec3& point) const
  {
    return this->Even_ && this->Grids_[0].Bounds.Contains(point);
  }

  /// Optical depth of the ray between two distances, for extinction as given (633 nm).
  double OpticalDepth(const Vec3& origin, const Vec3& direction, double begin, double end) const;

private:
  struct Grid
  {
    std::array<std::vector<double>, 3> Nodes;
    /// Cells a metre along each axis where the nodes are evenly spaced, else 0.
    Vec3 InverseStep{0.0};
    std::array<int, 3> Size{};
    std::int64_t FirstCell = 0;
    Box Bounds;
    /// Smallest cell volume, by which grids are ranked.
    double Fineness = 0.0;
    ClearBricks Clear;
    /// Whether rays look for them.
    bool Leaps = false;
    /// Bounds of finer grids that lie over a part of it.
    std::vector<Box> Finer;

    int Index(int axis, double coordinate) const;
    std::int64_t Cell(const std::array<int, 3>& index) const
    {
      return this->FirstCell + PlaceNumber(this->Size, index);
    }
  };

  class GridRay;
  /// Which pieces of a ray are asked for.
  enum class Pieces
  {
    All,
    /// Pieces in clear air may be left out.
    Smoke
  };
  template <Pieces Wanted, class Visit>
  void ForEachPiece(
    const Vec3& origin, const Vec3& direction, double begin, double end, Visit&& visit) const;
  template <Pieces Wanted>
  void ListPieces(const Vec3& origin, const Vec3& direction, double begin, double end,
    std::vector<Segment>& pieces) const;
  void FindClearAir();
  const Grid& GridOf(std::int64_t cell, std::array<int, 3>& index) const;
  /// The cell of a grid that holds a point, or -1.
  std::int64_t LocateInGrids(const Vec3& point) const;

  /// As given, so that cells are numbered in that order.
  std::vector<Grid> Grids_;
  /// Indices of the grids, finest first.
  std::vector<int> Rank_;
  bool Overlap_ = false;
  /// One grid of one extinction: optical depths need no walk.
  bool Even_ = false;
  std::vector<float> Extinction_;
  std::vector<float> EmittedLuminance_;
  CellParts Parts_;
  float MaximumExtinction_ = 0.0F;
  double LargestEdge_ = 0.0;
  Vec3 Lower_{0.0};
  Vec3 Upper_{0.0};
};

} // namespace smokevis
