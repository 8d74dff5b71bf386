// Arrays of a light field, made and read.
#pragma once

#include "Errors.h"
#include "Types.h"

#include <vtkCellData.h>
#include <vtkDataSet.h>
#include <vtkFloatArray.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace smokevis
{

inline vtkSmartPointer<vtkFloatArray> MakeArray(const char* name, int components, vtkIdType tuples)
{
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  return array;
}

/// An array of the cells of a block.
/// @param names of its components, where it has three
inline vtkSmartPointer<vtkFloatArray> AddArray(vtkDataSet& block, const char* name, int components,
  const std::array<const char*, 3>& names = {"R", "G", "B"})
{
  auto array = MakeArray(name, components, block.GetNumberOfCells());
  for (int component = 0; component < components && components == 3; ++component)
  {
    array->SetComponentName(component, names[component]);
  }
  block.GetCellData()->AddArray(array);
  return array;
}

inline void CopyLanes(const Lanes& lanes, float* target)
{
  std::copy(lanes.Value, lanes.Value + Batches, target);
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

} // namespace smokevis
