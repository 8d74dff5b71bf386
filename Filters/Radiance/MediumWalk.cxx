// Medium's part for rays: the exact walk from cell to cell.
#include "Medium.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace smokevis
{

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();
/// Share of a cell that planes may lie off their places.
constexpr double Hair = 1e-9;

/// Adds up extinction over lengths.
struct DepthSum
{
  const float* Extinction;
  double Depth = 0.0;

  void operator()(std::int64_t cell, double from, double to)
  {
    this->Depth += this->Extinction[cell] * (to - from);
  }
};

/// What a loop calls: for a sum a copy that goes back in the end, since only that is kept in
/// registers.
template <class Visit> struct Kept
{
  explicit Kept(Visit& visit) : Own(visit) {}
  Visit& Own;
};
template <> struct Kept<DepthSum>
{
  explicit Kept(DepthSum& sum) : Own(sum), Sum_(sum) {}
  ~Kept() { this->Sum_ = this->Own; }
  Kept(const Kept&) = delete;
  Kept& operator=(const Kept&) = delete;
  DepthSum Own;

private:
  DepthSum& Sum_;
};

} // namespace

/// A ray on its way through the cells of one grid.
class Medium::GridRay
{
public:
  GridRay(const Grid& grid, const Vec3& origin, const Vec3& direction, const Vec3& inverse,
    double begin, double end);

  /// Calls visit(cell, begin, end) for each piece.
  template <class Visit> void Step(Visit& visit)
  {
    this->StepTo(this->End_, visit);
    if (this->End_ > this->At_)
    {
      visit(this->Cell_, this->At_, this->End_);
    }
  }

  /// The same but for pieces in bricks without smoke. All planes are crossed at the same distances:
  /// each axis meets its own planes, whatever the others do.
  template <class Visit> void Leap(Visit& visit);

private:
  struct Axis
  {
    std::ptrdiff_t Step = 0;
    /// Planes until the grid ends.
    int Left = 0;
    const double* Plane = nullptr;
    double Next = Infinity;
    double Origin = 0.0;
    double Inverse = 0.0;
    std::int64_t Stride = 0;

    /// Distance of the plane so many behind the next one.
    double Distance(int planes) const
    {
      return (this->Plane[this->Step * planes] - this->Origin) * this->Inverse;
    }
    /// Crosses so many planes, without counting those left.
    void Cross(int planes, std::int64_t& cell)
    {
      cell += planes * this->Stride;
      this->Plane += planes * this->Step;
      this->Next = this->Distance(0);
    }
    /// Crosses so many planes, no more than are left.
    void Advance(int planes, std::int64_t& cell)
    {
      this->Left -= planes;
      this->Cross(planes, cell);
    }
    /// Distance at which the grid ends along this axis.
    double Leaves() const { return this->Step == 0 ? Infinity : this->Distance(this->Left); }
    /// Goes where a copy has crossed to.
    void MoveTo(const Axis& copy)
    {
      this->Left -= static_cast<int>(std::abs(copy.Plane - this->Plane));
      this->Plane = copy.Plane;
      this->Next = copy.Next;
    }
  };

  /// Crosses the planes before a distance; returns whether the grid goes on behind it.
  template <class Visit> bool StepTo(double distance, Visit& visit);
  /// Index of the cell along an axis.
  int Index(int axis) const
  {
    return this->Axes_[axis].Step > 0 ? this->Grid_.Size[axis] - 1 - this->Axes_[axis].Left
                                      : this->Axes_[axis].Left;
  }
  /// Shortens the way to the box around the smoke; returns whether anything is left.
  bool Clip();
  /// Crosses the planes up to a distance, which is one of theirs; returns whether the grid goes on
  /// behind it.
  bool LeapTo(double distance);
  /// Distance at which a cube of bricks ends that starts with the present one.
  double EndOfCube(int bricks) const;

  const Grid& Grid_;
  const Vec3& Direction_;
  std::array<Axis, 3> Axes_;
  std::int64_t Cell_;
  double At_, End_;
};

