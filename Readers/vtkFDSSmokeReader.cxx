#include "vtkFDSSmokeReader.h"

#include "vtkFDSDeviceTable.h"
#include "vtkFDSPieces.h"
#include "vtkFDSPlaneSlices.h"
#include "vtkFDSSmokeMeshes.h"
#include "vtkFDSWalls.h"

#include "Errors.h"
#include "ExtinctionSource.h"
#include "FlameSource.h"
#include "KeptOutput.h"
#include "MemoryGuard.h"
#include "PipelineProgress.h"
#include "SmvFile.h"

#include "vtkDemandDrivenPipeline.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

namespace
{

enum Port
{
  SmokePort,
  GeometryPort,
  DevicesPort,
  SlicesPort,
  NumberOfPorts
};

// FDS's default single-scattering albedo of smoke.
constexpr double DefaultAlbedo = 0.3;
// Memory that a mesh's arrays and the buffers for reading them take [bytes a cell].
constexpr double CellBytes = 24.0;
// Share of the flames' light that may go astray before it is worth a warning.
constexpr double TolerableLoss = 0.01;

// Which of the things that change while the run goes are there at a time.
std::vector<bool> ChangesAt(const smokevis::SmvFile& index, double time)
{
  std::vector<bool> state;
  const auto append = [&](const auto& things)
  {
    for (const auto& thing : things)
    {
      if (!thing.Events.empty())
      {
        state.push_back(smokevis::IsOn(thing.Events, time));
      }
    }
  };
  for (const smokevis::SmvMesh& mesh : index.Meshes)
  {
    append(mesh.Obstructions);
    append(mesh.Vents);
  }
  return state;
}

void AddField(vtkFieldData* fields, const char* name, double value)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->InsertNextValue(value);
  fields->AddArray(array);
}

void AddField(vtkFieldData* fields, const char* name, const std::string& value)
{
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  array->InsertNextValue(value);
  fields->AddArray(array);
}

} // namespace

vtkStandardNewMacro(vtkFDSSmokeReader);

//------------------------------------------------------------------------------------------------
struct vtkFDSSmokeReader::vtkInternals
{
  // What was loaded: to read the index again only when it or one of these properties changed.
  struct Key
  {
    std::string Name;
    std::filesystem::file_time_type Stamp;
    std::tuple<double, double, int, int> Properties;

    bool operator==(const Key&) const = default;
  };

  Key Loaded;
  std::unique_ptr<smokevis::SmvFile> Index;
  std::unique_ptr<smokevis::ExtinctionSource> Smoke;
  // Why there is no Smoke; an error only for those who ask for smoke.
  std::string SmokeProblem;
  std::unique_ptr<smokevis::FlameSource> Flames;
  std::unique_ptr<smokevis::FDSPlaneSlices> Slices;
  bool WarnedOfIndex = false;
  bool WarnedOfSmoke = false;
  bool WarnedOfFlames = false;
  // The geometry of last time, for time steps at which nothing changed.
  vtkSmartPointer<vtkPolyData> Geometry;
  std::vector<bool> GeometryChanges;
  bool GeometryMoves = false;
  double GeometryThreshold = 0.0;
  smokevis::KeptOutput Kept;

  // Forgets the run, but not what is shown of it.
  void Reset()
  {
    vtkInternals fresh;
    fresh.Kept = std::move(this->Kept);
    *this = std::move(fresh);
  }
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
}

//------------------------------------------------------------------------------------------------
int vtkFDSSmokeReader::FillOutputPortInformation(int port, vtkInformation* info)
{
  static constexpr const char* types[NumberOfPorts] = {"vtkPartitionedDataSetCollection",
    "vtkPolyData", "vtkTable", "vtkPartitionedDataSetCollection"};
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
  this->Internals->Reset();
  this->Modified();
}

//------------------------------------------------------------------------------------------------
void vtkFDSSmokeReader::LoadIndex()
{
  if (!this->FileName || !*this->FileName)
  {
    throw smokevis::Error(
      "FDS reader", "no file name is set", "Set FileName to the run's .smv file");
  }
  std::error_code problem;
  const vtkInternals::Key key{this->FileName,
    std::filesystem::last_write_time(this->FileName, problem),
    {this->VisibilityFactor, this->MassExtinctionCoefficient, this->ExtinctionSource,
      this->FlameModel}};
  vtkInternals& own = *this->Internals;
  if (own.Index && !problem && own.Loaded == key)
  {
    return;
  }
  own.Reset();
  own.Index = std::make_unique<smokevis::SmvFile>(this->FileName);
  own.Loaded = key;
  own.Slices = std::make_unique<smokevis::FDSPlaneSlices>(*own.Index);
  try
  {
    const smokevis::SmokeOptions options{this->VisibilityFactor, this->MassExtinctionCoefficient,
      static_cast<smokevis::SmokeSourceKind>(this->ExtinctionSource)};
    own.Smoke = std::make_unique<smokevis::ExtinctionSource>(*own.Index, options);
  }
  catch (const smokevis::Error& error)
  {
    own.SmokeProblem = error.what();
  }
  if (own.Smoke && this->FlameModel != NO_FLAMES)
  {
    own.Flames = std::make_unique<smokevis::FlameSource>(*own.Index,
      this->FlameModel == FLAMES_BY_TEMPERATURE ? smokevis::FlameModel::BlackBody
                                                : smokevis::FlameModel::LuminousEfficacy);
  }
}

