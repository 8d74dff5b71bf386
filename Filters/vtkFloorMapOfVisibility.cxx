#include "vtkFloorMapOfVisibility.h"

#include "Agreement.h"
#include "Box.h"
#include "Errors.h"
#include "EyeProperties.h"
#include "FloorMap.h"
#include "Identity.h"
#include "KeptOrigin.h"
#include "KeptOutput.h"
#include "LightFieldInput.h"
#include "MemoryGuard.h"
#include "PointArrays.h"
#include "PropertyChecks.h"
#include "RankTeam.h"
#include "Ranks.h"
#include "WholeInput.h"

#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkIntArray.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <tuple>

vtkStandardNewMacro(vtkFloorMapOfVisibility);

struct vtkFloorMapOfVisibility::Internals
{
  smokevis::LightFieldInput Input;
  smokevis::KeptOutput Kept;
  /// Of Kept: the light field.
  smokevis::KeptOrigin<smokevis::Identity> Origin;
};

namespace
{

constexpr double MaximumValues = 1e8;
/// Arrays with a value a place, and with one a place and sign: the solver's and the output's.
constexpr double PlaceBytes = 2 * 8 * sizeof(float);
constexpr double SignBytes = 2 * 4 * sizeof(float);

using smokevis::Error;
using smokevis::Vec3;

} // namespace

//------------------------------------------------------------------------------
vtkFloorMapOfVisibility::vtkFloorMapOfVisibility() : Implementation(std::make_unique<Internals>())
{
}

//------------------------------------------------------------------------------
vtkFloorMapOfVisibility::~vtkFloorMapOfVisibility() = default;

//------------------------------------------------------------------------------
int vtkFloorMapOfVisibility::ComputePipelineMTime(
  vtkInformation*, vtkInformationVector**, vtkInformationVector*, int, vtkMTimeType* mtime)
{
  *mtime = this->Implementation->Kept.PipelineMTime(this->GetMTime());
  return 1;
}

//------------------------------------------------------------------------------
int vtkFloorMapOfVisibility::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

//------------------------------------------------------------------------------
int vtkFloorMapOfVisibility::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  const int extent[6] = {
    0, std::max(1, this->Resolution[0]) - 1, 0, std::max(1, this->Resolution[1]) - 1, 0, 0};
  outputVector->GetInformationObject(0)->Set(
    vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  smokevis::HandlePieces(outputVector);
  return 1;
}

//------------------------------------------------------------------------------
int vtkFloorMapOfVisibility::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  smokevis::RequestWholeInputs(inputVector[0]);
  return 1;
}

//------------------------------------------------------------------------------
void vtkFloorMapOfVisibility::CheckProperties() const
{
  smokevis::Check(this->Resolution[0] > 0 && this->Resolution[1] > 0, "Resolution",
    "it is not positive", "Give the number of places along x and y");
  smokevis::Check(static_cast<double>(this->Resolution[0]) * this->Resolution[1] <= MaximumValues,
    "Resolution", "the map has more than 100 million places", "Give fewer places");
  smokevis::Check(
    std::isfinite(this->EyeHeight), "EyeHeight", "it is not finite", "Give it in metres");
  smokevis::CheckNotNegative(
    this->ContrastThreshold, "ContrastThreshold", "Give 0.2 for the point of disappearance");
  smokevis::CheckNotNegative(
    this->ThresholdSpread, "ThresholdSpread", "Give 0.04, or 0 for observers who are all alike");
  smokevis::CheckNotNegative(this->CutOff, "CutOff", "Give 0 to compute all signs");
}

