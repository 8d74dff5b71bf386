// Finds the cells of the smoke that walls cut, and parts them.
#pragma once

#include "CellParts.h"

namespace smokevis
{

class Scene;

/// The parts of the cells with smoke that surfaces and plates cut in two or more. A cell is cut
/// along the planes of the triangles in it, largest first, and what light passes between freely is
/// one part. Walls in the faces between cells cut nothing.
CellParts FindCellParts(const Scene& scene);

} // namespace smokevis
