#include "vtkVisibilityOverTime.h"

#include "Errors.h"
#include "KeptOutput.h"
#include "LightFieldInput.h"
#include "PointArrays.h"
#include "Ranks.h"
#include "StepWalk.h"
#include "VisibilityHistory.h"
#include "WholeInput.h"
#include "vtkFloorMapOfVisibility.h"

#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkIntArray.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>

vtkStandardNewMacro(vtkVisibilityOverTime);

struct vtkVisibilityOverTime::Internals
{
  smokevis::KeptOutput Kept;
};

namespace
{

constexpr double PointOfDisappearance = 0.2;

using smokevis::Error;

vtkDataArray* NeededArray(vtkImageData* map, const char* name)
{
  vtkDataArray* const array = map->GetPointData()->GetArray(name);
  if (!array || array->GetNumberOfComponents() != 1)
  {
    throw Error("the input", std::string("it has no point array ") + name,
      "Give the output of FloorMapOfVisibility, or files that it was saved to");
  }
  return array;
}

/// What the components of an array are called.
std::vector<std::string> ComponentNames(vtkDataArray* array)
{
  std::vector<std::string> names;
  for (int i = 0; i < array->GetNumberOfComponents(); ++i)
  {
    const char* const name = array->GetComponentName(i);
    names.emplace_back(name ? name : "");
  }
  return names;
}

smokevis::VisibilityFrame Frame(vtkImageData* map, double time)
{
  vtkDataArray* const visibility = NeededArray(map, "Visibility");
  vtkDataArray* const sign = NeededArray(map, "BestSign");
  vtkDataArray* const status = NeededArray(map, "Status");
  smokevis::VisibilityFrame frame;
  frame.Time = time;
  for (vtkIdType i = 0; i < map->GetNumberOfPoints(); ++i)
  {
    frame.Visibility.push_back(static_cast<float>(visibility->GetComponent(i, 0)));
    frame.BestSign.push_back(static_cast<int>(sign->GetComponent(i, 0)));
    frame.InsideSolid.push_back(
      static_cast<int>(status->GetComponent(i, 0)) == vtkFloorMapOfVisibility::INSIDE_SOLID);
  }
  return frame;
}

/// The same for each sign: a place of the frame is a place and a sign of the map.
smokevis::VisibilityFrame SignFrame(vtkImageData* map, double time)
{
  vtkDataArray* const contrast = map->GetPointData()->GetArray("PerceivedContrast");
  vtkDataArray* const shown = map->GetPointData()->GetArray("VisibleFraction");
  smokevis::VisibilityFrame frame;
  frame.Time = time;
  for (vtkIdType i = 0; contrast && i < contrast->GetNumberOfTuples(); ++i)
  {
    for (int sign = 0; sign < contrast->GetNumberOfComponents(); ++sign)
    {
      const auto value = static_cast<float>(contrast->GetComponent(i, sign));
      const bool inView = shown && sign < shown->GetNumberOfComponents()
                            ? shown->GetComponent(i, sign) > 0.0
                            : value > 0.0F;
      frame.Visibility.push_back(value);
      frame.BestSign.push_back(inView ? sign : -1);
    }
  }
  frame.InsideSolid.resize(frame.Visibility.size());
  return frame;
}

} // namespace

//------------------------------------------------------------------------------
vtkVisibilityOverTime::vtkVisibilityOverTime() : Implementation(std::make_unique<Internals>())
{
}

//------------------------------------------------------------------------------
vtkVisibilityOverTime::~vtkVisibilityOverTime() = default;

//------------------------------------------------------------------------------
int vtkVisibilityOverTime::ComputePipelineMTime(
  vtkInformation*, vtkInformationVector**, vtkInformationVector*, int, vtkMTimeType* mtime)
{
  *mtime = this->Implementation->Kept.PipelineMTime(this->GetMTime());
  return 1;
}

//------------------------------------------------------------------------------
int vtkVisibilityOverTime::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  smokevis::DropTime(outputVector->GetInformationObject(0));
  smokevis::HandlePieces(outputVector);
  return 1;
}

//------------------------------------------------------------------------------
int vtkVisibilityOverTime::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  try
  {
    smokevis::AskForTime(inputVector[0], this->Steps(inputVector[0]).front());
  }
  catch (const smokevis::Error&)
  {
    // RequestData runs into it again, and tells of it once.
    smokevis::RequestWholeInputs(inputVector[0]);
  }
  return 1;
}

