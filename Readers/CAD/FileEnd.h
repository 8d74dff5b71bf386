// Whether a CAD file is all there: libraries read the rest of a file cut short as a smaller model.
#pragma once

#include <string>
#include <string_view>

namespace smokevis
{

/// Throws Error where a file lacks what its format ends with: the end mark of STEP, IFC, IGES, DXF,
/// COLLADA, text STL and glTF, the sections of text FBX, and the lengths that binary STL, GLB, FBX
/// and 3DS announce. OBJ has nothing of the kind; PLY is checked by CheckPlyFile().
/// @param format name as in CadFormats()
void CheckFileEnd(const std::string& fileName, std::string_view format);

/// Whether a file stops within a line. Programs end the last line, too, so that it may be cut
/// short.
bool EndsInsideLine(const std::string& fileName);

} // namespace smokevis
