// Reads a building's geometry from any CAD file.
#pragma once

#include "CadModel.h"
#include "Progress.h"

#include <string>

namespace smokevis
{

/// The model in a file, in metres and with z up. Throws Error for a file that is missing, broken,
/// of an unknown format or without surfaces, and when `progress` asked to stop.
CadModel ReadCadFile(const std::string& fileName, const CadOptions& options, Progress& progress);

} // namespace smokevis
