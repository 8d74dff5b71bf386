#include "PolygonClip.h"

#include "Triangle.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace smokevis
{

//------------------------------------------------------------------------------
std::vector<Vec3> InBox(const std::vector<Vec3>& polygon, const Box& box)
{
  std::vector<Vec3> kept = polygon;
  std::vector<Vec3> next;
  for (int axis = 0; axis < 3; ++axis)
  {
    KeepBetween(
      kept, [axis](const Vec3& point) { return point[axis]; }, box.Lower[axis], box.Upper[axis],
      next);
    std::swap(kept, next);
  }
  return kept;
}

//------------------------------------------------------------------------------
void DropRepeated(std::vector<Vec3>& polygon, double share)
{
  const double distance = polygon.empty() ? 0.0 : share * glm::length(Box::Around(polygon).Size());
  const auto same = [distance](const Vec3& a, const Vec3& b)
  { return glm::length(a - b) <= distance; };
  polygon.erase(std::unique(polygon.begin(), polygon.end(), same), polygon.end());
  while (polygon.size() > 1 && same(polygon.back(), polygon.front()))
  {
    polygon.pop_back();
  }
}

//------------------------------------------------------------------------------
double AreaOf(const FlatPolygon& polygon)
{
  double sum = 0.0;
  for (std::size_t i = 2; i < polygon.size(); ++i)
  {
    const glm::dvec2 a = polygon[i - 1] - polygon[0];
    const glm::dvec2 b = polygon[i] - polygon[0];
    sum += a.x * b.y - a.y * b.x;
  }
  return 0.5 * std::abs(sum);
}

//------------------------------------------------------------------------------
Vec3 AreaVector(const std::vector<Vec3>& polygon)
{
  Vec3 sum(0.0);
  for (std::size_t i = 2; i < polygon.size(); ++i)
  {
    sum += AreaVector(Triangle{polygon[0], polygon[i - 1], polygon[i]});
  }
  return sum;
}

//------------------------------------------------------------------------------
bool Holds(const FlatPolygon& polygon, const glm::dvec2& point)
{
  bool left = true;
  bool right = true;
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const glm::dvec2 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    const glm::dvec2 from = point - polygon[i];
    const double turn = edge.x * from.y - edge.y * from.x;
    left = left && turn >= 0.0;
    right = right && turn <= 0.0;
  }
  return left || right;
}

glm::dvec2 MiddleOf(const FlatPolygon& polygon)
{
  glm::dvec2 sum(0.0);
  double area = 0.0;
  for (std::size_t i = 2; i < polygon.size(); ++i)
  {
    const glm::dvec2 a = polygon[i - 1] - polygon[0];
    const glm::dvec2 b = polygon[i] - polygon[0];
    const double own = a.x * b.y - a.y * b.x;
    sum += own * (a + b);
    area += own;
  }
  return area != 0.0 ? polygon[0] + sum / (3.0 * area) : polygon[0];
}

} // namespace smokevis
