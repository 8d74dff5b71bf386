// The leaves that a light's tree is made of.
#pragma once

#include "Emitters.h"
#include "Plane.h"

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace smokevis
{

/// A quadrilateral that emits evenly (a triangle repeats its last corner).
LightGroup MakeLeaf(const Spectrum& luminance, int signId, const Vec3& normal,
  const EmissionLaw& law, const std::array<Vec3, 4>& corners);

/// A polygon's leaves; corners in one line span nothing and make none.
void AddLeaves(const EmitterCell& cell, const Vec3& normal, const EmissionLaw& law, double area,
  std::vector<LightGroup>& leaves);

/// Corners of the rectangle around leaves, in the plane through a point, along the first leaf's
/// first edge.
std::array<Vec3, 4> RectangleAround(std::span<const LightGroup> leaves, const Vec3& through);

/// Divides leaves of one plane by other planes, until there are none.
/// @param find the plane that divides a group, which so many have divided before; none: it stays
std::vector<std::vector<LightGroup>> DivideLeaves(std::vector<LightGroup> leaves,
  const std::function<std::optional<Plane>(const std::vector<LightGroup>&, int)>& find);

/// Sorts leaves of one plane into groups of neighbours, as large as the rectangle around each does
/// for what is worked out of a light: it is taken for that.
/// @param does whether it does for a group; that of one leaf does always
std::vector<std::vector<LightGroup>> GroupLeaves(
  std::vector<LightGroup> leaves, const std::function<bool(const std::vector<LightGroup>&)>& does);

/// The same so that each group fills a quarter at least of the rectangle around it.
std::vector<std::vector<LightGroup>> FilledParts(std::vector<LightGroup> leaves);

/// Leaves of one plane that are lit; of more than twenty, if nothing crosses them, a lattice of
/// rectangles that send out what they do, finer where the board ends: light must not come from
/// beside it.
/// @param leaves of all of the board, lit and dark
std::vector<LightGroup> Simplified(std::vector<LightGroup> leaves);

} // namespace smokevis
