#include "vtkVisibilityImage.h"

#include "Agreement.h"
#include "Contrast.h"
#include "Errors.h"
#include "Eye.h"
#include "EyeProperties.h"
#include "ImageOutput.h"
#include "ImageTracer.h"
#include "KeptOutput.h"
#include "LightFieldInput.h"
#include "MemoryGuard.h"
#include "Photograph.h"
#include "PropertyChecks.h"
#include "RankReport.h"
#include "RankTeam.h"
#include "Ranks.h"
#include "SignChoice.h"
#include "ThinLens.h"
#include "WholeInput.h"

#include <vtkExecutive.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkStringArray.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

vtkStandardNewMacro(vtkVisibilityImage);

struct vtkVisibilityImage::Internals
{
  smokevis::LightFieldInput Input;
  smokevis::KeptOutput Kept;
  vtkNew<vtkStringArray> SignList;
  /// Of filter and input when the image could not be made, 0: it could.
  vtkMTimeType FailedFilter = 0;
  vtkMTimeType FailedInput = 0;
};

namespace
{

/// In metres.
constexpr double Millimetre = 1e-3;
constexpr std::int64_t MaximumPixels = 100000000;
/// Of all arrays: the tracer's (two where the lens blurs), the outputs' and the photograph's.
constexpr double PixelBytes = 100.0;
constexpr double BlurredPixelBytes = 140.0;
/// Threshold of observers and its spread, for the share of them who see the sign.
constexpr double Threshold = 0.2;
constexpr double ThresholdSpread = 0.04;
constexpr double LargestMargin = 1000.0;
/// Lenses in air end at 0.5.
constexpr double SmallestFNumber = 0.1;
using smokevis::Error;
using smokevis::Vec3;

Vec3 Vector(const double* values)
{
  return {values[0], values[1], values[2]};
}

} // namespace

//------------------------------------------------------------------------------
/// What is taken, from where and with what.
struct vtkVisibilityImage::Shot
{
  const smokevis::View* View = nullptr;
  Vec3 Eye{0.0};
  /// Id of the sign that fills the frame, or -1.
  int Target = -1;
  int Size[2] = {0, 0};
  smokevis::Camera Camera;
  smokevis::ThinLens Lens;
  smokevis::ResponseCurve Response;
  smokevis::Adaptation State;
  smokevis::Observer Observer;
  /// What was taken.
  smokevis::TracedImage Image;
};

//------------------------------------------------------------------------------
vtkVisibilityImage::vtkVisibilityImage() : Implementation(std::make_unique<Internals>())
{
  this->SetNumberOfOutputPorts(2);
  this->SetTargetSignName(smokevis::SignById);
}

//------------------------------------------------------------------------------
vtkVisibilityImage::~vtkVisibilityImage()
{
  this->SetResponseFile(nullptr);
  this->SetTargetSignName(nullptr);
}

//------------------------------------------------------------------------------
vtkStringArray* vtkVisibilityImage::GetSignList()
{
  vtkStringArray* const list = this->Implementation->SignList;
  list->Initialize();
  for (const std::string& entry : smokevis::SignChoices(this->GetInputDataObject(0, 0)))
  {
    list->InsertNextValue(entry);
  }
  return list;
}

//------------------------------------------------------------------------------
int vtkVisibilityImage::ComputePipelineMTime(
  vtkInformation*, vtkInformationVector**, vtkInformationVector*, int, vtkMTimeType* mtime)
{
  *mtime = this->Implementation->Kept.PipelineMTime(this->GetMTime());
  return 1;
}

//------------------------------------------------------------------------------
int vtkVisibilityImage::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

//------------------------------------------------------------------------------
int vtkVisibilityImage::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  double sensor[2];
  int size[2];
  this->UseModel(sensor, size);
  const int extent[6] = {0, std::max(1, size[0]) - 1, 0, std::max(1, size[1]) - 1, 0, 0};
  const double origin[3] = {0.0, 0.0, 0.0};
  const double spacing[3] = {1.0, 1.0, 1.0};
  for (int port = 0; port < 2; ++port)
  {
    vtkInformation* const info = outputVector->GetInformationObject(port);
    info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
    info->Set(vtkDataObject::ORIGIN(), origin, 3);
    info->Set(vtkDataObject::SPACING(), spacing, 3);
  }
  smokevis::HandlePieces(outputVector);
  return 1;
}

