#include "Medium.h"

#include "GridChecks.h"
#include "LargePages.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>

namespace smokevis
{

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();
/// Share of a cell's edge behind its face at which its neighbour is sought.
constexpr double JustBehind = 1e-3;
/// What simulations leave in clear air counts as none where it adds less than this optical depth to
/// any line through all smoke, and its extinction is below this share of the largest.
constexpr double TraceDepth = 1e-10;
constexpr double TraceShare = 1e-6;

} // namespace

double FinenessOf(const SmokeGrid& grid)
{
  if (grid.Fineness > 0.0)
  {
    return grid.Fineness;
  }
  double volume = 1.0;
  for (const std::vector<double>& nodes : grid.Nodes)
  {
    double smallest = Infinity;
    for (std::size_t i = 1; i < nodes.size(); ++i)
    {
      smallest = std::min(smallest, nodes[i] - nodes[i - 1]);
    }
    volume *= smallest;
  }
  return volume;
}

int Medium::Grid::Index(int axis, double coordinate) const
{
  const std::vector<double>& nodes = this->Nodes[axis];
  const int last = this->Size[axis] - 1;
  int index = 0;
  if (this->InverseStep[axis] > 0.0)
  {
    const double guess = (coordinate - nodes.front()) * this->InverseStep[axis];
    index = guess <= 0.0 ? 0 : guess >= last ? last : static_cast<int>(guess);
  }
  else
  {
    index =
      static_cast<int>(std::upper_bound(nodes.begin(), nodes.end(), coordinate) - nodes.begin()) -
      1;
    index = std::clamp(index, 0, last);
  }
  // The guess can be one off by rounding.
  while (index < last && coordinate >= nodes[index + 1])
  {
    ++index;
  }
  while (index > 0 && coordinate < nodes[index])
  {
    --index;
  }
  return index;
}

Medium::Medium(std::vector<SmokeGrid> grids, bool leaps)
{
  this->Lower_ = Vec3(Infinity);
  this->Upper_ = Vec3(-Infinity);
  std::size_t cells = 0;
  bool emits = false;
  for (const SmokeGrid& grid : grids)
  {
    CheckGrid(grid);
    cells += grid.Extinction.size();
    emits = emits || !grid.EmittedLuminance.empty();
  }
  ReserveInLargePages(cells, this->Extinction_);
  for (SmokeGrid& source : grids)
  {
    Grid grid;
    grid.FirstCell = static_cast<std::int64_t>(this->Extinction_.size());
    grid.Fineness = FinenessOf(source);
    for (int axis = 0; axis < 3; ++axis)
    {
      const std::vector<double>& nodes = source.Nodes[axis];
      grid.Size[axis] = static_cast<int>(nodes.size()) - 1;
      grid.Bounds.Lower[axis] = nodes.front();
      grid.Bounds.Upper[axis] = nodes.back();
      double smallest = Infinity;
      double largest = 0.0;
      for (std::size_t i = 1; i < nodes.size(); ++i)
      {
        smallest = std::min(smallest, nodes[i] - nodes[i - 1]);
        largest = std::max(largest, nodes[i] - nodes[i - 1]);
      }
      this->LargestEdge_ = std::max(this->LargestEdge_, largest);
      if (largest <= smallest * 1.001)
      {
        grid.InverseStep[axis] = grid.Size[axis] / (nodes.back() - nodes.front());
      }
    }
    grid.Nodes = std::move(source.Nodes);
    this->Lower_ = glm::min(this->Lower_, grid.Bounds.Lower);
    this->Upper_ = glm::max(this->Upper_, grid.Bounds.Upper);
    this->Extinction_.insert(
      this->Extinction_.end(), source.Extinction.begin(), source.Extinction.end());
    if (emits)
    {
      this->EmittedLuminance_.insert(this->EmittedLuminance_.end(), source.EmittedLuminance.begin(),
        source.EmittedLuminance.end());
      this->EmittedLuminance_.resize(this->Extinction_.size(), 0.0F);
    }
    this->Grids_.push_back(std::move(grid));
  }
  if (cells == 0)
  {
    this->Lower_ = this->Upper_ = Vec3(0.0);
    return;
  }
  this->MaximumExtinction_ = *std::max_element(this->Extinction_.begin(), this->Extinction_.end());

  if (leaps)
  {
    this->FindClearAir();
  }

  const float least = *std::min_element(this->Extinction_.begin(), this->Extinction_.end());
  this->Even_ = this->Grids_.size() == 1 && least == this->MaximumExtinction_;

  this->Rank_.resize(this->Grids_.size());
  std::iota(this->Rank_.begin(), this->Rank_.end(), 0);
  std::stable_sort(this->Rank_.begin(), this->Rank_.end(),
    [this](int a, int b) { return this->Grids_[a].Fineness < this->Grids_[b].Fineness; });
  for (std::size_t coarse = 0; coarse < this->Rank_.size(); ++coarse)
  {
    Grid& grid = this->Grids_[this->Rank_[coarse]];
    for (std::size_t fine = 0; fine < coarse; ++fine)
    {
      const Box& over = this->Grids_[this->Rank_[fine]].Bounds;
      if (grid.Bounds.Meets(over))
      {
        grid.Finer.push_back(over);
        this->Overlap_ = true;
      }
    }
  }
}

