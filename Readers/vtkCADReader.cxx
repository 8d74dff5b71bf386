#include "vtkCADReader.h"

#include "CadFile.h"
#include "CadImages.h"
#include "CadPolyData.h"
#include "Errors.h"
#include "KeptOutput.h"
#include "MaterialTable.h"
#include "PipelineProgress.h"
#include "PrintableText.h"
#include "PropertyChecks.h"
#include "Ranks.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkTransform.h"

#include <filesystem>
#include <string>

vtkStandardNewMacro(vtkCADReader);

namespace
{

enum Port
{
  SurfacesPort,
  EmittersPort,
  NumberOfPorts
};

// Most names that a message lists.
constexpr std::size_t MostListed = 10;

} // namespace

//------------------------------------------------------------------------------------------------
struct vtkCADReader::vtkInternals
{
  std::unique_ptr<smokevis::CadModel> Model;
  // What was read: to read the file again only when it or a property that counts for it changed.
  std::string ReadName;
  std::filesystem::file_time_type ReadStamp;
  smokevis::CadOptions ReadOptions;
  smokevis::KeptOutput Kept;
};

//------------------------------------------------------------------------------------------------
vtkCADReader::vtkCADReader() : Internals(std::make_unique<vtkInternals>())
{
  this->SetNumberOfInputPorts(0);
  this->SetNumberOfOutputPorts(NumberOfPorts);
}

//------------------------------------------------------------------------------------------------
vtkCADReader::~vtkCADReader()
{
  this->SetFileName(nullptr);
  this->SetMaterialTable(nullptr);
}

//------------------------------------------------------------------------------------------------
void vtkCADReader::SetDefaultReflectance(double value)
{
  smokevis::SetClamped(this, this->DefaultReflectance, value, 0.0, 1.0);
}

//------------------------------------------------------------------------------------------------
void vtkCADReader::SetTransparencyThreshold(double value)
{
  smokevis::SetClamped(this, this->TransparencyThreshold, value, 0.0, 1.0);
}

//------------------------------------------------------------------------------------------------
void vtkCADReader::CheckProperties() const
{
  for (int axis = 0; axis < 3; ++axis)
  {
    smokevis::CheckFinite("Translation", this->Translation[axis], "Give metres");
    smokevis::CheckFinite("Rotation", this->Rotation[axis], "Give degrees");
  }
  smokevis::CheckFinite("DefaultReflectance", this->DefaultReflectance, "Give 0 to 1");
  smokevis::CheckFinite("TransparencyThreshold", this->TransparencyThreshold, "Give 0 to 1");
}

//------------------------------------------------------------------------------------------------
int vtkCADReader::ComputePipelineMTime(
  vtkInformation*, vtkInformationVector**, vtkInformationVector*, int, vtkMTimeType* mtime)
{
  *mtime = this->Internals->Kept.PipelineMTime(this->GetMTime());
  return 1;
}

//------------------------------------------------------------------------------------------------
void vtkCADReader::LoadModel()
{
  if (!this->FileName || !*this->FileName)
  {
    throw smokevis::Error("CAD reader", "no file name is set", "Set FileName to a CAD file");
  }
  smokevis::CadOptions options;
  options.UnitScale = this->UnitScale;
  options.Up = static_cast<smokevis::UpAxis>(this->UpAxis);
  options.Colors = static_cast<smokevis::ColorSpace>(this->ColorSpace);
  options.LinearTolerance = this->LinearTolerance;
  options.AngularTolerance = this->AngularTolerance;

  vtkInternals& own = *this->Internals;
  std::error_code problem;
  const auto stamp = std::filesystem::last_write_time(this->FileName, problem);
  if (own.Model && !problem && own.ReadName == this->FileName && own.ReadStamp == stamp &&
      own.ReadOptions == options)
  {
    return;
  }
  own.Model.reset();
  auto model = std::make_unique<smokevis::CadModel>();
  smokevis::RunWithProgress(this, 0.0, 0.9,
    [&](smokevis::Progress& progress)
    { *model = smokevis::ReadCadFile(this->FileName, options, progress); });
  smokevis::ApplyImages(*model);
  for (const std::string& warning : model->Warnings)
  {
    vtkWarningMacro(<< smokevis::Printable(this->FileName + (": " + warning + ".")));
  }
  own.Model = std::move(model);
  own.ReadName = this->FileName;
  own.ReadStamp = stamp;
  own.ReadOptions = options;
}

