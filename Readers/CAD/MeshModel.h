// Reads formats that hold meshes (OBJ, STL, PLY, glTF, COLLADA, FBX, 3DS, DXF) and IFC.
#pragma once

#include "CadFormat.h"
#include "CadModel.h"
#include "Progress.h"

#include <string>

namespace smokevis
{

/// Adds what a file holds to `model`. Points come in units and axes of the file. Throws Error for a
/// file that is broken.
void ReadMeshModel(const std::string& fileName, const CadFormat& format, const CadOptions& options,
  Progress& progress, CadModel& model);

} // namespace smokevis