void Medium::FindClearAir()
{
  const double longest = glm::length(this->Upper_ - this->Lower_);
  const auto trace = static_cast<float>(
    std::min(TraceDepth / longest, TraceShare * static_cast<double>(this->MaximumExtinction_)));
  for (Grid& grid : this->Grids_)
  {
    grid.Clear = ClearBricks(
      grid.Size, {this->Extinction_.data() + grid.FirstCell, trace,
                   this->Emits() ? this->EmittedLuminance_.data() + grid.FirstCell : nullptr});
    grid.Leaps = grid.Clear.Worthwhile();
  }
}

void Medium::Divide(CellParts parts)
{
  for (const CellPart& part : parts.Parts())
  {
    if (part.Number != part.Cell)
    {
      this->Extinction_.push_back(this->Extinction_[part.Cell]);
      if (!this->EmittedLuminance_.empty())
      {
        this->EmittedLuminance_.push_back(this->EmittedLuminance_[part.Cell]);
      }
    }
  }
  this->Parts_ = std::move(parts);
}

const Medium::Grid& Medium::GridOf(std::int64_t number, std::array<int, 3>& index) const
{
  const std::int64_t cell = this->Parts_.CellOf(number);
  const auto after = std::upper_bound(this->Grids_.begin(), this->Grids_.end(), cell,
    [](std::int64_t value, const Grid& grid) { return value < grid.FirstCell; });
  const Grid& grid = *(after - 1);
  // Divisions of short integers take a fraction of the time; a grid of more cells than they count
  // would take hundreds of gigabytes.
  const auto local = static_cast<std::uint32_t>(cell - grid.FirstCell);
  const auto columns = static_cast<std::uint32_t>(grid.Size[0]);
  const auto rows = static_cast<std::uint32_t>(grid.Size[1]);
  const std::uint32_t row = local / columns;
  index[0] = static_cast<int>(local - row * columns);
  index[2] = static_cast<int>(row / rows);
  index[1] = static_cast<int>(row - static_cast<std::uint32_t>(index[2]) * rows);
  return grid;
}

Vec3 Medium::CellCentre(std::int64_t cell) const
{
  if (const CellPart* part = this->Parts_.Find(cell))
  {
    return part->Centre;
  }
  std::array<int, 3> index;
  const Grid& grid = this->GridOf(cell, index);
  Vec3 centre;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double* node = grid.Nodes[axis].data() + index[axis];
    centre[axis] = 0.5 * (node[0] + node[1]);
  }
  return centre;
}

double Medium::CellVolume(std::int64_t cell) const
{
  if (const CellPart* part = this->Parts_.Find(cell))
  {
    return part->Volume;
  }
  const Vec3 size = this->CellSize(cell);
  return size.x * size.y * size.z;
}

double Medium::OwnVolume(std::int64_t cell) const
{
  if (const CellPart* part = this->Parts_.Find(cell))
  {
    return part->OwnVolume;
  }
  if (!this->Overlap_)
  {
    return this->CellVolume(cell);
  }
  double own = 0.0;
  for (const Box& box : this->OwnBoxes(cell))
  {
    own += box.Volume();
  }
  return own;
}

std::vector<Box> Medium::OwnBoxes(std::int64_t cell) const
{
  std::array<int, 3> index;
  const Grid& grid = this->GridOf(cell, index);
  const Box box = this->BoxOf(cell);
  std::vector<Box> finer;
  std::copy_if(grid.Finer.begin(), grid.Finer.end(), std::back_inserter(finer),
    [&box](const Box& over) { return box.Meets(over); });
  if (finer.empty())
  {
    return {box};
  }
  // Where finer grids begin and end parts the cell into boxes that each belong to one grid.
  constexpr double Rounding = 1e-6;
  std::array<std::vector<double>, 3> borders;
  for (int axis = 0; axis < 3; ++axis)
  {
    std::vector<double> ends = {box.Upper[axis]};
    for (const Box& over : finer)
    {
      ends.push_back(std::clamp(over.Lower[axis], box.Lower[axis], box.Upper[axis]));
      ends.push_back(std::clamp(over.Upper[axis], box.Lower[axis], box.Upper[axis]));
    }
    std::sort(ends.begin(), ends.end());
    borders[axis] = {box.Lower[axis]};
    // What rounding leaves between two of them is nothing.
    for (const double end : ends)
    {
      if (end - borders[axis].back() > Rounding * box.Size()[axis])
      {
        borders[axis].push_back(end);
      }
    }
    borders[axis].back() = box.Upper[axis];
  }
  std::vector<Box> own;
  ForEachPlace({static_cast<int>(borders[0].size()) - 1, static_cast<int>(borders[1].size()) - 1,
                 static_cast<int>(borders[2].size()) - 1},
    [&](const std::array<int, 3>& place)
    {
      Box one;
      for (int axis = 0; axis < 3; ++axis)
      {
        one.Lower[axis] = borders[axis][place[axis]];
        one.Upper[axis] = borders[axis][place[axis] + 1];
      }
      if (std::none_of(finer.begin(), finer.end(),
            [&one](const Box& over) { return over.Contains(one.Centre()); }))
      {
        own.push_back(one);
      }
    });
  return own;
}

