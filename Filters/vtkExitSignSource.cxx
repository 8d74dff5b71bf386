#include "vtkExitSignSource.h"

#include "Ranks.h"
#include "SignPlate.h"

#include <vtkFieldData.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>

#include <algorithm>

vtkStandardNewMacro(vtkExitSignSource);

//------------------------------------------------------------------------------
vtkExitSignSource::vtkExitSignSource()
{
  this->SetNumberOfInputPorts(0);
  this->SetText("EXIT");
}

//------------------------------------------------------------------------------
vtkExitSignSource::~vtkExitSignSource()
{
  this->SetPatternFile(nullptr);
  this->SetText(nullptr);
  this->SetSignTable(nullptr);
}

//------------------------------------------------------------------------------
int vtkExitSignSource::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  smokevis::HandlePieces(outputVector);
  return 1;
}

//------------------------------------------------------------------------------
int vtkExitSignSource::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  try
  {
    smokevis::Ranks().Together(this,
      [&]
      {
        smokevis::SignPlate sign;
        sign.Id = this->SignId;
        sign.Centre = {this->Center[0], this->Center[1], this->Center[2]};
        sign.Normal = {this->Normal[0], this->Normal[1], this->Normal[2]};
        sign.Up = {this->Up[0], this->Up[1], this->Up[2]};
        sign.Width = this->Width;
        sign.Height = this->Height;
        sign.Pattern = static_cast<smokevis::SignPattern>(this->Pattern);
        sign.Design = static_cast<smokevis::SignDesign>(this->Design);
        sign.Bars = this->Bars;
        sign.BarFraction = this->BarFraction;
        sign.SquareFraction = this->SquareFraction;
        sign.PatternFile = this->PatternFile ? this->PatternFile : "";
        sign.Text = this->Text ? this->Text : "";
        sign.FigureHeight = this->FigureHeight;
        sign.Luminance = this->Luminance;
        sign.UnlitLuminance = this->UnlitLuminance;
        sign.Uniformity = this->Uniformity;
        sign.EmissionExponent = this->EmissionExponent;
        std::copy_n(this->Color, 3, sign.Colour);
        std::copy_n(this->UnlitColor, 3, sign.UnlitColour);
        sign.Reflectance = this->Reflectance;
        sign.UnlitReflectance = this->UnlitReflectance;
        const auto preset = static_cast<smokevis::SignPreset>(this->Preset);
        sign.Apply(preset);

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
        vtkNew<vtkStringArray> source;
        source->SetName("PresetSource");
        source->InsertNextValue(smokevis::PresetSource(preset));
        output->GetFieldData()->AddArray(source);
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
  os << indent << "Preset: " << this->Preset << "\n";
  os << indent << "Pattern: " << this->Pattern << "\n";
  os << indent << "Design: " << this->Design << "\n";
  os << indent << "Bars: " << this->Bars << "\n";
  os << indent << "BarFraction: " << this->BarFraction << "\n";
  os << indent << "SquareFraction: " << this->SquareFraction << "\n";
  os << indent << "PatternFile: " << (this->PatternFile ? this->PatternFile : "(none)") << "\n";
  os << indent << "Text: " << (this->Text ? this->Text : "(none)") << "\n";
  os << indent << "FigureHeight: " << this->FigureHeight << "\n";
  os << indent << "Luminance: " << this->Luminance << "\n";
  os << indent << "UnlitLuminance: " << this->UnlitLuminance << "\n";
  os << indent << "Uniformity: " << this->Uniformity << "\n";
  os << indent << "EmissionExponent: " << this->EmissionExponent << "\n";
  vector("Color", this->Color);
  vector("UnlitColor", this->UnlitColor);
  os << indent << "Reflectance: " << this->Reflectance << "\n";
  os << indent << "UnlitReflectance: " << this->UnlitReflectance << "\n";
  os << indent << "SignId: " << this->SignId << "\n";
  os << indent << "SignTable: " << (this->SignTable ? this->SignTable : "(none)") << "\n";
}
