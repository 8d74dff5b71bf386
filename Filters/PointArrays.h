// Adds arrays to the points of an output.
#pragma once

#include <vtkDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <algorithm>
#include <string>
#include <vector>

namespace smokevis
{

/// Adds a point array, to be filled, with a component for each name, or with one without a name.
template <class Array>
Array* AddPointArray(
  vtkDataSet& data, const char* name, const std::vector<std::string>& components = {})
{
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfComponents(std::max(1, static_cast<int>(components.size())));
  array->SetNumberOfTuples(data.GetNumberOfPoints());
  for (std::size_t i = 0; i < components.size(); ++i)
  {
    if (!components[i].empty())
    {
      array->SetComponentName(static_cast<vtkIdType>(i), components[i].c_str());
    }
  }
  data.GetPointData()->AddArray(array);
  return array;
}

/// Adds a point array with the given values, tuple after tuple.
template <class Array, class Values>
void AddPointValues(vtkDataSet& data, const char* name, const Values& values,
  const std::vector<std::string>& components = {})
{
  Array* const array = AddPointArray<Array>(data, name, components);
  for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
  {
    array->SetValue(i, static_cast<typename Array::ValueType>(values[i]));
  }
}

} // namespace smokevis
