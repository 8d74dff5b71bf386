// Which cells of a mesh are solid at a time.
#pragma once

#include "SmvFile.h"

#include <vector>

namespace smokevis
{

/// How opaque an obstruction is, 0 to 1: of its own colour's alpha, else the largest alpha of its
/// surfaces; 0 for one hidden in Smokeview.
double Opacity(const SmvFile& index, const SmvObstruction& obstruction);

/// The obstructions of @p mesh that are there at @p time [s] and whose opacity is at least
/// @p leastOpacity, as positions in SmvMesh::Obstructions.
std::vector<int> PresentObstructions(
  const SmvFile& index, int mesh, double time, double leastOpacity);

/// One byte a cell of @p mesh, x fastest: 1 inside one of @p obstructions. Empty when none of them
/// has a volume.
std::vector<unsigned char> SolidCells(const SmvMesh& mesh, const std::vector<int>& obstructions);

} // namespace smokevis
