// The lists of indices in a COLLADA file, in which the mesh library reads on for ever where one is
// no number.
#pragma once

#include <string>

namespace smokevis
{

/// Throws Error that names file and line where a list of indices or counts in a COLLADA file holds
/// anything but whole numbers.
void CheckColladaNumbers(const std::string& fileName);

} // namespace smokevis
