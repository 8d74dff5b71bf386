// Makes the inputs of a light field one scene, cut into the patches that it is solved on.
#pragma once

#include "SceneBlocks.h"

#include <cstddef>

class vtkInformationVector;

namespace smokevis
{

/// The surfaces of all connections of an input port.
/// @param name what to call blocks that have no name of their own
std::vector<SurfaceBlock> CollectPort(vtkInformationVector* port, const std::string& name);

/// Diagonal of the box around everything [m].
double Diagonal(const SceneBlocks& blocks);

/// Gives surfaces that bring no `Reflectance` a diffuse one.
void AddDefaultReflectance(const std::vector<SurfaceBlock>& blocks, double reflectance);

/// Cuts surfaces into patches with edges of at most `patchSize` [m] and emitters into convex
/// polygons, drops the blocks of which nothing is left, and gives all blocks the same number of
/// bands. Returns the number of patches of surfaces.
std::size_t CutIntoPatches(SceneBlocks& blocks, double patchSize);

/// Whether smoke gives light of its own, such as flames.
bool SmokeEmits(const SceneBlocks& blocks);

/// Throws Error where the light field of so many bands takes more memory than is free.
void RequireMemoryForLight(const SceneBlocks& blocks, int bands);

} // namespace smokevis
