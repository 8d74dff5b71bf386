#include "Bodies.h"

#include "Geometry.h"
#include "SharedCorners.h"
#include "SurfaceMesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <glm/gtc/constants.hpp>

namespace smokevis
{

namespace
{

/// Cosine of the angle between faces above which they lie in one another.
constexpr double SamePlane = 0.999;

/// Directions into the half space before a place, none of them along an axis of a box.
std::array<Vec3, 8> DirectionsBefore(const Vec3& normal)
{
  const Vec3 aside = glm::normalize(
    glm::cross(normal, std::abs(normal.x) < 0.5 ? Vec3(1.0, 0.0, 0.0) : Vec3(0.0, 1.0, 0.0)));
  const Vec3 across = glm::cross(normal, aside);
  std::array<Vec3, 8> directions;
  for (std::size_t i = 0; i < directions.size(); ++i)
  {
    const double angle = 0.3 + 0.25 * glm::pi<double>() * static_cast<double>(i);
    const double height = i % 2 == 0 ? 0.4 : 1.5;
    directions[i] =
      glm::normalize(height * normal + std::cos(angle) * aside + std::sin(angle) * across);
  }
  return directions;
}

std::vector<std::uint32_t> FindBodies(
  const SurfaceMesh& surfaces, const std::vector<std::size_t>& triangles)
{
  Vec3 lower(std::numeric_limits<double>::infinity());
  Vec3 upper(-lower);
  for (const Vec3& point : surfaces.Points)
  {
    lower = glm::min(lower, point);
    upper = glm::max(upper, point);
  }
  std::vector<SharedCorner> corners;
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
  {
    for (const std::uint32_t point : surfaces.Triangles[triangles[i]])
    {
      corners.push_back(
        MakeSharedCorner(0, surfaces.Points[point] - lower, i, glm::length(upper - lower)));
    }
  }
  boost::disjoint_sets_with_storage<> sets(triangles.size());
  UniteAtCorners(corners, sets);
  std::vector<std::uint32_t> bodies;
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    bodies.push_back(static_cast<std::uint32_t>(sets.find_set(i)));
  }
  return bodies;
}

} // namespace

const std::vector<std::uint32_t>& Bodies::OfTriangles() const
{
  tbb::collaborative_call_once(this->Found_,
    [this] { this->OfTriangles_ = FindBodies(this->Surfaces_, this->Shapes_.SurfaceTriangles()); });
  return this->OfTriangles_;
}

bool Bodies::Enclose(const Vec3& place, const Vec3& normal) const
{
  const double reach = 4.0 * this->Shapes_.Tolerance();
  std::vector<Hit> standing;
  this->Shapes_.SurfacesAlong(place + reach * normal, -normal, 0.0, 2.0 * reach, standing);
  std::erase_if(standing,
    [&](const Hit& hit) { return glm::dot(this->Shapes_.Normal(hit), normal) > -SamePlane; });
  if (standing.empty())
  {
    return false;
  }
  const std::array<Vec3, 8> directions = DirectionsBefore(normal);
  const auto encloses = [&](const Hit& face)
  {
    return std::all_of(directions.begin(), directions.end(),
      [&](const Vec3& direction) {
        return this->MeetsBack(
          place + reach * normal, direction, this->OfTriangles()[face.Triangle]);
      });
  };
  return std::any_of(standing.begin(), standing.end(), encloses);
}

bool Bodies::MeetsBack(const Vec3& origin, const Vec3& direction, std::uint32_t body) const
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Hit first = this->Shapes_.Intersect(origin, direction, 0.0, infinity);
  if (!first.Found())
  {
    return false;
  }
  const double gap = 4.0 * this->Shapes_.Tolerance();
  std::vector<Hit> touching;
  this->Shapes_.SurfacesAlong(origin, direction, 0.0, first.Distance + gap, touching);
  return std::any_of(touching.begin(), touching.end(),
    [&](const Hit& hit) { return hit.Side == 1 && this->OfTriangles()[hit.Triangle] == body; });
}

} // namespace smokevis
