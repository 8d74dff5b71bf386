// Extinction from whatever a run wrote: which slices are taken, and what they are turned into.
#include "ErrorText.h"
#include "Errors.h"
#include "ExtinctionSource.h"
#include "FormatsTestRun.h"

#include <gmock/gmock.h>

#include <limits>

using testing::ElementsAre;
using testing::FloatNear;
using testing::HasSubstr;
using testing::IsEmpty;

namespace smokevis
{

namespace
{

// A run of one mesh with 2 x 1 x 1 cells of 1 m.
class OneMeshRun : public testing::Test
{
protected:
  OneMeshRun() { index_.Mesh("m", {2, 1, 1}, {0, 0, 0}, {2, 1, 1}); }

  // Adds a cell-centred 3-D slice with these two cells, constant in time.
  void AddCells(const std::string& file, const std::string& label, float first, float second)
  {
    const float ghost = -7.0F; // must never show up
    std::vector<float> stored(12, ghost);
    stored[10] = first;
    stored[11] = second;
    folder_.Write(
      file, test::SliceBytes(label, {0, 2, 0, 1, 0, 1}, {{0.0F, stored}, {1.0F, stored}}));
    index_.Slice(true, 1, {0, 2, 0, 1, 0, 1}, file, label);
  }

  // Adds a node-centred 3-D slice whose nodes have the values of their x index.
  void AddNodes(const std::string& file, const std::string& label, const std::array<float, 3>& x)
  {
    std::vector<float> stored;
    for (int row = 0; row < 4; ++row)
    {
      stored.insert(stored.end(), x.begin(), x.end());
    }
    folder_.Write(
      file, test::SliceBytes(label, {0, 2, 0, 1, 0, 1}, {{0.0F, stored}, {1.0F, stored}}));
    index_.Slice(false, 1, {0, 2, 0, 1, 0, 1}, file, label);
  }

  const SmvFile& Run()
  {
    run_ = std::make_unique<SmvFile>(folder_.Write("test.smv", index_.Bytes()));
    return *run_;
  }

  std::vector<float> Read()
  {
    ExtinctionSource source(this->Run(), {});
    return test::ReadCells(source, 0, 0.0, {}).Values;
  }

  std::string ReadError()
  {
    return test::ErrorText([&] { this->Read(); });
  }