//------------------------------------------------------------------------------
int vtkVisibilityImage::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  smokevis::RequestWholeInputs(inputVector[0]);
  return 1;
}

//------------------------------------------------------------------------------
void vtkVisibilityImage::UseModel(double sensor[2], int size[2]) const
{
  std::copy_n(this->SensorSize, 2, sensor);
  std::copy_n(this->ImageSize, 2, size);
  if (this->CameraModel == CANON_EOS_10D)
  {
    sensor[0] = 22.7;
    sensor[1] = 15.1;
    const int binning = std::max(1, this->PixelBinning);
    size[0] = std::max(1, 3072 / binning);
    size[1] = std::max(1, 2048 / binning);
  }
}

//------------------------------------------------------------------------------
void vtkVisibilityImage::CheckProperties() const
{
  smokevis::Check(this->ImageSize[0] > 0 && this->ImageSize[1] > 0, "ImageSize",
    "it is not positive", "Give a width and a height in pixels");
  smokevis::Check(
    static_cast<std::int64_t>(this->ImageSize[0]) * this->ImageSize[1] <= MaximumPixels,
    "ImageSize", "the image has more than 100 million pixels", "Give a smaller image");
  const std::pair<const char*, const double*> vectors[] = {{"CameraPosition", this->CameraPosition},
    {"CameraFocalPoint", this->CameraFocalPoint}, {"CameraViewUp", this->CameraViewUp}};
  for (const auto& [name, values] : vectors)
  {
    smokevis::Check(
      std::all_of(values, values + 3, [](double value) { return std::isfinite(value); }), name,
      "it is not finite", "Give three numbers, in metres");
  }
  smokevis::CheckPositive(this->FocalLength, "FocalLength", "Give it in mm");
  smokevis::Check(
    smokevis::IsPositive(this->SensorSize[0]) && smokevis::IsPositive(this->SensorSize[1]),
    "SensorSize", "it is not positive", "Give it in mm");
  smokevis::Check(this->FNumber >= SmallestFNumber && std::isfinite(this->FNumber), "FNumber",
    "it is less than 0.1", "Give 2.8, for example; no lens is below 0.5");
  smokevis::Check(this->Margin >= 0.0 && this->Margin <= LargestMargin, "Margin",
    "it is not from 0 to 1000", "Give a share of the sign's size");
  smokevis::Check(
    this->PixelBinning > 0, "PixelBinning", "it is not positive", "Give 1 for every pixel");
  smokevis::CheckNotNegative(
    this->FocusDistance, "FocusDistance", "Give metres from the sensor, or 0 for infinity");
  smokevis::CheckNotNegative(
    this->ExposureTime, "ExposureTime", "Give seconds, or 0 for a metered exposure");
  smokevis::CheckPositive(this->ISO, "ISO", "Give 100, for example");
  smokevis::CheckNotNegative(
    this->ReadNoise, "ReadNoise", "Give a share of the saturating exposure, or 0");
}

