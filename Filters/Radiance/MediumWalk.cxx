// Medium's part for rays: the exact walk from cell to cell.
#include "Medium.h"

#include <algorithm>
#include <limits>

namespace smokevis
{

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

} // namespace

template <class Visit>
void Medium::WalkGrid(const Grid& grid, const Vec3& origin, const Vec3& direction,
  const Vec3& inverse, double begin, double end, Visit&& visit)
{
  const Vec3 start = origin + begin * direction;
  // One variable an axis, not arrays: they stay in registers.
  struct Axis
  {
    int Step = 0;
    /// Planes until the grid ends.
    int Left = 0;
    const double* Plane = nullptr;
    double Next = Infinity;
    double Origin = 0.0;
    double Inverse = 0.0;
    std::int64_t Stride = 0;
  };
  std::int64_t cell = grid.FirstCell;
  const auto enter = [&](int axis, std::int64_t stride)
  {
    Axis result;
    int index = grid.Index(axis, start[axis]);
    const double* nodes = grid.Nodes[axis].data();
    result.Origin = origin[axis];
    result.Inverse = inverse[axis];
    if (direction[axis] > 0.0)
    {
      result.Step = 1;
      result.Left = grid.Size[axis] - 1 - index;
      result.Plane = nodes + index + 1;
    }
    else if (direction[axis] < 0.0)
    {
      result.Step = -1;
      // A start on a plane lies in the cell that the ray goes into.
      if (start[axis] <= nodes[index] && index > 0)
      {
        --index;
      }
      result.Left = index;
      result.Plane = nodes + index;
    }
    if (result.Step != 0)
    {
      result.Next = (*result.Plane - result.Origin) * result.Inverse;
    }
    result.Stride = result.Step * stride;
    cell += index * stride;
    return result;
  };
  Axis x = enter(0, 1);
  Axis y = enter(1, grid.Size[0]);
  Axis z = enter(2, static_cast<std::int64_t>(grid.Size[0]) * grid.Size[1]);
  double at = begin;
  const auto cross = [&](Axis& axis)
  {
    if (axis.Next >= end)
    {
      return false;
    }
    if (axis.Next > at)
    {
      visit(cell, at, axis.Next);
      at = axis.Next;
    }
    // Only rounding leads out before the end: the rest belongs to the last cell.
    if (axis.Left-- == 0)
    {
      return false;
    }
    cell += axis.Stride;
    axis.Plane += axis.Step;
    axis.Next = (*axis.Plane - axis.Origin) * axis.Inverse;
    return true;
  };
  bool inside = true;
  while (inside)
  {
    inside = x.Next < y.Next ? (x.Next < z.Next ? cross(x) : cross(z))
                             : (y.Next < z.Next ? cross(y) : cross(z));
  }
  if (end > at)
  {
    visit(cell, at, end);
  }
}

template <class Visit>
void Medium::ForEachPiece(
  const Vec3& origin, const Vec3& direction, double begin, double end, Visit&& visit) const
{
  struct Interval
  {
    double Begin, End;
    int Rank;
  };
  thread_local std::vector<Interval> intervals;
  intervals.clear();
  const Vec3 inverse = 1.0 / direction;
  for (std::size_t rank = 0; rank < this->Rank_.size(); ++rank)
  {
    const Grid& grid = this->Grids_[this->Rank_[rank]];
    double enter = begin;
    double leave = end;
    if (grid.Bounds.Clip(origin, direction, inverse, enter, leave))
    {
      intervals.push_back({enter, leave, static_cast<int>(rank)});
    }
  }
  const auto walk = [&](int rank, double from, double to)
  { WalkGrid(this->Grids_[this->Rank_[rank]], origin, direction, inverse, from, to, visit); };
  if (intervals.size() == 1)
  {
    walk(intervals[0].Rank, intervals[0].Begin, intervals[0].End);
    return;
  }
  if (!this->Overlap_)
  {
    std::sort(intervals.begin(), intervals.end(),
      [](const Interval& a, const Interval& b)
      { return a.Begin != b.Begin ? a.Begin < b.Begin : a.Rank < b.Rank; });
    double at = begin;
    for (const Interval& interval : intervals)
    {
      // A ray in the face between two grids lies in both: it counts once.
      const double from = std::max(at, interval.Begin);
      if (interval.End > from)
      {
        walk(interval.Rank, from, interval.End);
        at = interval.End;
      }
    }
    return;
  }
  // Between two neighbouring ends the finest grid there counts.
  thread_local std::vector<double> ends;
  ends.clear();
  for (const Interval& interval : intervals)
  {
    ends.push_back(interval.Begin);
    ends.push_back(interval.End);
  }
  std::sort(ends.begin(), ends.end());
  for (std::size_t i = 1; i < ends.size(); ++i)
  {
    const double from = ends[i - 1];
    const double to = ends[i];
    if (to <= from)
    {
      continue;
    }
    for (const Interval& interval : intervals)
    {
      if (interval.Begin <= from && interval.End >= to)
      {
        walk(interval.Rank, from, to);
        break;
      }
    }
  }
}

void Medium::Walk(const Vec3& origin, const Vec3& direction, double begin, double end,
  std::vector<Segment>& pieces) const
{
  pieces.clear();
  const auto add = [&pieces](std::int64_t cell, double from, double to) {
    pieces.push_back({cell, from, to});
  };
  if (this->Parts_.Empty())
  {
    this->ForEachPiece(origin, direction, begin, end, add);
    return;
  }
  this->ForEachPiece(origin, direction, begin, end,
    [&](std::int64_t cell, double from, double to)
    { this->Parts_.Divide(cell, origin, direction, from, to, add); });
}

double Medium::OpticalDepth(
  const Vec3& origin, const Vec3& direction, double begin, double end) const
{
  if (this->Even_)
  {
    return this->Grids_[0].Bounds.Clip(origin, direction, 1.0 / direction, begin, end)
             ? this->MaximumExtinction_ * (end - begin)
             : 0.0;
  }
  double depth = 0.0;
  this->ForEachPiece(origin, direction, begin, end,
    [&](std::int64_t cell, double from, double to)
    { depth += this->Extinction_[cell] * (to - from); });
  return depth;
}

} // namespace smokevis
