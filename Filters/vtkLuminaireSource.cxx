#include "vtkLuminaireSource.h"

#include "Errors.h"
#include "LightFieldInput.h"
#include "PhotometricArrays.h"
#include "PhotometricFile.h"
#include "PlateMesh.h"
#include "PropertyChecks.h"
#include "Ranks.h"

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkInformationVector.h>
#include <vtkIntArray.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>

vtkStandardNewMacro(vtkLuminaireSource);

namespace
{

constexpr int MaximumCount = 10000;
constexpr std::int64_t MaximumLamps = 1000000;
/// Plates of a lamp that shines both ways are at least so far apart [m].
constexpr double ThinnestLamp = 1e-3;
/// Files round their intensities and lumens.
constexpr double FluxTolerance = 1.02;

using smokevis::Error;

/// One luminous side of a lamp.
struct Side
{
  /// Against the lamp's normal.
  bool Back = false;
  double Luminance = 0.0;
  /// Empty for a Lambertian side.
  smokevis::PhotometricHalf Photometry;
};

/// What all lamps of a source share.
struct Lamp
{
  double Width = 0.0;
  double Height = 0.0;
  /// Between its sides [m].
  double Depth = 0.0;
  std::vector<Side> Sides;
  double Flux = 0.0;
  double RatedFlux = -1.0;
};

Lamp EvenLamp(double width, double height, double luminance, double flux)
{
  // Lambert: a plane of luminance L and area A sends out pi L A.
  const double unit = vtkMath::Pi() * width * height;
  Lamp lamp{width, height, 0.0, {}, flux > 0.0 ? flux : unit * luminance, -1.0};
  lamp.Sides.push_back({false, flux > 0.0 ? flux / unit : luminance, {}});
  return lamp;
}

Lamp MeasuredLamp(
  const smokevis::PhotometricFile& file, double width, double height, double flux, bool fileSize)
{
  Lamp lamp{width, height, std::max(ThinnestLamp, file.Height), {}, file.Flux(), file.RatedFlux};
  if (fileSize && file.Width > 0.0 && file.Length > 0.0)
  {
    lamp.Width = file.Width;
    lamp.Height = file.Length;
  }
  const double scale = flux > 0.0 ? flux / lamp.Flux : 1.0;
  lamp.Flux *= scale;
  for (const bool back : {false, true})
  {
    Side side{back, 0.0, back ? file.Up() : file.Down()};
    if (side.Photometry.Candela.empty())
    {
      continue;
    }
    for (double& value : side.Photometry.Candela)
    {
      value *= scale;
    }
    side.Luminance = scale * side.Photometry.Flux / (vtkMath::Pi() * lamp.Width * lamp.Height);
    lamp.Sides.push_back(std::move(side));
  }
  return lamp;
}

/// The tables of a lamp's sides, and which each of so many lamps has.
void AddPhotometry(vtkPolyData& output, const Lamp& lamp, const smokevis::Vec3& axis)
{
  vtkNew<vtkIntArray> index;
  index->SetName(smokevis::PhotometricArrays::IndexName);
  vtkNew<vtkDoubleArray> axes;
  axes->SetName(smokevis::PhotometricArrays::AxisName);
  axes->SetNumberOfComponents(3);
  std::vector<int> tables;
  for (const Side& side : lamp.Sides)
  {
    const smokevis::PhotometricHalf& half = side.Photometry;
    tables.push_back(
      smokevis::PhotometricArrays::AddTable(output, half.Polar, half.Azimuth, half.Candela));
  }
  for (vtkIdType cell = 0; cell < output.GetNumberOfCells(); ++cell)
  {
    index->InsertNextValue(tables[static_cast<std::size_t>(cell) % tables.size()]);
    axes->InsertNextTuple(&axis.x);
  }
  output.GetCellData()->AddArray(index);
  output.GetCellData()->AddArray(axes);
}

} // namespace

//------------------------------------------------------------------------------
vtkLuminaireSource::vtkLuminaireSource()
{
  this->SetNumberOfInputPorts(0);
}

//------------------------------------------------------------------------------
vtkLuminaireSource::~vtkLuminaireSource()
{
  this->SetPhotometricFile(nullptr);
}

//------------------------------------------------------------------------------
void vtkLuminaireSource::CheckProperties(double width, double height) const
{
  smokevis::Check(smokevis::IsPositive(width) && smokevis::IsPositive(height), "lamp",
    "its width or height is not a positive length", "Give both in metres");
  smokevis::Check(smokevis::IsNotNegative(this->LuminousFlux), "lamp",
    "its luminous flux is negative or not finite", "Give a flux in lumens, from 0");
  smokevis::Check(this->Reflectance >= 0.0 && this->Reflectance <= 1.0, "lamp",
    "its reflectance is outside 0 to 1", "Give a diffuse reflectance");
  const double size[2] = {width, height};
  for (int axis = 0; axis < 2; ++axis)
  {
    if (this->Count[axis] < 1 || this->Count[axis] > MaximumCount)
    {
      throw Error(
        "lamps", "a Count is outside 1 to 10000", "Give the lamps along both axes of the grid");
    }
    if (this->Count[axis] > 1 &&
        !(this->Spacing[axis] >= size[axis] && std::isfinite(this->Spacing[axis])))
    {
      throw Error("lamps", "their Spacing is less than their size, so they overlap",
        "Give the distance between the lamps' centres in metres");
    }
  }
  if (static_cast<std::int64_t>(this->Count[0]) * this->Count[1] > MaximumLamps)
  {
    throw Error(
      "lamps", "they are more than a million", "Model a luminous ceiling as one large lamp");
  }
}

