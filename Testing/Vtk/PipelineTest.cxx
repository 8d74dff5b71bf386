// The filters without ParaView: no process module, no MPI controller.
#include "UniformSmoke.h"

#include <vtkDataSet.h>
#include <vtkExitSignSource.h>
#include <vtkFieldData.h>
#include <vtkFloorMapOfVisibility.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkSmokeLightField.h>
#include <vtkVisibilityImage.h>

#include <gtest/gtest.h>

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <cstring>
#include <vector>

namespace
{

/// A light field of clear or absorbing air and one sign, 3 m from the eye.
class PipelineTest : public testing::Test
{
protected:
  void SetUp() override
  {
    this->Smoke->SetDimensions(5, 3, 3);
    this->Smoke->SetSpacing(1.0, 1.0, 1.0);
    FillExtinction(this->Smoke, 0.0);
    this->Sign->SetCenter(4.0, 1.0, 1.0);
    this->Sign->SetNormal(-1.0, 0.0, 0.0);
    this->Field->SetAlbedo(0.0);
    this->Field->SetInputDataObject(0, this->Smoke);
    this->Field->AddInputConnection(2, this->Sign->GetOutputPort());
    this->View->SetInputConnection(this->Field->GetOutputPort());
    this->View->SetCameraPosition(1.0, 1.0, 1.0);
    this->View->SetTargetSign(0);
    this->View->SetDarkLuminance(0.0);
    this->View->SetImageSize(8, 4);
  }

  double Result(const char* name)
  {
    this->View->Update();
    vtkDataArray* array = this->View->GetOutput()->GetFieldData()->GetArray(name);
    return array ? array->GetComponent(0, 0) : std::nan("");
  }

