// Where what hides a plate begins on it.
#pragma once

#include "Types.h"

#include <array>
#include <functional>
#include <vector>

namespace smokevis
{

/// Ends of blocks along both edges of a plate, from 0 to 1.
using PlateBorders = std::array<std::vector<double>, 2>;

/// What there is at a place of a plate's rectangle.
enum class PlateSight
{
  Nothing,
  Hidden,
  Seen
};
using PlateLook = std::function<PlateSight(const glm::dvec2&)>;

/// Looks at a plate's corners and at places all over it, one in each column and each row of a
/// raster of 128 x 128, so that no gap or bar along an edge of the plate is missed that is as wide
/// as one of them. Returns a few of the places that differ from most.
std::vector<glm::dvec2> OddPlaces(const PlateLook& look);

/// Halves blocks, again and again, where the plate is seen in the middle of one and hidden in the
/// middle of the next or at the plate's end, to a five hundredth of the plate or until there are
/// very many.
/// @param odd places that get blocks of their own first
void HalveAtEdges(PlateBorders& borders, const std::vector<glm::dvec2>& odd, const PlateLook& look);

/// Share of each block that is seen of what there is of the plate, row after row.
std::vector<double> SeenShares(const PlateBorders& borders, const PlateLook& look);

/// The block before the halving that each one lies in, along one edge.
std::vector<std::size_t> BlocksBefore(
  const std::vector<double>& before, const std::vector<double>& halved);

} // namespace smokevis
