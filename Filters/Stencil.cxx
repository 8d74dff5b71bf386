// Reads the image file that a sign's pattern comes from.
#include "ErrorCollector.h"
#include "Errors.h"
#include "SignPlate.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkImageReader2.h>
#include <vtkImageReader2Factory.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace smokevis
{
namespace
{

const char* const Remedy = "Give a PNG file, a cell of the sign a pixel";

/// The grey level of white in an array of this type.
double White(vtkDataArray& pixels)
{
  switch (pixels.GetDataType())
  {
  case VTK_FLOAT:
  case VTK_DOUBLE:
    return 1.0;
  default:
    return pixels.GetDataTypeMax();
  }
}

} // namespace

//------------------------------------------------------------------------------
Stencil Stencil::Read(const std::string& fileName)
{
  const std::string where = "pattern file '" + fileName + "'";
  if (fileName.empty())
  {
    throw Error("pattern file", "the pattern is Image but no file is given", Remedy);
  }
  std::error_code code;
  if (!std::filesystem::is_regular_file(fileName, code))
  {
    throw Error(where, "there is no such file", Remedy);
  }
  const auto reader = vtkSmartPointer<vtkImageReader2>::Take(
    vtkImageReader2Factory::CreateImageReader2(fileName.c_str()));
  if (!reader)
  {
    throw Error(where, "it is not an image of a known format", Remedy);
  }
  vtkNew<ErrorCollector> errors;
  reader->AddObserver(vtkCommand::ErrorEvent, errors);
  reader->AddObserver(vtkCommand::WarningEvent, errors);
  reader->SetFileName(fileName.c_str());
  reader->UpdateInformation();
  int extent[6];
  reader->GetDataExtent(extent);
  const std::int64_t width = static_cast<std::int64_t>(extent[1]) - extent[0] + 1;
  const std::int64_t height = static_cast<std::int64_t>(extent[3]) - extent[2] + 1;
  if (!errors->Text().empty() || width < 1 || height < 1)
  {
    throw Error(where, "it is damaged, its size cannot be read", Remedy);
  }
  if (width > MaximumPixels || height > MaximumPixels || width * height > MaximumPixels)
  {
    throw Error(where,
      "its " + std::to_string(width) + " x " + std::to_string(height) + " pixels are more than " +
        std::to_string(MaximumPixels),
      "Scale the image down, a sign needs no more detail than the eye resolves");
  }
  reader->Update();
  vtkDataArray* pixels = reader->GetOutput()->GetPointData()->GetScalars();
  if (!errors->Text().empty() || !pixels || pixels->GetNumberOfTuples() != width * height)
  {
    throw Error(where, "it is damaged, its pixels cannot be read", Remedy);
  }

  Stencil stencil;
  stencil.Width = static_cast<int>(width);
  stencil.Height = static_cast<int>(height);
  stencil.Grey.resize(width * height);
  const double white = White(*pixels);
  const bool coloured = pixels->GetNumberOfComponents() >= 3;
  for (vtkIdType i = 0; i < width * height; ++i)
  {
    const Spectrum value = {pixels->GetComponent(i, 0), coloured ? pixels->GetComponent(i, 1) : 0.0,
      coloured ? pixels->GetComponent(i, 2) : 0.0};
    const double grey = Luminance(value, coloured ? 3 : 1) / white;
    stencil.Grey[i] = std::isfinite(grey) ? std::clamp(grey, 0.0, 1.0) : 0.0;
  }
  return stencil;
}

} // namespace smokevis