double Medium::MeanChord(std::int64_t cell) const
{
  return 4.0 * this->CellVolume(cell) / BoxSurface(this->CellSize(cell));
}

bool Medium::Covered(std::int64_t cell) const
{
  return this->Overlap_ && this->OwnVolume(cell) < this->CellVolume(cell);
}

Vec3 Medium::CellSize(std::int64_t cell) const
{
  if (const CellPart* part = this->Parts_.Find(cell))
  {
    return part->Size;
  }
  std::array<int, 3> index;
  const Grid& grid = this->GridOf(cell, index);
  Vec3 size;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double* node = grid.Nodes[axis].data() + index[axis];
    size[axis] = node[1] - node[0];
  }
  return size;
}

Box Medium::BoxOf(std::int64_t cell) const
{
  std::array<int, 3> index;
  const Grid& grid = this->GridOf(cell, index);
  Box box;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double* node = grid.Nodes[axis].data() + index[axis];
    box.Lower[axis] = node[0];
    box.Upper[axis] = node[1];
  }
  return box;
}

std::vector<Medium::Block> Medium::Blocks(int edge) const
{
  std::vector<Block> blocks;
  for (std::size_t grid = 0; grid < this->Grids_.size(); ++grid)
  {
    const std::array<int, 3>& size = this->Grids_[grid].Size;
    for (int z = 0; z < size[2]; z += edge)
    {
      for (int y = 0; y < size[1]; y += edge)
      {
        for (int x = 0; x < size[0]; x += edge)
        {
          blocks.push_back({grid, {x, y, z},
            {std::min(edge, size[0] - x), std::min(edge, size[1] - y),
              std::min(edge, size[2] - z)}});
        }
      }
    }
  }
  return blocks;
}

bool Medium::Holds(const Block& block) const
{
  bool holds = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    holds = holds && block.First[axis] >= 0 &&
            block.First[axis] + block.Size[axis] <= this->Grids_[block.Grid].Size[axis];
  }
  return holds;
}

std::int64_t Medium::LeaptCells() const
{
  return std::accumulate(this->Grids_.begin(), this->Grids_.end(), std::int64_t{0},
    [](std::int64_t sum, const Grid& grid) { return sum + (grid.Leaps ? grid.Clear.Cells() : 0); });
}

bool Medium::FacesAt(int axis, double coordinate) const
{
  return std::any_of(this->Grids_.begin(), this->Grids_.end(),
    [&](const Grid& grid)
    {
      const double* node = grid.Nodes[axis].data() + grid.Index(axis, coordinate);
      return std::min(std::abs(node[0] - coordinate), std::abs(node[1] - coordinate)) <
             1e-6 * (node[1] - node[0]);
    });
}

std::int64_t Medium::Locate(const Vec3& point) const
{
  const std::int64_t cell = this->LocateInGrids(point);
  return cell < 0 ? cell : this->Parts_.Locate(cell, point);
}

std::int64_t Medium::LocateInGrids(const Vec3& point) const
{
  for (const int rank : this->Rank_)
  {
    const Grid& grid = this->Grids_[rank];
    if (grid.Bounds.Contains(point))
    {
      return grid.Cell({grid.Index(0, point.x), grid.Index(1, point.y), grid.Index(2, point.z)});
    }
  }
  return -1;
}

std::int64_t Medium::Neighbour(std::int64_t cell, int axis, int side) const
{
  std::array<int, 3> index;
  const Grid& grid = this->GridOf(cell, index);
  const int step = side == 0 ? -1 : 1;
  const int moved = index[axis] + step;
  Vec3 point;
  for (int other = 0; other < 3; ++other)
  {
    const double* node = grid.Nodes[other].data() + index[other];
    point[other] = 0.5 * (node[0] + node[1]);
  }
  if (const CellPart* part = this->Parts_.Find(cell))
  {
    point = part->Centre;
  }
  const bool inside = moved >= 0 && moved < grid.Size[axis];
  std::int64_t found = -1;
  if (inside && !this->Overlap_)
  {
    index[axis] = moved;
    found = grid.Cell(index);
  }
  else
  {
    const double* node = grid.Nodes[axis].data() + (inside ? moved : index[axis]);
    point[axis] = inside ? 0.5 * (node[0] + node[1])
                         : (side == 0 ? node[0] : node[1]) + step * 0.25 * (node[1] - node[0]);
    found = this->LocateInGrids(point);
  }
  if (found < 0 || !this->Parts_.Find(found))
  {
    return found;
  }
  // Of a cell that walls cut, the part right behind the face.
  const double* node = grid.Nodes[axis].data() + (moved - step);
  const double width = node[1] - node[0];
  point[axis] = (side == 0 ? node[0] : node[1]) + step * JustBehind * width;
  return this->Parts_.Locate(found, point);
}

} // namespace smokevis
