// The parts of smoke cells that walls cut.
#pragma once

#include "ConvexSolid.h"
#include "Types.h"

#include <cstdint>
#include <vector>

namespace smokevis
{

/// Where the part of a cell is measured, for its share of the part's volume.
struct PartSample
{
  /// From the part's centre [m].
  glm::vec3 Offset{0.0F};
  float Share = 0.0F;
};

/// A part of a cell: what of it light fills without passing a wall.
struct CellPart
{
  /// The cell that it is of, and its own number: the cell's for its first part, numbers behind
  /// those of all cells for the others.
  std::int64_t Cell = 0;
  std::int64_t Number = 0;
  double Volume = 0.0;
  /// Without what finer grids lie over.
  double OwnVolume = 0.0;
  /// Centre of mass.
  Vec3 Centre{0.0};
  /// Edges of a box that is as far spread along each axis.
  Vec3 Size{0.0};
  /// A few samples, each inside a convex piece of the part, and more of them.
  std::vector<PartSample> Coarse, Fine;
};

/// How a cell is cut: planes, each of which parts what lies in front of it from what lies behind.
struct CellCut
{
  struct Node
  {
    Plane Where;
    /// In front, behind: another node, or -1 - the place of a part in Parts.
    std::int32_t Front = -1;
    std::int32_t Behind = -1;
  };
  std::int64_t Cell = 0;
  /// The first is the root.
  std::vector<Node> Nodes;
  std::vector<CellPart> Parts;
};

/// The parts of all cells that are cut. Places are given from a base, for the sake of precision.
class CellParts
{
public:
  CellParts() = default;
  /// @param cells number of all cells
  /// @param cuts of different cells, by their number, with two parts or more; numbers the parts
  CellParts(std::int64_t cells, const Vec3& base, double tolerance, std::vector<CellCut> cuts);

  bool Empty() const { return this->Parts_.empty(); }
  /// All parts, those of a cell together.
  const std::vector<CellPart>& Parts() const { return this->Parts_; }
  /// Numbers given to parts behind those of the cells.
  std::int64_t Added() const { return static_cast<std::int64_t>(this->Later_.size()); }
  /// The part of a number; null: the number is that of a whole cell.
  const CellPart* Find(std::int64_t number) const
  {
    if (this->Empty())
    {
      return nullptr;
    }
    const std::int32_t place =
      number < this->Cells_ ? this->First_[number] : this->Later_[number - this->Cells_];
    return place < 0 ? nullptr : &this->Parts_[place];
  }
  /// The cell that a number is of.
  std::int64_t CellOf(std::int64_t number) const
  {
    return number < this->Cells_ || this->Empty() ? number : this->Find(number)->Cell;
  }
  /// The part of a cell that holds a point.
  std::int64_t Locate(std::int64_t cell, const Vec3& point) const;
  /// Calls visit(number) for the parts of a cell.
  template <class Visit> void ForEachPart(std::int64_t cell, Visit&& visit) const
  {
    visit(cell);
    if (this->Empty() || this->First_[cell] < 0)
    {
      return;
    }
    for (std::size_t place = this->First_[cell] + 1;
         place < this->Parts_.size() && this->Parts_[place].Cell == cell; ++place)
    {
      visit(this->Parts_[place].Number);
    }
  }
  /// Calls visit(number, begin, end) for the parts of a cell that a piece of a ray passes, in
  /// order.
  template <class Visit>
  void Divide(std::int64_t cell, const Vec3& origin, const Vec3& direction, double begin,
    double end, Visit&& visit) const
  {
    if (!this->IsCut(cell))
    {
      visit(cell, begin, end);
      return;
    }
    Piece open{-1, begin};
    this->Descend(this->Root_[cell], origin - this->Base_, direction, begin, end, open, visit);
    visit(open.Number, open.Begin, end);
  }

private:
  bool IsCut(std::int64_t cell) const { return !this->Empty() && this->Cut_[cell]; }

  /// What was last entered on a ray's way.
  struct Piece
  {
    std::int64_t Number;
    double Begin;
  };

  template <class Visit>
  void Descend(std::int32_t node, const Vec3& origin, const Vec3& direction, double begin,
    double end, Piece& open, Visit& visit) const;

  std::int64_t Cells_ = 0;
  Vec3 Base_{0.0};
  /// A shorter piece than this is none [m].
  double Tolerance_ = 0.0;
  /// With places among all parts.
  std::vector<CellCut::Node> Nodes_;
  std::vector<CellPart> Parts_;
  /// Of each cell: its first part's place and its root; -1: it is not cut.
  std::vector<std::int32_t> First_, Root_;
  /// Which cells are cut, a bit each: rays ask this of every cell they meet.
  std::vector<bool> Cut_;
  /// Places of the parts with numbers of their own.
  std::vector<std::int32_t> Later_;
};

template <class Visit>
void CellParts::Descend(std::int32_t node, const Vec3& origin, const Vec3& direction, double begin,
  double end, Piece& open, Visit& visit) const
{
  while (node >= 0)
  {
    const CellCut::Node& cut = this->Nodes_[node];
    const double height = cut.Where.Height(origin);
    const double slope = glm::dot(cut.Where.Normal, direction);
    const double meets = -height / slope;
    if (meets > begin + this->Tolerance_ && meets < end - this->Tolerance_)
    {
      this->Descend(
        slope > 0.0 ? cut.Behind : cut.Front, origin, direction, begin, meets, open, visit);
      node = slope > 0.0 ? cut.Front : cut.Behind;
      begin = meets;
    }
    else
    {
      node = height + 0.5 * (begin + end) * slope > 0.0 ? cut.Front : cut.Behind;
    }
  }
  const std::int64_t number = this->Parts_[-1 - node].Number;
  if (open.Number >= 0 && open.Number != number)
  {
    visit(open.Number, open.Begin, begin);
    open.Begin = begin;
  }
  open.Number = number;
}

} // namespace smokevis
