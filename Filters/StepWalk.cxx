// Time steps, asked for one by one.
#include "StepWalk.h"

#include "Errors.h"
#include "WholeInput.h"

#include <vtkDataObject.h>
#include <vtkExecutive.h>
#include <vtkInformation.h>
#include <vtkInformationExecutivePortKey.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <string>

namespace smokevis
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

//------------------------------------------------------------------------------
std::vector<double> TimeSteps(vtkInformation* info)
{
  if (!info->Has(Pipeline::TIME_STEPS()))
  {
    return {};
  }
  const double* const first = info->Get(Pipeline::TIME_STEPS());
  return {first, first + info->Length(Pipeline::TIME_STEPS())};
}

//------------------------------------------------------------------------------
void DropTime(vtkInformation* output)
{
  output->Remove(Pipeline::TIME_STEPS());
  output->Remove(Pipeline::TIME_RANGE());
}

//------------------------------------------------------------------------------
std::vector<double> ChooseSteps(const std::vector<double>& steps, const double range[2], int stride)
{
  if (stride < 1)
  {
    throw Error("Stride", "it is below 1", "Give 1 for every time step");
  }
  if (steps.empty())
  {
    throw Error("the input", "it has no time steps",
      "Connect a filter whose smoke comes from a reader with time steps");
  }
  std::vector<double> inside;
  for (const double step : steps)
  {
    if (range[0] > range[1] || (step >= range[0] && step <= range[1]))
    {
      inside.push_back(step);
    }
  }
  if (inside.empty())
  {
    throw Error("TimeRange", "no time step lies within it",
      "Steps are from " + std::to_string(steps.front()) + " to " + std::to_string(steps.back()) +
        " s; give (1, -1) for all of them");
  }
  std::vector<double> chosen;
  for (std::size_t i = 0; i < inside.size(); i += static_cast<std::size_t>(stride))
  {
    chosen.push_back(inside[i]);
  }
  if (chosen.back() != inside.back())
  {
    chosen.push_back(inside.back());
  }
  return chosen;
}

//------------------------------------------------------------------------------
void AskForTime(vtkInformationVector* input, double time)
{
  RequestWholeInputs(input);
  input->GetInformationObject(0)->Set(Pipeline::UPDATE_TIME_STEP(), time);
}

//------------------------------------------------------------------------------
void UpdateToTime(vtkInformationVector* input, double time)
{
  vtkExecutive* producer = nullptr;
  int port = 0;
  vtkExecutive::PRODUCER()->Get(input->GetInformationObject(0), producer, port);
  AskForTime(input, time);
  auto* const pipeline = Pipeline::SafeDownCast(producer);
  if (!pipeline || !pipeline->Update(port))
  {
    throw Error("the input at " + std::to_string(time) + " s", "it could not be made",
      "See the error of the filter before this one");
  }
  // What was given up wants to be done: it stays newer than what it put out.
  pipeline->UpdatePipelineMTime();
  vtkDataObject* const data = vtkDataObject::GetData(input);
  if (!data || pipeline->GetPipelineMTime() > data->GetUpdateTime())
  {
    throw StoppedUpstream("the input at " + std::to_string(time) + " s", "it was stopped",
      "Update again to have it done");
  }
}

} // namespace smokevis