//------------------------------------------------------------------------------
std::array<double, 6> vtkFloorMapOfVisibility::Area(const smokevis::Medium& smoke) const
{
  if (!this->UseBox && this->Bounds[0] > this->Bounds[1])
  {
    return {smoke.Lower().x, smoke.Upper().x, smoke.Lower().y, smoke.Upper().y, smoke.Lower().z,
      smoke.Upper().z};
  }
  std::array<double, 6> bounds;
  for (int axis = 0; axis < 3; ++axis)
  {
    double& lower = bounds[2 * axis];
    double& upper = bounds[2 * axis + 1];
    lower = this->UseBox ? this->BoxPosition[axis] : this->Bounds[2 * axis];
    upper = this->UseBox ? lower + this->BoxSize[axis] : this->Bounds[2 * axis + 1];
    const bool isGood = lower < upper && std::isfinite(lower) && std::isfinite(upper);
    if (this->UseBox)
    {
      smokevis::Check(isGood, "BoxSize", "the box is empty",
        "Give BoxPosition and positive lengths along x, y and z in metres, or turn UseBox off");
    }
    smokevis::Check(isGood, "Bounds", "a lower bound is not below its upper bound",
      "Give xmin, xmax, ymin, ymax, floor and ceiling, or xmin above xmax for the smoke's");
  }
  return bounds;
}

//------------------------------------------------------------------------------
smokevis::FloorMapOptions vtkFloorMapOfVisibility::Prepare(const smokevis::View& view) const
{
  this->CheckProperties();
  const smokevis::Adaptation state{
    this->AdaptationLuminance, this->AdaptationTime, this->Glare, this->ObserverAge};
  const smokevis::Observer eye = smokevis::CheckedEye(this->DarkLuminance, this->Acuity, state);
  const std::vector<smokevis::Sign>& signs = view.TheScene().Lights().Signs();
  if (signs.empty())
  {
    throw Error("floor map", "the light field holds no sign",
      "Give emitters with a SignId from 0, such as the source ExitSign makes");
  }
  const double places = static_cast<double>(this->Resolution[0]) * this->Resolution[1];
  if (places * static_cast<double>(signs.size()) > MaximumValues)
  {
    throw Error("Resolution",
      "the map would hold more than 100 million values, places times " +
        std::to_string(signs.size()) + " signs",
      "Give fewer places");
  }

  smokevis::RequireMemory("Resolution", "the map",
    places * (PlaceBytes + SignBytes * static_cast<double>(signs.size())), "Give fewer places");

  const std::array<double, 6> bounds = this->Area(view.TheScene().Smoke());
  if (!(this->EyeHeight >= 0.0 && this->EyeHeight <= bounds[5] - bounds[4]))
  {
    throw Error("EyeHeight", "the eyes are not between floor and ceiling",
      "Give a height above the floor in metres, or another area");
  }

  smokevis::FloorMapOptions options;
  options.PlacesX = this->Resolution[0];
  options.PlacesY = this->Resolution[1];
  options.StepX = (bounds[1] - bounds[0]) / options.PlacesX;
  options.StepY = (bounds[3] - bounds[2]) / options.PlacesY;
  options.FirstPlace = {
    bounds[0] + 0.5 * options.StepX, bounds[2] + 0.5 * options.StepY, bounds[4] + this->EyeHeight};
  options.ContrastThreshold = this->ContrastThreshold;
  options.CutOff = this->CutOff;
  options.Eye = eye;
  options.ThresholdSpread = this->ThresholdSpread;
  options.State = state;
  return options;
}

//------------------------------------------------------------------------------
void vtkFloorMapOfVisibility::AddProperties(smokevis::Agreement& agreement) const
{
  agreement.Add("EyeHeight", this->EyeHeight);
  agreement.Add("Resolution", this->Resolution, 2);
  agreement.Add("Bounds", this->Bounds, 6);
  agreement.Add("UseBox", this->UseBox);
  agreement.Add("BoxPosition", this->BoxPosition, 3);
  agreement.Add("BoxSize", this->BoxSize, 3);
  agreement.Add("ContrastThreshold", this->ContrastThreshold);
  agreement.Add("ThresholdSpread", this->ThresholdSpread);
  agreement.Add("DarkLuminance", this->DarkLuminance);
  agreement.Add("CutOff", this->CutOff);
  agreement.Add("Acuity", this->Acuity);
  agreement.Add("AdaptationLuminance", this->AdaptationLuminance);
  agreement.Add("AdaptationTime", this->AdaptationTime);
  agreement.Add("Glare", this->Glare);
  agreement.Add("ObserverAge", this->ObserverAge);
}

