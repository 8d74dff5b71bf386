// Samples flat grids of FDS slices.
#include "SliceSampler.h"

#include "SceneBlocks.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkProbeFilter.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace smokevis
{
namespace
{

struct Slice
{
  vtkDataSet* Grid;
  std::string Array;
  /// Height above or below the image.
  double Away;
};

bool EndsWith(const char* name, const std::string& ending)
{
  const std::string text = name ? name : "";
  return text.size() >= ending.size() &&
         text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
}

/// Name of the array of a quantity, or nothing.
std::string FindArray(vtkDataSet* grid, const std::string& quantity)
{
  for (vtkDataSetAttributes* const data :
    std::initializer_list<vtkDataSetAttributes*>{grid->GetPointData(), grid->GetCellData()})
  {
    for (int i = 0; i < data->GetNumberOfArrays(); ++i)
    {
      if (data->GetArray(i) && EndsWith(data->GetArrayName(i), quantity))
      {
        return data->GetArrayName(i);
      }
    }
  }
  return {};
}

void Collect(vtkDataObject* object, const std::string& quantity, double height, double tolerance,
  std::vector<Slice>& slices)
{
  if (auto* const grid = vtkDataSet::SafeDownCast(object))
  {
    const double* const bounds = grid->GetBounds();
    const std::string array = FindArray(grid, quantity);
    const double away = std::abs(bounds[4] - height);
    if (bounds[4] == bounds[5] && !array.empty() && away <= tolerance)
    {
      slices.push_back({grid, array, away});
    }
  }
  for (const Child& child : Children(object))
  {
    Collect(child.Object, quantity, height, tolerance, slices);
  }
}

} // namespace

//------------------------------------------------------------------------------
std::vector<float> SampleSlices(
  vtkDataObject* slices, const std::string& quantity, vtkImageData* image, double tolerance)
{
  std::vector<float> values(image->GetNumberOfPoints(), std::numeric_limits<float>::quiet_NaN());
  std::vector<Slice> found;
  Collect(slices, quantity, image->GetOrigin()[2], tolerance, found);
  std::stable_sort(
    found.begin(), found.end(), [](const Slice& a, const Slice& b) { return a.Away < b.Away; });
  for (const Slice& slice : found)
  {
    vtkNew<vtkImageData> points;
    points->CopyStructure(image);
    points->SetOrigin(image->GetOrigin()[0], image->GetOrigin()[1], slice.Grid->GetBounds()[4]);
    vtkNew<vtkProbeFilter> probe;
    probe->SetInputData(points);
    probe->SetSourceData(slice.Grid);
    probe->Update();
    vtkPointData* const data = probe->GetOutput()->GetPointData();
    vtkDataArray* const mask = data->GetArray(probe->GetValidPointMaskArrayName());
    vtkDataArray* const array = data->GetArray(slice.Array.c_str());
    for (vtkIdType i = 0; mask && array && i < image->GetNumberOfPoints(); ++i)
    {
      const double value = array->GetComponent(i, 0);
      if (std::isnan(values[i]) && mask->GetComponent(i, 0) != 0.0 && value > 0.0)
      {
        values[i] = static_cast<float>(value);
      }
    }
  }
  return values;
}

} // namespace smokevis
