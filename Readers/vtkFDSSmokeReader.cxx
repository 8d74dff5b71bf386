#include "vtkFDSSmokeReader.h"

#include "vtkFDSDeviceTable.h"
#include "vtkFDSPieces.h"
#include "vtkFDSRun.h"
#include "vtkFDSSmokeMeshes.h"
#include "vtkFDSSmokeOutput.h"

#include "Errors.h"
#include "KeptOutput.h"
#include "PrintableText.h"
#include "PropertyChecks.h"

#include "vtkDemandDrivenPipeline.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"

#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

enum Port
{
  SmokePort,
  GeometryPort,
  DevicesPort,
  SlicesPort,
  BoundaryPort,
  NumberOfPorts
};

// FDS's default single-scattering albedo of smoke.
constexpr double DefaultAlbedo = 0.3;

} // namespace

vtkStandardNewMacro(vtkFDSSmokeReader);

//------------------------------------------------------------------------------------------------
struct vtkFDSSmokeReader::vtkInternals
{
  smokevis::FDSRun Run;
  // What opening it failed on, and how the properties were then: the pipeline asks again and again,
  // and is told once.
  std::string Problem;
  vtkMTimeType ProblemTime = 0;
  smokevis::KeptOutput Kept;
};

//------------------------------------------------------------------------------------------------
vtkFDSSmokeReader::vtkFDSSmokeReader() : Internals(std::make_unique<vtkInternals>())
{
  this->SetNumberOfInputPorts(0);
  this->SetNumberOfOutputPorts(NumberOfPorts);
}

//------------------------------------------------------------------------------------------------
vtkFDSSmokeReader::~vtkFDSSmokeReader()
{
  this->SetFileName(nullptr);
}

//------------------------------------------------------------------------------------------------
void vtkFDSSmokeReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "TransparencyThreshold: " << this->TransparencyThreshold << "\n";
  os << indent << "ExtinctionSource: " << this->ExtinctionSource << "\n";
  os << indent << "MassExtinctionCoefficient: " << this->MassExtinctionCoefficient << "\n";
  os << indent << "VisibilityFactor: " << this->VisibilityFactor << "\n";
  os << indent << "Albedo: " << this->Albedo << "\n";
  os << indent << "TimeInterpolation: " << this->TimeInterpolation << "\n";
  os << indent << "FlameModel: " << this->FlameModel << "\n";
  os << indent << "LuminousEfficacy: " << this->LuminousEfficacy << "\n";
  os << indent << "ReadPlaneSlices: " << this->ReadPlaneSlices << "\n";
  os << indent << "ReadBoundary: " << this->ReadBoundary << "\n";
}

//------------------------------------------------------------------------------------------------
void vtkFDSSmokeReader::SetTransparencyThreshold(double value)
{
  smokevis::SetClamped(this, this->TransparencyThreshold, value, 0.0, 1.0);
}

//------------------------------------------------------------------------------------------------
void vtkFDSSmokeReader::SetMassExtinctionCoefficient(double value)
{
  smokevis::SetClamped(this, this->MassExtinctionCoefficient, value, 0.0, 1e5);
}

//------------------------------------------------------------------------------------------------
void vtkFDSSmokeReader::SetVisibilityFactor(double value)
{
  smokevis::SetClamped(this, this->VisibilityFactor, value, 0.01, 100.0);
}

//------------------------------------------------------------------------------------------------
void vtkFDSSmokeReader::SetAlbedo(double value)
{
  smokevis::SetClamped(this, this->Albedo, value, -1.0, 1.0);
}

//------------------------------------------------------------------------------------------------
void vtkFDSSmokeReader::SetLuminousEfficacy(double value)
{
  smokevis::SetClamped(this, this->LuminousEfficacy, value, 0.0, 100.0);
}

//------------------------------------------------------------------------------------------------
int vtkFDSSmokeReader::FillOutputPortInformation(int port, vtkInformation* info)
{
  static constexpr const char* types[NumberOfPorts] = {"vtkPartitionedDataSetCollection",
    "vtkPolyData", "vtkTable", "vtkPartitionedDataSetCollection",
    "vtkPartitionedDataSetCollection"};
  info->Set(vtkDataObject::DATA_TYPE_NAME(), types[port]);
  return 1;
}

//------------------------------------------------------------------------------------------------
int vtkFDSSmokeReader::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_NOT_GENERATED()))
  {
    // Only the port that was asked for is read; the others stay due.
    const int wanted = request->Get(vtkExecutive::FROM_OUTPUT_PORT());
    for (int port = 0; port < NumberOfPorts && wanted >= 0; ++port)
    {
      if (port != wanted)
      {
        outputVector->GetInformationObject(port)->Set(
          vtkDemandDrivenPipeline::DATA_NOT_GENERATED(), 1);
      }
    }
    return 1;
  }
  return this->Superclass::ProcessRequest(request, inputVector, outputVector);
}

