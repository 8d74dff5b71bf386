// Opaque shapes and rays against them. The one place that knows Embree.
#pragma once

#include "Types.h"

#include <limits>
#include <memory>
#include <vector>

namespace smokevis
{

/// Triangulated surface cells.
struct SurfaceMesh
{
  std::vector<Vec3> Points;
  /// Corners of each triangle; the front is the right-hand side.
  std::vector<std::array<std::uint32_t, 3>> Triangles;
  /// The cell that each triangle belongs to.
  std::vector<std::uint32_t> TriangleCell;
  /// Diffuse reflectance of each cell, both sides, 0 to 1 a band.
  std::vector<Spectrum> CellReflectance;

  bool operator==(const SurfaceMesh&) const = default;
};

/// Where a ray meets a shape.
struct Hit
{
  /// Distance along the ray [m]; infinity: nothing was hit.
  double Distance = std::numeric_limits<double>::infinity();
  /// Place of the triangle among Geometry's, of the surfaces or of the emitters.
  std::uint32_t Triangle = 0;
  /// True where a plate of a sign or lamp was hit.
  bool Emitter = false;
  /// 0: seen from its front, 1: from its back.
  int Side = 0;

  bool Found() const { return this->Distance < std::numeric_limits<double>::infinity(); }
};

/// Where a straight line passes through a shape, as seen from both sides.
struct Crossing
{
  /// What the line meets coming from its beginning.
  Hit Arrive;
  /// What it would meet here coming from its end: the same triangle's other side, or the other of
  /// two shapes that touch, such as a plate on a wall.
  Hit Leave;
};

/// All opaque shapes of a scene: surfaces and the plates of the emitters. A plate that lies in a
/// surface, or behind it by less than Tolerance(), wins over the surface when seen from its front.
class Geometry
{
public:
  Geometry();
  /// Builds the search structures. Exact duplicates and triangles without area are left out.
  /// @param sceneSize diagonal of all that rays come from, smoke included [m]; at least that of the
  /// shapes is taken
  /// @param coreSize diagonal of the part that matters, such as the smoke [m]; 0: all does
  Geometry(const SurfaceMesh& surfaces, const SurfaceMesh& emitters, double sceneSize = 0.0,
    double coreSize = 0.0);
  ~Geometry();
  Geometry(Geometry&&) noexcept;
  Geometry& operator=(Geometry&&) noexcept;

  bool Empty() const;
  /// Distance within which two shapes count as touching [m].
  double Tolerance() const;
  /// Triangles that are there to be hit, as indices into their mesh; Hit::Triangle is a place in
  /// this list.
  const std::vector<std::size_t>& SurfaceTriangles() const;
  const std::vector<std::size_t>& EmitterTriangles() const;
  /// The cell of a surface triangle or of an emitter triangle.
  std::uint32_t Cell(const Hit& hit) const;
  /// Unit normal of the front of the triangle that was hit.
  Vec3 Normal(const Hit& hit) const;

  /// First shape met between two distances [m].
  Hit Intersect(const Vec3& origin, const Vec3& direction, double begin, double end) const;
  /// All shapes that a line meets between two distances, in order; `crossings` is overwritten.
  void Cross(const Vec3& origin, const Vec3& direction, double begin, double end,
    std::vector<Crossing>& crossings) const;
  /// Whether anything opaque lies between two distances.
  bool Occluded(const Vec3& origin, const Vec3& direction, double begin, double end) const;
  /// Whether the straight line between two points is clear but for what touches its ends.
  bool Visible(const Vec3& from, const Vec3& to) const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> Implementation_;
};

} // namespace smokevis