Medium::GridRay::GridRay(const Grid& grid, const Vec3& origin, const Vec3& direction,
  const Vec3& inverse, double begin, double end)
    : Grid_(grid), Direction_(direction), Cell_(grid.FirstCell), At_(begin), End_(end)
{
  std::int64_t stride = 1;
  for (int axis = 0; axis < 3; ++axis)
  {
    Axis& own = this->Axes_[axis];
    const double start = origin[axis] + begin * direction[axis];
    const double* nodes = grid.Nodes[axis].data();
    int index = grid.Index(axis, start);
    own.Origin = origin[axis];
    own.Inverse = inverse[axis];
    own.Left = index;
    const bool along = std::isfinite(inverse[axis]);
    if (along && direction[axis] > 0.0)
    {
      own.Step = 1;
      own.Left = grid.Size[axis] - 1 - index;
      own.Plane = nodes + index + 1;
    }
    else if (along)
    {
      own.Step = -1;
      // A start on a plane lies in the cell that the ray goes into.
      if (start <= nodes[index] && index > 0)
      {
        --index;
      }
      own.Left = index;
      own.Plane = nodes + index;
    }
    if (own.Step != 0)
    {
      own.Next = own.Distance(0);
    }
    own.Stride = own.Step * stride;
    this->Cell_ += index * stride;
    stride *= grid.Size[axis];
  }
}

template <class Visit> bool Medium::GridRay::StepTo(double distance, Visit& visit)
{
  // One variable an axis, and copies: they stay in registers.
  Kept<Visit> kept(visit);
  Axis x = this->Axes_[0];
  Axis y = this->Axes_[1];
  Axis z = this->Axes_[2];
  // Only rounding leads out before the end: the rest belongs to the last cell.
  const double leaves = std::min({x.Leaves(), y.Leaves(), z.Leaves()});
  const double limit = std::min(distance, leaves);
  double at = this->At_;
  std::int64_t cell = this->Cell_;
  const auto cross = [&](Axis& axis)
  {
    if (axis.Next >= limit)
    {
      return false;
    }
    if (axis.Next > at)
    {
      kept.Own(cell, at, axis.Next);
      at = axis.Next;
    }
    axis.Cross(1, cell);
    return true;
  };
  bool inside = true;
  while (inside)
  {
    inside = x.Next < y.Next ? (x.Next < z.Next ? cross(x) : cross(z))
                             : (y.Next < z.Next ? cross(y) : cross(z));
  }
  this->Axes_[0].MoveTo(x);
  this->Axes_[1].MoveTo(y);
  this->Axes_[2].MoveTo(z);
  this->At_ = at;
  this->Cell_ = cell;
  return leaves >= distance;
}

bool Medium::GridRay::Clip()
{
  double from = this->At_;
  for (int axis = 0; axis < 3; ++axis)
  {
    const Axis& own = this->Axes_[axis];
    const int index = this->Index(axis);
    const int first = this->Grid_.Clear.First()[axis];
    const int last = this->Grid_.Clear.Last()[axis];
    const int before = own.Step > 0 ? first - index : index - last;
    const int within = own.Step > 0 ? last - index : index - first;
    if (within < 0 || last < first || (own.Step == 0 && before > 0))
    {
      return false;
    }
    if (own.Step != 0)
    {
      from = before > 0 ? std::max(from, own.Distance(before - 1)) : from;
      this->End_ = std::min(this->End_, own.Distance(within));
    }
  }
  return from < this->End_ && (from == this->At_ || this->LeapTo(from));
}

bool Medium::GridRay::LeapTo(double distance)
{
  this->At_ = std::max(this->At_, distance);
  for (int axis = 0; axis < 3; ++axis)
  {
    Axis& own = this->Axes_[axis];
    if (own.Step == 0)
    {
      continue;
    }
    // Right but for rounding where the planes are evenly spaced.
    const double guess =
      1.0 + Hair +
      (distance - own.Next) * this->Grid_.InverseStep[axis] * std::abs(this->Direction_[axis]);
    int planes = static_cast<int>(std::clamp(guess, 0.0, own.Left + 1.0));
    while (planes > 0 && own.Distance(planes - 1) > distance)
    {
      --planes;
    }
    while (planes <= own.Left && own.Distance(planes) <= distance)
    {
      ++planes;
    }
    if (planes > own.Left)
    {
      return false;
    }
    own.Advance(planes, this->Cell_);
  }
  return true;
}

double Medium::GridRay::EndOfCube(int bricks) const
{
  double end = Infinity;
  for (int axis = 0; axis < 3; ++axis)
  {
    const Axis& own = this->Axes_[axis];
    if (own.Step != 0)
    {
      const int inside = this->Index(axis) & ClearBricks::Mask;
      const int passed = own.Step > 0 ? inside : ClearBricks::Mask - inside;
      const int planes = (bricks << ClearBricks::Shift) - 1 - passed;
      end = std::min(end, own.Distance(std::min(planes, own.Left)));
    }
  }
  return end;
}

