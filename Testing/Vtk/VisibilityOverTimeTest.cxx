// Times at which places lose and regain their signs, against straight lines between the steps.
#include "MapSeries.h"

#include <vtkDataArray.h>
#include <vtkErrorCode.h>
#include <vtkTestErrorObserver.h>
#include <vtkVisibilityOverTime.h>

#include <gtest/gtest.h>

#include <cmath>

namespace
{

/// One place a column of contrasts of the sign 3, one row a step.
class VisibilityOverTimeTest : public testing::Test
{
protected:
  void SetUp() override { this->Filter->SetInputConnection(this->Maps->GetOutputPort()); }

  void Give(std::vector<double> times, std::vector<std::vector<float>> rows)
  {
    this->Maps->Times = std::move(times);
    for (const std::vector<float>& row : rows)
    {
      std::vector<std::vector<float>> places;
      for (const float value : row)
      {
        places.push_back({value, std::min(-0.5F, value)});
      }
      this->Maps->Contrast.push_back(places);
    }
  }

  double Value(const char* name, vtkIdType place = 0)
  {
    this->Filter->Update();
    vtkDataArray* const array = this->Filter->GetOutput()->GetPointData()->GetArray(name);
    return array ? array->GetComponent(place, 0) : std::nan("");
  }

  vtkNew<MapSeries> Maps;
  vtkNew<vtkVisibilityOverTime> Filter;
};

TEST_F(VisibilityOverTimeTest, PutsTheLossWhereTheLineCrossesTheThreshold)
{
  // From 0.6 to 0.1 within 20 s: the threshold of 0.2 is crossed after 16 s.
  this->Give({10, 20, 40, 50}, {{0.8F}, {0.6F}, {0.1F}, {0.0F}});
  EXPECT_NEAR(this->Value("AvailableTime"), 36.0, 1e-5);
  EXPECT_NEAR(this->Value("FinalLossTime"), 36.0, 1e-5);
  EXPECT_NEAR(this->Value("InvisibleTime"), 14.0, 1e-5);
  EXPECT_EQ(this->Value("AvailableTimeInterval"), 20.0);
  EXPECT_EQ(this->Value("Outcome"), vtkVisibilityOverTime::LOST);
  EXPECT_EQ(this->Value("FirstSign"), 3);
  EXPECT_EQ(this->Value("LastSign"), 3);
  EXPECT_EQ(this->Value("LeastVisibility"), 0.0);
}

TEST_F(VisibilityOverTimeTest, DefinesTheEndsOfTheRange)
{
  // Never lost; lost from the start; hidden; inside a solid; in view only at times, but too faint.
  this->Give({5, 15, 30}, {{0.5F, 0.1F, -0.5F, -2.0F, 0.1F}, {0.2F, 0.1F, -0.5F, -2.0F, -0.5F},
                            {0.9F, 0.1F, -0.5F, -2.0F, 0.15F}});
  EXPECT_EQ(this->Value("Outcome", 0), vtkVisibilityOverTime::KEPT);
  EXPECT_EQ(this->Value("AvailableTime", 0), 30.0);
  EXPECT_EQ(this->Value("FinalLossTime", 0), 30.0);
  EXPECT_EQ(this->Value("AvailableTimeInterval", 0), 0.0);
  EXPECT_EQ(this->Value("InvisibleTime", 0), 0.0);
  for (const vtkIdType faint : {1, 4})
  {
    EXPECT_EQ(this->Value("Outcome", faint), vtkVisibilityOverTime::NEVER_VISIBLE);
    EXPECT_EQ(this->Value("AvailableTime", faint), 5.0);
    EXPECT_EQ(this->Value("FinalLossTime", faint), 5.0);
    EXPECT_EQ(this->Value("InvisibleTime", faint), 25.0);
    EXPECT_EQ(this->Value("FirstSign", faint), -1);
    EXPECT_EQ(this->Value("LastSign", faint), -1);
  }
  EXPECT_EQ(this->Value("Outcome", 2), vtkVisibilityOverTime::NO_SIGN_IN_VIEW);
  EXPECT_EQ(this->Value("Outcome", 3), vtkVisibilityOverTime::INSIDE_SOLID);
  for (const char* const name : {"AvailableTime", "FinalLossTime", "InvisibleTime"})
  {
    EXPECT_TRUE(std::isnan(this->Value(name, 2))) << name;
    EXPECT_TRUE(std::isnan(this->Value(name, 3))) << name;
  }
}

TEST_F(VisibilityOverTimeTest, AddsUpInterruptions)
{
  // Lost at 5, back at 15, lost at 25 s; and a place that sees nothing before 5 s, then all.
  this->Give({0, 10, 20, 30}, {{0.3F, 0.0F}, {0.1F, 0.4F}, {0.3F, 0.4F}, {0.1F, 0.4F}});
  EXPECT_NEAR(this->Value("AvailableTime", 0), 5.0, 1e-5);
  EXPECT_NEAR(this->Value("FinalLossTime", 0), 25.0, 1e-5);
  EXPECT_NEAR(this->Value("InvisibleTime", 0), 15.0, 1e-5);
  EXPECT_EQ(this->Value("Outcome", 0), vtkVisibilityOverTime::LOST);
  EXPECT_EQ(this->Value("AvailableTime", 1), 0.0);
  EXPECT_EQ(this->Value("FinalLossTime", 1), 30.0);
  EXPECT_NEAR(this->Value("InvisibleTime", 1), 5.0, 1e-5);
  EXPECT_EQ(this->Value("Outcome", 1), vtkVisibilityOverTime::INTERRUPTED);
}

TEST_F(VisibilityOverTimeTest, NamesTheFirstAndTheLastSign)
{
  this->Maps->Times = {0, 1, 2};
  this->Maps->Contrast = {{{0.5F, 0.3F}}, {{0.1F, 0.3F}}, {{0.1F, 0.1F}}};
  EXPECT_EQ(this->Value("FirstSign"), 3);
  EXPECT_EQ(this->Value("LastSign"), 8);
  // The first sign is lost where 0.5 - 0.4 t is 0.2, the second where 0.3 - 0.2 (t - 1) is.
  vtkDataArray* const signs =
    this->Filter->GetOutput()->GetPointData()->GetArray("SignAvailableTime");
  ASSERT_NE(signs, nullptr);
  ASSERT_EQ(signs->GetNumberOfComponents(), 2);
  EXPECT_NEAR(signs->GetComponent(0, 0), 0.75, 1e-6);
  EXPECT_NEAR(signs->GetComponent(0, 1), 1.5, 1e-6);
  EXPECT_STREQ(signs->GetComponentName(1), "South");
  auto* const names = vtkStringArray::SafeDownCast(
    this->Filter->GetOutput()->GetFieldData()->GetAbstractArray("SignNames"));
  ASSERT_NE(names, nullptr);
  EXPECT_EQ(names->GetValue(1), "South");
}

TEST_F(VisibilityOverTimeTest, TakesTheStepsThatItIsAskedFor)
{
  std::vector<std::vector<float>> rows;
  std::vector<double> times;
  for (int i = 0; i <= 10; ++i)
  {
    times.push_back(i);
    rows.push_back({1.0F - 0.1F * static_cast<float>(i)});
  }
  this->Give(times, rows);
  this->Filter->SetTimeRange(2.0, 9.5);
  this->Filter->SetStride(3);
  // The steps 2, 5, 8 and, being the last, 9.
  EXPECT_NEAR(this->Value("AvailableTime"), 8.0, 1e-5);
  vtkFieldData* const fields = this->Filter->GetOutput()->GetFieldData();
  EXPECT_EQ(fields->GetArray("TimeSteps")->GetComponent(0, 0), 4.0);
  EXPECT_EQ(fields->GetArray("TimeRange")->GetComponent(0, 0), 2.0);
  EXPECT_EQ(fields->GetArray("TimeRange")->GetComponent(1, 0), 9.0);
  EXPECT_EQ(this->Maps->Runs, 4);
  // What comes out belongs to all times: another time costs nothing.
  this->Filter->UpdateTimeStep(7.0);
  EXPECT_EQ(this->Maps->Runs, 4);
  this->Filter->SetContrastThreshold(0.6);
  EXPECT_NEAR(this->Value("AvailableTime"), 4.0, 1e-5);
}

TEST_F(VisibilityOverTimeTest, EndsWithAnErrorWhereAStepFails)
{
  this->Give({0, 1, 2, 3}, {{0.5F}, {0.5F}, {0.5F}, {0.5F}});
  this->Maps->Fails = 2;
  vtkNew<vtkTest::ErrorObserver> errors;
  this->Filter->AddObserver(vtkCommand::ErrorEvent, errors);
  this->Filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, errors);
  this->Maps->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, errors);
  this->Filter->Update();
  EXPECT_TRUE(errors->GetError());
  EXPECT_EQ(this->Filter->GetOutput()->GetNumberOfPoints(), 0);
  this->Maps->Fails = -1;
  this->Maps->Modified();
  EXPECT_EQ(this->Value("Outcome"), vtkVisibilityOverTime::KEPT);
}

} // namespace
