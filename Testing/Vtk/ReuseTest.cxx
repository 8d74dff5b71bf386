// What time steps that change nothing, or the smoke alone, do not do again: the results are those
// of fresh filters, bit by bit.
#include "UniformSmoke.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkExitSignSource.h>
#include <vtkFieldData.h>
#include <vtkFloorMapOfVisibility.h>
#include <vtkImageData.h>
#include <vtkLuminaireSource.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkSmokeLightField.h>
#include <vtkStringArray.h>

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <string>

namespace
{

/// Light field and map of a room with smoke, a wall, a sign and a lamp with a photometric file.
struct Chain
{
  Chain(vtkImageData* smoke, vtkAlgorithm* wall, vtkAlgorithm* sign, vtkAlgorithm* lamp)
  {
    this->Field->SetInputDataObject(0, smoke);
    this->Field->AddInputConnection(1, wall->GetOutputPort());
    this->Field->AddInputConnection(2, sign->GetOutputPort());
    this->Field->AddInputConnection(2, lamp->GetOutputPort());
    this->Field->SetTolerance(0.2);
    this->Field->SetPatchSize(1.0);
    this->Map->SetInputConnection(this->Field->GetOutputPort());
    this->Map->SetEyeHeight(1.0);
    this->Map->SetResolution(3, 2);
  }

  /// Count of an entry of the work report, -1: there is none.
  static double Entry(vtkDataObject* data, const std::string& what)
  {
    auto* const names =
      vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray("WorkReportWhat"));
    for (vtkIdType i = 0; names && i < names->GetNumberOfValues(); ++i)
    {
      if (names->GetValue(i) == what)
      {
        return data->GetFieldData()->GetArray("WorkReportCount")->GetComponent(i, 0);
      }
    }
    return -1.0;
  }
  double FieldEntry(const std::string& what) { return Entry(this->Field->GetOutput(), what); }
  double MapEntry(const std::string& what) { return Entry(this->Map->GetOutput(), what); }

  /// Every number of the map.
  std::vector<double> Values()
  {
    this->Map->Update();
    std::vector<double> values;
    vtkPointData* const data = this->Map->GetOutput()->GetPointData();
    for (int i = 0; i < data->GetNumberOfArrays(); ++i)
    {
      vtkDataArray* const array = data->GetArray(i);
      for (vtkIdType j = 0; j < array->GetNumberOfTuples(); ++j)
      {
        for (int k = 0; k < array->GetNumberOfComponents(); ++k)
        {
          values.push_back(array->GetComponent(j, k));
        }
      }
    }
    return values;
  }

  vtkNew<vtkSmokeLightField> Field;
  vtkNew<vtkFloorMapOfVisibility> Map;
};

class ReuseTest : public testing::Test
{
protected:
  void SetUp() override
  {
    this->Smoke->SetDimensions(5, 3, 3);
    FillExtinction(this->Smoke, 0.4);
    this->Wall->SetOrigin(0, 0, 0);
    this->Wall->SetPoint1(4, 0, 0);
    this->Wall->SetPoint2(0, 2, 0);
    this->Sign->SetCenter(4.0, 1.0, 1.0);
    this->Sign->SetNormal(-1.0, 0.0, 0.0);
    this->Path = testing::TempDir() + "ReuseTest.ies";
    std::ofstream(this->Path) << "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 1 1 2 0.2 0.2 0\n1 1 10\n"
                                 "0 45 90\n0\n100 80 0\n";
    this->Lamp->SetPhotometricFile(this->Path.c_str());
    this->Lamp->SetCenter(2.0, 1.0, 1.9);
    this->Lamp->SetNormal(0.0, 0.0, -1.0);
  }
  void TearDown() override { std::remove(this->Path.c_str()); }

  std::vector<double> FreshValues()
  {
    return Chain(this->Smoke, this->Wall, this->Sign, this->Lamp).Values();
  }

  std::string Path;
  vtkNew<vtkImageData> Smoke;
  vtkNew<vtkPlaneSource> Wall;
  vtkNew<vtkExitSignSource> Sign;
  vtkNew<vtkLuminaireSource> Lamp;
};

