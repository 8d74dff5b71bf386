#include "vtkFDSSmokeReader.h"

#include "vtkFDSDeviceTable.h"

#include "Errors.h"
#include "ExtinctionSource.h"
#include "SmvFile.h"
#include "SolidCells.h"
#include "SrgbColor.h"
#include "WallBuilder.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <set>
#include <span>
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
  NumberOfPorts
};

// FDS's default single-scattering albedo of smoke.
constexpr double DefaultAlbedo = 0.3;

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

vtkSmartPointer<vtkDoubleArray> Coordinates(const std::vector<double>& nodes)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetNumberOfValues(static_cast<vtkIdType>(nodes.size()));
  std::copy(nodes.begin(), nodes.end(), array->GetPointer(0));
  return array;
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
  std::unique_ptr<smokevis::SmvFile> Index;
  std::unique_ptr<smokevis::ExtinctionSource> Smoke;
  // Why there is no Smoke; an error only for those who ask for smoke.
  std::string SmokeProblem;
  // What was loaded: to read the index again only when it or a property changed.
  std::string LoadedName;
  std::filesystem::file_time_type LoadedStamp;
  double LoadedVisibilityFactor = 0.0;
  bool WarnedOfIndex = false;
  bool WarnedOfSmoke = false;
  // The geometry of last time, for time steps at which nothing changed.
  vtkSmartPointer<vtkPolyData> Geometry;
  std::vector<bool> GeometryChanges;
  double GeometryThreshold = 0.0;
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
  os << indent << "VisibilityFactor: " << this->VisibilityFactor << "\n";
}

