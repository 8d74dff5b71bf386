// A source of floor maps with given values at given times, for tests of filters that walk through
// time.
#pragma once

#include <vtkFloatArray.h>
#include <vtkImageAlgorithm.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkStringArray.h>

#include <algorithm>
#include <vector>

/// Two signs, of the ids 3 and 8. The places lie in a row along x. Contrast[step][place][sign]; a
/// contrast below 0 stands for a sign that is not in view, below -1 for a place inside a solid.
class MapSeries : public vtkImageAlgorithm
{
public:
  static MapSeries* New() { VTK_STANDARD_NEW_BODY(MapSeries); }
  vtkTypeMacro(MapSeries, vtkImageAlgorithm);

  std::vector<double> Times;
  std::vector<std::vector<std::vector<float>>> Contrast;
  /// The step that fails, -1: none.
  int Fails = -1;
  int Runs = 0;

protected:
  MapSeries() { this->SetNumberOfInputPorts(0); }

  int Places() const { return static_cast<int>(this->Contrast[0].size()); }

  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector) override
  {
    vtkInformation* const info = outputVector->GetInformationObject(0);
    using Pipeline = vtkStreamingDemandDrivenPipeline;
    const int extent[6] = {0, this->Places() - 1, 0, 0, 0, 0};
    info->Set(Pipeline::WHOLE_EXTENT(), extent, 6);
    info->Set(Pipeline::TIME_STEPS(), this->Times.data(), static_cast<int>(this->Times.size()));
    const double range[2] = {this->Times.front(), this->Times.back()};
    info->Set(Pipeline::TIME_RANGE(), range, 2);
    return 1;
  }

  int RequestData(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector) override
  {
    vtkInformation* const info = outputVector->GetInformationObject(0);
    const double time = info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP());
    const auto step = std::lower_bound(this->Times.begin(), this->Times.end(), time - 1e-9);
    const auto index = std::min<std::ptrdiff_t>(
      step - this->Times.begin(), static_cast<std::ptrdiff_t>(this->Times.size()) - 1);
    ++this->Runs;
    if (index == this->Fails)
    {
      return 0;
    }
    vtkImageData* const image = vtkImageData::GetData(outputVector);
    image->SetDimensions(this->Places(), 1, 1);
    image->SetOrigin(0.5, 2.0, 1.7);
    vtkNew<vtkFloatArray> visibility, contrast;
    vtkNew<vtkIntArray> best, status, ids;
    visibility->SetName("Visibility");
    contrast->SetName("PerceivedContrast");
    contrast->SetNumberOfComponents(2);
    contrast->SetComponentName(0, "North");
    contrast->SetComponentName(1, "South");
    best->SetName("BestSign");
    status->SetName("Status");
    ids->SetName("SignIds");
    ids->InsertNextValue(3);
    ids->InsertNextValue(8);
    for (const std::vector<float>& place : this->Contrast[index])
    {
      const bool second = place[1] > place[0];
      const float most = std::max(place[0], place[1]);
      visibility->InsertNextValue(std::max(0.0F, most));
      best->InsertNextValue(most < 0.0F ? -1 : ids->GetValue(second ? 1 : 0));
      status->InsertNextValue(most < -1.0F ? 3 : (most < 0.0F ? 2 : (most < 0.2F ? 1 : 0)));
      contrast->InsertNextTuple2(std::max(0.0F, place[0]), std::max(0.0F, place[1]));
    }
    for (vtkDataArray* const array : std::initializer_list<vtkDataArray*>{
           visibility.Get(), contrast.Get(), best.Get(), status.Get()})
    {
      image->GetPointData()->AddArray(array);
    }
    vtkNew<vtkStringArray> names;
    names->SetName("SignNames");
    names->InsertNextValue("North");
    names->InsertNextValue("South");
    image->GetFieldData()->AddArray(ids);
    image->GetFieldData()->AddArray(names);
    return 1;
  }
};
