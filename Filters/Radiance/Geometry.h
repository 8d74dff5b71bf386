// Opaque shapes, which may touch, and rays against them. The one place that knows Embree.
#pragma once

#include "SurfaceMesh.h"
#include "Triangle.h"
#include "Types.h"

#include <array>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

struct RTCDeviceTy;
struct RTCSceneTy;

namespace smokevis
{

/// A straight line between two points.
struct LineOfSight
{
  Vec3 From, To;
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

/// What lies on a ray between two distances [m]; nothing where it ends before it begins.
struct RayPiece
{
  Vec3 Origin, Direction;
  double Begin, End;
};

/// All straight lines between a plane plate and a box, or a convex part of one.
struct Shaft
{
  std::array<Vec3, 4> Plate;
  /// To where the box lies.
  Vec3 Normal;
  Box Before;
  /// Corners of the part of the box; none: all of it.
  std::vector<Vec3> Part = {};
};

/// The units of single precision: the same numbers, to their last digit but for rounding in double
/// precision, in whatever unit of length a scene comes, so that lines that meet an edge meet it in
/// all. It is finest at the scene's centre.
class SinglePrecision
{
public:
  SinglePrecision() = default;
  /// @param size of the scene [m]
  SinglePrecision(const Vec3& centre, double size) : Centre_(centre), Size_(size > 0.0 ? size : 1.0)
  {
  }

  Vec3 Place(const Vec3& metres) const { return (metres - this->Centre_) / this->Size_; }
  Vec3 PlaceOf(const Vec3& units) const { return this->Centre_ + this->Size_ * units; }
  double Length(double metres) const { return metres / this->Size_; }
  double Metres(double length) const { return length * this->Size_; }

private:
  Vec3 Centre_{0.0};
  double Size_ = 1.0;
};

/// Triangles in double precision with their search structure, which works in single precision.
class TriangleTree
{
public:
  using Device = std::shared_ptr<RTCDeviceTy>;
  static Device NewDevice();

  /// None: nothing is hit.
  TriangleTree() = default;
  /// Exact duplicates and triangles without area are left out.
  /// @param emitters whether these are plates of signs and lamps
  /// @param tolerance to which single precision knows distances in the scene, about [m]
  TriangleTree(const Device& device, const SurfaceMesh& mesh, bool emitters,
    const SinglePrecision& units, double tolerance);

  bool Empty() const { return !this->Tree_; }
  /// Triangles that are there to be hit, as indices into their mesh.
  const std::vector<std::size_t>& Triangles() const { return this->Triangles_; }
  /// The cell that a triangle belongs to.
  std::uint32_t Cell(std::uint32_t triangle) const { return this->Cells_[triangle]; }
  /// Unit normal of a triangle's front.
  const Vec3& Normal(std::uint32_t triangle) const { return this->Normals_[triangle]; }

  /// First triangle met between two distances [m].
  Hit Intersect(const Vec3& origin, const Vec3& direction, double begin, double end) const;
  /// All triangles that a line meets, nearest first; `hits` is overwritten.
  void IntersectAll(const Vec3& origin, const Vec3& direction, double begin, double end,
    std::vector<Hit>& hits) const;
  /// Whether any triangle lies between two distances.
  bool Occluded(const Vec3& origin, const Vec3& direction, double begin, double end) const;
  /// Which pieces of rays no triangle lies on; those beside one another cost a fraction of pieces
  /// asked for one by one.
  /// @param trees of one scene, with the same units, at least one
  static std::vector<bool> Clear(
    std::initializer_list<const TriangleTree*> trees, std::span<const RayPiece> pieces);
  /// Whether something holds for all triangles near to a place, which it is told with their corners
  /// to single precision. After the first for which it does not, no more are asked.
  /// @param radius around the place within which triangles are near; some beyond are asked, too [m]
  bool AllNear(
    const Vec3& place, double radius, const std::function<bool(const Triangle&)>& holds) const;

private:
  /// A hit at a distance that is known to single precision.
  Hit MakeHit(const Vec3& origin, const Vec3& direction, double begin, double end,
    std::uint32_t triangle, double rough) const;

  std::shared_ptr<RTCSceneTy> Tree_;
  /// Embree's own: three of each point and triangle.
  const float* Vertices_ = nullptr;
  const unsigned* Indices_ = nullptr;
  std::vector<std::size_t> Triangles_;
  std::vector<Vec3> Corners_, Normals_;
  std::vector<std::uint32_t> Cells_;
  SinglePrecision Units_;
  double Tolerance_ = 0.0;
  bool Emitters_ = false;
};

/// Where a straight line passes through a shape, as seen from both sides.
struct Crossing
{
  /// What the line meets coming from its beginning.
  Hit Arrive;
  /// What it would meet here coming from its end: the same triangle's other side, or the other of
  /// two shapes that touch, such as a plate on a wall.
  Hit Leave;
  /// Whether more than one triangle lies here.
  bool Several = false;
};

/// All opaque shapes of a scene: surfaces and the plates of the emitters. A plate that lies in a
/// surface, or behind it by less than Tolerance(), wins over the surface when seen from its front.
class Geometry
{
public:
  /// None.
  Geometry() = default;
  /// Builds the search structures. Exact duplicates and triangles without area are left out.
  /// @param sceneSize diagonal of all that rays come from, smoke included [m]; at least that of the
  /// shapes is taken
  /// @param coreSize diagonal of the part that matters, such as the smoke [m]; 0: all does
  Geometry(const SurfaceMesh& surfaces, const SurfaceMesh& emitters, double sceneSize = 0.0,
    double coreSize = 0.0);

