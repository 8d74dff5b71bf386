#include "CellWalls.h"

#include "PolygonClip.h"
#include "Scene.h"

#include <algorithm>
#include <cmath>

namespace smokevis
{

namespace
{

/// Walls closer to a cell's faces than this share of its edges lie in them.
constexpr double FaceShare = 1e-3;
/// Triangles are halved until their edges are no longer than so many cells.
constexpr double LongestEdge = 8.0;

} // namespace

//--------------------------------------------------------------------------------------------------
CellWalls::CellWalls(const Scene& scene)
{
  scene.ForEachTriangle(
    [&](std::size_t, const Triangle& corners)
    {
      const std::size_t before = this->Meetings.size();
      this->Find(scene.Smoke(), corners);
      if (this->Meetings.size() > before)
      {
        this->Walls.push_back(corners);
      }
    });
  std::sort(this->Meetings.begin(), this->Meetings.end());
  this->Meetings.erase(
    std::unique(this->Meetings.begin(), this->Meetings.end()), this->Meetings.end());
}

//--------------------------------------------------------------------------------------------------
void CellWalls::Find(const Medium& smoke, const Triangle& corners)
{
  const auto [low, high] = BoundsOf(corners);
  if (glm::any(glm::greaterThan(low, smoke.Upper())) ||
      glm::any(glm::lessThan(high, smoke.Lower())))
  {
    return;
  }
  int longest = 0;
  double length = 0.0;
  for (int edge = 0; edge < 3; ++edge)
  {
    const double own = glm::distance(corners[edge], corners[(edge + 1) % 3]);
    longest = own > length ? edge : longest;
    length = std::max(length, own);
  }
  // In a plane across an axis there is nothing beside the triangle.
  const Vec3 size = high - low;
  const bool askew = std::min({size.x, size.y, size.z}) > 0.0;
  if (askew && length > LongestEdge * smoke.LargestEdge())
  {
    const Vec3& from = corners[longest];
    const Vec3& to = corners[(longest + 1) % 3];
    const Vec3& other = corners[(longest + 2) % 3];
    const Vec3 middle = 0.5 * (from + to);
    this->Find(smoke, {from, middle, other});
    this->Find(smoke, {middle, to, other});
    return;
  }
  const Vec3 normal = AreaVector(corners);
  smoke.ForCellsIn(low, high,
    [&](std::int64_t cell)
    {
      if (smoke.Extinction(cell) == 0.0F)
      {
        return;
      }
      const Vec3 centre = smoke.CellCentre(cell);
      const Vec3 half = (0.5 - FaceShare) * smoke.CellSize(cell);
      if (std::abs(glm::dot(normal, corners[0] - centre)) > glm::dot(glm::abs(normal), half))
      {
        return;
      }
      const std::vector<Vec3> kept =
        InBox({corners[0] - centre, corners[1] - centre, corners[2] - centre}, Box{-half, half});
      if (kept.size() >= 3)
      {
        this->Meetings.push_back({cell, this->Walls.size()});
      }
    });
}

} // namespace smokevis