//------------------------------------------------------------------------------------------------
int vtkFDSSmokeReader::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  try
  {
    this->LoadIndex();
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
    return 0;
  }
  const vtkInternals& own = *this->Internals;
  std::set<double> times;
  if (own.Smoke)
  {
    times.insert(own.Smoke->Times().begin(), own.Smoke->Times().end());
  }
  else
  {
    // The walls still change.
    times.insert(own.Index->Times[0]);
    for (const smokevis::SmvMesh& mesh : own.Index->Meshes)
    {
      for (const smokevis::SmvObstruction& obstruction : mesh.Obstructions)
      {
        for (const smokevis::SmvEvent& event : obstruction.Events)
        {
          times.insert(event.Time);
        }
      }
    }
  }
  const std::vector<double> steps(times.begin(), times.end());
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
  const vtkInternals& own = *this->Internals;
  const bool asked = outInfo->Has(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP());
  const double time =
    asked ? outInfo->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP()) : 0.0;
  if (!own.Smoke)
  {
    return asked ? time : own.Index->Times[0];
  }
  // Walls and smoke are of the same moment.
  const std::vector<double>& times = own.Smoke->Times();
  if (!asked)
  {
    return times.front();
  }
  return this->TimeInterpolation == LINEAR_IN_TIME ? std::clamp(time, times.front(), times.back())
                                                   : own.Smoke->NearestTime(time);
}

//------------------------------------------------------------------------------------------------
int vtkFDSSmokeReader::RequestData(
  vtkInformation* request, vtkInformationVector**, vtkInformationVector* outputVector)
{
  const int wanted = request->Get(vtkExecutive::FROM_OUTPUT_PORT());
  try
  {
    this->LoadIndex();
    vtkInternals& own = *this->Internals;
    for (const std::string& warning : own.Index->Warnings)
    {
      if (!own.WarnedOfIndex)
      {
        vtkWarningMacro(<< warning);
      }
    }
    own.WarnedOfIndex = true;
    for (int port = 0; port < NumberOfPorts; ++port)
    {
      if (wanted < 0 || wanted == port)
      {
        this->ReadPort(port, outputVector->GetInformationObject(port));
        own.Kept.Keep(outputVector, port);
      }
    }
  }
  catch (const std::exception& error)
  {
    smokevis::KeptOutput& kept = this->Internals->Kept;
    if (this->GetAbortOutput())
    {
      for (int port = 0; port < NumberOfPorts; ++port)
      {
        if (wanted < 0 || wanted == port)
        {
          kept.Restore(this, outputVector, port);
        }
      }
      return 1;
    }
    kept.Clear();
    vtkErrorMacro(<< error.what());
    return 0;
  }
  return 1;
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
  default:
    this->ReadSlices(outInfo);
  }
}

