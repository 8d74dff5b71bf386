#include "PolygonClip.h"

#include <cmath>

namespace smokevis
{

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
glm::dvec2 MiddleOf(const FlatPolygon& polygon)
{
  glm::dvec2 sum(0.0);
  for (const glm::dvec2& corner : polygon)
  {
    sum += corner;
  }
  return sum / static_cast<double>(polygon.size());
}

} // namespace smokevis