//------------------------------------------------------------------------------
int vtkLuminaireSource::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  smokevis::HandlePieces(outputVector);
  return 1;
}

//------------------------------------------------------------------------------
int vtkLuminaireSource::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  try
  {
    smokevis::Ranks().Together(this,
      [&]
      {
        const Lamp lamp =
          this->PhotometricFile && *this->PhotometricFile
            ? MeasuredLamp(smokevis::PhotometricFile::Read(this->PhotometricFile), this->Width,
                this->Height, this->LuminousFlux, this->SizeFromFile != 0)
            : EvenLamp(this->Width, this->Height, this->Luminance, this->LuminousFlux);
        this->CheckProperties(lamp.Width, lamp.Height);
        const auto grid =
          smokevis::PlateFrame::Make({this->Center[0], this->Center[1], this->Center[2]},
            {this->Normal[0], this->Normal[1], this->Normal[2]},
            {this->Up[0], this->Up[1], this->Up[2]}, "lamp");

        smokevis::PlateMesh mesh;
        for (int j = 0; j < this->Count[1]; ++j)
        {
          for (int i = 0; i < this->Count[0]; ++i)
          {
            const smokevis::Vec3 centre =
              grid.Centre + (i - 0.5 * (this->Count[0] - 1)) * this->Spacing[0] * grid.Right +
              (j - 0.5 * (this->Count[1] - 1)) * this->Spacing[1] * grid.Up;
            for (const Side& side : lamp.Sides)
            {
              smokevis::PlateMesh::Plate plate;
              plate.Frame = side.Back
                              ? smokevis::PlateFrame::Make(
                                  centre - lamp.Depth * grid.Normal, -grid.Normal, grid.Up, "lamp")
                              : grid;
              plate.Frame.Centre = side.Back ? plate.Frame.Centre : centre;
              smokevis::CellLook look;
              look.Luminance = smokevis::ColouredLuminance(side.Luminance, this->Color, "lamp");
              look.Reflectance.fill(this->Reflectance);
              mesh.Add(plate, {-0.5 * lamp.Width, 0.5 * lamp.Width},
                {-0.5 * lamp.Height, 0.5 * lamp.Height},
                [&look](std::size_t, std::size_t) { return look; });
            }
          }
        }
        output->ShallowCopy(mesh.Finish());
        if (!lamp.Sides.front().Photometry.Candela.empty())
        {
          AddPhotometry(*output, lamp, grid.Up);
        }
        smokevis::AddFieldNumber(*output, "LampFlux", {lamp.Flux});
        smokevis::AddFieldNumber(*output, "RatedFlux", {lamp.RatedFlux});
        if (this->LuminousFlux == 0.0 && lamp.RatedFlux > 0.0 &&
            lamp.Flux > FluxTolerance * lamp.RatedFlux)
        {
          vtkWarningMacro(<< "photometric file '" << this->PhotometricFile
                          << "': its intensities add up "
                          << "to " << lamp.Flux << " lm, more than the " << lamp.RatedFlux
                          << " lm of its light source. Check its candela multiplier.");
        }
      });
    smokevis::LeaveToFirstPiece(outputVector);
    return 1;
  }
  catch (const std::exception& error)
  {
    output->Initialize();
    vtkErrorMacro(<< error.what());
    return 0;
  }
}

//------------------------------------------------------------------------------
void vtkLuminaireSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto vector = [&](const char* name, const double* value)
  { os << indent << name << ": (" << value[0] << ", " << value[1] << ", " << value[2] << ")\n"; };
  vector("Center", this->Center);
  vector("Normal", this->Normal);
  vector("Up", this->Up);
  os << indent << "Width: " << this->Width << "\n";
  os << indent << "Height: " << this->Height << "\n";
  os << indent << "Luminance: " << this->Luminance << "\n";
  os << indent << "LuminousFlux: " << this->LuminousFlux << "\n";
  os << indent << "PhotometricFile: " << (this->PhotometricFile ? this->PhotometricFile : "(none)")
     << "\n";
  os << indent << "SizeFromFile: " << this->SizeFromFile << "\n";
  vector("Color", this->Color);
  os << indent << "Reflectance: " << this->Reflectance << "\n";
  os << indent << "Count: (" << this->Count[0] << ", " << this->Count[1] << ")\n";
  os << indent << "Spacing: (" << this->Spacing[0] << ", " << this->Spacing[1] << ")\n";
}
