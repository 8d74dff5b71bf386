// Cuts surfaces into patches small enough that each has one illuminance.
#pragma once

#include "SceneBlocks.h"

namespace smokevis
{

/// Most patches that a scene may be cut into.
inline constexpr std::int64_t MaximumPatches = 100000000;

/// Polydata of convex polygons without any edge longer than `patchSize` [m]. Convex quads become
/// quads, triangles are halved across their longest edge, other polygons are triangulated. The cell
/// data go with the pieces, and `ParentCell` (vtkIdType) is the input cell of each. Points, lines
/// and hidden cells are left out. Throws Error for points that are not finite and for more than
/// MaximumPatches patches.
/// @param patchSize infinity: polygons are only made convex
vtkSmartPointer<vtkPolyData> RefineSurface(
  vtkPolyData* input, const std::string& name, double patchSize);

/// Corners of the triangles that cover a polygon, as positions in `corners`; works for polygons
/// that are not convex. `points` are the polygon's points in order.
std::vector<std::array<int, 3>> TriangulatePolygon(
  const std::vector<std::array<double, 3>>& points);

} // namespace smokevis
