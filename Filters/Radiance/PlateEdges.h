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

/// Halves blocks, again and again, where the plate shows in the middle of one and not in the middle
/// of the next or at the plate's end, to a five hundredth of the plate or until there are very
/// many.
/// @param shows whether a place on the plate does
void HalveAtEdges(PlateBorders& borders, const std::function<bool(const glm::dvec2&)>& shows);

/// The block before the halving that each one lies in, along one edge.
std::vector<std::size_t> BlocksBefore(
  const std::vector<double>& before, const std::vector<double>& halved);

} // namespace smokevis
