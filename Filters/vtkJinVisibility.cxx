#include "vtkJinVisibility.h"

#include "Errors.h"
#include "KeptOutput.h"
#include "LightFieldInput.h"
#include "PipelineProgress.h"
#include "PointArrays.h"
#include "PropertyChecks.h"
#include "Ranks.h"
#include "ReportedLoop.h"
#include "SightLine.h"
#include "SignList.h"
#include "SliceSampler.h"
#include "WholeInput.h"
#include "vtkFloorMapOfVisibility.h"

#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>

#include <array>
#include <cmath>
#include <limits>

vtkStandardNewMacro(vtkJinVisibility);

struct vtkJinVisibility::Internals
{
  smokevis::KeptOutput Kept;
};

namespace
{

using smokevis::Error;
using smokevis::SightLine;
using smokevis::Vec3;

constexpr float NotANumber = std::numeric_limits<float>::quiet_NaN();
constexpr int Categories = vtkJinVisibility::NOT_KNOWN + 1;

/// The category of a place, from what the map says of it and whether the practice sees a sign.
int Compare(int status, bool inView, bool seen)
{
  if (status == vtkFloorMapOfVisibility::INSIDE_SOLID)
  {
    return vtkJinVisibility::INSIDE_SOLID;
  }
  if (!inView && status == vtkFloorMapOfVisibility::NO_SIGN_IN_VIEW)
  {
    return vtkJinVisibility::NO_SIGN_IN_VIEW;
  }
  if (status == vtkFloorMapOfVisibility::SEEN)
  {
    return seen ? vtkJinVisibility::SEEN_BY_BOTH : vtkJinVisibility::MAP_ONLY;
  }
  return seen ? vtkJinVisibility::PRACTICE_ONLY : vtkJinVisibility::SEEN_BY_NEITHER;
}

void AddCounts(vtkImageData* image, const char* name)
{
  vtkDataArray* const categories = image->GetPointData()->GetArray(name);
  std::array<int, Categories> counts{};
  for (vtkIdType i = 0; i < categories->GetNumberOfTuples(); ++i)
  {
    ++counts[static_cast<std::size_t>(categories->GetComponent(i, 0))];
  }
  vtkNew<vtkIntArray> array;
  array->SetName((std::string(name) + "Count").c_str());
  for (const int count : counts)
  {
    array->InsertNextValue(count);
  }
  image->GetFieldData()->AddArray(array);
}

} // namespace

//------------------------------------------------------------------------------
vtkJinVisibility::vtkJinVisibility() : Implementation(std::make_unique<Internals>())
{
  this->SetNumberOfInputPorts(3);
}

//------------------------------------------------------------------------------
vtkJinVisibility::~vtkJinVisibility() = default;

//------------------------------------------------------------------------------
int vtkJinVisibility::ComputePipelineMTime(
  vtkInformation*, vtkInformationVector**, vtkInformationVector*, int, vtkMTimeType* mtime)
{
  *mtime = this->Implementation->Kept.PipelineMTime(this->GetMTime());
  return 1;
}

