#include "SmokeLightArrays.h"

#include "LightArrays.h"

#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkRectilinearGrid.h>

#include <algorithm>
#include <array>
#include <numeric>

namespace smokevis
{
namespace
{

/// Field data of a smoke block: of the later parts of the cells that walls cut,
constexpr const char* PartDirect = "PartDirectFluence";
constexpr const char* PartMultiple = "PartMultipleFluence";
/// and of the finer cells of a block that was refined.
constexpr const char* Refinement = "Refinement";
constexpr const char* RefinedDirect = "RefinedDirectFluence";
constexpr const char* RefinedMultiple = "RefinedMultipleFluence";
constexpr std::array FieldArrays = {
  PartDirect, PartMultiple, Refinement, RefinedDirect, RefinedMultiple};

/// Share of a cell's volume that counts at least.
constexpr double LeastShare = 1e-6;
/// Most parts that a cell is cut into along an axis, by far.
constexpr int MostParts = 1000;

/// The numbers of the later parts of the cells of a grid, whose first cell and number of cells are
/// given.
std::vector<std::int64_t> LaterParts(
  const Medium& smoke, std::size_t firstCell, std::size_t numberOfCells)
{
  std::vector<std::int64_t> numbers;
  const auto first = static_cast<std::int64_t>(firstCell);
  const auto end = first + static_cast<std::int64_t>(numberOfCells);
  for (const CellPart& part : smoke.Parts().Parts())
  {
    if (part.Number != part.Cell && part.Cell >= first && part.Cell < end)
    {
      numbers.push_back(part.Number);
    }
  }
  return numbers;
}

/// Adds arrays of the light of some cells of a scene to field data.
/// @param number(i) of the i-th of these cells
template <class Number>
void StoreFields(const LightField& field, std::size_t count, Number&& number, int bands,
  const char* directName, const char* multipleName, vtkFieldData& fields)
{
  const auto tuples = static_cast<vtkIdType>(count);
  const auto direct = MakeArray(directName, bands, tuples);
  const auto multiple = MakeArray(multipleName, bands * Batches, tuples);
  for (vtkIdType i = 0; i < tuples; ++i)
  {
    for (int band = 0; band < bands; ++band)
    {
      const std::size_t index = field.CellIndex(std::min(band, field.Bands - 1), number(i));
      direct->SetTypedComponent(i, band, field.DirectFluence[index]);
      CopyLanes(field.MultipleFluence[index], multiple->GetPointer((i * bands + band) * Batches));
    }
  }
  fields.AddArray(direct);
  fields.AddArray(multiple);
}

/// The light of one band that some cells of a scene hold in the mean. What finer grids lie over
/// counts only where there is nothing else.
class MeanLight
{
public:
  /// Adds a cell with all its parts.
  void Add(const LightField& field, const Medium& smoke, std::int64_t cell, int band)
  {
    smoke.Parts().ForEachPart(cell,
      [&](std::int64_t number)
      {
        const double volume =
          std::max(smoke.OwnVolume(number), LeastShare * smoke.CellVolume(number));
        const std::size_t index = field.CellIndex(band, number);
        this->Volume_ += volume;
        this->Direct_ += volume * field.DirectFluence[index];
        for (int batch = 0; batch < Batches; ++batch)
        {
          this->Multiple_[batch] += volume * field.MultipleFluence[index][batch];
        }
      });
  }

  float Direct() const { return static_cast<float>(this->Direct_ / this->Volume_); }
  Lanes Multiple() const
  {
    Lanes lanes;
    for (int batch = 0; batch < Batches; ++batch)
    {
      lanes[batch] = static_cast<float>(this->Multiple_[batch] / this->Volume_);
    }
    return lanes;
  }

private:
  double Volume_ = 0.0;
  double Direct_ = 0.0;
  std::array<double, Batches> Multiple_{};
};

/// Adds the arrays of a block's cells.
class CellArrays
{
public:
  CellArrays(vtkDataSet& block, int bands)
      : Bands_(bands), Fluence_(AddArray(block, "Fluence", bands)),
        Error_(AddArray(block, "FluenceError", bands)),
        Direct_(AddArray(block, "DirectFluence", bands)),
        Multiple_(AddArray(block, "MultipleFluence", bands * Batches))
  {
  }

