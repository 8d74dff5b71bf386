// Triangulated surface cells, and which of their triangles are of use.
#pragma once

#include "Types.h"

#include <vector>

namespace smokevis
{

/// Triangulated surface cells.
struct SurfaceMesh
{
  std::vector<Vec3> Points;
  /// Corners of each triangle; the front is the right-hand side.
  std::vector<std::array<std::uint32_t, 3>> Triangles;
  /// The cell that each triangle belongs to.
  std::vector<std::uint32_t> TriangleCell;
  /// Diffuse reflectance of each cell, both sides, 0 to 1 a band.
  std::vector<Spectrum> CellReflectance;

  bool operator==(const SurfaceMesh&) const = default;
};

/// Indices of the triangles that have an area and are not repeated, in their order; refuses corners
/// without finite coordinates.
std::vector<std::size_t> UsefulTriangles(const SurfaceMesh& mesh);

} // namespace smokevis
