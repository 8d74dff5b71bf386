#include "vtkRouteVisibility.h"

#include "EyeProperties.h"
#include "KeptOutput.h"
#include "LightFieldInput.h"
#include "PointArrays.h"
#include "PropertyChecks.h"
#include "RankTeam.h"
#include "Ranks.h"
#include "RouteInput.h"
#include "RouteWalk.h"
#include "SignList.h"
#include "StepWalk.h"
#include "WholeInput.h"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>
#include <functional>

vtkStandardNewMacro(vtkRouteVisibility);

struct vtkRouteVisibility::Internals
{
  smokevis::KeptOutput Kept;
};

namespace
{

using smokevis::RouteWalker;

/// Adds a point array; `value` tells the value of a component at a place of a walker.
template <class Array>
void AddPoints(vtkPolyData* output, const std::vector<RouteWalker>& walkers, const char* name,
  const std::function<double(const RouteWalker&, std::size_t, int)>& value,
  const std::vector<std::string>& components = {})
{
  Array* const array = smokevis::AddPointArray<Array>(*output, name, components);
  const int width = array->GetNumberOfComponents();
  vtkIdType tuple = 0;
  for (const RouteWalker& walker : walkers)
  {
    for (std::size_t place = 0; place < walker.Way.Place.size(); ++place, ++tuple)
    {
      for (int component = 0; component < width; ++component)
      {
        array->SetComponent(tuple, component, value(walker, place, component));
      }
    }
  }
}

void AddArrays(
  vtkPolyData* output, const std::vector<RouteWalker>& walkers, const smokevis::SignList& signs)
{
  const auto width = signs.Ids.size();
  AddPoints<vtkDoubleArray>(output, walkers, "Time",
    [](const RouteWalker& w, std::size_t i, int) { return w.Way.Time[i]; });
  AddPoints<vtkDoubleArray>(output, walkers, "Distance",
    [](const RouteWalker& w, std::size_t i, int) { return w.Way.Distance[i]; });
  AddPoints<vtkDoubleArray>(
    output, walkers, "Speed", [](const RouteWalker& w, std::size_t i, int) { return w.Speed[i]; });
  AddPoints<vtkDoubleArray>(output, walkers, "Extinction",
    [](const RouteWalker& w, std::size_t i, int) { return w.Extinction[i]; });
  AddPoints<vtkFloatArray>(output, walkers, "Visibility",
    [](const RouteWalker& w, std::size_t i, int) { return w.Sight.Visibility[i]; });
  AddPoints<vtkIntArray>(output, walkers, "BestSign",
    [](const RouteWalker& w, std::size_t i, int) { return w.BestSign[i]; });
  AddPoints<vtkFloatArray>(
    output, walkers, "PerceivedContrast",
    [width](const RouteWalker& w, std::size_t i, int sign)
    { return w.PerceivedContrast[i * width + sign]; },
    signs.Names);
  AddPoints<vtkIntArray>(output, walkers, "Status",
    [](const RouteWalker& w, std::size_t i, int) { return static_cast<double>(w.Status[i]); });
  AddPoints<vtkIntArray>(output, walkers, "BeyondTimes",
    [](const RouteWalker& w, std::size_t i, int) { return w.Beyond[i] ? 1.0 : 0.0; });
  output->GetPointData()->SetActiveScalars("Visibility");
}

void AddSummary(vtkPolyData* output, const std::vector<RouteWalker>& walkers, double threshold)
{
  const auto add = [output](const char* name, int components)
  {
    vtkNew<vtkDoubleArray> array;
    array->SetName(name);
    array->SetNumberOfComponents(components);
    output->GetFieldData()->AddArray(array);
    return array.Get();
  };
  vtkDoubleArray* const length = add("RouteLength", 1);
  vtkDoubleArray* const duration = add("RouteTime", 1);
  vtkDoubleArray* const dark = add("InvisibleTime", 1);
  vtkDoubleArray* const darkWay = add("InvisibleDistance", 1);
  vtkDoubleArray* const longest = add("LongestInvisibleTime", 1);
  vtkDoubleArray* const lossTime = add("FirstLossTime", 1);
  vtkDoubleArray* const lossDistance = add("FirstLossDistance", 1);
  vtkDoubleArray* const lossPlace = add("FirstLossPlace", 3);
  vtkDoubleArray* const least = add("LeastVisibility", 1);
  for (const RouteWalker& walker : walkers)
  {
    const smokevis::RouteSummary summary = smokevis::Summarize(walker.Way, walker.Sight, threshold);
    length->InsertNextValue(summary.Length);
    duration->InsertNextValue(summary.Duration);
    dark->InsertNextValue(summary.InvisibleTime);
    darkWay->InsertNextValue(summary.InvisibleDistance);
    longest->InsertNextValue(summary.LongestInvisibleTime);
    lossTime->InsertNextValue(summary.FirstLossTime);
    lossDistance->InsertNextValue(summary.FirstLossDistance);
    lossPlace->InsertNextTuple(&summary.FirstLossPlace.x);
    least->InsertNextValue(summary.LeastVisibility);
  }
}

/// Progress after so many time steps: nobody knows how many a walk takes, but it never falls.
double ShareOf(std::size_t steps, bool last)
{
  return last ? 1.0 : 1.0 - 1.0 / (1.0 + static_cast<double>(steps));
}

void AddLines(vtkPolyData* output, const std::vector<RouteWalker>& walkers)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> lines;
  for (const RouteWalker& walker : walkers)
  {
    lines->InsertNextCell(static_cast<int>(walker.Way.Place.size()));
    for (const smokevis::Vec3& place : walker.Way.Place)
    {
      lines->InsertCellPoint(points->InsertNextPoint(&place.x));
    }
  }
  output->SetPoints(points);
  output->SetLines(lines);
}

} // namespace

