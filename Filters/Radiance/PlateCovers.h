// Parts of surfaces that plates lie on.
#pragma once

#include "Box.h"
#include "Triangle.h"

#include <array>
#include <vector>

namespace smokevis
{

class Geometry;
struct SurfaceMesh;

/// What signs and lamps in the plane of a wall, or off it by less than the geometry's tolerance,
/// hide of it: the light of others that comes there arrives at the plate, not at the wall.
class PlateCovers
{
public:
  /// @param emitters mesh of the plates
  PlateCovers(const Geometry& shapes, const SurfaceMesh& emitters);

  /// What is covered of the two sides of a surface's triangle, in triangles; where plates overlap,
  /// twice.
  std::array<std::vector<Triangle>, 2> On(const Triangle& corners) const;

private:
  struct Plate
  {
    Triangle Corners;
    /// Unit vector to where it sends light.
    Vec3 Normal;
    Box Bounds;
  };
  /// Plates that follow each other, and so mostly belong to one sign.
  struct Group
  {
    Box Bounds = Box::Nothing();
    std::vector<Plate> Plates;
  };

  double Tolerance_;
  std::vector<Group> Groups_;
};

} // namespace smokevis
