// Reads solids and faces with curved surfaces, STEP and IGES, and tessellates them.
#pragma once

#include "CadModel.h"
#include "Progress.h"

#include <string>

namespace smokevis
{

/// Adds what a STEP or IGES file holds to `model`, whose Format says which of them it is. Points
/// come in units and axes of the file. Throws Error for a file that is broken.
void ReadBRepModel(
  const std::string& fileName, const CadOptions& options, Progress& progress, CadModel& model);

} // namespace smokevis
