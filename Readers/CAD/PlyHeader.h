// The header of a PLY file, which the mesh library believes blindly.
#pragma once

#include <string>

namespace smokevis
{

/// Throws Error that names file and line where the header of a PLY file is malformed or claims more
/// elements than the file can hold.
void CheckPlyHeader(const std::string& fileName);

} // namespace smokevis
