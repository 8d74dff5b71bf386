// The smoke of many meshes as one image of even cells, which volume mappers draw right: without
// seams, and none of it twice where meshes overlap.
#pragma once

#include "DrawnMeshes.h"

#include <array>
#include <vector>

namespace smokevis
{

/// Where the image's cells are.
struct Lattice
{
  /// Lowest corner [m].
  std::array<double, 3> Origin = {};
  /// Size of a cell [m].
  std::array<double, 3> Spacing = {};
  /// None where there is no smoke.
  std::array<int, 3> Cells = {};

  bool Empty() const { return this->Cells[0] == 0; }
  int LongestAxis() const;
};

/// A lattice over all meshes with smoke. Along each axis its cells are as large as those of the
/// finest mesh, so that meshes whose cells fit into each other keep their values; larger where it
/// would have too many.
/// @param most how many cells at most, more than 0
/// @param layers how many cells at least along the longest axis
Lattice LatticeOver(const std::vector<DrawnMesh>& meshes, double most, int layers);

/// Mean extinction of the image's cells in a block of the lattice, x fastest [1/m]. Where meshes
/// overlap the one with the smaller cells counts, and outside all meshes there is no smoke.
/// @param first lowest cell of the block along each axis
/// @param end cell behind its highest
std::vector<float> SampleSmoke(const std::vector<DrawnMesh>& meshes, const Lattice& lattice,
  const std::array<int, 3>& first, const std::array<int, 3>& end);

} // namespace smokevis