  /// Body of a surface triangle that belongs to no solid.
  static constexpr std::uint32_t NoBody = std::numeric_limits<std::uint32_t>::max();
  /// Lets lines tell what they meet where faces of several bodies lie in one another: within a
  /// solid, its own back.
  /// @param bodies of the surface triangles, as Bodies tells them
  void TellBodies(std::vector<std::uint32_t> bodies) { this->Bodies_ = std::move(bodies); }

  bool Empty() const { return this->Surfaces_.Empty() && this->Emitters_.Empty(); }
  /// Distance within which two shapes count as touching [m].
  double Tolerance() const { return this->Tolerance_; }
  /// How closely single precision knows places; 0 where there are no shapes [m].
  double Rounding() const { return this->Rounding_; }
  /// Triangles that are there to be hit, as indices into their mesh; Hit::Triangle is a place in
  /// this list.
  const std::vector<std::size_t>& SurfaceTriangles() const { return this->Surfaces_.Triangles(); }
  const std::vector<std::size_t>& EmitterTriangles() const { return this->Emitters_.Triangles(); }
  /// The cell of a surface triangle or of an emitter triangle.
  std::uint32_t Cell(const Hit& hit) const { return this->TreeOf(hit).Cell(hit.Triangle); }
  /// Unit normal of the front of the triangle that was hit.
  const Vec3& Normal(const Hit& hit) const { return this->TreeOf(hit).Normal(hit.Triangle); }

  /// First shape met between two distances [m].
  Hit Intersect(const Vec3& origin, const Vec3& direction, double begin, double end) const;
  /// All shapes that a line meets between two distances, in order; `crossings` is overwritten.
  void Cross(const Vec3& origin, const Vec3& direction, double begin, double end,
    std::vector<Crossing>& crossings) const;
  /// All triangles of surfaces that a line meets between two distances, also those that lie in one
  /// another, nearest first; `hits` is overwritten.
  void SurfacesAlong(const Vec3& origin, const Vec3& direction, double begin, double end,
    std::vector<Hit>& hits) const
  {
    this->Surfaces_.IntersectAll(origin, direction, begin, end, hits);
  }
  /// Triangles of surfaces that lie near to a place, and some beyond, to single precision.
  std::vector<Triangle> SurfacesNear(const Vec3& place, double radius) const;
  /// Whether anything opaque lies between two distances.
  bool Occluded(const Vec3& origin, const Vec3& direction, double begin, double end) const;
  /// Whether the straight line between two points is clear but for what touches its ends.
  bool Visible(const Vec3& from, const Vec3& to) const;
  /// The same of each of many lines; those beside one another cost a fraction of lines asked for
  /// one by one.
  std::vector<bool> Visible(std::span<const LineOfSight> lines) const;
  /// Whether all lines of a shaft are clear, but for what touches the plate. False where that is
  /// not told quickly: where shapes are near, or the box does not lie before the plate.
  bool Free(const Shaft& shaft) const;
  /// Whether rays into these directions, unit vectors, meet backs of surfaces alone, as they do
  /// within a solid. Plates tell nothing.
  bool SeesBacks(const Vec3& point, std::span<const Vec3> directions) const;

private:
  const TriangleTree& TreeOf(const Hit& hit) const
  {
    return hit.Emitter ? this->Emitters_ : this->Surfaces_;
  }
  /// The straight line between two points without the ends that shapes may touch: it ends before it
  /// begins where the points lie so close together that nothing is left.
  RayPiece Between(const Vec3& from, const Vec3& to) const;
  /// Whether a plate that was hit lies in the surface that was hit, to within the tolerance.
  bool Touch(const Hit& surface, const Hit& plate, const Vec3& direction) const;
  /// Of the surfaces that a line meets within a gap, the first of the model of those that lie in
  /// the nearest one, or in the farthest, whichever way rounding falls.
  Hit FirstOfModel(std::vector<Hit>::const_iterator nearest, std::vector<Hit>::const_iterator end,
    double gap, bool farthest) const;
  /// The surface and the plate that a ray meets first; a plate farther than the surface is only
  /// looked for as deep as it can still touch it.
  void IntersectBoth(const Vec3& origin, const Vec3& direction, double begin, double end,
    Hit& surface, Hit& plate) const;

  /// Where several surfaces lie in one another, a line that leads through a solid meets the back of
  /// that.
  void PreferOwnBacks(const std::vector<Hit>& surfaces, std::vector<Crossing>& crossings) const;

  TriangleTree Surfaces_, Emitters_;
  std::vector<std::uint32_t> Bodies_;
  double Tolerance_ = 0.0;
  double Rounding_ = 0.0;
};

} // namespace smokevis
