// Where surfaces go through the plates of lights, or stand on them.
#pragma once

#include "Emitters.h"
#include "Plane.h"

#include <optional>
#include <span>
#include <vector>

namespace smokevis
{

class Geometry;

/// Divides lights so that a wall that goes through one hides all of a part, or nothing of it, but
/// for ways past the wall's own edges.
class SurfaceCuts
{
public:
  /// @param shapes must outlive this
  explicit SurfaceCuts(const Geometry& shapes) : Shapes_(shapes) {}

  /// Leaves of one plane, in groups on either side of the surfaces that cross them.
  std::vector<std::vector<LightGroup>> Divide(std::vector<LightGroup> leaves) const;

private:
  /// Across the line on which surfaces cross most of the rectangle around leaves; none where they
  /// cover little of any line, or none has enough of what has these corners on either side.
  std::optional<Plane> Longest(
    const std::vector<LightGroup>& leaves, std::span<const Vec3> corners) const;

  const Geometry& Shapes_;
};

} // namespace smokevis
