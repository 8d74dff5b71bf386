#include "vtkExitSignSource.h"

#include "SignPlate.h"

#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

#include <algorithm>

vtkStandardNewMacro(vtkExitSignSource);

//------------------------------------------------------------------------------
vtkExitSignSource::vtkExitSignSource()
{
  this->SetNumberOfInputPorts(0);
}

//------------------------------------------------------------------------------
vtkExitSignSource::~vtkExitSignSource()
{
  this->SetPatternFile(nullptr);
  this->SetSignTable(nullptr);
}

//------------------------------------------------------------------------------
int vtkExitSignSource::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  try
  {
    smokevis::SignPlate sign;
    sign.Id = this->SignId;
    sign.Centre = {this->Center[0], this->Center[1], this->Center[2]};
    sign.Normal = {this->Normal[0], this->Normal[1], this->Normal[2]};
    sign.Up = {this->Up[0], this->Up[1], this->Up[2]};
    sign.Width = this->Width;
    sign.Height = this->Height;
    sign.Pattern = static_cast<smokevis::SignPattern>(this->Pattern);
    sign.Bars = this->Bars;
    sign.SquareFraction = this->SquareFraction;
    sign.PatternFile = this->PatternFile ? this->PatternFile : "";
    sign.Luminance = this->Luminance;
    sign.UnlitLuminance = this->UnlitLuminance;
    std::copy_n(this->Color, 3, sign.Colour);
    sign.Reflectance = this->Reflectance;

    smokevis::PlateMesh mesh;
    if (this->SignTable && *this->SignTable)
    {
      for (const smokevis::SignPlate& row : smokevis::ReadSignTable(this->SignTable, sign))
      {
        smokevis::AddSign(row, mesh);
      }
    }
    else
    {
      smokevis::AddSign(sign, mesh);
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
void vtkExitSignSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto vector = [&](const char* name, const double* value)
  { os << indent << name << ": (" << value[0] << ", " << value[1] << ", " << value[2] << ")\n"; };
  vector("Center", this->Center);
  vector("Normal", this->Normal);
  vector("Up", this->Up);
  os << indent << "Width: " << this->Width << "\n";
  os << indent << "Height: " << this->Height << "\n";
  os << indent << "Pattern: " << this->Pattern << "\n";
  os << indent << "Bars: " << this->Bars << "\n";
  os << indent << "SquareFraction: " << this->SquareFraction << "\n";
  os << indent << "PatternFile: " << (this->PatternFile ? this->PatternFile : "(none)") << "\n";
  os << indent << "Luminance: " << this->Luminance << "\n";
  os << indent << "UnlitLuminance: " << this->UnlitLuminance << "\n";
  vector("Color", this->Color);
  os << indent << "Reflectance: " << this->Reflectance << "\n";
  os << indent << "SignId: " << this->SignId << "\n";
  os << indent << "SignTable: " << (this->SignTable ? this->SignTable : "(none)") << "\n";
}