//------------------------------------------------------------------------------------------------
int vtkFDSSmokeReader::ComputePipelineMTime(
  vtkInformation*, vtkInformationVector**, vtkInformationVector*, int, vtkMTimeType* mtime)
{
  *mtime = this->Internals->Kept.PipelineMTime(this->GetMTime());
  return 1;
}

//------------------------------------------------------------------------------------------------
void vtkFDSSmokeReader::Refresh()
{
  // What is shown of it stays until it is read again.
  this->Internals->Run = smokevis::FDSRun();
  this->Modified();
}

//------------------------------------------------------------------------------------------------
bool vtkFDSSmokeReader::LoadRun()
{
  vtkInternals& own = *this->Internals;
  try
  {
    if (!this->FileName || !*this->FileName)
    {
      throw smokevis::Error(
        "FDS reader", "no file name is set", "Set FileName to the run's .smv file");
    }
    smokevis::CheckFinite("TransparencyThreshold", this->TransparencyThreshold, "Give 0 to 1");
    smokevis::CheckFinite("MassExtinctionCoefficient", this->MassExtinctionCoefficient,
      "Give it in m2/kg, such as 8700, or 0 for the run's own");
    smokevis::CheckFinite("VisibilityFactor", this->VisibilityFactor, "Give a number, such as 3");
    smokevis::CheckFinite("Albedo", this->Albedo, "Give 0 to 1, or -1 for the run's own");
    smokevis::CheckFinite(
      "LuminousEfficacy", this->LuminousEfficacy, "Give it in lm/W, such as 0.05");
    std::optional<smokevis::FlameModel> flames;
    if (this->FlameModel != NO_FLAMES)
    {
      flames = this->FlameModel == FLAMES_BY_TEMPERATURE ? smokevis::FlameModel::BlackBody
                                                         : smokevis::FlameModel::LuminousEfficacy;
    }
    own.Run.Load({this->FileName,
      {this->VisibilityFactor, this->MassExtinctionCoefficient,
        static_cast<smokevis::SmokeSourceKind>(this->ExtinctionSource)},
      flames});
    own.Problem.clear();
    return true;
  }
  catch (const std::exception& error)
  {
    if (own.Problem != error.what() || own.ProblemTime != this->GetMTime())
    {
      own.Problem = error.what();
      own.ProblemTime = this->GetMTime();
      vtkErrorMacro(<< own.Problem);
    }
  }
  return false;
}

//------------------------------------------------------------------------------------------------
int vtkFDSSmokeReader::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  if (!this->LoadRun())
  {
    // The pipeline asks several times and would say each time that this failed; data it does not
    // get.
    return 1;
  }
  const std::vector<double> steps = this->Internals->Run.Times();
  const std::array<double, 2> range{steps.front(), steps.back()};
  for (int port = 0; port < NumberOfPorts; ++port)
  {
    vtkInformation* info = outputVector->GetInformationObject(port);
    info->Set(CAN_HANDLE_PIECE_REQUEST(), 1);
    if (port != DevicesPort)
    {
      info->Set(vtkStreamingDemandDrivenPipeline::TIME_STEPS(), steps.data(),
        static_cast<int>(steps.size()));
      info->Set(vtkStreamingDemandDrivenPipeline::TIME_RANGE(), range.data(), 2);
    }
  }
  return 1;
}

//------------------------------------------------------------------------------------------------
double vtkFDSSmokeReader::SceneTime(vtkInformation* outInfo) const
{
  std::optional<double> asked;
  if (outInfo->Has(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP()))
  {
    asked = outInfo->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP());
  }
  return this->Internals->Run.SceneTime(
    asked, static_cast<smokevis::TimeInterpolation>(this->TimeInterpolation));
}

//------------------------------------------------------------------------------------------------
void vtkFDSSmokeReader::Warn(const std::vector<std::string>& warnings)
{
  for (const std::string& warning : warnings)
  {
    vtkWarningMacro(<< smokevis::Printable(warning));
  }
}

//------------------------------------------------------------------------------------------------
int vtkFDSSmokeReader::RequestData(
  vtkInformation* request, vtkInformationVector**, vtkInformationVector* outputVector)
{
  smokevis::KeptOutput& kept = this->Internals->Kept;
  if (!this->LoadRun())
  {
    kept.Clear();
    return 0;
  }
  const int wanted = request->Get(vtkExecutive::FROM_OUTPUT_PORT());
  const auto work = [&]
  {
    smokevis::FDSRun& run = this->Internals->Run;
    this->Warn(run.NotSaidYet(run.Index().Warnings));
    for (int port = 0; port < NumberOfPorts; ++port)
    {
      if (wanted < 0 || wanted == port)
      {
        this->ReadPort(port, outputVector->GetInformationObject(port));
      }
    }
  };
  return kept.Produce(this, outputVector, work, wanted);
}