  test::Folder folder_{"extinction"};
  test::Index index_;
  std::unique_ptr<SmvFile> run_;
};

TEST_F(OneMeshRun, PrefersCellsOfExtinction)
{
  this->AddNodes("n.sf", "SOOT EXTINCTION COEFFICIENT", {4, 5, 6});
  this->AddCells("d.sf", "SOOT DENSITY", 1, 1);
  this->AddCells("k.sf", "SOOT EXTINCTION COEFFICIENT", 0.5, 0.75);
  ExtinctionSource source(this->Run(), {});
  EXPECT_THAT(test::ReadCells(source, 0, 0.0, {}).Values, ElementsAre(0.5, 0.75));
  EXPECT_THAT(source.Times(), ElementsAre(0.0, 1.0));
  EXPECT_THAT(source.Warnings(), IsEmpty());
  EXPECT_THAT(source.Description(), HasSubstr("k.sf"));
  EXPECT_THAT(source.Description(), testing::Not(HasSubstr("n.sf")));
  EXPECT_EQ(source.NearestTime(-5.0), 0.0);
  EXPECT_EQ(source.NearestTime(0.5), 0.0);
  EXPECT_EQ(source.NearestTime(0.51), 1.0);
}

TEST_F(OneMeshRun, PrefersCellsOfOtherQuantitiesToNodesOfExtinction)
{
  const auto taken = [this](double massExtinction)
  {
    return ExtinctionSource(this->Run(), {3.0, massExtinction, SmokeSourceKind::Automatic})
      .Description();
  };
  // Visibility is capped and comes behind.
  this->AddCells("v.sf", "SOOT VISIBILITY", 3, 3);
  this->AddNodes("n.sf", "SOOT EXTINCTION COEFFICIENT", {4, 5, 6});
  EXPECT_THAT(taken(0.0), HasSubstr("n.sf"));
  // Without Km in the index density may be off by any factor; with one it is exact.
  this->AddCells("d.sf", "SOOT DENSITY", 1e-4F, 2e-4F);
  EXPECT_THAT(taken(0.0), HasSubstr("n.sf"));
  EXPECT_THAT(taken(8000.0), HasSubstr("d.sf"));
  index_.Text("SMOKF3D     1   8000.0\n gone.s3d\n SOOT DENSITY\n rho\n kg/m3\n");
  EXPECT_THAT(taken(0.0), HasSubstr("d.sf"));
  EXPECT_THAT(this->Read(), ElementsAre(testing::FloatEq(0.8F), testing::FloatEq(1.6F)));
  this->AddCells("o.sf", "SOOT OPTICAL DENSITY", 1, 2);
  EXPECT_THAT(taken(0.0), HasSubstr("o.sf"));
  this->AddCells("k.sf", "SOOT EXTINCTION COEFFICIENT", 0.5, 0.75);
  EXPECT_THAT(taken(0.0), HasSubstr("k.sf"));
}

TEST_F(OneMeshRun, AMassFractionIsAsExactAsItsDensity)
{
  index_.Text("SMOKF3D     1   8000.0\n gone.s3d\n SOOT DENSITY\n rho\n kg/m3\n");
  this->AddNodes("n.sf", "SOOT OPTICAL DENSITY", {1, 1, 1});
  this->AddCells("y.sf", "SOOT MASS FRACTION", 1e-4F, 1e-4F);
  this->AddNodes("rn.sf", "DENSITY", {1, 1, 1});
  EXPECT_THAT(ExtinctionSource(this->Run(), {}).Description(), HasSubstr("n.sf"));
  EXPECT_THAT(this->Read(), ElementsAre(2.3F, 2.3F));
  this->AddCells("r.sf", "DENSITY", 1, 1);
  EXPECT_THAT(this->Read(), ElementsAre(testing::FloatEq(0.8F), testing::FloatEq(0.8F)));
}

TEST_F(OneMeshRun, AveragesTheNodesOfACell)
{
  this->AddNodes("n.sf", "SOOT EXTINCTION COEFFICIENT", {1, 2, 4});
  EXPECT_THAT(this->Read(), ElementsAre(1.5, 3.0));
}

TEST_F(OneMeshRun, TurnsOpticalDensityIntoExtinction)
{
  this->AddCells("o.sf", "MY SMOKE OPTICAL DENSITY", 1, 2);
  EXPECT_THAT(this->Read(), ElementsAre(2.3F, 4.6F));
}

TEST_F(OneMeshRun, TurnsDensityIntoExtinctionWithTheRunsCoefficient)
{
  index_.Text("SMOKF3D     1   8000.0\n a.s3d\n BLACK STUFF DENSITY\n rho\n kg/m3\n");
  this->AddCells("b.sf", "BLACK STUFF DENSITY", 1e-4F, 0);
  this->AddCells("c.sf", "CARBON DIOXIDE DENSITY", 1, 1); // no smoke
  this->AddCells("g.sf", "DENSITY", 1.2F, 1.2F);          // the gas
  EXPECT_THAT(this->Read(), ElementsAre(testing::FloatEq(0.8F), 0.0F));
}

TEST_F(OneMeshRun, TakesFdsCoefficientForSootWithoutOne)
{
  this->AddCells("b.sf", "SOOT DENSITY", 1e-4F, 0);
  EXPECT_THAT(this->Read(), ElementsAre(testing::FloatEq(0.87F), 0.0F));
}

TEST_F(OneMeshRun, TakesTheMostSmokeThatACappedVisibilityAllows)
{
  this->AddCells("v.sf", "SOOT VISIBILITY", 3, 30);
  ExtinctionSource source(this->Run(), {});
  EXPECT_THAT(
    test::ReadCells(source, 0, 0.0, {}).Values, ElementsAre(1.0F, testing::FloatEq(0.1F)));
  ASSERT_EQ(source.Warnings().size(), 1U);
  EXPECT_THAT(source.Warnings()[0], HasSubstr("caps"));
}

TEST_F(OneMeshRun, AddsSpecies)
{
  this->AddCells("a.sf", "SOOT EXTINCTION COEFFICIENT", 0.5, 1);
  this->AddNodes("b.sf", "MY SMOKE EXTINCTION COEFFICIENT", {1, 1, 1});
  this->AddCells("c.sf", "EXTINCTION COEFFICIENT", 100, 100); // the sum of the two, not a third
  EXPECT_THAT(this->Read(), ElementsAre(1.5, 2.0));
}

TEST_F(OneMeshRun, PartsOfAMeshCompleteEachOther)
{
  const auto part = [&](const std::string& file, int cell, float value)
  {
    std::vector<float> stored(8, -7.0F);
    stored[7] = value;
    const std::array<int, 6> range{cell, cell + 1, 0, 1, 0, 1};
    folder_.Write(file, test::SliceBytes("SOOT EXTINCTION COEFFICIENT",
                          {range.begin(), range.end()}, {{0.0F, stored}}));
    index_.Slice(true, 1, range, file, "SOOT EXTINCTION COEFFICIENT");
  };
  part("a.sf", 1, 2.0F);
  part("a again.sf", 1, 3.0F); // the same cell once more must not add
  ExtinctionSource one(this->Run(), {});
  EXPECT_THAT(test::ReadCells(one, 0, 0.0, {}).Values, ElementsAre(0.0F, 2.0F));
  ASSERT_EQ(one.Warnings().size(), 1U);
  EXPECT_THAT(one.Warnings()[0], HasSubstr("only a part of mesh 'm'"));
  part("b.sf", 0, 1.0F);
  EXPECT_THAT(this->Read(), ElementsAre(1.0F, 2.0F));
}

TEST_F(OneMeshRun, CompletesABetterPartFromTheWholeMesh)
{
  std::vector<float> stored(8, 9.0F);
  folder_.Write(
    "p.sf", test::SliceBytes("SOOT EXTINCTION COEFFICIENT", {0, 1, 0, 1, 0, 1}, {{0.0F, stored}}));
  index_.Slice(true, 1, {0, 1, 0, 1, 0, 1}, "p.sf", "SOOT EXTINCTION COEFFICIENT");
  this->AddNodes("n.sf", "SOOT EXTINCTION COEFFICIENT", {1, 1, 1});
  EXPECT_THAT(this->Read(), ElementsAre(9.0, 1.0));
}

TEST_F(OneMeshRun, SolidsHoldNoSmokeWhateverTheFileSays)
{
  this->AddCells("k.sf", "SOOT EXTINCTION COEFFICIENT", std::numeric_limits<float>::quiet_NaN(), 2);
  ExtinctionSource source(this->Run(), {});
  EXPECT_THAT(test::ReadCells(source, 0, 0.0, {1, 0}).Values, ElementsAre(0.0F, 2.0F));
}

TEST_F(OneMeshRun, RefusesWhatIsNoExtinction)
{
  this->AddCells("k.sf", "SOOT EXTINCTION COEFFICIENT", 1, std::numeric_limits<float>::quiet_NaN());
  EXPECT_THAT(this->ReadError(), HasSubstr("k.sf"));
  EXPECT_THAT(this->ReadError(), HasSubstr("in cell (1, 0, 0) of mesh 'm' at 0 s"));
  this->AddCells("k.sf", "SOOT EXTINCTION COEFFICIENT", 1, -0.5F);
  EXPECT_THAT(this->ReadError(), HasSubstr("-0.5 1/m"));
  this->AddCells("k.sf", "SOOT EXTINCTION COEFFICIENT", 1, -1e-7F);
  EXPECT_THAT(this->Read(), ElementsAre(1.0F, 0.0F));
}

TEST_F(OneMeshRun, TellsWhatToAskFdsFor)
{
  index_.Slice(false, 1, {0, 2, 0, 1, 0, 0}, "t.sf", "TEMPERATURE");
  EXPECT_THAT(this->ReadError(), HasSubstr("2-D slice of TEMPERATURE"));
  EXPECT_THAT(this->ReadError(), HasSubstr("&SLCF"));
}

TEST_F(OneMeshRun, NamesAMissingFileAndOneOfAnotherRun)
{
  index_.Slice(true, 1, {0, 2, 0, 1, 0, 1}, "gone.sf", "SOOT EXTINCTION COEFFICIENT");
  EXPECT_THAT(this->ReadError(),
    HasSubstr("gone.sf: the slice of SOOT EXTINCTION COEFFICIENT of mesh 'm' cannot be opened"));
  folder_.Write(
    "gone.sf", test::SliceBytes("A", {0, 1, 0, 1, 0, 1}, {{0.0F, std::vector<float>(8)}}));
  EXPECT_THAT(this->ReadError(), HasSubstr("is not the one"));
}

TEST_F(OneMeshRun, ALostFileOfOneMeshIsAnError)
{
  index_.Mesh("other", {1, 1, 1}, {2, 0, 0}, {3, 1, 1});
  this->AddCells("k.sf", "SOOT EXTINCTION COEFFICIENT", 1, 2);
  index_.Slice(true, 2, {0, 1, 0, 1, 0, 1}, "gone.sf", "SOOT EXTINCTION COEFFICIENT");
  EXPECT_THAT(this->ReadError(), HasSubstr("gone.sf"));
}

TEST_F(OneMeshRun, SaysThatTheLastFrameIsCutShort)
{
  this->AddCells("k.sf", "SOOT EXTINCTION COEFFICIENT", 1, 2);
  std::filesystem::resize_file(
    folder_.Path("k.sf"), std::filesystem::file_size(folder_.Path("k.sf")) - 3);
  ExtinctionSource source(this->Run(), {});
  EXPECT_THAT(source.Times(), ElementsAre(0.0));
  EXPECT_THAT(source.Warnings(), IsEmpty());
  EXPECT_THAT(source.Damages(), ElementsAre(HasSubstr("frame 2")));
  EXPECT_THAT(test::ReadCells(source, 0, 0.0, {}).Values, ElementsAre(1.0F, 2.0F));
}

TEST_F(OneMeshRun, SaysThatAMeshHasNoSmokeOrNoSuchFrame)
{
  index_.Mesh("other", {1, 1, 1}, {2, 0, 0}, {3, 1, 1});
  this->AddCells("k.sf", "SOOT EXTINCTION COEFFICIENT", 1, 2);
  ExtinctionSource bare(this->Run(), {});
  ASSERT_EQ(bare.Warnings().size(), 1U);
  EXPECT_THAT(bare.Warnings()[0], HasSubstr("Mesh 'other' has no 3-D output"));
  EXPECT_THAT(test::ReadCells(bare, 1, 0.0, {}, 1).Values, ElementsAre(0.0F));
  folder_.Write("o.sf", test::SliceBytes("SOOT EXTINCTION COEFFICIENT", {0, 1, 0, 1, 0, 1},
                          {{0.0F, std::vector<float>(8, 5.0F)}}));
  index_.Slice(true, 2, {0, 1, 0, 1, 0, 1}, "o.sf", "SOOT EXTINCTION COEFFICIENT");
  ExtinctionSource both(this->Run(), {});
  EXPECT_EQ(test::ReadCells(both, 0, 1.0, {}).Time, 1.0);
  EXPECT_EQ(test::ReadCells(both, 1, 1.0, {}, 1).Time, 0.0);
}

TEST_F(OneMeshRun, ARestartedRunsLaterWritingHolds)
{
  const std::vector<float> first(12, 1.0F);
  const std::vector<float> second(12, 2.0F);
  folder_.Write("r.sf", test::SliceBytes("SOOT EXTINCTION COEFFICIENT", {0, 2, 0, 1, 0, 1},
                          {{0.0F, first}, {1.0F, first}, {0.0F, second}}));
  index_.Slice(true, 1, {0, 2, 0, 1, 0, 1}, "r.sf", "SOOT EXTINCTION COEFFICIENT");
  ExtinctionSource source(this->Run(), {});
  EXPECT_THAT(source.Times(), ElementsAre(0.0, 1.0));
  EXPECT_THAT(test::ReadCells(source, 0, 0.0, {}).Values, ElementsAre(2.0F, 2.0F));
}

TEST_F(OneMeshRun, MultipliesAMassFractionByTheGasDensity)
{
  this->AddCells("y.sf", "SOOT MASS FRACTION", 1e-4F, 2e-4F);
  EXPECT_THAT(this->ReadError(), HasSubstr("wrote no smoke in 3-D"));
  this->AddCells("r.sf", "DENSITY", 1.2F, 0.6F);
  EXPECT_THAT(this->Read(), ElementsAre(FloatNear(1.044F, 1e-5F), FloatNear(1.044F, 1e-5F)));
  ExtinctionSource source(*run_, {});
  EXPECT_THAT(source.Description(), HasSubstr("y.sf times DENSITY r.sf, Km = 8700 m2/kg"));
  // The density of the smoke itself is better.
  this->AddCells("d.sf", "SOOT DENSITY", 1e-4F, 1e-4F);
  EXPECT_THAT(this->Read(), ElementsAre(FloatNear(0.87F, 1e-5F), FloatNear(0.87F, 1e-5F)));
}

TEST_F(OneMeshRun, AnotherMassExtinctionScalesEverySource)
{
  index_.Text("SMOKF3D     1   8000.0\n a.s3d\n SOOT DENSITY\n rho\n kg/m3\n");
  this->AddCells("k.sf", "SOOT EXTINCTION COEFFICIENT", 1, 2);
  this->AddCells("d.sf", "SOOT DENSITY", 1e-4F, 2e-4F);
  this->AddCells("o.sf", "SOOT OPTICAL DENSITY", 1, 2);
  this->AddCells("v.sf", "SOOT VISIBILITY", 3, 1.5F);
  const auto first = [&](SmokeSourceKind kind)
  {
    ExtinctionSource source(this->Run(), {3.0, 4000.0, kind});
    return test::ReadCells(source, 0, 0.0, {}).Values[0];
  };
  EXPECT_FLOAT_EQ(first(SmokeSourceKind::Automatic), 0.5F);
  EXPECT_FLOAT_EQ(first(SmokeSourceKind::DensitySlice), 0.4F);
  EXPECT_FLOAT_EQ(first(SmokeSourceKind::OpticalDensitySlice), 1.15F);
  EXPECT_FLOAT_EQ(first(SmokeSourceKind::VisibilitySlice), 0.5F);
}

TEST_F(OneMeshRun, TheSourceThatIsAskedForMustBeThere)
{
  this->AddCells("k.sf", "SOOT EXTINCTION COEFFICIENT", 1, 2);
  try
  {
    ExtinctionSource source(this->Run(), {3.0, 0.0, SmokeSourceKind::Plot3D});
    FAIL();
  }
  catch (const Error& error)
  {
    EXPECT_THAT(error.what(), HasSubstr("wrote no Plot3D files with smoke"));
    EXPECT_THAT(error.what(), HasSubstr("3-D slice of SOOT EXTINCTION COEFFICIENT"));
  }
}

TEST_F(OneMeshRun, TheNextBestSourceStandsInForAMissingFile)
{
  index_.Slice(true, 1, {0, 2, 0, 1, 0, 1}, "gone.sf", "SOOT EXTINCTION COEFFICIENT");
  this->AddCells("d.sf", "SOOT DENSITY", 1e-4F, 0);
  ExtinctionSource source(this->Run(), {});
  EXPECT_THAT(
    test::ReadCells(source, 0, 0.0, {}).Values, ElementsAre(testing::FloatEq(0.87F), 0.0F));
  ASSERT_EQ(source.Warnings().size(), 1U);
  EXPECT_THAT(source.Warnings()[0],
    HasSubstr("gone.sf: the slice of SOOT EXTINCTION COEFFICIENT of mesh 'm' cannot be opened"));
}

TEST_F(OneMeshRun, InterpolatesInTime)
{
  folder_.Write(
    "t.sf", test::SliceBytes("SOOT EXTINCTION COEFFICIENT", {0, 2, 0, 1, 0, 1},
              {{-2.0F, std::vector<float>(12, 1.0F)}, {2.0F, std::vector<float>(12, 3.0F)}}));
  index_.Slice(true, 1, {0, 2, 0, 1, 0, 1}, "t.sf", "SOOT EXTINCTION COEFFICIENT");
  ExtinctionSource source(this->Run(), {});
  const auto at = [&](double time, TimeInterpolation interpolation)
  {
    std::vector<float> values(2);
    const double read = source.Read(0, time, interpolation, {}, values);
    return std::make_pair(values[1], read);
  };
  EXPECT_EQ(at(-1.0, TimeInterpolation::Linear), std::make_pair(1.5F, -1.0));
  EXPECT_EQ(at(-1.0, TimeInterpolation::Nearest), std::make_pair(1.0F, -2.0));
  EXPECT_EQ(at(0.0, TimeInterpolation::Nearest), std::make_pair(1.0F, -2.0));
  EXPECT_EQ(at(9.0, TimeInterpolation::Linear), std::make_pair(3.0F, 2.0));
  EXPECT_EQ(at(-9.0, TimeInterpolation::Linear), std::make_pair(1.0F, -2.0));
  EXPECT_EQ(at(2.0, TimeInterpolation::Linear), std::make_pair(3.0F, 2.0));
}

} // namespace
} // namespace smokevis