//------------------------------------------------------------------------------------------------
void vtkFDSSmokeReader::ReadSmoke(vtkInformation* outInfo)
{
  vtkInternals& own = *this->Internals;
  if (!own.Smoke)
  {
    throw std::runtime_error(own.SmokeProblem);
  }
  const auto warn = [this](const std::vector<std::string>& warnings, bool& warned)
  {
    for (const std::string& warning : warnings)
    {
      if (!warned)
      {
        vtkWarningMacro(<< warning);
      }
    }
    warned = true;
  };
  warn(own.Smoke->Warnings(), own.WarnedOfSmoke);

  const bool flames = own.Flames && own.Flames->HasData();
  smokevis::SmokeRequest request;
  request.Index = own.Index.get();
  request.Smoke = own.Smoke.get();
  request.Flames = flames ? own.Flames.get() : nullptr;
  request.Glow = this->FlameModel == FLAMES_BY_TEMPERATURE;
  request.Efficacy = this->LuminousEfficacy;
  request.Albedo = this->Albedo >= 0.0 ? this->Albedo : own.Index->Albedo.value_or(DefaultAlbedo);
  request.Time = this->SceneTime(outInfo);
  request.Interpolation = static_cast<smokevis::TimeInterpolation>(this->TimeInterpolation);

  using Outcome = smokevis::FDSPieces::Outcome;
  const smokevis::FDSPieces pieces(*own.Index, outInfo);
  std::vector<smokevis::SmokeMesh> meshes;
  std::string problem;
  Outcome outcome = Outcome::Good;
  try
  {
    double cells = 0.0;
    for (int i = pieces.First(); i < pieces.End(); ++i)
    {
      const smokevis::SmvMesh& mesh = own.Index->Meshes[i];
      cells += static_cast<double>(mesh.Cells(0)) * mesh.Cells(1) * mesh.Cells(2);
    }
    smokevis::RequireMemory(std::string("run '") + this->FileName + "'", "its smoke",
      CellBytes * cells, "Check that the file is whole, or read the run on more machines");
    smokevis::RunWithProgress(this, 0.0, 0.9,
      [&](smokevis::Progress& progress)
      { meshes = smokevis::ReadSmokeMeshes(request, pieces.First(), pieces.End(), progress); });
  }
  catch (const std::exception& error)
  {
    problem = error.what();
    outcome = this->GetAbortOutput() ? Outcome::Aborted : Outcome::Failed;
  }
  // All processes go on, or none.
  const Outcome all = pieces.Agree(outcome);
  if (all == Outcome::Failed)
  {
    throw std::runtime_error(problem.empty()
                               ? "Another process could not read its meshes; its message says why."
                               : problem);
  }
  if (all == Outcome::Aborted)
  {
    // Perhaps by another process only.
    this->SetAbortOutput(true);
    throw smokevis::Error("FDS reader", "reading was stopped", "Update again to have it done");
  }

  const std::size_t count = own.Index->Meshes.size();
  std::vector<smokevis::FlameLight> lights(count);
  for (std::size_t i = 0; i < meshes.size(); ++i)
  {
    lights[pieces.First() + i] = meshes[i].Light;
    // Meshes write their frames at the same time step, so times agree to rounding.
    if (std::abs(meshes[i].Time - request.Time) > 1e-4 * std::max(1.0, std::abs(request.Time)))
    {
      vtkWarningMacro(<< "Mesh '" << own.Index->Meshes[pieces.First() + i].Name
                      << "' has no frame at " << request.Time << " s: its frame at "
                      << meshes[i].Time << " s is shown.");
    }
  }
  vtkNew<vtkFieldData> fields;
  AddField(fields, "ExtinctionSource", own.Smoke->Description());
  AddField(fields, "Albedo", request.Albedo);
  AddField(fields, "Time", request.Time);
  AddField(fields, "CHID", own.Index->Chid);
  if (own.Flames && !own.Flames->Warnings().empty())
  {
    std::string lines;
    for (const std::string& warning : own.Flames->Warnings())
    {
      lines += (lines.empty() ? "" : "\n") + warning;
    }
    warn({lines}, own.WarnedOfFlames);
  }
  if (flames)
  {
    const smokevis::FlameLight light = pieces.Sum(lights);
    AddField(fields, "FlameSource",
      (request.Glow ? "black body at the temperature of " : "luminous efficacy times ") +
        own.Flames->Description());
    AddField(fields, "FlameHeatRelease", light.HeatRelease);
    AddField(fields, "FlameLumens", light.LumensAsked);
    AddField(fields, "FlameLumensPlaced", light.LumensPlaced);
    if (light.LumensPlaced < (1.0 - TolerableLoss) * light.LumensAsked && pieces.IsFirstPiece())
    {
      vtkWarningMacro(<< "At " << request.Time << " s the flames give " << light.LumensAsked
                      << " lm, but only " << light.LumensPlaced
                      << " lm are shown: in some meshes no burning cell has smoke that could emit "
                      << "it. Put a Luminaire of the missing light there.");
    }
  }

  vtkNew<vtkPartitionedDataSetCollection> collection;
  collection->SetNumberOfPartitionedDataSets(static_cast<unsigned int>(count));
  std::vector<int> meshOfBlock;
  for (std::size_t i = 0; i < meshes.size(); ++i)
  {
    meshes[i].Grid->GetFieldData()->ShallowCopy(fields);
    collection->SetPartition(static_cast<unsigned int>(pieces.First() + i), 0, meshes[i].Grid);
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    meshOfBlock.push_back(static_cast<int>(i));
  }
  pieces.Complete(collection, meshOfBlock);
  for (std::size_t i = 0; i < count; ++i)
  {
    collection->GetMetaData(static_cast<unsigned int>(i))
      ->Set(vtkCompositeDataSet::NAME(), own.Index->Meshes[i].Name.c_str());
  }
  collection->GetFieldData()->ShallowCopy(fields);
  vtkDataObject* const output = outInfo->Get(vtkDataObject::DATA_OBJECT());
  output->ShallowCopy(collection);
  output->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), request.Time);
}