//------------------------------------------------------------------------------------------------
int vtkFDSSmokeReader::FillOutputPortInformation(int port, vtkInformation* info)
{
  static constexpr const char* types[NumberOfPorts] = {
    "vtkPartitionedDataSetCollection", "vtkPolyData", "vtkTable"};
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
void vtkFDSSmokeReader::LoadIndex()
{
  if (!this->FileName || !*this->FileName)
  {
    throw smokevis::Error(
      "FDS reader", "no file name is set", "Set FileName to the run's .smv file");
  }
  vtkInternals& own = *this->Internals;
  std::error_code problem;
  const auto stamp = std::filesystem::last_write_time(this->FileName, problem);
  const bool sameIndex =
    own.Index && !problem && own.LoadedName == this->FileName && own.LoadedStamp == stamp;
  if (sameIndex && own.LoadedVisibilityFactor == this->VisibilityFactor)
  {
    return;
  }
  own = vtkInternals();
  own.Index = std::make_unique<smokevis::SmvFile>(this->FileName);
  own.LoadedName = this->FileName;
  own.LoadedStamp = stamp;
  own.LoadedVisibilityFactor = this->VisibilityFactor;
  try
  {
    own.Smoke = std::make_unique<smokevis::ExtinctionSource>(*own.Index, this->VisibilityFactor);
  }
  catch (const smokevis::Error& error)
  {
    own.SmokeProblem = error.what();
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
  for (const int port : {SmokePort, GeometryPort})
  {
    vtkInformation* info = outputVector->GetInformationObject(port);
    info->Set(
      vtkStreamingDemandDrivenPipeline::TIME_STEPS(), steps.data(), static_cast<int>(steps.size()));
    info->Set(vtkStreamingDemandDrivenPipeline::TIME_RANGE(), range.data(), 2);
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
  return asked ? own.Smoke->NearestTime(time) : own.Smoke->Times().front();
}

//------------------------------------------------------------------------------------------------
int vtkFDSSmokeReader::RequestData(
  vtkInformation* request, vtkInformationVector**, vtkInformationVector* outputVector)
{
  const int wanted = request->Get(vtkExecutive::FROM_OUTPUT_PORT());
  const auto isWanted = [wanted](int port) { return wanted < 0 || wanted == port; };
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
    if (isWanted(SmokePort))
    {
      const double time = this->SceneTime(outputVector->GetInformationObject(SmokePort));
      this->ReadSmoke(time, vtkPartitionedDataSetCollection::GetData(outputVector, SmokePort));
    }
    if (isWanted(GeometryPort))
    {
      const double time = this->SceneTime(outputVector->GetInformationObject(GeometryPort));
      this->ReadGeometry(time, vtkPolyData::GetData(outputVector, GeometryPort));
    }
    if (isWanted(DevicesPort))
    {
      vtkTable* devices = vtkTable::GetData(outputVector, DevicesPort);
      for (const std::string& missing : smokevis::ReadDeviceTable(*own.Index, devices))
      {
        vtkWarningMacro(<< missing
                        << ": the device table is missing, so Devices is empty. Copy the "
                        << "file that the index names beside the index.");
      }
    }
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
    return 0;
  }
  return 1;
}

//------------------------------------------------------------------------------------------------
void vtkFDSSmokeReader::ReadSmoke(double time, vtkPartitionedDataSetCollection* output)
{
  vtkInternals& own = *this->Internals;
  if (!own.Smoke)
  {
    throw std::runtime_error(own.SmokeProblem);
  }
  for (const std::string& warning : own.Smoke->Warnings())
  {
    if (!own.WarnedOfSmoke)
    {
      vtkWarningMacro(<< warning);
    }
  }
  own.WarnedOfSmoke = true;

  vtkNew<vtkFieldData> fields;
  AddField(fields, "ExtinctionSource", own.Smoke->Description());
  AddField(fields, "Albedo", own.Index->Albedo.value_or(DefaultAlbedo));
  AddField(fields, "Time", time);
  AddField(fields, "CHID", own.Index->Chid);

  // Filled aside, so that an error or an abort leaves nothing half read in the output.
  const int count = static_cast<int>(own.Index->Meshes.size());
  vtkNew<vtkPartitionedDataSetCollection> collection;
  collection->SetNumberOfPartitionedDataSets(static_cast<unsigned int>(count));
  for (int i = 0; i < count; ++i)
  {
    this->UpdateProgress(static_cast<double>(i) / count);
    if (this->CheckAbort())
    {
      return;
    }
    const smokevis::SmvMesh& mesh = own.Index->Meshes[i];
    const std::vector<unsigned char> solid =
      smokevis::SolidCells(mesh, smokevis::PresentObstructions(*own.Index, i, time, 0.0));
    const auto cells = static_cast<vtkIdType>(mesh.Cells(0)) * mesh.Cells(1) * mesh.Cells(2);
    vtkNew<vtkFloatArray> values;
    values->SetName("Extinction");
    values->SetNumberOfValues(cells);
    const double readTime = own.Smoke->Read(
      i, time, solid, std::span<float>(values->GetPointer(0), static_cast<std::size_t>(cells)));
    // Meshes write their frames at the same time step, so times agree to rounding.
    if (std::abs(readTime - time) > 1e-4 * std::max(1.0, std::abs(time)))
    {
      vtkWarningMacro(<< "Mesh '" << mesh.Name << "' has no frame at " << time
                      << " s: its frame at " << readTime << " s is shown.");
    }
    vtkNew<vtkUnsignedCharArray> solids;
    solids->SetName("Solid");
    solids->SetNumberOfValues(cells);
    if (solid.empty())
    {
      solids->FillValue(0);
    }
    else
    {
      std::copy(solid.begin(), solid.end(), solids->GetPointer(0));
    }
    vtkNew<vtkRectilinearGrid> grid;
    grid->SetDimensions(mesh.Cells(0) + 1, mesh.Cells(1) + 1, mesh.Cells(2) + 1);
    grid->SetXCoordinates(Coordinates(mesh.Nodes[0]));
    grid->SetYCoordinates(Coordinates(mesh.Nodes[1]));
    grid->SetZCoordinates(Coordinates(mesh.Nodes[2]));
    grid->GetCellData()->SetScalars(values);
    grid->GetCellData()->AddArray(solids);
    grid->GetFieldData()->ShallowCopy(fields);
    const auto block = static_cast<unsigned int>(i);
    collection->SetPartition(block, 0, grid);
    collection->GetMetaData(block)->Set(vtkCompositeDataSet::NAME(), mesh.Name.c_str());
  }
  collection->GetFieldData()->ShallowCopy(fields);
  output->ShallowCopy(collection);
  output->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
}

//------------------------------------------------------------------------------------------------
void vtkFDSSmokeReader::ReadGeometry(double time, vtkPolyData* output)
{
  vtkInternals& own = *this->Internals;
  const std::vector<bool> changes = ChangesAt(*own.Index, time);
  if (!own.Geometry || own.GeometryChanges != changes ||
      own.GeometryThreshold != this->TransparencyThreshold)
  {
    smokevis::WallBuilder builder(*own.Index, time, this->TransparencyThreshold);
    const std::vector<smokevis::WallQuad> quads = builder.Build();
    if (builder.FoundMirror())
    {
      vtkWarningMacro(
        "The run has MIRROR boundaries: they are taken as diffuse walls, and what they "
        "would mirror is missing from images.");
    }
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkCellArray> polygons;
    vtkNew<vtkFloatArray> reflectance;
    reflectance->SetName("Reflectance");
    reflectance->SetNumberOfComponents(3);
    vtkNew<vtkStringArray> names;
    names->SetName("SurfaceName");
    for (const smokevis::WallQuad& quad : quads)
    {
      polygons->InsertNextCell(4);
      for (const std::array<double, 3>& corner : quad.Corners())
      {
        polygons->InsertCellPoint(points->InsertNextPoint(corner.data()));
      }
      const smokevis::WallMaterial& material = builder.Materials()[quad.Material];
      std::array<float, 3> linear{};
      std::transform(material.Color.begin(), material.Color.end(), linear.begin(),
        [](double part) { return static_cast<float>(smokevis::LinearFromSrgb(part)); });
      reflectance->InsertNextTypedTuple(linear.data());
      names->InsertNextValue(own.Index->Surfaces[material.Surface].Name);
    }
    own.Geometry = vtkSmartPointer<vtkPolyData>::New();
    own.Geometry->SetPoints(points);
    own.Geometry->SetPolys(polygons);
    own.Geometry->GetCellData()->AddArray(reflectance);
    own.Geometry->GetCellData()->AddArray(names);
    own.GeometryChanges = changes;
    own.GeometryThreshold = this->TransparencyThreshold;
  }
  output->ShallowCopy(own.Geometry);
  output->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
}
