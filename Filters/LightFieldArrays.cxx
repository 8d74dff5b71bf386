// The light field as cell arrays.
#include "LightFieldArrays.h"

#include "Errors.h"

#include <vtkCellData.h>
#include <vtkDataSet.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>

#include <array>
#include <cmath>

namespace smokevis
{
namespace
{

constexpr int Sides = 2;
/// Field data of a smoke block, of the later parts of the cells that walls cut.
const char* const PartDirect = "PartDirectFluence";
const char* const PartMultiple = "PartMultipleFluence";

vtkSmartPointer<vtkFloatArray> MakeArray(const char* name, int components, vtkIdType tuples)
{
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  return array;
}

vtkSmartPointer<vtkFloatArray> AddArray(vtkDataSet& block, const char* name, int components)
{
  auto array = MakeArray(name, components, block.GetNumberOfCells());
  if (components == MaxBands)
  {
    array->SetComponentName(0, "R");
    array->SetComponentName(1, "G");
    array->SetComponentName(2, "B");
  }
  block.GetCellData()->AddArray(array);
  return array;
}

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

void CopyLanes(const Lanes& lanes, float* target)
{
  std::copy(lanes.Value, lanes.Value + Batches, target);
}

/// The numbers of the later parts of the cells of a grid, whose first cell and number of cells are
/// given.
std::vector<std::int64_t> LaterParts(
  const Medium& smoke, std::size_t firstCell, vtkIdType numberOfCells)
{
  std::vector<std::int64_t> numbers;
  const auto first = static_cast<std::int64_t>(firstCell);
  for (const CellPart& part : smoke.Parts().Parts())
  {
    if (part.Number != part.Cell && part.Cell >= first && part.Cell < first + numberOfCells)
    {
      numbers.push_back(part.Number);
    }
  }
  return numbers;
}

/// The batches of all the fluence of a cell; of one that walls cut, of the mean over its parts.
Lanes CellFluence(const LightField& field, const Medium& smoke, std::int64_t cell, int band)
{
  Lanes sum;
  double volume = 0.0;
  const auto add = [&](std::int64_t number, double weight)
  {
    const std::size_t index = field.CellIndex(band, number);
    for (int batch = 0; batch < Batches; ++batch)
    {
      sum[batch] += static_cast<float>(
        weight * (field.DirectFluence[index] + field.MultipleFluence[index][batch]));
    }
    volume += weight;
  };
  smoke.Parts().ForEachPart(
    cell, [&](std::int64_t number) { add(number, smoke.CellVolume(number)); });
  for (float& value : sum.Value)
  {
    value = static_cast<float>(value / volume);
  }
  return sum;
}

void StoreSmoke(
  const LightField& field, const Medium& smoke, std::size_t firstCell, int bands, vtkDataSet& block)
{
  const auto fluence = AddArray(block, "Fluence", bands);
  const auto error = AddArray(block, "FluenceError", bands);
  const auto direct = AddArray(block, "DirectFluence", bands);
  const auto multiple = AddArray(block, "MultipleFluence", bands * Batches);
  const auto store = [&](std::int64_t number, vtkIdType tuple, vtkFloatArray& directArray,
                       vtkFloatArray& multipleArray)
  {
    for (int band = 0; band < bands; ++band)
    {
      const std::size_t index = field.CellIndex(std::min(band, field.Bands - 1), number);
      directArray.SetTypedComponent(tuple, band, field.DirectFluence[index]);
      CopyLanes(
        field.MultipleFluence[index], multipleArray.GetPointer((tuple * bands + band) * Batches));
    }
  };
  for (vtkIdType i = 0; i < block.GetNumberOfCells(); ++i)
  {
    const auto cell = static_cast<std::int64_t>(firstCell) + i;
    store(cell, i, *direct, *multiple);
    const bool cut = smoke.Parts().Find(cell) != nullptr;
    for (int band = 0; band < bands; ++band)
    {
      const int own = std::min(band, field.Bands - 1);
      const std::size_t index = field.CellIndex(own, cell);
      const Lanes all = cut ? CellFluence(field, smoke, cell, own) : field.MultipleFluence[index];
      const float rest = cut ? 0.0F : field.DirectFluence[index];
      fluence->SetTypedComponent(i, band, static_cast<float>(rest + Mean(all)));
      error->SetTypedComponent(i, band, static_cast<float>(StandardError(all)));
    }
  }
  vtkNew<vtkFieldData> fields;
  fields->PassData(block.GetFieldData());
  RemoveParts(*fields);
  const std::vector<std::int64_t> later = LaterParts(smoke, firstCell, block.GetNumberOfCells());
  if (!later.empty())
  {
    const auto count = static_cast<vtkIdType>(later.size());
    const auto partDirect = MakeArray(PartDirect, bands, count);
    const auto partMultiple = MakeArray(PartMultiple, bands * Batches, count);
    for (vtkIdType i = 0; i < count; ++i)
    {
      store(later[i], i, *partDirect, *partMultiple);
    }
    fields->AddArray(partDirect);
    fields->AddArray(partMultiple);
  }
  block.SetFieldData(fields);
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

/// An array that must be there, with at least so many components.
class NeededArray
{
public:
  NeededArray(vtkDataSet& block, const std::string& blockName, const char* name, int components)
      : NeededArray(*block.GetCellData(), "cell array ", blockName, name, components,
          block.GetNumberOfCells())
  {
  }

  NeededArray(vtkFieldData& arrays, const std::string& kind, const std::string& blockName,
    const char* name, int components, vtkIdType tuples)
      : Values_(arrays.GetArray(name)), Where_(kind + name + " of block '" + blockName + "'")
  {
    if (!this->Values_ || this->Values_->GetNumberOfComponents() < components ||
        this->Values_->GetNumberOfTuples() != tuples)
    {
      throw Error(this->Where_, "it is missing or has another size than the light field needs",
        "Give the output of SmokeLightField, or a file that it was saved to");
    }
    this->Floats_ = vtkFloatArray::SafeDownCast(this->Values_);
  }

  float Get(vtkIdType cell, int component) const
  {
    const float value = this->Floats_
                          ? this->Floats_->GetTypedComponent(cell, component)
                          : static_cast<float>(this->Values_->GetComponent(cell, component));
    if (!std::isfinite(value))
    {
      throw Error(this->Where_, "the value of cell " + std::to_string(cell) + " is not finite",
        "Run SmokeLightField again");
    }
    return value;
  }

  void Get(vtkIdType cell, int component, Lanes& lanes) const
  {
    for (int batch = 0; batch < Batches; ++batch)
    {
      lanes[batch] = this->Get(cell, component + batch);
    }
  }

private:
  vtkDataArray* Values_;
  vtkFloatArray* Floats_ = nullptr;
  std::string Where_;
};

void LoadSmoke(
  const SmokeBlock& block, const Medium& smoke, std::size_t firstCell, LightField& field)
{
  const auto load = [&field](std::int64_t number, vtkIdType tuple, const NeededArray& direct,
                      const NeededArray& multiple)
  {
    for (int band = 0; band < field.Bands; ++band)
    {
      const std::size_t index = field.CellIndex(band, number);
      field.DirectFluence[index] = direct.Get(tuple, band);
      multiple.Get(tuple, band * Batches, field.MultipleFluence[index]);
    }
  };
  const NeededArray direct(*block.Grid, block.Name, "DirectFluence", field.Bands);
  const NeededArray multiple(*block.Grid, block.Name, "MultipleFluence", field.Bands * Batches);
  const vtkIdType cells = block.Grid->GetNumberOfCells();
  for (vtkIdType i = 0; i < cells; ++i)
  {
    load(static_cast<std::int64_t>(firstCell) + i, i, direct, multiple);
  }
  const std::vector<std::int64_t> later = LaterParts(smoke, firstCell, cells);
  if (later.empty())
  {
    return;
  }
  const auto count = static_cast<vtkIdType>(later.size());
  vtkFieldData& fields = *block.Grid->GetFieldData();
  const NeededArray partDirect(fields, "field array ", block.Name, PartDirect, field.Bands, count);
  const NeededArray partMultiple(
    fields, "field array ", block.Name, PartMultiple, field.Bands * Batches, count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    load(later[i], i, partDirect, partMultiple);
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

} // namespace

//------------------------------------------------------------------------------
void StoreLightField(LightField&& field, const Medium& smoke, const SceneBlocks& blocks, int bands)
{
  std::size_t cell = 0;
  for (const SmokeBlock& block : blocks.Smoke)
  {
    StoreSmoke(field, smoke, cell, bands, *block.Grid);
    cell += block.Grid->GetNumberOfCells();
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
  std::vector<float>().swap(field.DirectIlluminance);
  std::vector<Lanes>().swap(field.MultipleIlluminance);
}

//------------------------------------------------------------------------------
void RemoveParts(vtkFieldData& fields)
{
  fields.RemoveArray(PartDirect);
  fields.RemoveArray(PartMultiple);
}

//------------------------------------------------------------------------------
std::vector<vtkDataArray*> LightArrays(const SceneBlocks& blocks)
{
  std::vector<vtkDataArray*> arrays;
  for (const SmokeBlock& block : blocks.Smoke)
  {
    for (const char* const name : {"DirectFluence", "MultipleFluence"})
    {
      arrays.push_back(block.Grid->GetCellData()->GetArray(name));
    }
    for (const char* const name : {PartDirect, PartMultiple})
    {
      if (vtkDataArray* const array = block.Grid->GetFieldData()->GetArray(name))
      {
        arrays.push_back(array);
      }
    }
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
  return arrays;
}

//------------------------------------------------------------------------------
bool ShareLightField(const SceneBlocks& from, const SceneBlocks& to)
{
  if (CellCounts(from) != CellCounts(to))
  {
    return false;
  }
  const auto share = [](vtkDataSet& source, vtkDataSet& target, auto... names)
  { (target.GetCellData()->AddArray(source.GetCellData()->GetArray(names)), ...); };
  for (std::size_t i = 0; i < to.Smoke.size(); ++i)
  {
    share(*from.Smoke[i].Grid, *to.Smoke[i].Grid, "Fluence", "FluenceError", "DirectFluence",
      "MultipleFluence");
    vtkNew<vtkFieldData> fields;
    fields->PassData(to.Smoke[i].Grid->GetFieldData());
    RemoveParts(*fields);
    for (const char* const name : {PartDirect, PartMultiple})
    {
      if (vtkDataArray* const array = from.Smoke[i].Grid->GetFieldData()->GetArray(name))
      {
        fields->AddArray(array);
      }
    }
    to.Smoke[i].Grid->SetFieldData(fields);
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
  std::size_t cell = 0;
  for (const SmokeBlock& block : blocks.Smoke)
  {
    LoadSmoke(block, smoke, cell, field);
    cell += block.Grid->GetNumberOfCells();
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
  return field;
}

} // namespace smokevis
