// Routes as VTK data: polylines, points in order, or tables.
#pragma once

#include "Types.h"

#include <vector>

class vtkDataObject;

namespace smokevis
{

/// The corners of a route on the floor [m], and when they are reached [s]; no times where the data
/// have none.
struct RouteCorners
{
  std::vector<Vec3> Corners;
  std::vector<double> Times;
};

/// The routes of a data object. Polydata: a route a line, or one of all points where there are no
/// lines; times are the point array `Time`. A table: columns `x`, `y`, optional `z` (0), `time` or
/// `t`, and `route`, `person` or `id`, which tells the routes apart. Capital letters do not matter.
/// Throws Error where there is no route of at least two corners.
std::vector<RouteCorners> ReadRoutes(vtkDataObject* input);

} // namespace smokevis
