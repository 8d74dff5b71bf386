#include "Bodies.h"

#include "Geometry.h"
#include "SharedCorners.h"
#include "SurfaceMesh.h"
#include "Triangle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include <glm/gtc/constants.hpp>

namespace smokevis
{

namespace
{

/// Cosine of the angle between faces above which they lie in one another.
constexpr double SamePlane = 0.999;

constexpr double Infinity = std::numeric_limits<double>::infinity();
/// A direction along no face of a box.
const Vec3 Aside = glm::normalize(Vec3(0.5377, 0.2861, 0.7931));

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

} // namespace

const std::vector<std::uint32_t>& Bodies::OfTriangles() const
{
  tbb::collaborative_call_once(this->Found_, [this] { this->OfTriangles_ = this->Find(); });
  return this->OfTriangles_;
}

std::vector<std::uint32_t> Bodies::Find() const
{
  const std::vector<std::size_t>& triangles = this->Shapes_.SurfaceTriangles();
  Vec3 lower(Infinity);
  Vec3 upper(-Infinity);
  for (const Vec3& point : this->Surfaces_.Points)
  {
    lower = glm::min(lower, point);
    upper = glm::max(upper, point);
  }
  const double size = glm::length(upper - lower);
  std::vector<SharedCorner> corners;
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
  {
    for (const std::uint32_t point : this->Surfaces_.Triangles[triangles[i]])
    {
      corners.push_back(MakeSharedCorner(0, this->Surfaces_.Points[point] - lower, i, size));
    }
  }
  boost::disjoint_sets_with_storage<> joined(triangles.size());
  UniteAtCorners(corners, joined);
  std::vector<std::uint32_t> bodies;
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    bodies.push_back(static_cast<std::uint32_t>(joined.find_set(i)));
  }

  // A ray from a light leaves what that lies in once more than it goes in.
  std::vector<char> rooms(triangles.size(), 0);
  std::vector<Hit> hits;
  for (const auto& light : this->Emitters_.Triangles)
  {
    const Vec3 centre = CentreOf({this->Emitters_.Points[light[0]],
      this->Emitters_.Points[light[1]], this->Emitters_.Points[light[2]]});
    this->Shapes_.SurfacesAlong(centre, Aside, 0.0, Infinity, hits);
    std::map<std::uint32_t, int> leaves;
    for (const Hit& hit : hits)
    {
      leaves[bodies[hit.Triangle]] += hit.Side == 1 ? 1 : -1;
    }
    for (const auto& [body, times] : leaves)
    {
      rooms[body] = times > 0 ? 1 : rooms[body];
    }
  }
  for (std::uint32_t& body : bodies)
  {
    body = rooms[body] != 0 ? Geometry::NoBody : body;
  }
  return bodies;
}

bool Bodies::Enclose(
  const Vec3& place, const Vec3& normal, const std::optional<std::uint32_t>& inside) const
{
  const double reach = 4.0 * this->Shapes_.Tolerance();
  std::vector<Hit> standing;
  this->Shapes_.SurfacesAlong(place + reach * normal, -normal, 0.0, 2.0 * reach, standing);
  std::erase_if(standing,
    [&](const Hit& hit)
    {
      return glm::dot(this->Shapes_.Normal(hit), normal) > -SamePlane ||
             this->OfTriangles()[hit.Triangle] == Geometry::NoBody ||
             (inside && this->OfTriangles()[hit.Triangle] == this->OfTriangles()[*inside]);
    });
  if (standing.empty())
  {
    return false;
  }
  const std::array<Vec3, 8> directions = DirectionsBefore(normal);
  const auto encloses = [&](const Hit& face)
  {
    return std::all_of(directions.begin(), directions.end(),
      [&](const Vec3& direction) {
        return this->Leaves(place + reach * normal, direction, this->OfTriangles()[face.Triangle]);
      });
  };
  return std::any_of(standing.begin(), standing.end(), encloses);
}

bool Bodies::Leaves(const Vec3& origin, const Vec3& direction, std::uint32_t body) const
{
  std::vector<Hit> hits;
  this->Shapes_.SurfacesAlong(origin, direction, 0.0, Infinity, hits);
  const auto ofBody = [&](const Hit& hit) { return this->OfTriangles()[hit.Triangle] == body; };
  const auto first = std::find_if(hits.begin(), hits.end(), ofBody);
  return std::any_of(first, hits.end(),
    [&](const Hit& hit)
    {
      return ofBody(hit) && hit.Side == 1 &&
             hit.Distance <= first->Distance + 4.0 * this->Shapes_.Tolerance();
    });
}

} // namespace smokevis
