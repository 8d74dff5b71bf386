#include "SignByRays.h"

#include <cmath>

namespace smokevis
{

//--------------------------------------------------------------------------------------------------
SignByRays MeasureByRays(const View& view, const Vec3& eye, const glm::ivec2& steps)
{
  const EmitterSet& lights = view.TheScene().Lights();
  // Sums over solid angles of 1, the luminance and its square.
  glm::dvec3 all(0.0);
  glm::dvec3 unlit(0.0);
  for (const std::size_t index : lights.Signs()[0].Cells)
  {
    const EmitterCell& cell = lights.Cells()[index];
    const Vec3 along = cell.Vertices[1] - cell.Vertices[0];
    const Vec3 up = cell.Vertices[3] - cell.Vertices[0];
    for (int step = 0; step < steps.x * steps.y; ++step)
    {
      const Vec3 way = cell.Vertices[0] + (step % steps.x + 0.5) / steps.x * along +
                       (step / steps.x + 0.5) / steps.y * up - eye;
      const Vec3 direction = glm::normalize(way);
      const double solid =
        std::abs(glm::dot(glm::cross(along, up), way)) / std::pow(glm::length(way), 3.0);
      const double light = view.Trace(eye, direction, view.FirstHit(eye, direction), 0).Total();
      const glm::dvec3 moments = solid * glm::dvec3(1.0, light, light * light);
      all += moments;
      unlit += cell.Luminance[0] > 0.0 ? glm::dvec3(0.0) : moments;
    }
  }
  const double mean = all[1] / all[0];
  const glm::dvec3 lit = all - unlit;
  return {std::sqrt(all[2] / all[0] - mean * mean) / mean, lit[1] / lit[0], unlit[1] / unlit[0]};
}

} // namespace smokevis
