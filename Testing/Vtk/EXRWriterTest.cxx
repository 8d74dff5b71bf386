// What the writer puts into an OpenEXR file, read back without VTK.
#include "ImageFile.h"

#include <vtkDoubleArray.h>
#include <vtkEXRWriter.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>

#include <gtest/gtest.h>

namespace
{

template <class Array>
void AddArray(vtkFieldData* target, const char* name, int components, std::vector<double> values)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()) / components);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    array->SetVariantValue(static_cast<vtkIdType>(i), values[i]);
  }
  target->AddArray(array);
}

} // namespace

TEST(EXRWriter, NamesChannelsAndKeepsTheLowestRowFirst)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(2, 2, 1);
  AddArray<vtkFloatArray>(image->GetPointData(), "Luminance", 1, {1, 2, 3, 4});
  AddArray<vtkFloatArray>(image->GetPointData(), "VeilLuminance", 1, {5, 6, 7, 8});
  AddArray<vtkFloatArray>(
    image->GetPointData(), "LuminanceRGB", 3, {1, 10, 100, 2, 20, 200, 3, 30, 300, 4, 40, 400});
  AddArray<vtkIntArray>(image->GetPointData(), "SignIds", 1, {-1, 0, 1, 2});
  AddArray<vtkFloatArray>(image->GetPointData(), "Contrast", 2, {1, 2, 3, 4, 5, 6, 7, 8});
  image->GetPointData()->GetArray("Contrast")->SetComponentName(1, "North");
  AddArray<vtkDoubleArray>(image->GetFieldData(), "VisibleFraction", 1, {0.25});
  AddArray<vtkDoubleArray>(image->GetFieldData(), "CameraPosition", 1, {1, 2, 3.5});
  vtkNew<vtkStringArray> names;
  names->SetName("SignNames");
  names->InsertNextValue("North");
  image->GetFieldData()->AddArray(names);

  const std::string path = testing::TempDir() + "EXRWriterTest.exr";
  vtkNew<vtkEXRWriter> writer;
  writer->SetFileName(path.c_str());
  writer->SetInputData(image);
  ASSERT_EQ(writer->Write(), 1);

  const smokevis::ImageFile file = smokevis::ImageFile::Read(path);
  EXPECT_EQ(file.Width, 2);
  EXPECT_EQ(file.Height, 2);
  using Values = std::vector<float>;
  EXPECT_EQ(file.Channels.at("Y"), Values({1, 2, 3, 4}));
  EXPECT_EQ(file.Channels.at("Veil"), Values({5, 6, 7, 8}));
  EXPECT_EQ(file.Channels.at("G"), Values({10, 20, 30, 40}));
  EXPECT_EQ(file.Channels.at("B"), Values({100, 200, 300, 400}));
  EXPECT_EQ(file.Channels.at("SignId"), Values({-1, 0, 1, 2}));
  EXPECT_EQ(file.Channels.at("Contrast.0"), Values({1, 3, 5, 7}));
  EXPECT_EQ(file.Channels.at("Contrast.North"), Values({2, 4, 6, 8}));
  EXPECT_EQ(file.Channels.size(), 8U);
  EXPECT_EQ(file.Numbers.at("VisibleFraction"), 0.25);
  EXPECT_EQ(file.Numbers.at("CameraPosition.2"), 3.5);
  EXPECT_EQ(file.Texts.at("SignNames"), "North");
  EXPECT_NE(file.Texts.at("Units").find("cd/m2"), std::string::npos);
  std::remove(path.c_str());
}
