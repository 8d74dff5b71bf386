// Reads the images of materials with VTK.
#include "CadImages.h"

#include "SrgbColor.h"

#include "vtkCallbackCommand.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkImageReader2.h"
#include "vtkImageReader2Factory.h"
#include "vtkJPEGReader.h"
#include "vtkNew.h"
#include "vtkPNGReader.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace smokevis
{
namespace
{

vtkSmartPointer<vtkImageReader2> ReaderOf(const CadImage& image)
{
  vtkSmartPointer<vtkImageReader2> reader;
  if (image.Bytes.empty())
  {
    std::error_code problem;
    if (std::filesystem::is_regular_file(image.File, problem))
    {
      reader.TakeReference(vtkImageReader2Factory::CreateImageReader2(image.File.c_str()));
    }
    if (reader)
    {
      reader->SetFileName(image.File.c_str());
    }
    return reader;
  }
  if (image.Bytes[0] == 0x89)
  {
    reader = vtkSmartPointer<vtkPNGReader>::New();
  }
  else if (image.Bytes[0] == 0xFF)
  {
    reader = vtkSmartPointer<vtkJPEGReader>::New();
  }
  if (reader)
  {
    reader->SetMemoryBuffer(image.Bytes.data());
    reader->SetMemoryBufferLength(static_cast<vtkIdType>(image.Bytes.size()));
  }
  return reader;
}

/// The mean of an image's linear colours.
std::optional<CadColor> MeanColor(const CadImage& image)
{
  const vtkSmartPointer<vtkImageReader2> reader = ReaderOf(image);
  if (!reader)
  {
    return std::nullopt;
  }
  bool failed = false;
  vtkNew<vtkCallbackCommand> errors;
  errors->SetClientData(&failed);
  errors->SetCallback(
    [](vtkObject*, unsigned long, void* client, void*) { *static_cast<bool*>(client) = true; });
  reader->AddObserver(vtkCommand::ErrorEvent, errors);
  reader->Update();
  vtkDataArray* const pixels = reader->GetOutput()->GetPointData()->GetScalars();
  if (failed || !pixels || pixels->GetNumberOfTuples() == 0)
  {
    return std::nullopt;
  }
  const double most = pixels->GetDataTypeMax();
  const bool colored = pixels->GetNumberOfComponents() >= 3;
  const bool isByte = pixels->GetDataType() == VTK_UNSIGNED_CHAR;
  std::vector<double> linear;
  for (int i = 0; i <= std::numeric_limits<unsigned char>::max() && isByte; ++i)
  {
    linear.push_back(LinearFromSrgb(i / most));
  }
  CadColor sum = {0.0, 0.0, 0.0};
  for (vtkIdType i = 0; i < pixels->GetNumberOfTuples(); ++i)
  {
    for (int part = 0; part < (colored ? 3 : 1); ++part)
    {
      const double value = pixels->GetComponent(i, part);
      sum[part] += isByte ? linear[static_cast<std::size_t>(value)] : LinearFromSrgb(value / most);
    }
  }
  for (double& part : sum)
  {
    part /= static_cast<double>(pixels->GetNumberOfTuples());
  }
  if (!colored)
  {
    sum[1] = sum[2] = sum[0];
  }
  return sum;
}

} // namespace

//------------------------------------------------------------------------------------------------
void ApplyImages(CadModel& model)
{
  std::string unread;
  for (CadMaterial& material : model.Materials)
  {
    if (!material.Image)
    {
      continue;
    }
    const std::optional<CadColor> mean = MeanColor(*material.Image);
    if (mean)
    {
      CadColor color = material.Reflectance.value_or(CadColor{1.0, 1.0, 1.0});
      for (int part = 0; part < 3; ++part)
      {
        color[part] *= (*mean)[part];
      }
      material.Reflectance = color;
    }
    else
    {
      material.Reflectance.reset();
      unread += (unread.empty() ? "" : ", ") + material.Name;
    }
    material.Image.reset();
  }
  if (!unread.empty())
  {
    model.Warnings.push_back("the images of these materials cannot be read: " + unread +
                             "; state their reflectance in the material table");
  }
}

} // namespace smokevis
