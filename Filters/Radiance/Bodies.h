// Surfaces that hang together.
#pragma once

#include "Types.h"

#include <cstdint>
#include <optional>
#include <vector>

#include <tbb/collaborative_call_once.h>

namespace smokevis
{

class Geometry;
struct SurfaceMesh;

/// Bodies that the surfaces of a scene form: triangles that share corners, or whose corners lie in
/// the same places, belong to one. What a light lies in is a room, no solid.
class Bodies
{
public:
  /// All must outlive it; bodies are found when they are first asked for.
  Bodies(const Geometry& shapes, const SurfaceMesh& surfaces, const SurfaceMesh& emitters)
      : Shapes_(shapes), Surfaces_(surfaces), Emitters_(emitters)
  {
  }

  /// Whether a place in a triangle, on the side that `normal` points away from, lies within a
  /// closed solid that stands there with a face of its own: the back of a triangle faces that way,
  /// and all rays leave the body that it belongs to where they meet that first.
  /// @param normal unit vector
  /// @param inside a surface triangle there whose back faces that way itself: the body that it
  /// belongs to does not count, since it does not stand on itself
  bool Enclose(const Vec3& place, const Vec3& normal,
    const std::optional<std::uint32_t>& inside = std::nullopt) const;
  /// The body of each of the geometry's surface triangles, or Geometry::NoBody.
  const std::vector<std::uint32_t>& OfTriangles() const;

private:
  std::vector<std::uint32_t> Find() const;
  /// Whether a ray leaves a body where it meets that first.
  bool Leaves(const Vec3& origin, const Vec3& direction, std::uint32_t body) const;

  const Geometry& Shapes_;
  const SurfaceMesh& Surfaces_;
  const SurfaceMesh& Emitters_;
  mutable tbb::collaborative_once_flag Found_;
  mutable std::vector<std::uint32_t> OfTriangles_;
};

} // namespace smokevis
