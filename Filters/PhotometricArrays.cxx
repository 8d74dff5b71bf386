// Reads and writes intensity tables as VTK arrays.
#include "PhotometricArrays.h"

#include "Errors.h"
#include "Sampler.h"
#include "SceneBlocks.h"

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>

#include <algorithm>
#include <bit>

namespace smokevis
{
namespace
{

const char* const Remedy = "Give the output of Luminaire as it is; filters that append several "
                           "drop field data, so connect each of them to Emitters";

std::string ArrayName(int index, const char* part)
{
  return "Photometry" + std::to_string(index) + part;
}

std::vector<double> Values(vtkPolyData& block, const std::string& where, const std::string& name)
{
  vtkDataArray* const array = block.GetFieldData()->GetArray(name.c_str());
  if (!array)
  {
    throw Error(where, "its field data have no array " + name, Remedy);
  }
  std::vector<double> values(array->GetNumberOfTuples());
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    values[i] = array->GetComponent(static_cast<vtkIdType>(i), 0);
  }
  return values;
}

void AddValues(vtkPolyData& block, const std::string& name, const std::vector<double>& values)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name.c_str());
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  block.GetFieldData()->AddArray(array);
}

} // namespace

//------------------------------------------------------------------------------
PhotometricArrays::PhotometricArrays(vtkPolyData& block, const std::string& blockName)
    : Index_(CellArray(block, blockName, IndexName, false)),
      Axis_(CellArray(block, blockName, AxisName, true))
{
  const std::string where = "emitter block '" + blockName + "'";
  for (vtkIdType cell = 0; this->Index_ && cell < block.GetNumberOfCells(); ++cell)
  {
    const int index = static_cast<int>(this->Index_->GetComponent(cell, 0));
    if (index < 0 || this->Tables_.count(index) > 0)
    {
      continue;
    }
    if (!this->Axis_ || this->Axis_->GetNumberOfComponents() != 3)
    {
      throw Error(
        where, std::string("it has no cell array ") + AxisName + " of three components", Remedy);
    }
    this->Tables_[index] =
      std::make_shared<IntensityTable>(Values(block, where, ArrayName(index, "Polar")),
        Values(block, where, ArrayName(index, "Azimuth")),
        Values(block, where, ArrayName(index, "Intensity")),
        where + ", photometry " + std::to_string(index));
  }
}

//------------------------------------------------------------------------------
std::shared_ptr<const IntensityTable> PhotometricArrays::Table(vtkIdType cell) const
{
  if (!this->Index_)
  {
    return nullptr;
  }
  const auto found = this->Tables_.find(static_cast<int>(this->Index_->GetComponent(cell, 0)));
  return found == this->Tables_.end() ? nullptr : found->second;
}

//------------------------------------------------------------------------------
Vec3 PhotometricArrays::Axis(vtkIdType cell) const
{
  if (!this->Table(cell))
  {
    return Vec3(0.0);
  }
  return {this->Axis_->GetComponent(cell, 0), this->Axis_->GetComponent(cell, 1),
    this->Axis_->GetComponent(cell, 2)};
}

//------------------------------------------------------------------------------
int PhotometricArrays::AddTable(vtkPolyData& block, const std::vector<double>& polar,
  const std::vector<double>& azimuth, const std::vector<double>& intensity)
{
  std::uint64_t hash = 0;
  for (const auto* const values : {&polar, &azimuth, &intensity})
  {
    for (const double value : *values)
    {
      hash = Mix(hash ^ std::bit_cast<std::uint64_t>(value));
    }
  }
  const auto index = static_cast<int>(hash >> 33);
  AddValues(block, ArrayName(index, "Polar"), polar);
  AddValues(block, ArrayName(index, "Azimuth"), azimuth);
  AddValues(block, ArrayName(index, "Intensity"), intensity);
  return index;
}

} // namespace smokevis
