// Figures of straight edges on a plate, and the cells that figure and ground are cut into.
#pragma once

#include <glm/glm.hpp>

#include <vector>

namespace smokevis
{

/// Corners in order, either way round; a simple polygon.
using FigurePolygon = std::vector<glm::dvec2>;

/// A convex cell, counter-clockwise, of three or four corners.
struct FigureCell
{
  FigurePolygon Corners;
  /// Part of the figure, not of the ground.
  bool Figure = false;
  /// The row of the plate that it lies in.
  std::size_t Row = 0;
};

/// Cuts a plate of width x height, centred on 0, along the borders of a figure, the union of
/// polygons; what reaches beyond the plate is left out. The cells cover the plate without overlap.
/// @param rows equal rows that no cell crosses, at least 1
std::vector<FigureCell> CutFigure(
  const std::vector<FigurePolygon>& figure, double width, double height, std::size_t rows);

/// The outline of a line of some thickness through points, with square ends and mitred corners, as
/// a polygon a segment. A line whose last point is its first is closed.
std::vector<FigurePolygon> Stroke(const std::vector<glm::dvec2>& points, double thickness);

} // namespace smokevis