//------------------------------------------------------------------------------
void vtkFloorMapOfVisibility::WarnOfPlacesOutside(const smokevis::FloorMap& map,
  const smokevis::FloorMapOptions& options, const smokevis::View& view)
{
  const smokevis::Medium& medium = view.TheScene().Smoke();
  const smokevis::Box smoke{medium.Lower(), medium.Upper()};
  const smokevis::Box eyes{options.EyeAt(0), options.EyeAt(map.Status.size() - 1)};
  const bool shows = std::any_of(map.Status.begin(), map.Status.end(),
    [](smokevis::PlaceStatus status) { return status != smokevis::PlaceStatus::NoSignInView; });
  if (shows || smoke.Meets(eyes))
  {
    return;
  }
  vtkWarningMacro(<< "No sign is in view from any place, and all are outside of the smoke: eyes at "
                  << eyes.Lower.x << " to " << eyes.Upper.x << ", " << eyes.Lower.y << " to "
                  << eyes.Upper.y << " and " << eyes.Lower.z << " m, smoke at " << smoke.Lower.x
                  << " to " << smoke.Upper.x << ", " << smoke.Lower.y << " to " << smoke.Upper.y
                  << " and " << smoke.Lower.z << " to " << smoke.Upper.z
                  << " m. Give the area in metres, in the coordinates of the smoke.");
}

//------------------------------------------------------------------------------
void vtkFloorMapOfVisibility::Compute(vtkDataObject* input, vtkImageData* output)
{
  const smokevis::Ranks ranks;
  const smokevis::View* view = nullptr;
  smokevis::FloorMapOptions options;
  smokevis::FloorMap map;
  const auto start = std::chrono::steady_clock::now();
  ranks.Together(this,
    [&]
    {
      view = &this->Implementation->Input.Get(input);
      options = this->Prepare(*view);
    });
  smokevis::Agreement agreement(ranks);
  agreement.Add("LightField", input);
  this->AddProperties(agreement);
  agreement.Check();
  std::tie(options.First, options.End) =
    ranks.Share(static_cast<std::size_t>(options.PlacesX) * options.PlacesY);
  smokevis::RankTeam team(this);
  team.Run(0.05, 0.98,
    [&](smokevis::Progress& progress)
    { map = smokevis::ComputeFloorMap(*view, options, progress); });
  const std::chrono::duration<double> all = std::chrono::steady_clock::now() - start;
  const std::vector<double> seconds = ranks.Each(all.count() - team.Waited());
  const std::size_t places = map.Status.size();
  ranks.Complete(map.Status, places);
  ranks.Complete(map.BestSign, places);
  for (std::vector<float>* const values :
    {&map.Visibility, &map.VisibilityError, &map.VisibilityDivisionError, &map.OpticalDepth,
      &map.JinVisibility, &map.VisibleProbability, &map.EyeLuminance, &map.Contrast,
      &map.PerceivedContrast, &map.SignLuminance, &map.VisibleFraction})
  {
    ranks.Complete(*values, places);
  }
  for (smokevis::WorkItem& item : map.Report)
  {
    item.Count = ranks.Sum(item.Count);
  }
  for (int rank = 0; rank < ranks.Count() && ranks.Count() > 1; ++rank)
  {
    const auto [first, end] = ranks.Share(places, rank);
    map.Report.push_back({"seconds of process " + std::to_string(rank), seconds[rank],
      "for " + std::to_string(end - first) + " places"});
  }

  this->WarnOfPlacesOutside(map, options, *view);

  output->SetOrigin(options.FirstPlace.x, options.FirstPlace.y, options.FirstPlace.z);
  output->SetSpacing(options.StepX, options.StepY, 1.0);
  output->SetDimensions(options.PlacesX, options.PlacesY, 1);
  const smokevis::SignList signs = this->Implementation->Input.Signs();
  smokevis::AddPointValues<vtkFloatArray>(*output, "Visibility", map.Visibility);
  smokevis::AddPointValues<vtkFloatArray>(*output, "VisibilityError", map.VisibilityError);
  smokevis::AddPointValues<vtkFloatArray>(
    *output, "VisibilityDivisionError", map.VisibilityDivisionError);
  smokevis::AddPointValues<vtkFloatArray>(*output, "VisibleProbability", map.VisibleProbability);
  smokevis::AddPointValues<vtkFloatArray>(*output, "EyeLuminance", map.EyeLuminance);
  smokevis::AddPointValues<vtkIntArray>(*output, "BestSign", map.BestSign);
  smokevis::AddPointValues<vtkFloatArray>(*output, "Contrast", map.Contrast, signs.Names);
  smokevis::AddPointValues<vtkFloatArray>(
    *output, "PerceivedContrast", map.PerceivedContrast, signs.Names);
  smokevis::AddPointValues<vtkFloatArray>(*output, "SignLuminance", map.SignLuminance, signs.Names);
  smokevis::AddPointValues<vtkFloatArray>(
    *output, "VisibleFraction", map.VisibleFraction, signs.Names);
  smokevis::AddPointValues<vtkFloatArray>(*output, "OpticalDepth", map.OpticalDepth);
  smokevis::AddPointValues<vtkFloatArray>(*output, "JinVisibility", map.JinVisibility);
  smokevis::AddPointValues<vtkIntArray>(*output, "Status", map.Status);
  output->GetPointData()->SetActiveScalars("Visibility");
  smokevis::AddSignList(*output, signs);
  smokevis::AddFieldNumber(*output, "ContrastThreshold", {this->ContrastThreshold});
  std::vector<smokevis::WorkItem> report = this->Implementation->Input.Report();
  report.insert(report.end(), map.Report.begin(), map.Report.end());
  smokevis::AddWorkReport(*output, report);
}

