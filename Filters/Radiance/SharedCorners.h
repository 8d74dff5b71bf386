// Shapes that hang together because corners of theirs lie in one place.
#pragma once

#include "Types.h"

#include <array>
#include <compare>
#include <cstdint>
#include <vector>

#include <boost/pending/disjoint_sets.hpp>

namespace smokevis
{

/// A shape's corner, in a grid whose mesh is the distance within which corners are one.
struct SharedCorner
{
  /// Only shapes of one kind hang together.
  std::uint32_t Kind;
  std::array<std::int64_t, 3> Place;
  /// Of the shape.
  std::uint32_t Shape;

  auto operator<=>(const SharedCorner&) const = default;
};

/// @param sceneSize its diagonal [m]: corners may lie a share of that apart, since patches that cut
/// up two walls are rounded in each wall by itself
SharedCorner MakeSharedCorner(
  std::uint32_t kind, const Vec3& place, std::uint32_t shape, double sceneSize);

/// Puts the shapes that corners of one kind in one place belong to into one set.
/// @param corners are sorted
void UniteAtCorners(
  std::vector<SharedCorner>& corners, boost::disjoint_sets_with_storage<>& shapes);

} // namespace smokevis
