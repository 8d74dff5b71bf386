// The light in smoke as arrays of its blocks.
#pragma once

#include "LightField.h"
#include "SceneBlocks.h"

#include <cstddef>
#include <string>
#include <vector>

class vtkDataArray;
class vtkFieldData;

namespace smokevis
{

/// Adds the light of a smoke block to it, as LightFieldArrays.h describes.
/// @param smoke of the scene that was solved
/// @param firstCell of the block among the scene's
void StoreSmoke(const LightField& field, const Medium& smoke, std::size_t firstCell, int bands,
  const SmokeBlock& block);

/// Reads it back. Throws Error where an array is missing or has another size.
void LoadSmoke(
  const SmokeBlock& block, const Medium& smoke, std::size_t firstCell, LightField& field);

/// Gives a block the light of another one; the arrays are shared.
void ShareSmoke(const SmokeBlock& from, const SmokeBlock& to);

/// The arrays that LoadSmoke reads, in a fixed order, null where one is missing that every light
/// field has.
std::vector<vtkDataArray*> SmokeLightArrays(const SmokeBlock& block);

/// Takes what the field data of a block tell of its light out of those of one that is to hold other
/// light.
void RemoveSmokeLight(vtkFieldData& fields);

/// How a block that holds light was refined when that was solved. Throws Error where its field data
/// tell something else than a number of parts for each interval.
GridRefinement RefinementOf(vtkDataSet& grid, const std::string& name);

/// Cells that a block has in the scene.
std::size_t SceneCells(const SmokeBlock& block);

} // namespace smokevis
