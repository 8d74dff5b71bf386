// The light field as cell arrays of VTK data: what SmokeLightField writes and the views read.
#pragma once

#include "LightField.h"
#include "SceneBlocks.h"

class vtkDataArray;

namespace smokevis
{

/// Adds the light field to the blocks that it was solved for. Where the field was solved in one
/// band for a scene of three equal bands, the band is repeated. Memory of the field is given back
/// on the way.
///
/// Smoke cells: `Fluence`, `FluenceError` [lx] a band, `DirectFluence` a band, and
/// `MultipleFluence` with a value a batch, band after band. Surface and emitter cells:
/// `Illuminance`, `IlluminanceError`, `IlluminanceBack` [lx] a band, `DirectIlluminance` with front
/// and back of each band, and `MultipleIlluminance` with the batches of the front, then of the
/// back, band after band. Emitter cells also: `MultipleIlluminanceGradient` [1/m], the
/// gradient of that over the front, over its mean, a vector a band.
///
/// A cell that walls cut is in parts, each with a light of its own: its `DirectFluence` and
/// `MultipleFluence` are those of its first part, `Fluence` is the mean over the cell. The other
/// parts' are in the field data of the smoke block, `PartDirectFluence` and `PartMultipleFluence`.
///
/// Of a block that was refined all four are means over its cells. Its field data hold the number of
/// parts of each interval between nodes along x, then y, then z, `Refinement`, and the light of the
/// finer cells, x fastest, `RefinedDirectFluence` and `RefinedMultipleFluence`.
/// @param smoke  of the scene that was solved
void StoreLightField(LightField&& field, const Medium& smoke, const SceneBlocks& blocks, int bands);

/// The arrays that LoadLightField reads, in a fixed order, null where one is missing that every
/// light field has.
std::vector<vtkDataArray*> LightArrays(const SceneBlocks& blocks);

/// Gives blocks the light field of others; the arrays are shared. Returns false, and does nothing,
/// where the blocks have other numbers of cells or were refined in another way.
bool ShareLightField(const SceneBlocks& from, const SceneBlocks& to);

/// Reads the light field back. Throws Error where an array is missing or has another size.
/// @param smoke  of the scene that the blocks describe
/// @param bands  bands to read, the first ones of the file
LightField LoadLightField(const SceneBlocks& blocks, const Medium& smoke, int bands);

} // namespace smokevis