  /// All light of a cell in a band.
  void SetAll(vtkIdType cell, int band, float direct, const Lanes& multiple) const
  {
    this->Fluence_->SetTypedComponent(cell, band, static_cast<float>(direct + Mean(multiple)));
    this->Error_->SetTypedComponent(cell, band, static_cast<float>(StandardError(multiple)));
  }
  /// What views read of it.
  void SetOwn(vtkIdType cell, int band, float direct, const Lanes& multiple) const
  {
    this->Direct_->SetTypedComponent(cell, band, direct);
    CopyLanes(multiple, this->Multiple_->GetPointer((cell * this->Bands_ + band) * Batches));
  }

private:
  int Bands_;
  vtkSmartPointer<vtkFloatArray> Fluence_, Error_, Direct_, Multiple_;
};

/// Of a block whose cells are the scene's.
void StoreCells(
  const LightField& field, const Medium& smoke, std::size_t firstCell, int bands, vtkDataSet& block)
{
  const CellArrays arrays(block, bands);
  for (vtkIdType i = 0; i < block.GetNumberOfCells(); ++i)
  {
    const auto cell = static_cast<std::int64_t>(firstCell) + i;
    const bool cut = smoke.Parts().Find(cell) != nullptr;
    for (int band = 0; band < bands; ++band)
    {
      const int own = std::min(band, field.Bands - 1);
      const std::size_t index = field.CellIndex(own, cell);
      const float direct = field.DirectFluence[index];
      const Lanes& multiple = field.MultipleFluence[index];
      arrays.SetOwn(i, band, direct, multiple);
      if (cut)
      {
        MeanLight mean;
        mean.Add(field, smoke, cell, own);
        arrays.SetAll(i, band, mean.Direct(), mean.Multiple());
      }
      else
      {
        arrays.SetAll(i, band, direct, multiple);
      }
    }
  }
}

/// Of a block that was refined: means over its cells.
void StoreMeans(const LightField& field, const Medium& smoke, std::size_t firstCell, int bands,
  const SmokeBlock& block)
{
  const CellArrays arrays(*block.Grid, bands);
  const std::vector<std::int64_t> parents = block.Refinement.Parents();
  for (int band = 0; band < bands; ++band)
  {
    const int own = std::min(band, field.Bands - 1);
    std::vector<MeanLight> means(block.Grid->GetNumberOfCells());
    for (std::size_t i = 0; i < parents.size(); ++i)
    {
      means[parents[i]].Add(field, smoke, static_cast<std::int64_t>(firstCell + i), own);
    }
    for (std::size_t i = 0; i < means.size(); ++i)
    {
      const auto cell = static_cast<vtkIdType>(i);
      arrays.SetAll(cell, band, means[i].Direct(), means[i].Multiple());
      arrays.SetOwn(cell, band, means[i].Direct(), means[i].Multiple());
    }
  }
}

vtkSmartPointer<vtkIntArray> RefinementArray(const GridRefinement& refinement)
{
  auto array = vtkSmartPointer<vtkIntArray>::New();
  array->SetName(Refinement);
  for (const std::vector<int>& parts : refinement.Parts)
  {
    for (const int part : parts)
    {
      array->InsertNextValue(part);
    }
  }
  return array;
}

/// Cells of a grid along each axis.
std::array<int, 3> CellsAlong(vtkDataSet& grid)
{
  std::array<int, 3> points{};
  if (auto* const image = vtkImageData::SafeDownCast(&grid))
  {
    image->GetDimensions(points.data());
  }
  else
  {
    vtkRectilinearGrid::SafeDownCast(&grid)->GetDimensions(points.data());
  }
  return {points[0] - 1, points[1] - 1, points[2] - 1};
}

} // namespace

//------------------------------------------------------------------------------
void StoreSmoke(const LightField& field, const Medium& smoke, std::size_t firstCell, int bands,
  const SmokeBlock& block)
{
  vtkNew<vtkFieldData> fields;
  fields->PassData(block.Grid->GetFieldData());
  RemoveSmokeLight(*fields);
  if (block.Refinement.None())
  {
    StoreCells(field, smoke, firstCell, bands, *block.Grid);
  }
  else
  {
    StoreMeans(field, smoke, firstCell, bands, block);
    fields->AddArray(RefinementArray(block.Refinement));
    StoreFields(
      field, SceneCells(block), [firstCell](std::size_t i) { return firstCell + i; }, bands,
      RefinedDirect, RefinedMultiple, *fields);
  }
  const std::vector<std::int64_t> later = LaterParts(smoke, firstCell, SceneCells(block));
  if (!later.empty())
  {
    StoreFields(
      field, later.size(), [&later](std::size_t i) { return later[i]; }, bands, PartDirect,
      PartMultiple, *fields);
  }
  block.Grid->SetFieldData(fields);
}

//------------------------------------------------------------------------------
void LoadSmoke(
  const SmokeBlock& block, const Medium& smoke, std::size_t firstCell, LightField& field)
{
  const auto load = [&field](std::size_t count, auto&& number, const NeededArray& direct,
                      const NeededArray& multiple)
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      const auto tuple = static_cast<vtkIdType>(i);
      for (int band = 0; band < field.Bands; ++band)
      {
        const std::size_t index = field.CellIndex(band, number(i));
        field.DirectFluence[index] = direct.Get(tuple, band);
        multiple.Get(tuple, band * Batches, field.MultipleFluence[index]);
      }
    }
  };
  const auto loadFields =
    [&](std::size_t count, auto&& number, const char* directName, const char* multipleName)
  {
    const auto tuples = static_cast<vtkIdType>(count);
    vtkFieldData& fields = *block.Grid->GetFieldData();
    load(count, number, {fields, "field array ", block.Name, directName, field.Bands, tuples},
      {fields, "field array ", block.Name, multipleName, field.Bands * Batches, tuples});
  };
  const std::size_t cells = SceneCells(block);
  const auto numberOfCell = [firstCell](std::size_t i) { return firstCell + i; };
  if (block.Refinement.None())
  {
    load(cells, numberOfCell, {*block.Grid, block.Name, "DirectFluence", field.Bands},
      {*block.Grid, block.Name, "MultipleFluence", field.Bands * Batches});
  }
  else
  {
    loadFields(cells, numberOfCell, RefinedDirect, RefinedMultiple);
  }
  const std::vector<std::int64_t> later = LaterParts(smoke, firstCell, cells);
  if (!later.empty())
  {
    loadFields(
      later.size(), [&later](std::size_t i) { return later[i]; }, PartDirect, PartMultiple);
  }
}