//------------------------------------------------------------------------------
vtkRouteVisibility::vtkRouteVisibility() : Implementation(std::make_unique<Internals>())
{
  this->SetNumberOfInputPorts(2);
}

//------------------------------------------------------------------------------
vtkRouteVisibility::~vtkRouteVisibility() = default;

//------------------------------------------------------------------------------
int vtkRouteVisibility::ComputePipelineMTime(
  vtkInformation*, vtkInformationVector**, vtkInformationVector*, int, vtkMTimeType* mtime)
{
  *mtime = this->Implementation->Kept.PipelineMTime(this->GetMTime());
  return 1;
}

//------------------------------------------------------------------------------
int vtkRouteVisibility::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(
    vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), port == 0 ? "vtkCompositeDataSet" : "vtkPolyData");
  if (port == 1)
  {
    info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkTable");
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkRouteVisibility::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  smokevis::DropTime(outputVector->GetInformationObject(0));
  smokevis::HandlePieces(outputVector);
  return 1;
}

//------------------------------------------------------------------------------
int vtkRouteVisibility::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  smokevis::RequestWholeInputs(inputVector[0]);
  smokevis::RequestWholeInputs(inputVector[1]);
  const std::vector<double> steps = smokevis::TimeSteps(inputVector[0]->GetInformationObject(0));
  if (!steps.empty())
  {
    // A trajectory may begin elsewhere; that is known once its points are.
    const auto after = std::upper_bound(steps.begin(), steps.end(), this->StartTime);
    smokevis::AskForTime(inputVector[0], after == steps.begin() ? steps.front() : *(after - 1));
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkRouteVisibility::CheckProperties() const
{
  smokevis::Check(std::isfinite(this->StartTime), "StartTime", "it is not finite", "Give seconds");
  smokevis::CheckPositive(this->WalkingSpeed, "WalkingSpeed", "Give metres a second, such as 1.19");
  smokevis::CheckPositive(this->SpeedVisibilityFactor, "SpeedVisibilityFactor",
    "Give 2 for what reflects light, 8 for what emits it");
  smokevis::CheckNotNegative(this->EyeHeight, "EyeHeight", "Give metres above the floor");
  smokevis::CheckPositive(this->SampleSpacing, "SampleSpacing", "Give metres");
  smokevis::CheckPositive(this->SampleInterval, "SampleInterval", "Give seconds");
  smokevis::CheckNotNegative(
    this->ContrastThreshold, "ContrastThreshold", "Give 0.2 for the point of disappearance");
}

//------------------------------------------------------------------------------
void vtkRouteVisibility::Compute(
  vtkInformationVector* lightField, vtkDataObject* routes, vtkPolyData* output)
{
  this->CheckProperties();
  std::vector<RouteWalker> walkers;
  for (const smokevis::RouteCorners& route : smokevis::ReadRoutes(routes))
  {
    walkers.emplace_back().Way =
      smokevis::SampleRoute(route.Corners, route.Times, this->SampleSpacing, this->SampleInterval);
  }
  smokevis::RouteOptions options;
  options.EyeHeight = this->EyeHeight;
  options.StartTime = this->StartTime;
  options.Speed = this->WalkingSpeed;
  options.Law = static_cast<smokevis::SpeedLaw>(this->SpeedLaw);
  options.SpeedFactor = this->SpeedVisibilityFactor;
  options.ContrastThreshold = this->ContrastThreshold;
  smokevis::Adaptation state;
  state.Luminance = this->AdaptationLuminance;
  options.Eye = smokevis::CheckedEye(this->DarkLuminance, this->Acuity, state);
  options.AdaptationLuminance = this->AdaptationLuminance;
  smokevis::RouteWalk walk(std::move(walkers), options);

  const std::vector<double> steps = smokevis::TimeSteps(lightField->GetInformationObject(0));
  std::vector<double> used;
  // The light fields of two steps, the later one in `current`.
  smokevis::LightFieldInput inputs[2];
  int current = 0;
  smokevis::RouteFrame before, after;
  const auto load = [&](double time)
  {
    if (!steps.empty())
    {
      smokevis::UpdateToTime(lightField, time);
    }
    current = 1 - current;
    before = after;
    smokevis::Ranks().Together(this,
      [&] {
        after = {time, &inputs[current].Get(vtkDataObject::GetData(lightField))};
      });
    used.push_back(time);
  };
  double done = 0.0;
  const auto advance = [&](const smokevis::RouteFrame& from, bool last)
  {
    // All processes of a parallel run walk on to the next step, or none does.
    smokevis::RankTeam(this).Run(done, ShareOf(used.size(), last),
      [&](smokevis::Progress& progress) { walk.Advance(from, after, last, progress); });
    done = ShareOf(used.size(), last);
  };
  if (steps.empty())
  {
    load(this->StartTime);
    advance(after, true);
  }
  else
  {
    const auto first = std::upper_bound(steps.begin(), steps.end(), walk.StartTime());
    auto step = first == steps.begin() ? first : first - 1;
    load(*step);
    if (step + 1 == steps.end())
    {
      advance(after, true);
    }
    while (!walk.Done())
    {
      ++step;
      load(*step);
      advance(before, step + 1 == steps.end());
    }
  }

  const smokevis::SignList signs = inputs[current].Signs();
  AddLines(output, walk.Walkers());
  AddArrays(output, walk.Walkers(), signs);
  AddSummary(output, walk.Walkers(), this->ContrastThreshold);
  smokevis::AddSignList(*output, signs);
  smokevis::AddFieldNumber(*output, "ContrastThreshold", {this->ContrastThreshold});
  vtkNew<vtkDoubleArray> times;
  times->SetName("TimeStepsUsed");
  for (const double time : used)
  {
    times->InsertNextValue(time);
  }
  output->GetFieldData()->AddArray(times);
}

//------------------------------------------------------------------------------
int vtkRouteVisibility::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const int done = this->Implementation->Kept.Produce(this, outputVector,
    [&]
    {
      this->Compute(
        inputVector[0], vtkDataObject::GetData(inputVector[1]), vtkPolyData::GetData(outputVector));
    });
  smokevis::LeaveToFirstPiece(outputVector);
  return done;
}

//------------------------------------------------------------------------------
void vtkRouteVisibility::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "StartTime: " << this->StartTime << "\n";
  os << indent << "WalkingSpeed: " << this->WalkingSpeed << "\n";
  os << indent << "SpeedLaw: " << this->SpeedLaw << "\n";
  os << indent << "SpeedVisibilityFactor: " << this->SpeedVisibilityFactor << "\n";
  os << indent << "EyeHeight: " << this->EyeHeight << "\n";
  os << indent << "SampleSpacing: " << this->SampleSpacing << "\n";
  os << indent << "SampleInterval: " << this->SampleInterval << "\n";
  os << indent << "ContrastThreshold: " << this->ContrastThreshold << "\n";
  os << indent << "DarkLuminance: " << this->DarkLuminance << "\n";
  os << indent << "Acuity: " << this->Acuity << "\n";
  os << indent << "AdaptationLuminance: " << this->AdaptationLuminance << "\n";
}
