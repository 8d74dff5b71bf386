// What a PLY file announces against what it holds: the mesh library believes it blindly.
#pragma once

#include <string>

namespace smokevis
{

/// Throws Error where the header of a PLY file is malformed, which names the line, or the file ends
/// before the last of the elements that it announces. Returns whether it is a text file.
bool CheckPlyFile(const std::string& fileName);

} // namespace smokevis