//------------------------------------------------------------------------------
void ShareSmoke(const SmokeBlock& from, const SmokeBlock& to)
{
  for (const char* const name : {"Fluence", "FluenceError", "DirectFluence", "MultipleFluence"})
  {
    to.Grid->GetCellData()->AddArray(from.Grid->GetCellData()->GetArray(name));
  }
  vtkNew<vtkFieldData> fields;
  fields->PassData(to.Grid->GetFieldData());
  RemoveSmokeLight(*fields);
  for (const char* const name : FieldArrays)
  {
    if (vtkDataArray* const array = from.Grid->GetFieldData()->GetArray(name))
    {
      fields->AddArray(array);
    }
  }
  to.Grid->SetFieldData(fields);
}

//------------------------------------------------------------------------------
std::vector<vtkDataArray*> SmokeLightArrays(const SmokeBlock& block)
{
  std::vector<vtkDataArray*> arrays;
  for (const char* const name : {"DirectFluence", "MultipleFluence"})
  {
    arrays.push_back(block.Grid->GetCellData()->GetArray(name));
  }
  for (const char* const name : FieldArrays)
  {
    if (vtkDataArray* const array = block.Grid->GetFieldData()->GetArray(name))
    {
      arrays.push_back(array);
    }
  }
  return arrays;
}

//------------------------------------------------------------------------------
void RemoveSmokeLight(vtkFieldData& fields)
{
  for (const char* const name : FieldArrays)
  {
    fields.RemoveArray(name);
  }
}

//------------------------------------------------------------------------------
GridRefinement RefinementOf(vtkDataSet& grid, const std::string& name)
{
  GridRefinement refinement;
  vtkDataArray* const array = grid.GetFieldData()->GetArray(Refinement);
  const std::string where = std::string("field array ") + Refinement + " of block '" + name + "'";
  const char* const remedy = "Give the output of SmokeLightField, or a file that it was saved to";
  if (!array)
  {
    if (grid.GetFieldData()->HasArray(RefinedMultiple))
    {
      throw Error(where, "it is missing beside the light of finer cells", remedy);
    }
    return refinement;
  }
  const std::array<int, 3> cells = CellsAlong(grid);
  if (array->GetNumberOfValues() != std::accumulate(cells.begin(), cells.end(), vtkIdType{0}))
  {
    throw Error(where, "it has not one value for each interval between nodes", remedy);
  }
  vtkIdType value = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int interval = 0; interval < cells[axis]; ++interval)
    {
      const double parts = array->GetComponent(
        value / array->GetNumberOfComponents(), value % array->GetNumberOfComponents());
      if (!(parts >= 1.0 && parts <= MostParts))
      {
        throw Error(
          where, "value " + std::to_string(value) + " is " + std::to_string(parts), remedy);
      }
      refinement.Parts[axis].push_back(static_cast<int>(parts));
      ++value;
    }
  }
  return refinement;
}

//------------------------------------------------------------------------------
std::size_t SceneCells(const SmokeBlock& block)
{
  return block.Refinement.None() ? static_cast<std::size_t>(block.Grid->GetNumberOfCells())
                                 : block.Refinement.Cells();
}

} // namespace smokevis