//------------------------------------------------------------------------------
std::vector<double> vtkVisibilityOverTime::Steps(vtkInformationVector* input) const
{
  return smokevis::ChooseSteps(
    smokevis::TimeSteps(input->GetInformationObject(0)), this->TimeRange, this->Stride);
}

//------------------------------------------------------------------------------
double vtkVisibilityOverTime::Threshold(vtkImageData* map) const
{
  double threshold = PointOfDisappearance;
  if (this->ContrastThreshold >= 0.0)
  {
    return this->ContrastThreshold;
  }
  smokevis::FieldNumber(map, "ContrastThreshold", 0, threshold);
  return threshold;
}

//------------------------------------------------------------------------------
void vtkVisibilityOverTime::Compute(vtkInformationVector* input, vtkImageData* output)
{
  const std::vector<double> steps = this->Steps(input);
  vtkImageData* const map = vtkImageData::GetData(input);
  const double threshold = this->Threshold(map);
  const vtkIdType places = map->GetNumberOfPoints();
  smokevis::VisibilityHistory history(places, threshold);
  vtkDataArray* const contrast = map->GetPointData()->GetArray("PerceivedContrast");
  smokevis::VisibilityHistory signHistory(
    contrast ? static_cast<std::size_t>(contrast->GetNumberOfValues()) : 0, threshold);
  for (std::size_t i = 0; i < steps.size(); ++i)
  {
    smokevis::UpdateToTime(input, steps[i]);
    // All processes of a parallel run ask for the next step, or none does.
    smokevis::Ranks().Together(this,
      [&]
      {
        history.Add(Frame(map, steps[i]));
        signHistory.Add(SignFrame(map, steps[i]));
        this->UpdateProgress(static_cast<double>(i + 1) / static_cast<double>(steps.size()));
        if (this->CheckAbort())
        {
          throw Error("visibility over time", "the work was stopped");
        }
      });
  }

  const smokevis::VisibilityHistory::Summary summary = history.Finish();
  output->CopyStructure(map);
  smokevis::AddPointValues<vtkDoubleArray>(*output, "AvailableTime", summary.AvailableTime);
  smokevis::AddPointValues<vtkDoubleArray>(
    *output, "AvailableTimeInterval", summary.AvailableTimeInterval);
  smokevis::AddPointValues<vtkDoubleArray>(*output, "FinalLossTime", summary.FinalLossTime);
  smokevis::AddPointValues<vtkDoubleArray>(*output, "InvisibleTime", summary.InvisibleTime);
  smokevis::AddPointValues<vtkIntArray>(*output, "FirstSign", summary.FirstSign);
  smokevis::AddPointValues<vtkIntArray>(*output, "LastSign", summary.LastSign);
  smokevis::AddPointValues<vtkFloatArray>(*output, "LeastVisibility", summary.LeastVisibility);
  smokevis::AddPointValues<vtkIntArray>(*output, "Outcome", summary.Outcome);
  if (vtkDataArray* const signs = map->GetPointData()->GetArray("PerceivedContrast"))
  {
    smokevis::AddPointValues<vtkDoubleArray>(
      *output, "SignAvailableTime", signHistory.Finish().AvailableTime, ComponentNames(signs));
  }
  output->GetPointData()->SetActiveScalars("AvailableTime");
  for (const char* const name : {"SignIds", "SignNames"})
  {
    if (vtkAbstractArray* const array = map->GetFieldData()->GetAbstractArray(name))
    {
      output->GetFieldData()->AddArray(array);
    }
  }
  smokevis::AddFieldNumber(*output, "TimeRange", {history.FirstTime(), history.LastTime()});
  smokevis::AddFieldNumber(*output, "TimeSteps", {static_cast<double>(steps.size())});
  smokevis::AddFieldNumber(*output, "ContrastThreshold", {threshold});
  smokevis::AddFieldTexts(*output, "OutcomeNames",
    {"kept", "lost", "interrupted", "never visible", "no sign in view", "inside a solid"});
}

//------------------------------------------------------------------------------
int vtkVisibilityOverTime::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const int done = this->Implementation->Kept.Produce(this, outputVector,
    [&] { this->Compute(inputVector[0], vtkImageData::GetData(outputVector)); });
  smokevis::LeaveToFirstPiece(outputVector);
  return done;
}

//------------------------------------------------------------------------------
void vtkVisibilityOverTime::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "TimeRange: (" << this->TimeRange[0] << ", " << this->TimeRange[1] << ")\n";
  os << indent << "Stride: " << this->Stride << "\n";
  os << indent << "ContrastThreshold: " << this->ContrastThreshold << "\n";
}
