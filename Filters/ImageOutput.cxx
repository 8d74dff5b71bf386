// Stores images as VTK data.
#include "ImageOutput.h"

#include "LightFieldInput.h"
#include "PointArrays.h"

#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkUnsignedCharArray.h>

namespace smokevis
{

//------------------------------------------------------------------------------
void StorePixels(
  const TracedImage& traced, const int size[2], int bands, int target, vtkImageData& image)
{
  image.SetOrigin(0.0, 0.0, 0.0);
  image.SetSpacing(1.0, 1.0, 1.0);
  image.SetDimensions(size[0], size[1], 1);
  AddPointValues<vtkFloatArray>(image, "Luminance", traced.Luminance);
  AddPointValues<vtkFloatArray>(image, "LuminanceError", traced.LuminanceError);
  AddPointValues<vtkFloatArray>(image, "DirectLuminance", traced.Direct);
  AddPointValues<vtkFloatArray>(image, "VeilLuminance", traced.Veil);
  AddPointValues<vtkFloatArray>(image, "OpticalDepth", traced.OpticalDepth);
  if (bands == 3)
  {
    AddPointValues<vtkFloatArray>(image, "LuminanceRGB", traced.LuminanceRGB, {"R", "G", "B"});
  }
  auto* const mask = AddPointArray<vtkUnsignedCharArray>(image, "SignMask");
  for (vtkIdType i = 0; i < image.GetNumberOfPoints(); ++i)
  {
    const int id = traced.SignIds[i];
    mask->SetValue(i, id >= 0 && (target < 0 || id == target) ? 1 : 0);
  }
  AddPointValues<vtkIntArray>(image, "SignIds", traced.SignIds);
  image.GetPointData()->SetActiveScalars("Luminance");
}

//------------------------------------------------------------------------------
void StoreMeasurement(const SignMeasurement& result, int sign, vtkImageData& image)
{
  const auto number = [&image](const char* name, double value)
  { AddFieldNumber(image, name, {value}); };
  number("MeasuredSign", static_cast<double>(sign));
  number("Contrast", result.Contrast);
  number("ContrastError", result.ContrastError);
  number("ContrastDivisionError", result.ContrastDivisionError);
  number("PerceivedContrast", result.PerceivedContrast);
  number("PerceivedContrastError", result.PerceivedContrastError);
  number("PerceivedContrastDivisionError", result.PerceivedContrastDivisionError);
  number("WebberContrast", result.WebberContrast);
  number("UL924Contrast", result.UL924Contrast);
  number("MeanLuminance", result.MeanLuminance);
  number("MeanLuminanceError", result.MeanLuminanceError);
  number("LitLuminance", result.LitLuminance);
  number("UnlitLuminance", result.UnlitLuminance);
  number("VisibleFraction", result.VisibleFraction);
  number("OpticalDepthToSign", result.OpticalDepth);
}

//------------------------------------------------------------------------------
void StoreCamera(const Camera& camera, vtkImageData& image)
{
  const auto vector = [&image](const char* name, const Vec3& value) {
    AddFieldNumber(image, name, {value.x, value.y, value.z});
  };
  vector("CameraPosition", camera.Position);
  vector("CameraForward", camera.Forward);
  vector("CameraUp", camera.Up);
  AddFieldNumber(image, "CameraWindow", {camera.Left, camera.RightEdge, camera.Bottom, camera.Top});
}

//------------------------------------------------------------------------------
void StorePhotograph(const Photograph& taken, int bands, vtkImageData& like, vtkImageData& image)
{
  image.CopyStructure(&like);
  image.GetFieldData()->DeepCopy(like.GetFieldData());
  vtkNew<vtkUnsignedCharArray> pixels;
  pixels->SetName("Photograph");
  pixels->SetNumberOfComponents(bands);
  pixels->SetNumberOfTuples(image.GetNumberOfPoints());
  std::copy(taken.Values.begin(), taken.Values.end(), pixels->GetPointer(0));
  image.GetPointData()->SetScalars(pixels);
}

} // namespace smokevis