//------------------------------------------------------------------------------------------------
int vtkCADReader::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  smokevis::HandlePieces(outputVector);
  return 1;
}

//------------------------------------------------------------------------------------------------
int vtkCADReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  const auto work = [&]
  {
    smokevis::Ranks().Together(this,
      [&]
      {
        this->CheckProperties();
        this->LoadModel();
        this->Build(*vtkPolyData::GetData(outputVector, SurfacesPort),
          *vtkPolyData::GetData(outputVector, EmittersPort));
      });
    this->UpdateProgress(1.0);
  };
  const int done = this->Internals->Kept.Produce(this, outputVector, work);
  smokevis::LeaveToFirstPiece(outputVector);
  return done;
}

//------------------------------------------------------------------------------------------------
void vtkCADReader::Build(vtkPolyData& surfaces, vtkPolyData& emitters)
{
  const smokevis::CadModel& model = *this->Internals->Model;
  smokevis::MaterialTable table;
  if (this->MaterialTable && *this->MaterialTable)
  {
    table = smokevis::MaterialTable(this->MaterialTable);
    const std::vector<std::string> unmatched = table.Unmatched(model);
    std::string list;
    for (std::size_t i = 0; i < unmatched.size() && i < MostListed; ++i)
    {
      list += (list.empty() ? "" : "; ") + unmatched[i];
    }
    if (!unmatched.empty())
    {
      vtkWarningMacro(<< "material table '" << this->MaterialTable << "': " << unmatched.size()
                      << " rows match no material and no object: " << smokevis::Printable(list)
                      << ". The names are in the cell arrays Material and Object.");
    }
  }
  vtkNew<vtkTransform> placement;
  placement->Translate(this->Translation);
  placement->RotateZ(this->Rotation[2]);
  placement->RotateX(this->Rotation[0]);
  placement->RotateY(this->Rotation[1]);
  smokevis::CadPolyDataOptions options;
  options.DefaultReflectance = this->DefaultReflectance;
  options.TransparencyThreshold = this->TransparencyThreshold;
  const smokevis::CadTriangleCounts counts =
    smokevis::BuildCadPolyData(model, table, options, *placement->GetMatrix(), surfaces, emitters);
  if (counts.Kept == 0)
  {
    throw smokevis::Error(this->FileName,
      "nothing of it is left: " + std::to_string(counts.Transparent) +
        " triangles are transparent and " + std::to_string(counts.Dropped) +
        " are dropped by the material table",
      "Lower TransparencyThreshold or change the table");
  }
}

//------------------------------------------------------------------------------------------------
void vtkCADReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "MaterialTable: " << (this->MaterialTable ? this->MaterialTable : "(none)")
     << "\n";
  os << indent << "UnitScale: " << this->UnitScale << "\n";
  os << indent << "UpAxis: " << this->UpAxis << "\n";
  os << indent << "Translation: (" << this->Translation[0] << ", " << this->Translation[1] << ", "
     << this->Translation[2] << ")\n";
  os << indent << "Rotation: (" << this->Rotation[0] << ", " << this->Rotation[1] << ", "
     << this->Rotation[2] << ")\n";
  os << indent << "LinearTolerance: " << this->LinearTolerance << "\n";
  os << indent << "AngularTolerance: " << this->AngularTolerance << "\n";
  os << indent << "ColorSpace: " << this->ColorSpace << "\n";
  os << indent << "DefaultReflectance: " << this->DefaultReflectance << "\n";
  os << indent << "TransparencyThreshold: " << this->TransparencyThreshold << "\n";
}
