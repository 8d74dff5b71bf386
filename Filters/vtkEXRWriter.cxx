#include "vtkEXRWriter.h"

#include "Errors.h"
#include "ImageFile.h"
#include "Ranks.h"

#include <vtkDataArray.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>

#include <map>

vtkStandardNewMacro(vtkEXRWriter);

namespace
{

const char* const Units = "Y, R, G, B, Direct, Veil, Error, SignLuminance: cd/m2; OpticalDepth, "
                          "Mask, SignId, contrasts: 1; JinVisibility: m; illuminances: lx";

/// Name of the channel of an array, or of one of its components.
std::string ChannelName(vtkDataArray* array, int component)
{
  static const std::map<std::string, std::string> known = {{"Luminance", "Y"},
    {"DirectLuminance", "Direct"}, {"VeilLuminance", "Veil"}, {"LuminanceError", "Error"},
    {"SignMask", "Mask"}, {"SignIds", "SignId"}};
  const std::string name = array->GetName();
  if (array->GetNumberOfComponents() == 1)
  {
    const auto found = known.find(name);
    return found == known.end() ? name : found->second;
  }
  if (name == "LuminanceRGB" && array->GetNumberOfComponents() == 3)
  {
    return std::string(1, "RGB"[component]);
  }
  const char* const part = array->GetComponentName(component);
  return name + "." + (part ? part : std::to_string(component));
}

smokevis::ImageFile BuildFile(vtkImageData* image)
{
  int size[3];
  image->GetDimensions(size);
  if (size[2] != 1)
  {
    throw smokevis::Error(
      "EXR writer", "the image has more than one layer of points along z", "Extract a slice first");
  }
  smokevis::ImageFile file;
  file.Width = size[0];
  file.Height = size[1];
  vtkPointData* const points = image->GetPointData();
  for (int i = 0; i < points->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* const array = points->GetArray(i);
    if (!array || !array->GetName())
    {
      continue;
    }
    for (int component = 0; component < array->GetNumberOfComponents(); ++component)
    {
      std::vector<float>& channel = file.Channels[ChannelName(array, component)];
      channel.resize(array->GetNumberOfTuples());
      for (vtkIdType point = 0; point < array->GetNumberOfTuples(); ++point)
      {
        channel[point] = static_cast<float>(array->GetComponent(point, component));
      }
    }
  }
  vtkFieldData* const fields = image->GetFieldData();
  for (int i = 0; i < fields->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* const array = fields->GetAbstractArray(i);
    if (!array || !array->GetName())
    {
      continue;
    }
    const vtkIdType count = array->GetNumberOfValues();
    for (vtkIdType value = 0; value < count; ++value)
    {
      const std::string name =
        array->GetName() + (count == 1 ? std::string() : '.' + std::to_string(value));
      if (vtkStringArray::SafeDownCast(array))
      {
        file.Texts[name] = array->GetVariantValue(value).ToString();
      }
      else if (vtkDataArray::SafeDownCast(array))
      {
        file.Numbers[name] = array->GetVariantValue(value).ToDouble();
      }
    }
  }
  file.Texts["Units"] = Units;
  return file;
}

} // namespace

//------------------------------------------------------------------------------
vtkEXRWriter::~vtkEXRWriter()
{
  this->SetFileName(nullptr);
}

//------------------------------------------------------------------------------
int vtkEXRWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

//------------------------------------------------------------------------------
void vtkEXRWriter::WriteData()
{
  try
  {
    if (!this->FileName || !*this->FileName)
    {
      throw smokevis::Error("EXR writer", "there is no file name", "Give a FileName");
    }
    // All processes of a parallel run have made the image together; the first one writes it.
    const smokevis::Ranks ranks;
    ranks.Together(this,
      [&]
      {
        if (ranks.Rank() == 0)
        {
          BuildFile(vtkImageData::SafeDownCast(this->GetInput())).Write(this->FileName);
        }
      });
  }
  catch (const std::exception& error)
  {
    this->SetErrorCode(vtkErrorCode::CannotOpenFileError);
    vtkErrorMacro(<< error.what());
  }
}

//------------------------------------------------------------------------------
void vtkEXRWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
}
