// Triangles and rays against them. The one place that knows Embree.
#pragma once

#include "SurfaceMesh.h"
#include "Types.h"

#include <cstdint>
#include <initializer_list>
#include <limits>
#include <memory>
#include <span>
#include <vector>

struct RTCDeviceTy;
struct RTCSceneTy;

namespace smokevis
{

/// Where a ray meets a shape.
struct Hit
{
  /// Distance along the ray [m]; infinity: nothing was hit.
  double Distance = std::numeric_limits<double>::infinity();
  /// Its place in the tree.
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
  /// @param centre of the scene: where single precision is finest
  /// @param tolerance to which single precision knows distances in the scene, about [m]
  TriangleTree(const Device& device, const SurfaceMesh& mesh, bool emitters, const Vec3& centre,
    double tolerance);

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
  /// @param trees of one scene, with the same centre, at least one
  static std::vector<bool> Clear(
    std::initializer_list<const TriangleTree*> trees, std::span<const RayPiece> pieces);

private:
  /// A hit at a distance that is known to single precision.
  Hit MakeHit(const Vec3& origin, const Vec3& direction, double begin, double end,
    std::uint32_t triangle, double rough) const;

  std::shared_ptr<RTCSceneTy> Tree_;
  std::vector<std::size_t> Triangles_;
  std::vector<Vec3> Corners_, Normals_;
  std::vector<std::uint32_t> Cells_;
  Vec3 Centre_{0.0};
  double Tolerance_ = 0.0;
  bool Emitters_ = false;
};

} // namespace smokevis