TEST_F(ReuseTest, AStepThatChangesNothingKeepsAll)
{
  Chain chain(this->Smoke, this->Wall, this->Sign, this->Lamp);
  const std::vector<double> first = chain.Values();
  EXPECT_EQ(chain.FieldEntry("search structures built"), 1.0);
  EXPECT_EQ(chain.FieldEntry("light fields solved"), -1.0);
  EXPECT_EQ(chain.MapEntry("views set up"), 1.0);
  // As a reader does, whose next step has other objects with the same content.
  FillExtinction(this->Smoke, 0.4);
  this->Sign->Modified();
  this->Lamp->Modified();
  this->Wall->Modified();
  EXPECT_EQ(chain.Values(), first);
  EXPECT_EQ(chain.FieldEntry("light fields solved"), 0.0);
  EXPECT_EQ(chain.MapEntry("views set up"), 0.0);
}

// What views read of refined smoke is kept with the rest, and dropped when smoke is thin again.
TEST_F(ReuseTest, RefinedSmokeIsKeptAsWell)
{
  const auto isRefined = [](Chain& chain)
  {
    vtkDataObject* const block = chain.Field->GetOutput()->GetPartitionAsDataObject(0, 0);
    return block->GetFieldData()->HasArray("RefinedMultipleFluence") != 0;
  };
  FillExtinction(this->Smoke, 2.0);
  Chain chain(this->Smoke, this->Wall, this->Sign, this->Lamp);
  const std::vector<double> first = chain.Values();
  EXPECT_EQ(chain.FieldEntry("thick smoke cells refined"), 16.0);
  EXPECT_TRUE(isRefined(chain));
  FillExtinction(this->Smoke, 2.0);
  EXPECT_EQ(chain.Values(), first);
  EXPECT_EQ(chain.FieldEntry("light fields solved"), 0.0);
  EXPECT_EQ(chain.MapEntry("views set up"), 0.0);
  EXPECT_TRUE(isRefined(chain));
  FillExtinction(this->Smoke, 0.4);
  EXPECT_EQ(chain.Values(), this->FreshValues());
  EXPECT_EQ(chain.FieldEntry("thick smoke cells refined"), 0.0);
  EXPECT_FALSE(isRefined(chain));
}

TEST_F(ReuseTest, SmokeThatChangesKeepsTheSearchStructures)
{
  Chain chain(this->Smoke, this->Wall, this->Sign, this->Lamp);
  const std::vector<double> first = chain.Values();
  FillExtinction(this->Smoke, 0.7);
  const std::vector<double> second = chain.Values();
  EXPECT_NE(second, first);
  EXPECT_EQ(chain.FieldEntry("search structures built"), 0.0);
  EXPECT_EQ(chain.MapEntry("views set up"), 1.0);
  EXPECT_EQ(chain.MapEntry("search structures built"), 0.0);
  EXPECT_EQ(second, this->FreshValues());
  FillExtinction(this->Smoke, 0.4);
  EXPECT_EQ(chain.Values(), first);
}

TEST_F(ReuseTest, WhatMattersIsNoticed)
{
  Chain chain(this->Smoke, this->Wall, this->Sign, this->Lamp);
  std::vector<double> last = chain.Values();
  const auto changes = [&](const char* what, double built)
  {
    const std::vector<double> values = chain.Values();
    EXPECT_NE(values, last) << what;
    EXPECT_EQ(values, this->FreshValues()) << what;
    EXPECT_EQ(chain.FieldEntry("search structures built"), built) << what;
    EXPECT_EQ(chain.FieldEntry("light fields solved"), -1.0) << what;
    last = values;
  };
  this->Wall->SetPoint2(0, 1, 0);
  changes("a wall", 1.0);
  this->Sign->SetLuminance(200.0);
  changes("a luminance", 0.0);
  this->Sign->SetCenter(3.9, 1.0, 1.0);
  changes("a place", 1.0);
  std::ofstream(this->Path) << "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 1 1 2 0.2 0.2 0\n1 1 10\n"
                               "0 45 90\n0\n100 20 0\n";
  this->Lamp->Modified();
  changes("a photometric file", 0.0);
}

TEST_F(ReuseTest, OtherAccuracyIsSolvedAnew)
{
  Chain chain(this->Smoke, this->Wall, this->Sign, this->Lamp);
  chain.Values();
  chain.Field->SetSeed(2);
  chain.Values();
  EXPECT_EQ(chain.FieldEntry("light fields solved"), -1.0);
  EXPECT_EQ(chain.FieldEntry("search structures built"), 0.0);
  chain.Field->SetDefaultReflectance(0.6);
  chain.Values();
  EXPECT_EQ(chain.FieldEntry("light fields solved"), -1.0);
}

} // namespace