//------------------------------------------------------------------------------
vtkVisibilityImage::Shot vtkVisibilityImage::Prepare(vtkDataObject* input)
{
  this->CheckProperties();
  Shot shot;
  shot.State = {this->AdaptationLuminance, this->AdaptationTime, this->Glare, this->ObserverAge};
  shot.Observer = smokevis::CheckedEye(this->DarkLuminance, this->Acuity, shot.State);
  if (this->ResponseFile && *this->ResponseFile)
  {
    shot.Response = smokevis::ResponseCurve::Read(this->ResponseFile);
  }
  double sensor[2];
  this->UseModel(sensor, shot.Size);
  const auto [width, height] = shot.Size;
  smokevis::RequireMemory("ImageSize", "the image",
    (this->LensBlur ? BlurredPixelBytes : PixelBytes) * width * height, "Give a smaller image");
  const double focalLength = Millimetre * this->FocalLength;
  shot.Lens = this->FocusDistance > 0.0
                ? smokevis::ThinLens::Focused(focalLength, this->FocusDistance)
                : smokevis::ThinLens::FocusedAtInfinity(focalLength);
  shot.View = &this->Implementation->Input.Get(input);
  shot.Eye = Vector(this->CameraPosition);
  if (shot.View->InsideSolid(shot.Eye))
  {
    throw Error("CameraPosition", "it lies inside a solid", "Move the camera into the open");
  }

  shot.Target =
    smokevis::ChooseSign(this->TargetSignName ? this->TargetSignName : "", this->TargetSign, input);
  const Vec3 up = Vector(this->CameraViewUp);
  if (shot.Target >= 0)
  {
    const std::size_t sign = smokevis::FindSign(*shot.View, shot.Target);
    if (sign == smokevis::NoSign)
    {
      throw Error("TargetSign", "there is no sign " + std::to_string(shot.Target),
        "The signs of this light field: " + this->Implementation->Input.SignIds());
    }
    shot.Camera = smokevis::Camera::FramePlate(shot.Eye,
      shot.View->TheScene().Lights().Signs()[sign].Corners, up, this->Margin, width, height);
  }
  else
  {
    shot.Camera = smokevis::Camera::LookAt(shot.Eye, Vector(this->CameraFocalPoint), up,
      shot.Lens.ImageDistance / Millimetre, sensor[0], sensor[1], width, height);
  }
  if (this->LensBlur)
  {
    shot.Camera.Aperture = shot.Lens.FocalLength / this->FNumber;
    shot.Camera.FocusDistance = shot.Lens.ObjectDistance;
  }
  return shot;
}

//------------------------------------------------------------------------------
void vtkVisibilityImage::AddProperties(smokevis::Agreement& agreement) const
{
  agreement.Add("CameraPosition", this->CameraPosition, 3);
  agreement.Add("TargetSign", this->TargetSign);
  agreement.Add(
    "TargetSignName", std::string_view(this->TargetSignName ? this->TargetSignName : ""));
  agreement.Add("CameraFocalPoint", this->CameraFocalPoint, 3);
  agreement.Add("CameraViewUp", this->CameraViewUp, 3);
  agreement.Add("FocalLength", this->FocalLength);
  agreement.Add("SensorSize", this->SensorSize, 2);
  agreement.Add("FNumber", this->FNumber);
  agreement.Add("CameraModel", this->CameraModel);
  agreement.Add("PixelBinning", this->PixelBinning);
  agreement.Add("FocusDistance", this->FocusDistance);
  agreement.Add("LensBlur", this->LensBlur);
  agreement.Add("ImageSize", this->ImageSize, 2);
  agreement.Add("Margin", this->Margin);
  agreement.Add("Acuity", this->Acuity);
}

//------------------------------------------------------------------------------
void vtkVisibilityImage::Trace(vtkDataObject* input, vtkImageData* output, vtkImageData* photograph)
{
  const smokevis::Ranks ranks;
  Shot shot;
  ranks.Together(this, [&] { shot = this->Prepare(input); });
  smokevis::Agreement agreement(ranks);
  agreement.Add("LightField", input);
  this->AddProperties(agreement);
  agreement.Check();
  smokevis::RankTeam team(this);
  const auto start = std::chrono::steady_clock::now();
  team.Run(0.1, 0.95,
    [&](smokevis::Progress& progress)
    {
      shot.Image =
        smokevis::TraceImage(*shot.View, shot.Camera, shot.Observer.Acuity, team, progress);
    });
  const std::chrono::duration<double> all = std::chrono::steady_clock::now() - start;
  const std::vector<double> seconds = ranks.Each(all.count() - team.Waited());
  smokevis::SignMeasurement sign;
  ranks.Together(this, [&] { sign = this->Develop(shot, output, photograph); });
  this->Report(shot, sign, seconds, *output);
}

