#include "SignShadow.h"

#include "PolygonClip.h"
#include "SignFacets.h"
#include "Triangle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace smokevis
{

namespace
{

/// Rays to a sign, and pieces of it that shadows leave: where more are needed, looks at its parts
/// cost less.
constexpr int MostRays = 64;
constexpr std::size_t MostPieces = 64;
/// Share of a plate that is no more than rounding between triangles that meet.
constexpr double LeastShare = 1e-9;

/// Convex, in a plane; seen from the eye, which is the origin.
using Polygon = std::vector<Vec3>;

/// All that a triangle hides from the origin.
class Shadow
{
public:
  /// @param distance of its plane from the eye, and behind it, from where on there is shadow [m]
  /// @return none where its plane is closer to the eye
  static std::optional<Shadow> Of(const Triangle& triangle, double distance)
  {
    const Vec3 normal = glm::normalize(AreaVector(triangle));
    const double height = glm::dot(normal, triangle[0]);
    if (!(std::abs(height) >= distance))
    {
      return std::nullopt;
    }
    const double turn = height > 0.0 ? 1.0 : -1.0;
    Shadow shadow;
    shadow.Sides_ = {turn * glm::cross(triangle[0], triangle[1]),
      turn * glm::cross(triangle[1], triangle[2]), turn * glm::cross(triangle[2], triangle[0])};
    shadow.Normal_ = turn * normal;
    shadow.Height_ = std::abs(height) + distance;
    return shadow;
  }

  bool Holds(const Vec3& point) const
  {
    return glm::dot(point, this->Normal_) >= this->Height_ &&
           std::all_of(this->Sides_.begin(), this->Sides_.end(),
             [&](const Vec3& side) { return glm::dot(point, side) >= 0.0; });
  }

  /// Adds what lies outside of it.
  void AddLit(Polygon polygon, std::vector<Polygon>& lit) const
  {
    Polygon kept;
    const auto part = [&](const auto& function)
    {
      KeepSide(
        polygon, [&](const Vec3& point) { return -function(point); }, kept);
      lit.push_back(kept);
      KeepSide(polygon, function, kept);
      std::swap(polygon, kept);
    };
    part([&](const Vec3& point) { return glm::dot(point, this->Normal_) - this->Height_; });
    for (const Vec3& side : this->Sides_)
    {
      part([&](const Vec3& point) { return glm::dot(point, side); });
    }
  }

private:
  std::array<Vec3, 3> Sides_;
  Vec3 Normal_;
  double Height_ = 0.0;
};

/// Of the surface triangle that was hit, seen from the eye.
Triangle TriangleOf(const Scene& scene, const Hit& hit, const Vec3& eye)
{
  const SurfaceMesh& mesh = scene.Surfaces();
  const auto& corners = mesh.Triangles[scene.Shapes().SurfaceTriangles()[hit.Triangle]];
  return {
    mesh.Points[corners[0]] - eye, mesh.Points[corners[1]] - eye, mesh.Points[corners[2]] - eye};
}

/// Whether shadows cover a plate.
/// @param reach before the plate within which what is met counts as the plate [m]
/// @param rays that are left
bool Covered(const View& view, const Vec3& eye, const Polygon& plate, double reach, int& rays)
{
  const auto area = [](const Polygon& polygon) { return glm::length(AreaVector(polygon)); };
  const double least = LeastShare * area(plate);
  for (std::vector<Polygon> pieces = {plate}; !pieces.empty();)
  {
    // Where most is left a place that is seen is found soonest.
    const Polygon& largest = *std::max_element(pieces.begin(), pieces.end(),
      [&](const Polygon& a, const Polygon& b) { return area(a) < area(b); });
    const Vec3 middle = std::accumulate(largest.begin(), largest.end(), Vec3(0.0)) /
                        static_cast<double>(largest.size());
    const double distance = glm::length(middle);
    const Hit hit = view.FirstHit(eye, middle / distance, distance + reach);
    if (--rays < 0 || pieces.size() > MostPieces || !hit.Found() || hit.Emitter)
    {
      return false;
    }
    const auto shadow = Shadow::Of(TriangleOf(view.TheScene(), hit, eye), reach);
    if (!shadow || !shadow->Holds(middle))
    {
      return false;
    }
    std::vector<Polygon> lit;
    for (Polygon& piece : pieces)
    {
      shadow->AddLit(std::move(piece), lit);
    }
    std::erase_if(lit, [&](const Polygon& piece) { return !(area(piece) > least); });
    pieces = std::move(lit);
  }
  return true;
}

} // namespace

//--------------------------------------------------------------------------------------------------
bool InShadowOfSurfaces(const View& view, const Sign& sign, const Vec3& eye)
{
  const EmitterSet& lights = view.TheScene().Lights();
  const std::vector<Facet> facets = FacetsOf(lights, sign, eye);
  int rays = MostRays;
  for (const Facet& facet : facets)
  {
    Polygon plate;
    double farthest = 0.0;
    for (const glm::dvec2& place : {glm::dvec2(0.0, 0.0), {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}})
    {
      plate.push_back(OnFacet(lights, sign, facet, place) - eye);
      farthest = std::max(farthest, glm::length(plate.back()));
    }
    if (!Covered(view, eye, plate, SightReach(view, sign, farthest), rays))
    {
      return false;
    }
  }
  return !facets.empty();
}

} // namespace smokevis