//------------------------------------------------------------------------------
int vtkFloorMapOfVisibility::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkDataObject* const input = vtkDataObject::GetData(inputVector[0]);
  Internals& own = *this->Implementation;
  const smokevis::Identity identity = smokevis::IdentityOf(input);
  const auto work = [&]
  {
    // A parallel run asks for the whole and for pieces in turn: the work is done once.
    own.Origin.Renew(this, outputVector, own.Kept, identity,
      [&] { this->Compute(input, vtkImageData::GetData(outputVector)); });
  };
  const int done = own.Kept.Produce(this, outputVector, work);
  smokevis::LeaveToFirstPiece(outputVector);
  return done;
}

//------------------------------------------------------------------------------
void vtkFloorMapOfVisibility::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto vector = [&](const char* name, const double* value)
  { os << indent << name << ": (" << value[0] << ", " << value[1] << ", " << value[2] << ")\n"; };
  os << indent << "EyeHeight: " << this->EyeHeight << "\n";
  os << indent << "Resolution: (" << this->Resolution[0] << ", " << this->Resolution[1] << ")\n";
  os << indent << "Bounds: (";
  for (int i = 0; i < 6; ++i)
  {
    os << this->Bounds[i] << (i < 5 ? ", " : ")\n");
  }
  os << indent << "UseBox: " << this->UseBox << "\n";
  vector("BoxPosition", this->BoxPosition);
  vector("BoxSize", this->BoxSize);
  os << indent << "ContrastThreshold: " << this->ContrastThreshold << "\n";
  os << indent << "ThresholdSpread: " << this->ThresholdSpread << "\n";
  os << indent << "DarkLuminance: " << this->DarkLuminance << "\n";
  os << indent << "CutOff: " << this->CutOff << "\n";
  os << indent << "Acuity: " << this->Acuity << "\n";
  os << indent << "AdaptationLuminance: " << this->AdaptationLuminance << "\n";
  os << indent << "AdaptationTime: " << this->AdaptationTime << "\n";
  os << indent << "Glare: " << this->Glare << "\n";
  os << indent << "ObserverAge: " << this->ObserverAge << "\n";
}
