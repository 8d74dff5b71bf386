#include "PolygonLight.h"

#include <cmath>
#include <complex>

namespace smokevis
{

namespace
{

/// A place as seen from a point.
struct Sighted
{
  Sighted(const Vec3& point, const Vec3& place) : Way(place - point), Distance(glm::length(Way)) {}

  Vec3 Way;
  double Distance;
};

/// A number whose argument is half of a triangle's solid angle.
std::complex<double> HalfAngle(const Sighted& a, const Sighted& b, const Sighted& c)
{
  const std::complex<double> half(
    a.Distance * b.Distance * c.Distance + glm::dot(a.Way, b.Way) * c.Distance +
      glm::dot(a.Way, c.Way) * b.Distance + glm::dot(b.Way, c.Way) * a.Distance,
    std::abs(glm::dot(a.Way, glm::cross(b.Way, c.Way))));
  // Seen from its edge, it has no angle to tell.
  return half == 0.0 ? 1.0 : half;
}

} // namespace

double SolidAngle(const Vec3& point, const Vec3& a, const Vec3& b, const Vec3& c)
{
  return 2.0 * std::arg(HalfAngle({point, a}, {point, b}, {point, c}));
}

double SolidAngle(const Vec3& point, const std::array<Vec3, 4>& corners)
{
  const Sighted first(point, corners[0]);
  const Sighted across(point, corners[2]);
  // Arguments of factors add up: one arctangent does for both triangles. In all they take pi at
  // most, but for rounding.
  return 2.0 * std::abs(std::arg(HalfAngle(first, {point, corners[1]}, across) *
                                 HalfAngle(first, across, {point, corners[3]})));
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
