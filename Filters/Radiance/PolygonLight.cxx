#include "PolygonLight.h"

#include <cmath>

namespace smokevis
{

double SolidAngle(const Vec3& point, const Vec3& a, const Vec3& b, const Vec3& c)
{
  const Vec3 p = a - point;
  const Vec3 q = b - point;
  const Vec3 r = c - point;
  const double lp = glm::length(p);
  const double lq = glm::length(q);
  const double lr = glm::length(r);
  const double above = std::abs(glm::dot(p, glm::cross(q, r)));
  const double below =
    lp * lq * lr + glm::dot(p, q) * lr + glm::dot(p, r) * lq + glm::dot(q, r) * lp;
  return above == 0.0 && below == 0.0 ? 0.0 : 2.0 * std::atan2(above, below);
}

double SolidAngle(const Vec3& point, const std::array<Vec3, 4>& corners)
{
  return SolidAngle(point, corners[0], corners[1], corners[2]) +
         SolidAngle(point, corners[0], corners[2], corners[3]);
}

double ProjectedSolidAngle(
  const Vec3& point, const Vec3& normal, const std::array<Vec3, 4>& corners)
{
  // A convex quadrilateral cut by a plane has at most five corners.
  std::array<Vec3, 8> clipped;
  int count = 0;
  for (int i = 0; i < 4; ++i)
  {
    const Vec3 here = corners[i] - point;
    const Vec3 next = corners[(i + 1) % 4] - point;
    const double heightHere = glm::dot(here, normal);
    const double heightNext = glm::dot(next, normal);
    if (heightHere >= 0.0)
    {
      clipped[count++] = here;
    }
    if ((heightHere > 0.0 && heightNext < 0.0) || (heightHere < 0.0 && heightNext > 0.0))
    {
      clipped[count++] = here + heightHere / (heightHere - heightNext) * (next - here);
    }
  }
  double sum = 0.0;
  for (int i = 0; i < count; ++i)
  {
    const Vec3& a = clipped[i];
    const Vec3& b = clipped[(i + 1) % count];
    const Vec3 cross = glm::cross(a, b);
    const double sine = glm::length(cross);
    if (sine > 0.0)
    {
      sum += std::atan2(sine, glm::dot(a, b)) * glm::dot(cross, normal) / sine;
    }
  }
  return 0.5 * std::abs(sum);
}

} // namespace smokevis
