// The light field as cell arrays.
#include "LightFieldArrays.h"

#include "LightArrays.h"
#include "SmokeLightArrays.h"

#include <algorithm>
#include <array>

namespace smokevis
{
namespace
{

constexpr int Sides = 2;
/// Of the emitter cells.
const char* const Gradient = "MultipleIlluminanceGradient";
constexpr int Axes = 3;

/// Of the blocks of each kind.
std::array<std::vector<vtkIdType>, 3> CellCounts(const SceneBlocks& blocks)
{
  std::array<std::vector<vtkIdType>, 3> counts;
  for (const SmokeBlock& block : blocks.Smoke)
  {
    counts[0].push_back(block.Grid->GetNumberOfCells());
  }
  for (const SurfaceBlock& block : blocks.Surfaces)
  {
    counts[1].push_back(block.Mesh->GetNumberOfCells());
  }
  for (const SurfaceBlock& block : blocks.Emitters)
  {
    counts[2].push_back(block.Mesh->GetNumberOfCells());
  }
  return counts;
}

void StorePatches(const LightField& field, std::size_t firstPatch, int bands, vtkDataSet& block)
{
  const auto front = AddArray(block, "Illuminance", bands);
  const auto error = AddArray(block, "IlluminanceError", bands);
  const auto back = AddArray(block, "IlluminanceBack", bands);
  const auto direct = AddArray(block, "DirectIlluminance", bands * Sides);
  const auto multiple = AddArray(block, "MultipleIlluminance", bands * Sides * Batches);
  for (vtkIdType i = 0; i < block.GetNumberOfCells(); ++i)
  {
    for (int band = 0; band < bands; ++band)
    {
      for (int side = 0; side < Sides; ++side)
      {
        const std::size_t index =
          field.PatchIndex(std::min(band, field.Bands - 1), firstPatch + i, side);
        const Lanes& lanes = field.MultipleIlluminance[index];
        direct->SetTypedComponent(i, band * Sides + side, field.DirectIlluminance[index]);
        (side == 0 ? front : back)
          ->SetTypedComponent(
            i, band, static_cast<float>(field.DirectIlluminance[index] + Mean(lanes)));
        if (side == 0)
        {
          error->SetTypedComponent(i, band, static_cast<float>(StandardError(lanes)));
        }
        CopyLanes(lanes, multiple->GetPointer(((i * bands + band) * Sides + side) * Batches));
      }
    }
  }
}

void LoadPatches(const SurfaceBlock& block, std::size_t firstPatch, LightField& field)
{
  const NeededArray direct(*block.Mesh, block.Name, "DirectIlluminance", field.Bands * Sides);
  const NeededArray multiple(
    *block.Mesh, block.Name, "MultipleIlluminance", field.Bands * Sides * Batches);
  for (vtkIdType i = 0; i < block.Mesh->GetNumberOfCells(); ++i)
  {
    for (int band = 0; band < field.Bands; ++band)
    {
      for (int side = 0; side < Sides; ++side)
      {
        const std::size_t index = field.PatchIndex(band, firstPatch + i, side);
        field.DirectIlluminance[index] = direct.Get(i, band * Sides + side);
        multiple.Get(i, (band * Sides + side) * Batches, field.MultipleIlluminance[index]);
      }
    }
  }
}

/// @param first of the cells among all emitter cells
void StoreGradients(const LightField& field, std::size_t first, int bands, vtkDataSet& block)
{
  const std::size_t emitters = field.MultipleGradient.size() / field.Bands;
  const auto gradient = AddArray(block, Gradient, bands * Axes, {"X", "Y", "Z"});
  for (vtkIdType i = 0; i < block.GetNumberOfCells(); ++i)
  {
    for (int band = 0; band < bands; ++band)
    {
      const glm::vec3& own =
        field.MultipleGradient[std::min(band, field.Bands - 1) * emitters + first + i];
      for (int axis = 0; axis < Axes; ++axis)
      {
        gradient->SetTypedComponent(i, band * Axes + axis, own[axis]);
      }
    }
  }
}

/// Light fields that were saved before there were gradients have none.
void LoadGradients(const SurfaceBlock& block, std::size_t first, LightField& field)
{
  if (!block.Mesh->GetCellData()->GetArray(Gradient))
  {
    return;
  }
  const std::size_t emitters = field.MultipleGradient.size() / field.Bands;
  const NeededArray gradient(*block.Mesh, block.Name, Gradient, field.Bands * Axes);
  for (vtkIdType i = 0; i < block.Mesh->GetNumberOfCells(); ++i)
  {
    for (int band = 0; band < field.Bands; ++band)
    {
      for (int axis = 0; axis < Axes; ++axis)
      {
        field.MultipleGradient[band * emitters + first + i][axis] =
          gradient.Get(i, band * Axes + axis);
      }
    }
  }
}

} // namespace

//------------------------------------------------------------------------------
void StoreLightField(LightField&& field, const Medium& smoke, const SceneBlocks& blocks, int bands)
{
  std::size_t cell = 0;
  for (const SmokeBlock& block : blocks.Smoke)
  {
    StoreSmoke(field, smoke, cell, bands, block);
    cell += SceneCells(block);
  }
  std::vector<float>().swap(field.DirectFluence);
  std::vector<Lanes>().swap(field.MultipleFluence);
  std::size_t patch = 0;
  for (const auto* const group : {&blocks.Surfaces, &blocks.Emitters})
  {
    for (const SurfaceBlock& block : *group)
    {
      StorePatches(field, patch, bands, *block.Mesh);
      patch += block.Mesh->GetNumberOfCells();
    }
  }
  std::size_t emitter = 0;
  for (const SurfaceBlock& block : blocks.Emitters)
  {
    StoreGradients(field, emitter, bands, *block.Mesh);
    emitter += block.Mesh->GetNumberOfCells();
  }
  std::vector<float>().swap(field.DirectIlluminance);
  std::vector<Lanes>().swap(field.MultipleIlluminance);
}

//------------------------------------------------------------------------------
std::vector<vtkDataArray*> LightArrays(const SceneBlocks& blocks)
{
  std::vector<vtkDataArray*> arrays;
  for (const SmokeBlock& block : blocks.Smoke)
  {
    const std::vector<vtkDataArray*> smoke = SmokeLightArrays(block);
    arrays.insert(arrays.end(), smoke.begin(), smoke.end());
  }
  for (const auto* const group : {&blocks.Surfaces, &blocks.Emitters})
  {
    for (const SurfaceBlock& block : *group)
    {
      for (const char* const name : {"DirectIlluminance", "MultipleIlluminance"})
      {
        arrays.push_back(block.Mesh->GetCellData()->GetArray(name));
      }
    }
  }
  for (const SurfaceBlock& block : blocks.Emitters)
  {
    if (vtkDataArray* const gradient = block.Mesh->GetCellData()->GetArray(Gradient))
    {
      arrays.push_back(gradient);
    }
  }
  return arrays;
}

//------------------------------------------------------------------------------
bool ShareLightField(const SceneBlocks& from, const SceneBlocks& to)
{
  const bool sameCells =
    std::equal(from.Smoke.begin(), from.Smoke.end(), to.Smoke.begin(), to.Smoke.end(),
      [](const SmokeBlock& a, const SmokeBlock& b) { return a.Refinement == b.Refinement; });
  if (CellCounts(from) != CellCounts(to) || !sameCells)
  {
    return false;
  }
  const auto share = [](vtkDataSet& source, vtkDataSet& target, auto... names)
  { (target.GetCellData()->AddArray(source.GetCellData()->GetArray(names)), ...); };
  for (std::size_t i = 0; i < to.Smoke.size(); ++i)
  {
    ShareSmoke(from.Smoke[i], to.Smoke[i]);
  }
  const auto shareMeshes =
    [&share](const std::vector<SurfaceBlock>& sources, const std::vector<SurfaceBlock>& targets)
  {
    for (std::size_t i = 0; i < targets.size(); ++i)
    {
      share(*sources[i].Mesh, *targets[i].Mesh, "Illuminance", "IlluminanceError",
        "IlluminanceBack", "DirectIlluminance", "MultipleIlluminance");
    }
  };
  shareMeshes(from.Surfaces, to.Surfaces);
  shareMeshes(from.Emitters, to.Emitters);
  for (std::size_t i = 0; i < to.Emitters.size(); ++i)
  {
    share(*from.Emitters[i].Mesh, *to.Emitters[i].Mesh, Gradient);
  }
  return true;
}

//------------------------------------------------------------------------------
LightField LoadLightField(const SceneBlocks& blocks, const Medium& smoke, int bands)
{
  LightField field;
  field.Bands = bands;
  field.Cells = smoke.Cells();
  for (const auto* const group : {&blocks.Surfaces, &blocks.Emitters})
  {
    for (const SurfaceBlock& block : *group)
    {
      field.Patches += block.Mesh->GetNumberOfCells();
    }
  }
  field.DirectFluence.resize(field.Cells * bands);
  field.MultipleFluence.resize(field.Cells * bands);
  field.DirectIlluminance.resize(field.Patches * bands * Sides);
  field.MultipleIlluminance.resize(field.Patches * bands * Sides);
  std::size_t emitters = 0;
  for (const SurfaceBlock& block : blocks.Emitters)
  {
    emitters += block.Mesh->GetNumberOfCells();
  }
  field.MultipleGradient.resize(emitters * bands, glm::vec3(0.0F));
  std::size_t cell = 0;
  for (const SmokeBlock& block : blocks.Smoke)
  {
    LoadSmoke(block, smoke, cell, field);
    cell += SceneCells(block);
  }
  std::size_t patch = 0;
  for (const auto* const group : {&blocks.Surfaces, &blocks.Emitters})
  {
    for (const SurfaceBlock& block : *group)
    {
      LoadPatches(block, patch, field);
      patch += block.Mesh->GetNumberOfCells();
    }
  }
  std::size_t emitter = 0;
  for (const SurfaceBlock& block : blocks.Emitters)
  {
    LoadGradients(block, emitter, field);
    emitter += block.Mesh->GetNumberOfCells();
  }
  return field;
}

} // namespace smokevis
