#include "SurfaceMesh.h"

#include "Errors.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

namespace smokevis
{

namespace
{

/// Corners in an order of their own, by which equal triangles are found.
struct SortedTriangle
{
  std::array<Vec3, 3> Corner;
  std::size_t Index;

  std::array<double, 9> Key() const
  {
    return {this->Corner[0].x, this->Corner[0].y, this->Corner[0].z, this->Corner[1].x,
      this->Corner[1].y, this->Corner[1].z, this->Corner[2].x, this->Corner[2].y,
      this->Corner[2].z};
  }
};

} // namespace

std::vector<std::size_t> UsefulTriangles(const SurfaceMesh& mesh)
{
  std::vector<SortedTriangle> sorted;
  for (std::size_t i = 0; i < mesh.Triangles.size(); ++i)
  {
    SortedTriangle triangle{{}, i};
    std::array<Vec3, 3>& corner = triangle.Corner;
    for (int c = 0; c < 3; ++c)
    {
      corner[c] = mesh.Points[mesh.Triangles[i][c]];
      if (!std::isfinite(corner[c].x) || !std::isfinite(corner[c].y) || !std::isfinite(corner[c].z))
      {
        throw Error("surface cell " + std::to_string(mesh.TriangleCell[i]),
          "a corner has no finite coordinates", "Check the geometry that is put in");
      }
    }
    const double longest = std::max({glm::length(corner[1] - corner[0]),
      glm::length(corner[2] - corner[1]), glm::length(corner[0] - corner[2])});
    const double area = glm::length(glm::cross(corner[1] - corner[0], corner[2] - corner[0]));
    if (!(area > 1e-12 * longest * longest))
    {
      continue;
    }
    std::sort(corner.begin(), corner.end(),
      [](const Vec3& a, const Vec3& b) {
        return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
      });
    sorted.push_back(triangle);
  }
  std::stable_sort(sorted.begin(), sorted.end(),
    [](const SortedTriangle& a, const SortedTriangle& b) { return a.Key() < b.Key(); });
  const auto end = std::unique(sorted.begin(), sorted.end(),
    [](const SortedTriangle& a, const SortedTriangle& b) { return a.Key() == b.Key(); });
  std::vector<std::size_t> kept;
  std::transform(sorted.begin(), end, std::back_inserter(kept),
    [](const SortedTriangle& triangle) { return triangle.Index; });
  std::sort(kept.begin(), kept.end());
  return kept;
}

} // namespace smokevis
