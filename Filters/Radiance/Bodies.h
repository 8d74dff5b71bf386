// Surfaces that hang together.
#pragma once

#include "Types.h"

#include <cstdint>
#include <vector>

#include <tbb/collaborative_call_once.h>

namespace smokevis
{

class Geometry;
struct SurfaceMesh;

/// Bodies that the surfaces of a scene form: triangles that share corners, or whose corners lie in
/// the same places, belong to one.
class Bodies
{
public:
  /// Both must outlive it; bodies are found when they are first asked for.
  Bodies(const Geometry& shapes, const SurfaceMesh& surfaces) : Shapes_(shapes), Surfaces_(surfaces)
  {
  }

  /// Whether a place in a triangle, on the side that `normal` points away from, lies within a
  /// closed solid that stands there with a face of its own: the back of another triangle faces that
  /// way, and all around backs of the body that it belongs to are met first.
  /// @param normal unit vector
  bool Enclose(const Vec3& place, const Vec3& normal) const;
  /// The body of each of the geometry's surface triangles.
  const std::vector<std::uint32_t>& OfTriangles() const;

private:
  /// Whether the first that a ray meets, or what touches that, is the back of a body.
  bool MeetsBack(const Vec3& origin, const Vec3& direction, std::uint32_t body) const;

  const Geometry& Shapes_;
  const SurfaceMesh& Surfaces_;
  mutable tbb::collaborative_once_flag Found_;
  mutable std::vector<std::uint32_t> OfTriangles_;
};

} // namespace smokevis
