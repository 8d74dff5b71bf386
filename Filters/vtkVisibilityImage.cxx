#include "vtkVisibilityImage.h"

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
#include "PipelineProgress.h"
#include "PropertyChecks.h"
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
#include <cmath>
#include <optional>

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
void vtkVisibilityImage::Trace(vtkDataObject* input, vtkImageData* output, vtkImageData* photograph)
{
  this->CheckProperties();
  const smokevis::Adaptation state{
    this->AdaptationLuminance, this->AdaptationTime, this->Glare, this->ObserverAge};
  smokevis::Observer observer = smokevis::CheckedEye(this->DarkLuminance, this->Acuity, state);
  const smokevis::ResponseCurve response = this->ResponseFile && *this->ResponseFile
                                             ? smokevis::ResponseCurve::Read(this->ResponseFile)
                                             : smokevis::ResponseCurve();
  double sensor[2];
  int size[2];
  this->UseModel(sensor, size);
  smokevis::RequireMemory("ImageSize", "the image",
    (this->LensBlur ? BlurredPixelBytes : PixelBytes) * size[0] * size[1], "Give a smaller image");
  const smokevis::ThinLens lens =
    this->FocusDistance > 0.0
      ? smokevis::ThinLens::Focused(Millimetre * this->FocalLength, this->FocusDistance)
      : smokevis::ThinLens::FocusedAtInfinity(Millimetre * this->FocalLength);
  const smokevis::View& view = this->Implementation->Input.Get(input);
  const Vec3 eye = Vector(this->CameraPosition);
  if (view.InsideSolid(eye))
  {
    throw Error("CameraPosition", "it lies inside a solid", "Move the camera into the open");
  }

  const int target =
    smokevis::ChooseSign(this->TargetSignName ? this->TargetSignName : "", this->TargetSign, input);
  smokevis::Camera camera;
  std::size_t sign = smokevis::NoSign;
  if (target >= 0)
  {
    sign = smokevis::FindSign(view, target);
    if (sign == smokevis::NoSign)
    {
      throw Error("TargetSign", "there is no sign " + std::to_string(target),
        "The signs of this light field: " + this->Implementation->Input.SignIds());
    }
    camera = smokevis::Camera::FramePlate(eye, view.TheScene().Lights().Signs()[sign].Corners,
      Vector(this->CameraViewUp), this->Margin, size[0], size[1]);
  }
  else
  {
    camera =
      smokevis::Camera::LookAt(eye, Vector(this->CameraFocalPoint), Vector(this->CameraViewUp),
        lens.ImageDistance / Millimetre, sensor[0], sensor[1], size[0], size[1]);
  }
  if (this->LensBlur)
  {
    camera.Aperture = lens.FocalLength / this->FNumber;
    camera.FocusDistance = lens.ObjectDistance;
  }

  smokevis::TracedImage image;
  smokevis::RunWithProgress(this, 0.1, 0.95,
    [&](smokevis::Progress& progress)
    { image = smokevis::TraceImage(view, camera, observer.Acuity, progress); });

  const int bands = this->Implementation->Input.Bands();
  smokevis::StorePixels(image, size, bands, target, *output);

  const int measured = target >= 0 ? target : smokevis::LargestSign(image.SignIds);
  smokevis::SignMeasurement result;
  if (measured >= 0)
  {
    sign = smokevis::FindSign(view, measured);
    std::optional<smokevis::GlareSources> glare;
    if (this->Glare)
    {
      glare.emplace(view, eye);
    }
    observer = smokevis::LookingAt(
      observer, state, glare ? &*glare : nullptr, view.TheScene().Lights().Signs()[sign]);
    result = smokevis::MeasureSign(view, sign, eye, observer);
  }
  if (target >= 0 && !result.InView)
  {
    vtkWarningMacro("Sign " << target << " is not in view from here: it faces away or is hidden.");
  }
  smokevis::StoreMeasurement(result, measured, *output);
  const auto number = [&](const char* name, double value)
  { smokevis::AddFieldNumber(*output, name, {value}); };
  const smokevis::ExposureSettings exposure{this->FNumber, lens.Magnification(), this->ExposureTime,
    this->ISO, this->ReadNoise, static_cast<std::uint64_t>(this->NoiseSeed)};
  number("SensorIlluminance", smokevis::SensorIlluminance(result.MeanLuminance, exposure));
  number("VisibleProbability",
    result.InView
      ? smokevis::VisibleProbability(result.PerceivedContrast, Threshold, ThresholdSpread)
      : 0.0);
  number("EyeLuminance", observer.DarkLuminance);
  smokevis::StoreCamera(camera, *output);
  number("ImageDistance", lens.ImageDistance / Millimetre);
  number("ObjectDistance", lens.ObjectDistance);
  number("Magnification", lens.Magnification());

  const smokevis::Photograph taken = smokevis::TakePhotograph(
    bands == 3 ? image.LuminanceRGB : image.Luminance, bands, exposure, response);
  number("ShutterTime", taken.Time);
  smokevis::StorePhotograph(taken, bands, *output, *photograph);
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
  const int done = own.Kept.Produce(this, outputVector,
    [&] { smokevis::Ranks().Together(this, [&] { this->Trace(input, output, photograph); }); });
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