//------------------------------------------------------------------------------
void vtkVisibilityImage::Report(const Shot& shot, const smokevis::SignMeasurement& sign,
  const std::vector<double>& seconds, vtkImageData& output) const
{
  std::vector<smokevis::WorkItem> report = this->Implementation->Input.Report();
  report.push_back({"pixels", static_cast<double>(shot.Image.Luminance.size()),
    shot.Target >= 0 ? "the target sign fills the picture but for the margin"
                     : "of the sensor, along the line of sight"});
  report.push_back({"pixels that are means of samples", static_cast<double>(shot.Image.Averaged),
    "a pattern or an edge lies in what they show"});
  report.push_back({"rays cut short", static_cast<double>(shot.Image.CutShort),
    "so much smoke lies ahead that the rest adds next to nothing"});
  report.push_back({"points of the lens", std::max(1.0, double(shot.Image.LensPoints)),
    shot.Image.LensPoints > 0 ? "the picture is the mean over the aperture"
                              : "without LensBlur the lens is a pinhole"});
  report.push_back({"rays gathered by the sign's view", static_cast<double>(sign.Rays),
    sign.Rays > 0 ? "the light field left its contrast uncertain"
    : sign.LeftUncertain
      ? "its contrast is uncertain, but lost in the eye's own noise, or no smoke scatters"
    : sign.InView ? "the light field tells its contrast"
                  : "no target sign is in view"});
  report.push_back({"signs not looked at in parts", sign.Clear || sign.InShadow ? 1.0 : 0.0,
    sign.Clear      ? "nothing reaches between the eye and the sign"
    : sign.InShadow ? "surfaces stand before all of it"
    : sign.InView   ? "something may hide a part of the sign"
                    : "no target sign is in view"});
  report.push_back({"plates divided finely", sign.Uneven ? 1.0 : 0.0,
    sign.Uneven   ? "the smoke before the sign is uneven"
    : sign.InView ? "the smoke before the sign is even enough"
                  : "no target sign is in view"});
  smokevis::AddWorkReport(output, report);
  smokevis::ReportRanks(
    *output.GetFieldData(), {{"seconds", seconds, "tracing its pixels, but for waiting"}});
}

//------------------------------------------------------------------------------
smokevis::SignMeasurement vtkVisibilityImage::Develop(
  const Shot& shot, vtkImageData* output, vtkImageData* photograph)
{
  const int bands = this->Implementation->Input.Bands();
  smokevis::StorePixels(shot.Image, shot.Size, bands, shot.Target, *output);

  const int measured = shot.Target >= 0 ? shot.Target : smokevis::LargestSign(shot.Image.SignIds);
  smokevis::SignMeasurement result;
  smokevis::Observer observer = shot.Observer;
  if (measured >= 0)
  {
    const std::size_t sign = smokevis::FindSign(*shot.View, measured);
    std::optional<smokevis::GlareSources> glare;
    if (this->Glare)
    {
      glare.emplace(*shot.View, shot.Eye);
    }
    observer = smokevis::LookingAt(observer, shot.State, glare ? &*glare : nullptr,
      shot.View->TheScene().Lights().Signs()[sign]);
    result = smokevis::MeasureSign(*shot.View, sign, shot.Eye, observer);
  }
  if (shot.Target >= 0 && !result.InView)
  {
    vtkWarningMacro(
      "Sign " << shot.Target << " is not in view from here: it faces away or is hidden.");
  }
  smokevis::StoreMeasurement(result, measured, *output);
  const auto number = [&](const char* name, double value)
  { smokevis::AddFieldNumber(*output, name, {value}); };
  const smokevis::ExposureSettings exposure{this->FNumber, shot.Lens.Magnification(),
    this->ExposureTime, this->ISO, this->ReadNoise, static_cast<std::uint64_t>(this->NoiseSeed)};
  number("SensorIlluminance", smokevis::SensorIlluminance(result.MeanLuminance, exposure));
  number("VisibleProbability",
    result.InView
      ? smokevis::VisibleProbability(result.PerceivedContrast, Threshold, ThresholdSpread)
      : 0.0);
  number("EyeLuminance", observer.DarkLuminance);
  smokevis::StoreCamera(shot.Camera, *output);
  number("ImageDistance", shot.Lens.ImageDistance / Millimetre);
  number("ObjectDistance", shot.Lens.ObjectDistance);
  number("Magnification", shot.Lens.Magnification());

  const smokevis::Photograph taken = smokevis::TakePhotograph(
    bands == 3 ? shot.Image.LuminanceRGB : shot.Image.Luminance, bands, exposure, shot.Response);
  number("ShutterTime", taken.Time);
  smokevis::StorePhotograph(taken, bands, *output, *photograph);
  return result;
}