//------------------------------------------------------------------------------------------------
void vtkFDSSmokeReader::ReadBlocks(
  vtkInformation* outInfo, const char* what, smokevis::FDSFileBlocks& files)
{
  const std::string leftOut = files.Publish(this->SceneTime(outInfo),
    static_cast<smokevis::TimeInterpolation>(this->TimeInterpolation), outInfo);
  if (!leftOut.empty())
  {
    vtkWarningMacro(<< "Some " << what << " are left out: " << leftOut);
  }
  this->WarnOfGrowth(outInfo);
}

//------------------------------------------------------------------------------------------------
void vtkFDSSmokeReader::WarnOfGrowth(vtkInformation* outInfo)
{
  smokevis::FDSRun& run = this->Internals->Run;
  const std::string text = run.NotWhole(
    smokevis::FDSPieces(run.Index(), outInfo), this->ReadPlaneSlices, this->ReadBoundary);
  if (!text.empty())
  {
    this->Warn({text});
  }
}

//------------------------------------------------------------------------------------------------
void vtkFDSSmokeReader::ReadPort(int port, vtkInformation* outInfo)
{
  switch (port)
  {
  case SmokePort:
    this->ReadSmoke(outInfo);
    break;
  case GeometryPort:
    this->ReadGeometry(outInfo);
    break;
  case DevicesPort:
    this->ReadDevices(outInfo);
    break;
  case SlicesPort:
    if (this->ReadPlaneSlices)
    {
      this->ReadBlocks(outInfo, "2-D slices", this->Internals->Run.Slices());
    }
    break;
  default:
    if (this->ReadBoundary)
    {
      this->ReadBlocks(outInfo, "boundary files", this->Internals->Run.Boundary());
    }
  }
}

//------------------------------------------------------------------------------------------------
void vtkFDSSmokeReader::ReadSmoke(vtkInformation* outInfo)
{
  smokevis::FDSRun& run = this->Internals->Run;
  if (!run.Smoke())
  {
    throw std::runtime_error(run.SmokeProblem());
  }
  this->Warn(run.NotSaidYet(run.Smoke()->Warnings()));
  if (run.Flames())
  {
    this->Warn(run.NotSaidYet(run.Flames()->Warnings()));
  }
  this->WarnOfGrowth(outInfo);
  const smokevis::SmvFile& index = run.Index();
  const bool flames = run.Flames() && run.Flames()->HasData();
  smokevis::SmokeRequest request;
  request.Index = &index;
  request.Smoke = run.Smoke();
  request.Flames = flames ? run.Flames() : nullptr;
  request.Glow = this->FlameModel == FLAMES_BY_TEMPERATURE;
  request.Heat = flames && run.Heat() && run.Heat()->HasData() ? run.Heat() : nullptr;
  request.Efficacy = this->LuminousEfficacy;
  request.Albedo = this->Albedo >= 0.0 ? this->Albedo : index.Albedo.value_or(DefaultAlbedo);
  request.Time = this->SceneTime(outInfo);
  request.Interpolation = static_cast<smokevis::TimeInterpolation>(this->TimeInterpolation);
  this->Warn(smokevis::ReadSmokeOutput(request, this, outInfo));
}

//------------------------------------------------------------------------------------------------
void vtkFDSSmokeReader::ReadGeometry(vtkInformation* outInfo)
{
  smokevis::FDSRun& run = this->Internals->Run;
  const double time = this->SceneTime(outInfo);
  vtkDataObject* const output = outInfo->Get(vtkDataObject::DATA_OBJECT());
  // Walls need no data but the index, which all processes have; shown they are once.
  if (smokevis::FDSPieces(run.Index(), outInfo).IsFirstPiece())
  {
    std::vector<std::string> warnings;
    output->ShallowCopy(run.Geometry(time, this->TransparencyThreshold, warnings));
    this->Warn(warnings);
  }
  output->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
}

//------------------------------------------------------------------------------------------------
void vtkFDSSmokeReader::ReadDevices(vtkInformation* outInfo)
{
  const smokevis::SmvFile& index = this->Internals->Run.Index();
  if (!smokevis::FDSPieces(index, outInfo).IsFirstPiece())
  {
    return;
  }
  vtkTable* const devices = vtkTable::SafeDownCast(outInfo->Get(vtkDataObject::DATA_OBJECT()));
  this->Warn(smokevis::ReadDeviceTable(index, devices));
  this->WarnOfGrowth(outInfo);
}