//------------------------------------------------------------------------------------------------
void vtkFDSSmokeReader::ReadGeometry(vtkInformation* outInfo)
{
  vtkInternals& own = *this->Internals;
  const double time = this->SceneTime(outInfo);
  vtkDataObject* const output = outInfo->Get(vtkDataObject::DATA_OBJECT());
  output->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
  // Walls need no data but the index, which all processes have; shown they are once.
  if (!smokevis::FDSPieces(*own.Index, outInfo).IsFirstPiece())
  {
    return;
  }
  const std::vector<bool> changes = ChangesAt(*own.Index, time);
  if (!own.Geometry || own.GeometryMoves || own.GeometryChanges != changes ||
      own.GeometryThreshold != this->TransparencyThreshold)
  {
    own.Geometry = vtkSmartPointer<vtkPolyData>::New();
    const smokevis::WallReport report =
      smokevis::BuildWalls(*own.Index, time, this->TransparencyThreshold, own.Geometry);
    if (report.Mirrors)
    {
      vtkWarningMacro(
        "The run has MIRROR boundaries: they are taken as diffuse walls, and what they "
        "would mirror is missing from images.");
    }
    for (const std::string& warning : report.Warnings)
    {
      vtkWarningMacro(<< warning);
    }
    own.GeometryMoves = report.Moves;
    own.GeometryChanges = changes;
    own.GeometryThreshold = this->TransparencyThreshold;
  }
  output->ShallowCopy(own.Geometry);
  output->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
}

//------------------------------------------------------------------------------------------------
void vtkFDSSmokeReader::ReadDevices(vtkInformation* outInfo)
{
  vtkInternals& own = *this->Internals;
  if (!smokevis::FDSPieces(*own.Index, outInfo).IsFirstPiece())
  {
    return;
  }
  vtkTable* const devices = vtkTable::SafeDownCast(outInfo->Get(vtkDataObject::DATA_OBJECT()));
  for (const std::string& missing : smokevis::ReadDeviceTable(*own.Index, devices))
  {
    vtkWarningMacro(<< missing << ": the device table is missing, so Devices is empty. Copy the "
                    << "file that the index names beside the index.");
  }
}

//------------------------------------------------------------------------------------------------
void vtkFDSSmokeReader::ReadSlices(vtkInformation* outInfo)
{
  if (!this->ReadPlaneSlices)
  {
    return;
  }
  vtkInternals& own = *this->Internals;
  const double time = this->SceneTime(outInfo);
  const auto interpolation = static_cast<smokevis::TimeInterpolation>(this->TimeInterpolation);
  const smokevis::FDSPieces pieces(*own.Index, outInfo);
  std::vector<smokevis::FDSPlaneSlices::Plane>& planes = own.Slices->Planes();
  vtkNew<vtkPartitionedDataSetCollection> collection;
  collection->SetNumberOfPartitionedDataSets(static_cast<unsigned int>(planes.size()));
  std::vector<int> meshOfBlock;
  std::string problems;
  for (unsigned int block = 0; block < planes.size(); ++block)
  {
    smokevis::FDSPlaneSlices::Plane& plane = planes[block];
    const int mesh = plane.Slice->Mesh;
    meshOfBlock.push_back(mesh);
    std::error_code missing;
    const std::string path = own.Index->Resolve(plane.Slice->File);
    if (mesh < pieces.First() || mesh >= pieces.End() || !std::filesystem::exists(path, missing))
    {
      continue;
    }
    try
    {
      collection->SetPartition(block, 0, own.Slices->Read(plane, time, interpolation));
    }
    catch (const std::exception& error)
    {
      problems += (problems.empty() ? "" : "\n") + std::string(error.what());
    }
  }
  if (!problems.empty())
  {
    vtkWarningMacro(<< "Some 2-D slices are left out: " << problems);
  }
  pieces.Complete(collection, meshOfBlock);
  for (unsigned int block = 0; block < planes.size(); ++block)
  {
    collection->GetMetaData(block)->Set(vtkCompositeDataSet::NAME(), planes[block].Name.c_str());
  }
  AddField(collection->GetFieldData(), "Time", time);
  AddField(collection->GetFieldData(), "CHID", own.Index->Chid);
  vtkDataObject* const output = outInfo->Get(vtkDataObject::DATA_OBJECT());
  output->ShallowCopy(collection);
  output->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
}