//------------------------------------------------------------------------------
int vtkVisibilityImage::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkImageData* const output = vtkImageData::GetData(outputVector, 0);
  vtkImageData* const photograph = vtkImageData::GetData(outputVector, 1);
  vtkDataObject* const input = vtkDataObject::GetData(inputVector[0]);
  Internals& own = *this->Implementation;
  const vtkMTimeType inputTime = input ? input->GetMTime() : 0;
  if (request->Get(vtkExecutive::FROM_OUTPUT_PORT()) == 1 && own.FailedFilter == this->GetMTime() &&
      own.FailedInput == inputTime)
  {
    // The second output is asked for after the first has failed: that was said already.
    output->Initialize();
    photograph->Initialize();
    return 0;
  }
  own.FailedFilter = 0;
  const int done =
    own.Kept.Produce(this, outputVector, [&] { this->Trace(input, output, photograph); });
  if (!done)
  {
    own.FailedFilter = this->GetMTime();
    own.FailedInput = inputTime;
  }
  smokevis::LeaveToFirstPiece(outputVector);
  return done;
}

//------------------------------------------------------------------------------
void vtkVisibilityImage::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto vector = [&](const char* name, const double* value)
  { os << indent << name << ": (" << value[0] << ", " << value[1] << ", " << value[2] << ")\n"; };
  vector("CameraPosition", this->CameraPosition);
  os << indent << "TargetSign: " << this->TargetSign << "\n";
  os << indent << "TargetSignName: " << (this->TargetSignName ? this->TargetSignName : "(none)")
     << "\n";
  vector("CameraFocalPoint", this->CameraFocalPoint);
  vector("CameraViewUp", this->CameraViewUp);
  os << indent << "FocalLength: " << this->FocalLength << "\n";
  os << indent << "SensorSize: (" << this->SensorSize[0] << ", " << this->SensorSize[1] << ")\n";
  os << indent << "FNumber: " << this->FNumber << "\n";
  os << indent << "CameraModel: " << this->CameraModel << "\n";
  os << indent << "PixelBinning: " << this->PixelBinning << "\n";
  os << indent << "FocusDistance: " << this->FocusDistance << "\n";
  os << indent << "LensBlur: " << this->LensBlur << "\n";
  os << indent << "ExposureTime: " << this->ExposureTime << "\n";
  os << indent << "ISO: " << this->ISO << "\n";
  os << indent << "ResponseFile: " << (this->ResponseFile ? this->ResponseFile : "(none)") << "\n";
  os << indent << "ReadNoise: " << this->ReadNoise << "\n";
  os << indent << "NoiseSeed: " << this->NoiseSeed << "\n";
  os << indent << "ImageSize: (" << this->ImageSize[0] << ", " << this->ImageSize[1] << ")\n";
  os << indent << "Margin: " << this->Margin << "\n";
  os << indent << "DarkLuminance: " << this->DarkLuminance << "\n";
  os << indent << "Acuity: " << this->Acuity << "\n";
  os << indent << "AdaptationLuminance: " << this->AdaptationLuminance << "\n";
  os << indent << "AdaptationTime: " << this->AdaptationTime << "\n";
  os << indent << "Glare: " << this->Glare << "\n";
  os << indent << "ObserverAge: " << this->ObserverAge << "\n";
}