//------------------------------------------------------------------------------
int vtkJinVisibility::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(
    vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), port == 1 ? "vtkImageData" : "vtkCompositeDataSet");
  if (port == 2)
  {
    info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkJinVisibility::RequestInformation(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  vtkInformation* const map = inputVector[1]->GetInformationObject(0);
  if (map->Has(Pipeline::WHOLE_EXTENT()))
  {
    outputVector->GetInformationObject(0)->Set(
      Pipeline::WHOLE_EXTENT(), map->Get(Pipeline::WHOLE_EXTENT()), 6);
  }
  smokevis::HandlePieces(outputVector);
  return 1;
}

//------------------------------------------------------------------------------
int vtkJinVisibility::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  for (int port = 0; port < this->GetNumberOfInputPorts(); ++port)
  {
    smokevis::RequestWholeInputs(inputVector[port]);
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkJinVisibility::CheckProperties() const
{
  smokevis::CheckPositive(
    this->VisibilityFactor, "VisibilityFactor", "Give 3 for signs that reflect, 8 for lit");
  smokevis::CheckPositive(
    this->InherentContrast, "InherentContrast", "Give 1 for a black plate with lit parts");
  smokevis::CheckPositive(this->LiminalContrast, "LiminalContrast", "Give 0.02, after Koschmieder");
  smokevis::CheckPositive(
    this->MaximumVisibility, "MaximumVisibility", "Give metres, 30 as FDS does");
  smokevis::CheckNotNegative(this->SliceTolerance, "SliceTolerance", "Give metres from 0");
}

//------------------------------------------------------------------------------
void vtkJinVisibility::Compute(
  vtkDataObject* lightField, vtkImageData* map, vtkDataObject* slices, vtkImageData* output)
{
  this->CheckProperties();
  vtkDataArray* const status = map ? map->GetPointData()->GetArray("Status") : nullptr;
  if (!status)
  {
    throw Error("FloorMap", "it has no point array Status",
      "Connect a FloorMapOfVisibility, or a file that it was saved to");
  }
  smokevis::SceneBlocks blocks;
  const smokevis::Scene scene(smokevis::DescribeScene(lightField, blocks));
  const std::vector<smokevis::Sign>& signs = scene.Lights().Signs();
  if (signs.empty())
  {
    throw Error("LightField", "it holds no sign",
      "Give emitters with a SignId from 0, such as the source ExitSign makes");
  }
  const smokevis::SignList list =
    smokevis::ListSigns(scene, smokevis::ReadSignNames(blocks.Emitters));

  output->CopyStructure(map);
  auto* const inView = smokevis::AddPointArray<vtkIntArray>(*output, "InView", list.Names);
  auto* const distance =
    smokevis::AddPointArray<vtkFloatArray>(*output, "SightDistance", list.Names);
  auto* const extinction =
    smokevis::AddPointArray<vtkFloatArray>(*output, "MeanExtinction", list.Names);
  auto* const visibility =
    smokevis::AddPointArray<vtkFloatArray>(*output, "JinVisibility", list.Names);
  auto* const depth = smokevis::AddPointArray<vtkFloatArray>(*output, "OpticalDepth");
  auto* const best = smokevis::AddPointArray<vtkIntArray>(*output, "JinSign");
  auto* const contrast = smokevis::AddPointArray<vtkFloatArray>(*output, "BeerLambertContrast");
  auto* const local = smokevis::AddPointArray<vtkFloatArray>(*output, "FDSVisibility");
  auto* const jin = smokevis::AddPointArray<vtkIntArray>(*output, "JinDifference");
  auto* const beer = smokevis::AddPointArray<vtkIntArray>(*output, "BeerLambertDifference");
  auto* const fds = smokevis::AddPointArray<vtkIntArray>(*output, "FDSDifference");
  const std::vector<float> sampled =
    smokevis::SampleSlices(slices, "VISIBILITY", map, this->SliceTolerance);

  const auto place = [&](vtkIdType i)
  {
    Vec3 eye;
    map->GetPoint(i, &eye.x);
    SightLine most;
    int mostSign = -1;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t s = 0; s < signs.size(); ++s)
    {
      const SightLine line = smokevis::LookAtSign(scene, signs[s], eye);
      const auto component = static_cast<int>(s);
      const double farthest =
        std::min(line.JinVisibility(this->VisibilityFactor), this->MaximumVisibility);
      inView->SetTypedComponent(i, component, line.InView ? 1 : 0);
      distance->SetTypedComponent(i, component, static_cast<float>(line.Distance));
      extinction->SetTypedComponent(i, component, static_cast<float>(line.MeanExtinction()));
      visibility->SetTypedComponent(
        i, component, line.InView ? static_cast<float>(farthest) : 0.0F);
      if (line.InView)
      {
        nearest = std::min(nearest, line.Distance);
        if (mostSign < 0 || line.OpticalDepth < most.OpticalDepth)
        {
          most = line;
          mostSign = signs[s].Id;
        }
      }
    }
    const bool any = mostSign >= 0;
    const double arriving = any ? this->InherentContrast * std::exp(-most.OpticalDepth) : 0.0;
    const auto state = static_cast<int>(status->GetComponent(i, 0));
    depth->SetValue(i, any ? static_cast<float>(most.OpticalDepth) : NotANumber);
    best->SetValue(i, mostSign);
    contrast->SetValue(i, static_cast<float>(arriving));
    local->SetValue(i, sampled[i]);
    jin->SetValue(i, Compare(state, any, most.SeenAfterJin(this->VisibilityFactor)));
    beer->SetValue(i, Compare(state, any, any && arriving >= this->LiminalContrast));
    // FDS writes nothing beyond its cap: there it does not limit what is seen.
    const bool reaches = sampled[i] >= this->MaximumVisibility || nearest <= sampled[i];
    fds->SetValue(i, std::isnan(sampled[i]) ? NOT_KNOWN : Compare(state, any, any && reaches));
  };
  const vtkIdType places = map->GetNumberOfPoints();
  smokevis::RunWithProgress(this, 0.1, 0.95,
    [&](smokevis::Progress& progress)
    {
      tbb::task_arena arena{tbb::task_arena::attach()};
      smokevis::ReportedLoop(
        arena, static_cast<std::size_t>(places), 16, progress,
        [&progress](double done) { progress.Report(done); }, place);
    });

  output->GetPointData()->SetActiveScalars("JinDifference");
  smokevis::AddSignList(*output, list);
  smokevis::AddFieldNumber(*output, "VisibilityFactor", {this->VisibilityFactor});
  smokevis::AddFieldTexts(*output, "DifferenceNames",
    {"seen by both", "seen by the practice only", "seen by the map only", "seen by neither",
      "no sign in view", "inside a solid", "not known"});
  for (const char* const name : {"JinDifference", "BeerLambertDifference", "FDSDifference"})
  {
    AddCounts(output, name);
  }
}

//------------------------------------------------------------------------------
int vtkJinVisibility::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const int done = this->Implementation->Kept.Produce(this, outputVector,
    [&]
    {
      smokevis::Ranks().Together(this,
        [&]
        {
          this->Compute(vtkDataObject::GetData(inputVector[0]),
            vtkImageData::GetData(inputVector[1]), vtkDataObject::GetData(inputVector[2]),
            vtkImageData::GetData(outputVector));
        });
    });
  smokevis::LeaveToFirstPiece(outputVector);
  return done;
}

//------------------------------------------------------------------------------
void vtkJinVisibility::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "VisibilityFactor: " << this->VisibilityFactor << "\n";
  os << indent << "InherentContrast: " << this->InherentContrast << "\n";
  os << indent << "LiminalContrast: " << this->LiminalContrast << "\n";
  os << indent << "MaximumVisibility: " << this->MaximumVisibility << "\n";
  os << indent << "SliceTolerance: " << this->SliceTolerance << "\n";
}
