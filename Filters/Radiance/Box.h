// Boxes with their edges along the axes.
#pragma once

#include "Types.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace smokevis
{

/// Surface of a box with edges of these lengths [m2].
inline double BoxSurface(const Vec3& size)
{
  return 2.0 * (size.x * size.y + size.y * size.z + size.z * size.x);
}

/// Area of one of its faces across an axis [m2].
inline double FaceArea(const Vec3& size, int axis)
{
  return size[(axis + 1) % 3] * size[(axis + 2) % 3];
}

inline double LargestEdge(const Vec3& size)
{
  return std::max({size.x, size.y, size.z});
}

struct Box
{
  Vec3 Lower{0.0};
  Vec3 Upper{0.0};

  /// One that holds nothing yet.
  static Box Nothing()
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return {Vec3(infinity), Vec3(-infinity)};
  }

  /// The smallest around points.
  static Box Around(std::span<const Vec3> points)
  {
    Box box = Nothing();
    for (const Vec3& point : points)
    {
      box.Add({point, point});
    }
    return box;
  }

  Vec3 Centre() const { return 0.5 * (this->Lower + this->Upper); }
  Vec3 Size() const { return this->Upper - this->Lower; }
  double Surface() const { return BoxSurface(this->Size()); }
  double Volume() const
  {
    const Vec3 size = this->Size();
    return size.x * size.y * size.z;
  }

  /// Whether it shares a volume with another.
  bool Meets(const Box& other) const
  {
    return glm::all(glm::lessThan(this->Lower, other.Upper)) &&
           glm::all(glm::lessThan(other.Lower, this->Upper));
  }

  bool Contains(const Vec3& point) const
  {
    return glm::all(glm::greaterThanEqual(point, this->Lower)) &&
           glm::all(glm::lessThanEqual(point, this->Upper));
  }

  /// Grows it around another.
  void Add(const Box& other)
  {
    this->Lower = glm::min(this->Lower, other.Lower);
    this->Upper = glm::max(this->Upper, other.Upper);
  }

  /// Shortens a stretch of a line to what lies in the box; returns whether anything does.
  /// @param inverse 1 / direction
  bool Clip(const Vec3& origin, const Vec3& inverse, double& begin, double& end) const
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      // The line runs along the axis's faces, but for less than numbers tell.
      if (!std::isfinite(inverse[axis]))
      {
        if (origin[axis] < this->Lower[axis] || origin[axis] > this->Upper[axis])
        {
          return false;
        }
        continue;
      }
      const double low = (this->Lower[axis] - origin[axis]) * inverse[axis];
      const double high = (this->Upper[axis] - origin[axis]) * inverse[axis];
      begin = std::max(begin, std::min(low, high));
      end = std::min(end, std::max(low, high));
    }
    return end > begin;
  }
};

/// Joins things in boxes that lines meet no more often in one box than in two.
/// @param boxOf(thing) its box
/// @param join(thing, other) adds the other to it, its box to the thing's
template <class Thing, class BoxOf, class Join>
void JoinWhereSmaller(std::vector<Thing>& things, BoxOf&& boxOf, Join&& join)
{
  for (std::size_t one = 0; one < things.size(); ++one)
  {
    for (std::size_t other = 0; other < one; ++other)
    {
      Box both = boxOf(things[one]);
      both.Add(boxOf(things[other]));
      // Roundings must not decide where both are the same.
      constexpr double rounding = 1.0 + 1e-6;
      if (both.Surface() <=
          rounding * (boxOf(things[one]).Surface() + boxOf(things[other]).Surface()))
      {
        join(things[other], things[one]);
        things.erase(things.begin() + static_cast<std::ptrdiff_t>(one));
        // Others may fit now.
        one = 0;
        break;
      }
    }
  }
}

} // namespace smokevis
