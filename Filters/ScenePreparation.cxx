// Collects, cuts and sizes up the scene of a light field.
#include "ScenePreparation.h"

#include "MemoryGuard.h"
#include "SmokeLightArrays.h"
#include "SurfaceRefiner.h"

#include <vtkBoundingBox.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace smokevis
{
namespace
{

/// What the solver and the output take for each smoke cell and surface patch, at their peak
/// [bytes]: so much at all, and so much more a band (measured: 365 with one band on two threads,
/// where the source has a shape in all cells; 560 with three, before views took 24 more a band).
constexpr double CellBytes = 260.0;
constexpr double CellBandBytes = 140.0;
constexpr double PatchBytes = 500.0;
constexpr double PatchBandBytes = 280.0;

/// Cuts the blocks and drops those of which nothing is left. Returns the number of patches.
std::size_t Refine(std::vector<SurfaceBlock>& blocks, double patchSize)
{
  std::size_t patches = 0;
  std::vector<SurfaceBlock> refined;
  for (const SurfaceBlock& block : blocks)
  {
    const auto mesh = RefineSurface(block.Mesh, block.Name, patchSize);
    if (mesh->GetNumberOfCells() > 0)
    {
      patches += mesh->GetNumberOfCells();
      refined.push_back({block.Name, mesh});
    }
  }
  blocks = std::move(refined);
  return patches;
}

} // namespace

//------------------------------------------------------------------------------
std::vector<SurfaceBlock> CollectPort(vtkInformationVector* port, const std::string& name)
{
  std::vector<SurfaceBlock> blocks;
  const int count = port->GetNumberOfInformationObjects();
  for (int i = 0; i < count; ++i)
  {
    for (SurfaceBlock& block : CollectSurfaces(
           vtkDataObject::GetData(port, i), count == 1 ? name : name + " " + std::to_string(i + 1)))
    {
      blocks.push_back(std::move(block));
    }
  }
  return blocks;
}

//------------------------------------------------------------------------------
double Diagonal(const SceneBlocks& blocks)
{
  vtkBoundingBox box;
  for (const SmokeBlock& block : blocks.Smoke)
  {
    box.AddBounds(block.Grid->GetBounds());
  }
  for (const auto* const group : {&blocks.Surfaces, &blocks.Emitters})
  {
    for (const SurfaceBlock& block : *group)
    {
      box.AddBounds(block.Mesh->GetBounds());
    }
  }
  return box.GetDiagonalLength();
}

//------------------------------------------------------------------------------
void AddDefaultReflectance(const std::vector<SurfaceBlock>& blocks, double reflectance)
{
  for (const SurfaceBlock& block : blocks)
  {
    if (!block.Mesh->GetCellData()->HasArray("Reflectance"))
    {
      vtkNew<vtkDoubleArray> array;
      array->SetName("Reflectance");
      array->SetNumberOfTuples(block.Mesh->GetNumberOfCells());
      array->Fill(reflectance);
      block.Mesh->GetCellData()->AddArray(array);
    }
  }
}

//------------------------------------------------------------------------------
std::size_t CutIntoPatches(SceneBlocks& blocks, double patchSize)
{
  const std::size_t patches = Refine(blocks.Surfaces, patchSize);
  Refine(blocks.Emitters, std::numeric_limits<double>::infinity());
  std::vector<SurfaceBlock*> all;
  for (auto* const group : {&blocks.Surfaces, &blocks.Emitters})
  {
    for (SurfaceBlock& block : *group)
    {
      all.push_back(&block);
    }
  }
  MatchComponents(all, "Reflectance");
  MatchComponents(all, "Luminance");
  return patches;
}

//------------------------------------------------------------------------------
bool SmokeEmits(const SceneBlocks& blocks)
{
  return std::any_of(blocks.Smoke.begin(), blocks.Smoke.end(),
    [](const SmokeBlock& block)
    { return block.Grid->GetCellData()->HasArray("EmittedLuminance") != 0; });
}

//------------------------------------------------------------------------------
void RequireMemoryForLight(const SceneBlocks& blocks, int bands)
{
  double cells = 0.0;
  for (const SmokeBlock& block : blocks.Smoke)
  {
    cells += static_cast<double>(SceneCells(block));
  }
  double patches = 0.0;
  for (const auto* const group : {&blocks.Surfaces, &blocks.Emitters})
  {
    for (const SurfaceBlock& block : *group)
    {
      patches += static_cast<double>(block.Mesh->GetNumberOfCells());
    }
  }
  RequireMemory("light field",
    "the light of " + std::to_string(std::llround(cells)) + " smoke cells and " +
      std::to_string(std::llround(patches)) + " surface patches",
    cells * (CellBytes + CellBandBytes * bands) + patches * (PatchBytes + PatchBandBytes * bands),
    "Give coarser smoke, one band, a larger PatchSize or a smaller MaximumRefinedCells");
}

} // namespace smokevis