  vtkNew<vtkImageData> Smoke;
  vtkNew<vtkExitSignSource> Sign;
  vtkNew<vtkSmokeLightField> Field;
  vtkNew<vtkVisibilityImage> View;
};

TEST_F(PipelineTest, ShowsASignInClearAirAsItIs)
{
  EXPECT_NEAR(this->Result("LitLuminance"), 300.0, 1e-3);
  EXPECT_NEAR(this->Result("UnlitLuminance"), 0.0, 1e-9);
  // Five of nine bars are lit: sqrt(5/9 * 4/9) / (5/9). The outer, lit bars look smaller by up
  // to 1.5 % (the cube of the cosine), which moves the share of the lit ones by some 0.1 %.
  EXPECT_NEAR(this->Result("Contrast"), std::sqrt(0.8), 2e-3);
  EXPECT_NEAR(this->Result("VisibleFraction"), 1.0, 1e-9);
}

TEST_F(PipelineTest, FollowsChangesUpstream)
{
  EXPECT_NEAR(this->Result("LitLuminance"), 300.0, 1e-3);
  FillExtinction(this->Smoke, 1.0);
  // Bouguer's law over 3 m and, in the mean over the plate, another 0.6 to 0.7 %.
  EXPECT_NEAR(this->Result("LitLuminance"), 300.0 * std::exp(-3.0), 0.01 * 300.0 * std::exp(-3.0));
  this->Sign->SetLuminance(600.0);
  EXPECT_NEAR(this->Result("LitLuminance"), 600.0 * std::exp(-3.0), 0.01 * 600.0 * std::exp(-3.0));
}

TEST_F(PipelineTest, KeepsTheLightFieldWhereOnlyTheCameraMoves)
{
  this->View->Update();
  const vtkMTimeType solved = this->Field->GetOutputDataObject(0)->GetUpdateTime();
  this->View->SetCameraPosition(2.0, 1.0, 1.0);
  this->View->Update();
  EXPECT_EQ(this->Field->GetOutputDataObject(0)->GetUpdateTime(), solved);
}

TEST_F(PipelineTest, DoesNotAskForPiecesOfTheSmoke)
{
  // An image that wants a part of its own extent still sees the whole scene.
  const double whole = this->Result("Contrast");
  const int part[6] = {0, 0, 0, 0, 0, 0};
  this->View->Modified();
  this->View->UpdateExtent(part);
  EXPECT_EQ(
    this->View->GetOutput()->GetFieldData()->GetArray("Contrast")->GetComponent(0, 0), whole);
}

// How exactly light close to a sign is known hangs on the tolerance that the light field was solved
// to; views of one that does not tell its tolerance take it for a small one.
TEST_F(PipelineTest, KnowsTheToleranceOfTheLightField)
{
  FillExtinction(this->Smoke, 0.5);
  this->Field->SetAlbedo(0.8);
  this->Field->SetTolerance(0.1);
  const double veiled = this->Result("UnlitLuminance");
  EXPECT_GT(veiled, 0.0);
  vtkNew<vtkPartitionedDataSetCollection> copy;
  copy->DeepCopy(this->Field->GetOutputDataObject(0));
  this->View->SetInputDataObject(0, copy);
  EXPECT_EQ(this->Result("UnlitLuminance"), veiled);
  vtkNew<vtkPartitionedDataSetCollection> untold;
  untold->DeepCopy(copy);
  untold->GetFieldData()->RemoveArray("Tolerance");
  for (unsigned int i = 0; i < untold->GetNumberOfPartitionedDataSets(); ++i)
  {
    for (unsigned int j = 0; j < untold->GetNumberOfPartitions(i); ++j)
    {
      untold->GetPartitionAsDataObject(i, j)->GetFieldData()->RemoveArray("Tolerance");
    }
  }
  this->View->SetInputDataObject(0, untold);
  const double fine = this->Result("UnlitLuminance");
  EXPECT_NEAR(fine, veiled, 0.02 * veiled);
  EXPECT_NE(fine, veiled);
}

// A ceiling that slopes through the cells: what lies above it and below it is kept apart in the
// data, and views of a copy see what views of the light field itself do.
TEST_F(PipelineTest, KeepsThePartsOfCellsThatWallsCut)
{
  vtkNew<vtkPlaneSource> ceiling;
  ceiling->SetOrigin(0.0, 0.0, 1.9);
  ceiling->SetPoint1(4.0, 0.0, 1.4);
  ceiling->SetPoint2(0.0, 2.0, 1.8);
  FillExtinction(this->Smoke, 0.5);
  this->Field->SetAlbedo(0.8);
  this->Field->SetTolerance(0.1);
  this->Field->AddInputConnection(1, ceiling->GetOutputPort());
  const double veiled = this->Result("UnlitLuminance");
  EXPECT_GT(veiled, 0.0);

  vtkNew<vtkPartitionedDataSetCollection> copy;
  copy->DeepCopy(this->Field->GetOutputDataObject(0));
  vtkFieldData* parts = nullptr;
  for (unsigned int i = 0; i < copy->GetNumberOfPartitionedDataSets() && !parts; ++i)
  {
    vtkDataSet* const block = copy->GetPartition(i, 0);
    if (block && block->GetFieldData()->GetArray("PartDirectFluence"))
    {
      parts = block->GetFieldData();
    }
  }
  ASSERT_NE(parts, nullptr);
  // Each of the eight upper cells is cut in two.
  EXPECT_EQ(parts->GetArray("PartDirectFluence")->GetNumberOfTuples(), 8);
  EXPECT_EQ(parts->GetArray("PartMultipleFluence")->GetNumberOfTuples(), 8);
  this->View->SetInputDataObject(0, copy);
  EXPECT_EQ(this->Result("UnlitLuminance"), veiled);

  // As smoke of another light field it brings no light along: a sign half as bright is seen the
  // same on it and on the smoke that there was first.
  this->Sign->SetLuminance(0.5 * this->Sign->GetLuminance());
  this->View->SetInputConnection(this->Field->GetOutputPort());
  const double first = this->Result("UnlitLuminance");
  this->Field->SetInputDataObject(0, copy->GetPartition(0, 0));
  EXPECT_EQ(this->Result("UnlitLuminance"), first);
  EXPECT_LT(first, 0.6 * veiled);
}

TEST_F(PipelineTest, ShowsTheSameBitsFromAnyNumberOfThreads)
{
  FillExtinction(this->Smoke, 0.5);
  this->Field->SetAlbedo(0.8);
  this->Field->SetTolerance(0.1);
  this->View->SetImageSize(64, 32);
  const tbb::global_control three(tbb::global_control::max_allowed_parallelism, 3);
  std::vector<vtkSmartPointer<vtkPointData>> images;
  for (const int threads : {1, 2, 3})
  {
    this->Field->Modified();
    tbb::task_arena(threads).execute([this] { this->View->Update(); });
    images.push_back(vtkSmartPointer<vtkPointData>::New());
    images.back()->DeepCopy(this->View->GetOutput()->GetPointData());
  }
  const int arrays = images.front()->GetNumberOfArrays();
  EXPECT_GT(arrays, 2);
  for (int i = 0; i < arrays; ++i)
  {
    vtkDataArray* const one = images.front()->GetArray(i);
    for (const auto& more : images)
    {
      vtkDataArray* const other = more->GetArray(one->GetName());
      ASSERT_EQ(other->GetDataSize(), one->GetDataSize());
      EXPECT_EQ(std::memcmp(other->GetVoidPointer(0), one->GetVoidPointer(0),
                  one->GetDataSize() * one->GetDataTypeSize()),
        0)
        << one->GetName();
    }
  }
}

TEST_F(PipelineTest, MapsTheFloor)
{
  vtkNew<vtkFloorMapOfVisibility> map;
  map->SetInputConnection(this->Field->GetOutputPort());
  map->SetEyeHeight(1.0);
  map->SetResolution(4, 2);
  map->SetDarkLuminance(0.0);
  map->Update();
  vtkImageData* output = map->GetOutput();
  ASSERT_EQ(output->GetNumberOfPoints(), 8);
  for (vtkIdType i = 0; i < 8; ++i)
  {
    EXPECT_EQ(output->GetPointData()->GetArray("Status")->GetComponent(i, 0),
      vtkFloorMapOfVisibility::SEEN);
    // At half a metre the middle of the plate looks twice as large as its sides.
    EXPECT_NEAR(
      output->GetPointData()->GetArray("Visibility")->GetComponent(i, 0), std::sqrt(0.8), 0.03);
  }
}

} // namespace
