#include "PlateCovers.h"

#include "Geometry.h"
#include "PolygonClip.h"
#include "Scene.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace smokevis
{

namespace
{

constexpr std::size_t PlatesAGroup = 32;

/// The part of a triangle within the edges of another in the same plane.
/// @param normal of the other
std::vector<Vec3> Within(const Triangle& corners, const Triangle& other, const Vec3& normal)
{
  std::vector<Vec3> part(corners.begin(), corners.end());
  std::vector<Vec3> kept;
  for (std::size_t edge = 0; edge < other.size(); ++edge)
  {
    const Vec3 inward = glm::cross(normal, other[(edge + 1) % other.size()] - other[edge]);
    KeepSide(
      part, [&](const Vec3& point) { return glm::dot(inward, point - other[edge]); }, kept);
    std::swap(part, kept);
  }
  return part;
}

} // namespace

PlateCovers::PlateCovers(const Geometry& shapes, const SurfaceMesh& emitters)
    : Tolerance_(shapes.Tolerance())
{
  for (const std::size_t triangle : shapes.EmitterTriangles())
  {
    const auto& points = emitters.Triangles[triangle];
    Plate plate;
    plate.Corners = {
      emitters.Points[points[0]], emitters.Points[points[1]], emitters.Points[points[2]]};
    plate.Normal = glm::normalize(AreaVector(plate.Corners));
    plate.Bounds = BoundsOf(plate.Corners);
    plate.Bounds.Lower -= this->Tolerance_;
    plate.Bounds.Upper += this->Tolerance_;
    if (this->Groups_.empty() || this->Groups_.back().Plates.size() == PlatesAGroup)
    {
      this->Groups_.emplace_back();
    }
    this->Groups_.back().Bounds.Add(plate.Bounds);
    this->Groups_.back().Plates.push_back(plate);
  }
}

std::array<std::vector<Triangle>, 2> PlateCovers::On(const Triangle& corners) const
{
  std::array<std::vector<Triangle>, 2> parts;
  const Vec3 normal = glm::normalize(AreaVector(corners));
  const Box bounds = BoundsOf(corners);
  const auto add = [&](const Plate& plate)
  {
    const auto inPlane = [&](const Vec3& corner)
    { return std::abs(glm::dot(corner - corners[0], normal)) <= this->Tolerance_; };
    if (!plate.Bounds.Meets(bounds) ||
        !std::all_of(plate.Corners.begin(), plate.Corners.end(), inPlane))
    {
      return;
    }
    const std::vector<Vec3> covered = Within(corners, plate.Corners, plate.Normal);
    for (std::size_t i = 2; i < covered.size(); ++i)
    {
      const Triangle part = {covered[0], covered[i - 1], covered[i]};
      if (AreaOf(part) > 0.0)
      {
        parts[glm::dot(plate.Normal, normal) > 0.0 ? 0 : 1].push_back(part);
      }
    }
  };
  for (const Group& group : this->Groups_)
  {
    if (group.Bounds.Meets(bounds))
    {
      std::for_each(group.Plates.begin(), group.Plates.end(), add);
    }
  }
  return parts;
}

} // namespace smokevis
