// Cuts convex polygons by lines and planes, and measures what is left.
#pragma once

#include "Box.h"
#include "Types.h"

#include <vector>

namespace smokevis
{

/// Convex, in a plane.
using FlatPolygon = std::vector<glm::dvec2>;

/// The part of a convex polygon where a linear function of the point is not negative.
/// @param kept is overwritten; no corners: nothing is left
template <class Point, class Function>
void KeepSide(const std::vector<Point>& polygon, const Function& function, std::vector<Point>& kept)
{
  kept.clear();
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const Point& here = polygon[i];
    const Point& next = polygon[i + 1 < polygon.size() ? i + 1 : 0];
    const double a = function(here);
    const double b = function(next);
    if (a >= 0.0)
    {
      kept.push_back(here);
    }
    if ((a > 0.0 && b < 0.0) || (a < 0.0 && b > 0.0))
    {
      kept.push_back(here + a / (a - b) * (next - here));
    }
  }
}

/// The part of a convex polygon between two values of a linear function.
template <class Point, class Function>
void KeepBetween(const std::vector<Point>& polygon, const Function& function, double low,
  double high, std::vector<Point>& kept)
{
  thread_local std::vector<Point> half;
  KeepSide(
    polygon, [&](const Point& point) { return function(point) - low; }, half);
  KeepSide(
    half, [&](const Point& point) { return high - function(point); }, kept);
}

/// The part of a convex polygon between two lines across an axis.
inline void KeepStrip(
  const FlatPolygon& polygon, int axis, double low, double high, FlatPolygon& kept)
{
  KeepBetween(
    polygon, [axis](const glm::dvec2& point) { return point[axis]; }, low, high, kept);
}

/// The part of a convex polygon in a box.
std::vector<Vec3> InBox(const std::vector<Vec3>& polygon, const Box& box);

/// Leaves one of corners that follow each other and lie no farther apart than a share of the
/// polygon's size.
void DropRepeated(std::vector<Vec3>& polygon, double share);

double AreaOf(const FlatPolygon& polygon);
/// Newell's normal of a plane polygon in space; its length is the area.
Vec3 AreaVector(const std::vector<Vec3>& polygon);
/// Whether a point lies in a convex polygon, whichever way that turns.
bool Holds(const FlatPolygon& polygon, const glm::dvec2& point);
/// Centroid of a convex polygon; a corner of one without area.
glm::dvec2 MiddleOf(const FlatPolygon& polygon);

} // namespace smokevis
