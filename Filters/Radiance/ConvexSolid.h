// Convex solids that are cut by planes, and their measures.
#pragma once

#include "Box.h"
#include "Plane.h"
#include "Types.h"

#include <utility>
#include <vector>

namespace smokevis
{

/// A convex solid, known by the polygons that bound it.
class ConvexSolid
{
public:
  ConvexSolid() = default;
  explicit ConvexSolid(const Box& box);

  /// The parts in front of a plane and behind it. One of them is empty where the plane does not
  /// meet the solid.
  std::pair<ConvexSolid, ConvexSolid> Cut(const Plane& plane) const;

  bool Empty() const { return this->Faces_.size() < 4; }
  double Volume() const;
  /// Centre of mass.
  Vec3 Centre() const;
  Box Bounds() const;
  /// Its corners, each as often as faces have it.
  std::vector<Vec3> Corners() const;

private:
  /// Adds a corner of the cut, unless it is there.
  static void AddCorner(std::vector<Vec3>& corners, const Vec3& corner, double tolerance);
  /// Calls visit(volume, centre) for the tetrahedra between the faces and a point inside.
  template <class Visit> void ForEachTetrahedron(Visit&& visit) const;

  std::vector<std::vector<Vec3>> Faces_;
};

} // namespace smokevis
