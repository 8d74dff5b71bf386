#include "SurfaceCuts.h"

#include "Geometry.h"
#include "LightLeaves.h"
#include "LightSight.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace smokevis
{

namespace
{

/// Times that a light, and each of its parts, is divided at most: a fine mesh that goes through it
/// makes no swarm of lights.
constexpr int MostCuts = 4;
/// Leaves of a part of which each may be a light of its own.
constexpr std::size_t MostLeaves = 8;
/// Share of a plate across a line that each side of it has to have, and of its diagonal that the
/// line has to be long.
constexpr double LeastShare = 0.002;
constexpr double LeastLength = 0.01;

/// The piece of a triangle in a plane, if it lies on both sides of that.
std::optional<std::array<Vec3, 2>> InPlane(const Triangle& triangle, const Plane& plane)
{
  std::array<Vec3, 2> ends{};
  std::size_t found = 0;
  for (std::size_t corner = 0; corner < 3; ++corner)
  {
    const Vec3& here = triangle[corner];
    const Vec3& next = triangle[(corner + 1) % 3];
    const double a = plane.Height(here);
    const double b = plane.Height(next);
    if ((a > 0.0) != (b > 0.0))
    {
      ends[found++] = here + a / (a - b) * (next - here);
    }
  }
  return found == ends.size() ? std::optional(ends) : std::nullopt;
}

/// The same between the edges of a rectangle.
double LengthWithin(const std::array<Vec3, 2>& piece, const std::array<Vec3, 4>& rectangle)
{
  const auto place = [&rectangle](const Vec3& point)
  {
    const Vec3 u = rectangle[1] - rectangle[0];
    const Vec3 v = rectangle[3] - rectangle[0];
    const Vec3 from = point - rectangle[0];
    return Vec3(glm::dot(from, u) / glm::dot(u, u), glm::dot(from, v) / glm::dot(v, v), 0.0);
  };
  const Vec3 begin = place(piece[0]);
  double from = 0.0;
  double to = 1.0;
  const bool meets =
    Box{Vec3(0.0, 0.0, -1.0), Vec3(1.0)}.Clip(begin, 1.0 / (place(piece[1]) - begin), from, to);
  return meets ? (to - from) * glm::length(piece[1] - piece[0]) : 0.0;
}

/// Whether a plane leaves enough of a plate with these corners on both sides.
bool Divides(const Plane& plane, std::span<const Vec3> corners)
{
  double below = 0.0;
  double above = 0.0;
  for (const Vec3& corner : corners)
  {
    const double height = plane.Height(corner);
    below = std::max(below, -height);
    above = std::max(above, height);
  }
  return std::min(below, above) >= LeastShare * (below + above);
}

std::vector<Vec3> CornersOf(const std::vector<LightGroup>& leaves)
{
  std::vector<Vec3> corners;
  for (const LightGroup& leaf : leaves)
  {
    corners.insert(corners.end(), leaf.Corners.begin(), leaf.Corners.end());
  }
  return corners;
}

} // namespace

std::optional<Plane> SurfaceCuts::Longest(
  const std::vector<LightGroup>& leaves, std::span<const Vec3> corners) const
{
  const Vec3& normal = leaves.front().Normal;
  const std::array<Vec3, 4> plate = RectangleAround(leaves, leaves.front().Centre);
  const Vec3 centre = 0.5 * (plate[0] + plate[2]);
  const double diagonal = glm::length(plate[2] - plate[0]);
  // Where rays to the plate end: walls that it lies in, or that end at it from behind, hide
  // nothing.
  const double lift = LightSight::Lift * this->Shapes_.Tolerance();
  const Plane before{normal, glm::dot(normal, centre) + lift};
  std::optional<Plane> longest;
  double most = LeastLength * diagonal;
  for (const Triangle& triangle : this->Shapes_.SurfacesNear(centre, 0.5 * diagonal + lift))
  {
    const auto piece = InPlane(triangle, before);
    const double length = piece ? LengthWithin(*piece, plate) : 0.0;
    if (length > most)
    {
      const Vec3 across = glm::normalize(glm::cross(normal, (*piece)[1] - (*piece)[0]));
      const Plane plane{across, glm::dot(across, (*piece)[0])};
      if (Divides(plane, corners))
      {
        longest = plane;
        most = length;
      }
    }
  }
  return longest;
}

std::vector<std::vector<LightGroup>> SurfaceCuts::Divide(std::vector<LightGroup> leaves) const
{
  std::vector<std::vector<LightGroup>> groups =
    DivideLeaves(std::move(leaves), [this](const std::vector<LightGroup>& group, int cuts)
      { return cuts < MostCuts ? this->Longest(group, CornersOf(group)) : std::nullopt; });
  // What is seen of a group is told by the rectangle around it, which may reach through the wall.
  std::vector<std::vector<LightGroup>> parts;
  for (std::vector<LightGroup>& group : groups)
  {
    if (group.size() > 1 && group.size() <= MostLeaves &&
        this->Longest(group, RectangleAround(group, group.front().Centre)))
    {
      std::transform(group.begin(), group.end(), std::back_inserter(parts),
        [](const LightGroup& leaf) { return std::vector<LightGroup>{leaf}; });
    }
    else
    {
      parts.push_back(std::move(group));
    }
  }
  return parts;
}

} // namespace smokevis
