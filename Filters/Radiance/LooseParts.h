// Places between which light goes to and fro, in parts that little of it passes between.
#pragma once

#include <cstddef>
#include <vector>

namespace smokevis
{

/// Parts places as a door parts two rooms: where the second eigenvector of the random walk between
/// them changes its sign, for as long as it lives long (spectral bisection; Fiedler 1973).
/// @param members places that hang together
/// @param reached places that some rays from each place came to; of members only members
/// @param areas of the places, which weigh them
std::vector<std::vector<std::size_t>> LooseParts(std::vector<std::size_t> members,
  const std::vector<std::vector<std::size_t>>& reached, const std::vector<double>& areas);

} // namespace smokevis
