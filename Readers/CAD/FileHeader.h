// What the heads of mesh files say of units and axes, where the mesh library keeps it to itself.
#pragma once

#include "CadModel.h"

#include <string>

namespace smokevis
{

/// Unit and up axis that a file states; UnitScale 0 and Automatic where it does not.
struct FileHeader
{
  double UnitScale = 0.0;
  UpAxis Up = UpAxis::Automatic;
};

/// From `<asset>` of a COLLADA file.
FileHeader ReadColladaHeader(const std::string& fileName);

/// From $INSUNITS in the header of a DXF file.
FileHeader ReadDxfHeader(const std::string& fileName);

/// From the unit assignment of an IFC file, as far as it is a plain SI unit of length.
FileHeader ReadIfcHeader(const std::string& fileName);

} // namespace smokevis