template <class Visit> void Medium::GridRay::Leap(Visit& visit)
{
  if (!this->Clip())
  {
    return;
  }
  const ClearBricks& clear = this->Grid_.Clear;
  if (!clear.HasBricks())
  {
    this->Step(visit);
    return;
  }
  const std::int16_t* const reach =
    clear.Reach(this->Axes_[0].Step < 0, this->Axes_[1].Step < 0, this->Axes_[2].Step < 0);
  for (;;)
  {
    const int bricks = reach[clear.Brick({this->Index(0), this->Index(1), this->Index(2)})];
    const double leave = this->EndOfCube(std::abs(bricks));
    if (bricks < 0)
    {
      if (leave >= this->End_ || !this->StepTo(leave, visit))
      {
        this->Step(visit);
        return;
      }
      if (leave > this->At_)
      {
        visit(this->Cell_, this->At_, leave);
        this->At_ = leave;
      }
      for (Axis& axis : this->Axes_)
      {
        // In an edge or a corner of the cube there are several.
        if (axis.Next <= leave)
        {
          if (axis.Left == 0)
          {
            visit(this->Cell_, leave, this->End_);
            return;
          }
          axis.Advance(1, this->Cell_);
        }
      }
    }
    else if (leave >= this->End_ || !this->LeapTo(leave))
    {
      return;
    }
  }
}

template <Medium::Pieces Wanted, class Visit>
void Medium::ForEachPiece(
  const Vec3& origin, const Vec3& direction, double begin, double end, Visit&& visit) const
{
  const Vec3 inverse = 1.0 / direction;
  const auto walk = [&](int rank, double from, double to)
  {
    const Grid& grid = this->Grids_[this->Rank_[rank]];
    GridRay ray(grid, origin, direction, inverse, from, to);
    if (Wanted == Pieces::Smoke && grid.Leaps)
    {
      ray.Leap(visit);
      return;
    }
    ray.Step(visit);
  };
  if (this->Grids_.size() == 1)
  {
    if (this->Grids_[0].Bounds.Clip(origin, inverse, begin, end))
    {
      walk(0, begin, end);
    }
    return;
  }
  struct Interval
  {
    double Begin, End;
    int Rank;
  };
  thread_local std::vector<Interval> intervals;
  intervals.clear();
  for (std::size_t rank = 0; rank < this->Rank_.size(); ++rank)
  {
    const Grid& grid = this->Grids_[this->Rank_[rank]];
    double enter = begin;
    double leave = end;
    if (grid.Bounds.Clip(origin, inverse, enter, leave))
    {
      intervals.push_back({enter, leave, static_cast<int>(rank)});
    }
  }
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

template <Medium::Pieces Wanted>
void Medium::ListPieces(const Vec3& origin, const Vec3& direction, double begin, double end,
  std::vector<Segment>& pieces) const
{
  pieces.clear();
  const auto add = [&](std::int64_t cell, double from, double to)
  {
    if (Wanted == Pieces::All || this->Extinction_[cell] > 0.0F)
    {
      pieces.push_back({cell, from, to});
    }
  };
  if (this->Parts_.Empty())
  {
    this->ForEachPiece<Wanted>(origin, direction, begin, end, add);
    return;
  }
  this->ForEachPiece<Wanted>(origin, direction, begin, end,
    [&](std::int64_t cell, double from, double to)
    { this->Parts_.Divide(cell, origin, direction, from, to, add); });
}

void Medium::Walk(const Vec3& origin, const Vec3& direction, double begin, double end,
  std::vector<Segment>& pieces) const
{
  this->ListPieces<Pieces::All>(origin, direction, begin, end, pieces);
}

void Medium::WalkSmoke(const Vec3& origin, const Vec3& direction, double begin, double end,
  std::vector<Segment>& pieces) const
{
  this->ListPieces<Pieces::Smoke>(origin, direction, begin, end, pieces);
}

double Medium::OpticalDepth(
  const Vec3& origin, const Vec3& direction, double begin, double end) const
{
  if (this->Even_)
  {
    return this->Grids_[0].Bounds.Clip(origin, 1.0 / direction, begin, end)
             ? this->MaximumExtinction_ * (end - begin)
             : 0.0;
  }
  DepthSum sum{this->Extinction_.data()};
  this->ForEachPiece<Pieces::Smoke>(origin, direction, begin, end, sum);
  return sum.Depth;
}

} // namespace smokevis
