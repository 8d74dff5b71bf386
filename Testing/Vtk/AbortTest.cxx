// Progress never falls, and work that is given up ends soon, without an error, and leaves the
// output that was there before.
#include "UniformSmoke.h"

#include <vtkCADReader.h>
#include <vtkCallbackCommand.h>
#include <vtkCellData.h>
#include <vtkCommand.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataObjectTreeRange.h>
#include <vtkDataSet.h>
#include <vtkExitSignSource.h>
#include <vtkFDSSmokeReader.h>
#include <vtkFloorMapOfVisibility.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkLineSource.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPointData.h>
#include <vtkRouteVisibility.h>
#include <vtkSmokeLightField.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkVisibilityImage.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

namespace
{

/// Sums of all numbers of all arrays: two outputs with equal sums hold the same data.
std::vector<double> Sums(vtkDataObject* data)
{
  std::vector<double> sums;
  const auto add = [&sums](vtkDataSetAttributes* arrays)
  {
    for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
    {
      vtkDataArray* const array = arrays->GetArray(i);
      double sum = 0.0;
      for (vtkIdType j = 0; array && j < array->GetNumberOfTuples(); ++j)
      {
        sum += array->GetComponent(j, 0);
      }
      sums.push_back(sum);
    }
  };
  std::vector<vtkDataObject*> leaves = {data};
  if (auto* const tree = vtkDataObjectTree::SafeDownCast(data))
  {
    const auto range = vtk::Range(tree, vtk::DataObjectTreeOptions::SkipEmptyNodes |
                                          vtk::DataObjectTreeOptions::TraverseSubTree |
                                          vtk::DataObjectTreeOptions::VisitOnlyLeaves);
    leaves.assign(range.begin(), range.end());
  }
  for (vtkDataObject* const leaf : leaves)
  {
    auto* const set = vtkDataSet::SafeDownCast(leaf);
    sums.push_back(static_cast<double>(set ? set->GetNumberOfCells() : 0));
    if (set)
    {
      add(set->GetCellData());
      add(set->GetPointData());
      sums.push_back(set->GetLength());
    }
  }
  return sums;
}

/// Watches an algorithm; aborts it once its progress has reached a point.
class Watch
{
public:
  explicit Watch(vtkAlgorithm* algorithm, double abortAt = std::numeric_limits<double>::infinity())
      : Algorithm_(algorithm), AbortAt_(abortAt)
  {
    this->Observer_->SetClientData(this);
    this->Observer_->SetCallback([](vtkObject*, unsigned long event, void* watch, void*)
      { static_cast<Watch*>(watch)->Receive(event); });
    for (const auto event : {vtkCommand::ProgressEvent, vtkCommand::ErrorEvent})
    {
      algorithm->AddObserver(event, this->Observer_);
    }
  }
  ~Watch()
  {
    this->Algorithm_->RemoveObserver(this->Observer_);
    this->Algorithm_->SetAbortExecute(0);
  }
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  const std::vector<double>& Fractions() const { return this->Fractions_; }
  int Errors() const { return this->Errors_; }
  bool HasAborted() const { return this->Algorithm_->GetAbortExecute() != 0; }
  /// Since the abort was asked for [s].
  double Waited() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - this->Asked_).count();
  }

private:
  void Receive(unsigned long event)
  {
    if (event == vtkCommand::ErrorEvent)
    {
      ++this->Errors_;
      return;
    }
    const double fraction = this->Algorithm_->GetProgress();
    this->Fractions_.push_back(fraction);
    if (fraction >= this->AbortAt_ && !this->HasAborted())
    {
      this->Algorithm_->SetAbortExecute(1);
      this->Asked_ = std::chrono::steady_clock::now();
    }
  }

  vtkAlgorithm* Algorithm_;
  double AbortAt_;
  vtkNew<vtkCallbackCommand> Observer_;
  std::vector<double> Fractions_;
  int Errors_ = 0;
  std::chrono::steady_clock::time_point Asked_;
};

void Update(vtkAlgorithm* algorithm, double time)
{
  algorithm->UpdateInformation();
  algorithm->GetOutputInformation(0)->Set(
    vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP(), time);
  algorithm->Update();
}

