// Turns a CAD model into the surfaces and emitters of a scene.
#pragma once

#include "CadModel.h"
#include "MaterialTable.h"

#include <cstddef>

class vtkMatrix4x4;
class vtkPolyData;

namespace smokevis
{

struct CadPolyDataOptions
{
  /// Reflectance of materials without a colour, 0 to 1.
  double DefaultReflectance = 0.5;
  /// Materials of less opacity are left out, 0 to 1.
  double TransparencyThreshold = 0.5;
};

/// What became of a model's triangles.
struct CadTriangleCounts
{
  std::size_t Kept = 0;
  std::size_t Transparent = 0;
  std::size_t Dropped = 0;
};

/// Fills `surfaces` and `emitters` with the arrays and field data that vtkCADReader documents.
/// @param table what the analyst says of materials and objects
/// @param placement a rotation and a shift [m]
CadTriangleCounts BuildCadPolyData(const CadModel& model, const MaterialTable& table,
  const CadPolyDataOptions& options, const vtkMatrix4x4& placement, vtkPolyData& surfaces,
  vtkPolyData& emitters);

} // namespace smokevis
