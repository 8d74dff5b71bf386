// The meshes of smoke that a picture shows, from any VTK data and from all processes.
#pragma once

#include <array>
#include <vector>

class vtkDataObject;
class vtkMultiProcessController;

namespace smokevis
{

/// An axis-aligned mesh. What is no grid with smoke is here with its bounds alone.
struct DrawnMesh
{
  /// Coordinates along each axis, growing [m].
  std::array<std::vector<double>, 3> Nodes;
  /// Of the cells, x fastest [1/m]; empty where there is no smoke.
  std::vector<float> Extinction;

  int Cells(int axis) const { return static_cast<int>(this->Nodes[axis].size()) - 1; }
  double Length(int axis) const { return this->Nodes[axis].back() - this->Nodes[axis].front(); }
  /// Mean volume of a cell [m3].
  double CellVolume() const;
};

/// The data sets in an object. Smoke is an image or rectilinear grid, not turned, with the array
/// Extinction on its cells, or on its points, of which a cell then gets the mean. Negative values,
/// those that are no numbers, and hidden cells count as clear.
std::vector<DrawnMesh> CollectMeshes(vtkDataObject* object);

/// The meshes of all processes, in the same order on each.
std::vector<DrawnMesh> ShareMeshes(
  const std::vector<DrawnMesh>& own, vtkMultiProcessController* controller);

} // namespace smokevis