/// Aborts an algorithm at its first sign of life and in the middle, after a change that would give
/// another output.
void CheckAbort(vtkAlgorithm* algorithm, const std::function<void(int)>& change, double time = 0.0)
{
  algorithm->SetAbortExecute(1);
  change(0);
  Update(algorithm, time);
  EXPECT_TRUE(algorithm->GetAbortOutput());
  algorithm->SetAbortExecute(0);

  std::vector<double> before;
  {
    const Watch watch(algorithm);
    Update(algorithm, time);
    EXPECT_EQ(watch.Errors(), 0);
    before = Sums(algorithm->GetOutputDataObject(0));
    ASSERT_GT(before.size(), 1U) << "the work that was given up is done when it is asked for again";
    const std::vector<double>& fractions = watch.Fractions();
    ASSERT_FALSE(fractions.empty());
    EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
    EXPECT_GE(fractions.front(), 0.0);
    EXPECT_EQ(fractions.back(), 1.0);
  }
  double longest = 0.0;
  for (const double share : {0.0, 0.3})
  {
    change(1);
    const Watch watch(algorithm, share);
    Update(algorithm, time);
    ASSERT_TRUE(watch.HasAborted());
    longest = std::max(longest, watch.Waited());
    EXPECT_EQ(watch.Errors(), 0);
    EXPECT_EQ(Sums(algorithm->GetOutputDataObject(0)), before) << "aborted at " << share;
  }
  testing::Test::RecordProperty("SecondsToAbort", std::to_string(longest));
  std::cout << "  " << algorithm->GetClassName() << ": " << longest << " s to abort\n";
  Update(algorithm, time);
  EXPECT_NE(Sums(algorithm->GetOutputDataObject(0)), before) << "the change comes in at last";
}

/// A closed room full of smoke whose light takes seconds.
class AbortTest : public testing::Test
{
protected:
  void SetUp() override
  {
    this->Smoke->SetDimensions(41, 21, 11);
    this->Smoke->SetSpacing(0.25, 0.25, 0.25);
    FillExtinction(this->Smoke, 0.5);
    this->Sign->SetCenter(10.0, 2.5, 1.5);
    this->Sign->SetNormal(-1.0, 0.0, 0.0);
    this->Field->SetAlbedo(0.9);
    this->Field->SetTolerance(0.02);
    this->Field->SetInputDataObject(0, this->Smoke);
    this->Field->AddInputConnection(2, this->Sign->GetOutputPort());
  }

  vtkNew<vtkImageData> Smoke;
  vtkNew<vtkExitSignSource> Sign;
  vtkNew<vtkSmokeLightField> Field;
};

TEST_F(AbortTest, OfTheLightField)
{
  CheckAbort(this->Field, [this](int step) { this->Field->SetSeed(1 + step); });
}

TEST_F(AbortTest, OfTheFloorMap)
{
  vtkNew<vtkFloorMapOfVisibility> map;
  map->SetInputConnection(this->Field->GetOutputPort());
  map->SetEyeHeight(1.5);
  CheckAbort(map, [&](int step) { map->SetResolution(90 + step, 60); });
}

TEST_F(AbortTest, OfTheImage)
{
  vtkNew<vtkVisibilityImage> image;
  image->SetInputConnection(this->Field->GetOutputPort());
  image->SetCameraPosition(1.0, 2.5, 1.5);
  image->SetTargetSign(0);
  CheckAbort(image, [&](int step) { image->SetImageSize(400 + step, 200); });
}

TEST_F(AbortTest, OfAWalk)
{
  vtkNew<vtkLineSource> way;
  way->SetPoint1(0.5, 0.5, 0.0);
  way->SetPoint2(9.0, 4.5, 0.0);
  vtkNew<vtkRouteVisibility> route;
  route->SetInputConnection(0, this->Field->GetOutputPort());
  route->SetInputConnection(1, way->GetOutputPort());
  CheckAbort(route, [&](int step) { route->SetSampleSpacing(0.004 + 0.0001 * step); });
}

TEST_F(AbortTest, OfTheLightFieldLeavesTheMapMadeOfItInPlace)
{
  vtkNew<vtkFloorMapOfVisibility> map;
  map->SetInputConnection(this->Field->GetOutputPort());
  map->SetEyeHeight(1.5);
  map->Update();
  const std::vector<double> before = Sums(map->GetOutputDataObject(0));
  this->Field->SetSeed(2);
  {
    const Watch watch(this->Field, 0.3);
    map->Update();
    EXPECT_TRUE(watch.HasAborted());
    EXPECT_EQ(Sums(map->GetOutputDataObject(0)), before);
  }
  map->Update();
  EXPECT_NE(Sums(map->GetOutputDataObject(0)), before);
}

TEST(ReaderAbortTest, OfSmoke)
{
  vtkNew<vtkFDSSmokeReader> reader;
  reader->SetFileName(SMOKEVIS_DATA_DIR "/Hall/fds/hall.smv");
  CheckAbort(
    reader, [&](int step) { reader->SetMassExtinctionCoefficient(8700.0 + step); }, 600.0);
}

TEST(ReaderAbortTest, OfABuilding)
{
  for (const char* const name : {"/CAD/kiosk.step", "/CAD/kiosk.obj"})
  {
    vtkNew<vtkCADReader> reader;
    reader->SetFileName((std::string(SMOKEVIS_DATA_DIR) + name).c_str());
    CheckAbort(reader, [&](int step) { reader->SetUnitScale(step == 0 ? 1.0 : 0.5); });
  }
}

} // namespace
