#include "vtkLuminaireSource.h"

#include "Errors.h"
#include "PlateMesh.h"

#include <vtkInformationVector.h>
#include <vtkMath.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

#include <cmath>

vtkStandardNewMacro(vtkLuminaireSource);

namespace
{

constexpr int MaximumCount = 10000;
constexpr std::int64_t MaximumLamps = 1000000;

} // namespace

//------------------------------------------------------------------------------
vtkLuminaireSource::vtkLuminaireSource()
{
  this->SetNumberOfInputPorts(0);
}

//------------------------------------------------------------------------------
int vtkLuminaireSource::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  try
  {
    const auto length = [](double value) { return value > 0.0 && std::isfinite(value); };
    if (!length(this->Width) || !length(this->Height))
    {
      throw smokevis::Error(
        "lamp", "its width or height is not a positive length", "Give both in metres");
    }
    if (!(this->LuminousFlux >= 0.0) || !std::isfinite(this->LuminousFlux))
    {
      throw smokevis::Error(
        "lamp", "its luminous flux is negative or not finite", "Give a flux in lumens, from 0");
    }
    if (!(this->Reflectance >= 0.0 && this->Reflectance <= 1.0))
    {
      throw smokevis::Error(
        "lamp", "its reflectance is outside 0 to 1", "Give a diffuse reflectance");
    }
    const double size[2] = {this->Width, this->Height};
    for (int axis = 0; axis < 2; ++axis)
    {
      if (this->Count[axis] < 1 || this->Count[axis] > MaximumCount)
      {
        throw smokevis::Error(
          "lamps", "a Count is outside 1 to 10000", "Give the lamps along both axes of the grid");
      }
      if (this->Count[axis] > 1 &&
          !(this->Spacing[axis] >= size[axis] && std::isfinite(this->Spacing[axis])))
      {
        throw smokevis::Error("lamps", "their Spacing is less than their size, so they overlap",
          "Give the distance between the lamps' centres in metres");
      }
    }
    if (static_cast<std::int64_t>(this->Count[0]) * this->Count[1] > MaximumLamps)
    {
      throw smokevis::Error(
        "lamps", "they are more than a million", "Model a luminous ceiling as one large lamp");
    }

    // Lambert: a plane of luminance L and area A sends out pi L A.
    const double photometric = this->LuminousFlux > 0.0
                                 ? this->LuminousFlux / (vtkMath::Pi() * this->Width * this->Height)
                                 : this->Luminance;
    const smokevis::Spectrum luminance =
      smokevis::ColouredLuminance(photometric, this->Color, "lamp");
    const auto grid =
      smokevis::PlateFrame::Make({this->Center[0], this->Center[1], this->Center[2]},
        {this->Normal[0], this->Normal[1], this->Normal[2]},
        {this->Up[0], this->Up[1], this->Up[2]}, "lamp");

    smokevis::PlateMesh mesh;
    smokevis::PlateMesh::Plate lamp;
    smokevis::CellLook look;
    look.Luminance = luminance;
    look.Reflectance.fill(this->Reflectance);
    for (int j = 0; j < this->Count[1]; ++j)
    {
      for (int i = 0; i < this->Count[0]; ++i)
      {
        lamp.Frame = grid;
        lamp.Frame.Centre += (i - 0.5 * (this->Count[0] - 1)) * this->Spacing[0] * grid.Right +
                             (j - 0.5 * (this->Count[1] - 1)) * this->Spacing[1] * grid.Up;
        mesh.Add(lamp, {-0.5 * this->Width, 0.5 * this->Width},
          {-0.5 * this->Height, 0.5 * this->Height},
          [&](std::size_t, std::size_t) { return look; });
      }
    }
    output->ShallowCopy(mesh.Finish());
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
  vector("Color", this->Color);
  os << indent << "Reflectance: " << this->Reflectance << "\n";
  os << indent << "Count: (" << this->Count[0] << ", " << this->Count[1] << ")\n";
  os << indent << "Spacing: (" << this->Spacing[0] << ", " << this->Spacing[1] << ")\n";
}
