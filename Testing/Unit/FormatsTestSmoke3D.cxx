// 8-bit smoke (.s3d, .s3dd) and Plot3D (.q), and how their nodes become extinction in cells.
#include "ErrorText.h"
#include "Errors.h"
#include "ExtinctionSource.h"
#include "FormatsTestRun.h"
#include "Plot3DSeries.h"
#include "Smoke3DFile.h"

#include <gmock/gmock.h>

#include <cmath>
#include <sys/stat.h>

using testing::Each;
using testing::ElementsAre;
using testing::FloatNear;
using testing::HasSubstr;

namespace smokevis
{

namespace
{

constexpr std::array<int, 3> Nodes{3, 2, 2};

using Bytes = std::vector<unsigned char>;

// A .s3d of 3 x 2 x 2 nodes with the given coded frames, one a second.
std::string Smoke(int version, const std::vector<Bytes>& frames, bool swapped = false)
{
  test::Records records(swapped);
  records.Add(std::vector<int>{1, version, 0, 2, 0, 1, 0, 1});
  for (std::size_t f = 0; f < frames.size(); ++f)
  {
    records.Add(std::vector<float>{static_cast<float>(f)});
    records.Add(std::vector<int>{12, static_cast<int>(frames[f].size())}).Add(frames[f]);
  }
  return records.Bytes();
}

// A run of ten times 127, then 0 and 254.
const Bytes Coded{255, 127, 10, 0, 254};

} // namespace

TEST(Smoke3DFile, DecodesDensityOfVersion1)
{
  test::Folder folder("v1");
  for (const bool swapped : {false, true})
  {
    const std::string path = folder.Write("a.s3d", Smoke(1, {Coded, Coded}, swapped));
    folder.Write("a.s3d.sz", "    1\n 0.0 12 5 0.0\n 1.0 12 5 2.0E-4\n");
    EXPECT_TRUE(Smoke3DFile::HoldsDensity(path));
    Smoke3DFile smoke(path, Nodes, 0.5);
    EXPECT_THAT(smoke.FrameTimes(), ElementsAre(0.0, 1.0));
    EXPECT_EQ(smoke.Damage(), "");
    std::vector<float> values;
    smoke.ReadFrame(0, values);
    EXPECT_THAT(values, Each(0.0F)); // the greatest density is 0
    smoke.ReadFrame(1, values);
    ASSERT_EQ(values.size(), 12U);
    EXPECT_NEAR(values[0], 0.5 * 2e-4, 1e-10);
    EXPECT_NEAR(values[9], 0.5 * 2e-4, 1e-10);
    EXPECT_EQ(values[10], 0.0F);
    EXPECT_NEAR(values[11], 2e-4, 1e-10);
  }
}

TEST(Smoke3DFile, DecodesOpacityOverTheFirstCell)
{
  test::Folder folder("v0");
  const std::string path = folder.Write("a.s3d", Smoke(0, {Coded}));
  EXPECT_FALSE(Smoke3DFile::HoldsDensity(path));
  Smoke3DFile smoke(path, Nodes, 0.5);
  std::vector<float> values;
  smoke.ReadFrame(0, values);
  // exp(-K 0.5 m) = 1 - 127/254
  EXPECT_NEAR(values[0], std::log(2.0) / 0.5, 1e-6);
  EXPECT_EQ(values[10], 0.0F);
  // Full opacity is what rounds to it: at least 253.5/254.
  EXPECT_NEAR(values[11], std::log(508.0) / 0.5, 1e-5);
}

TEST(Smoke3DFile, PrefersTheDensityTwin)
{
  test::Folder folder("twin");
  const std::string path = folder.Write("a.s3d", Smoke(0, {Coded}));
  folder.Write("a.s3dd", Smoke(0, {{255, 254, 12}}));
  folder.Write("a.s3d.sz", "    0\n 0.0 12 5 180.0 3 1.0E-4\n");
  EXPECT_TRUE(Smoke3DFile::HoldsDensity(path));
  std::vector<float> values;
  Smoke3DFile(path, Nodes, 0.5).ReadFrame(0, values);
  EXPECT_THAT(values, Each(FloatNear(1e-4F, 1e-10F)));
  // All names in capital letters, as some disks have them.
  const std::string capitals = folder.Write("B.S3D", Smoke(0, {Coded}));
  folder.Write("B.S3DD", Smoke(0, {{255, 254, 12}}));
  folder.Write("B.S3D.SZ", "    0\n 0.0 12 5 180.0 3 2.0E-4\n");
  EXPECT_TRUE(Smoke3DFile::HoldsDensity(capitals));
  Smoke3DFile(capitals, Nodes, 0.5).ReadFrame(0, values);
  EXPECT_THAT(values, Each(FloatNear(2e-4F, 1e-10F)));
}

TEST(Smoke3DFile, NamesWhatIsWrong)
{
  test::Folder folder("wrong");
  const auto read = [&](const std::string& bytes)
  {
    const std::string path = folder.Write("a.s3d", bytes);
    return test::ErrorText(
      [&]
      {
        Smoke3DFile smoke(path, Nodes, 0.5);
        std::vector<float> values;
        smoke.ReadFrame(0, values);
      });
  };
  EXPECT_THAT(read(""), HasSubstr("is empty"));
  EXPECT_THAT(read(Smoke(2, {Coded})), HasSubstr("version 2"));
  EXPECT_THAT(read(Smoke(0, {})), HasSubstr("no whole frame"));
  EXPECT_THAT(read(Smoke(0, {{255, 1, 11}})), HasSubstr("does not unpack to 12 values"));
  EXPECT_THAT(read(Smoke(0, {{255, 1, 13}})), HasSubstr("does not unpack"));
  EXPECT_THAT(read(Smoke(0, {{255, 1, 12, 255}})), HasSubstr("does not unpack"));
  EXPECT_THAT(read(Smoke(0, {{255, 1}})), HasSubstr("does not unpack"));
  EXPECT_THAT(read(Smoke(1, {Coded})), HasSubstr("a.s3d.sz"));
  const std::string cut = Smoke(0, {Coded});
  EXPECT_THAT(read(cut.substr(0, cut.size() - 1)), HasSubstr("frame 1 at byte 40 is cut short"));
  const std::string path = folder.Write("a.s3d", cut);
  EXPECT_THAT(test::ErrorText(
                [&] {
                  Smoke3DFile smoke(path, {4, 2, 2}, 0.5);
                }),
    HasSubstr("not that of the mesh"));
}

TEST(Smoke3DFile, FramesWithoutAGreatestDensityAreLeftOut)
{
  test::Folder folder("sz");
  const std::string path = folder.Write("a.s3d", Smoke(1, {Coded, Coded}));
  folder.Write("a.s3d.sz", "    1\n 0.0 12 5 1.0E-4\n");
  const Smoke3DFile smoke(path, Nodes, 0.5);
  EXPECT_THAT(smoke.FrameTimes(), ElementsAre(0.0));
  EXPECT_THAT(smoke.Damage(), HasSubstr("frame 2"));
}

TEST(Smoke3DFile, APipeInPlaceOfTheGreatestDensitiesIsNotWaitedFor)
{
  test::Folder folder("pipe");
  const std::string path = folder.Write("a.s3d", Smoke(1, {Coded}));
  ASSERT_EQ(::mkfifo(folder.Path("a.s3d.sz").c_str(), 0600), 0);
  try
  {
    Smoke3DFile(path, Nodes, 0.5);
    FAIL() << "no error";
  }
  catch (const Error& error)
  {
    EXPECT_THAT(error.what(), HasSubstr("a.s3d.sz: the text file with the greatest densities"));
  }
}

TEST(Smoke3DFile, AnyCutOrFlippedByteIsReadOrRefused)
{
  test::Folder folder("fuzz");
  const std::string whole = Smoke(0, {Coded, Coded});
  for (std::size_t i = 0; i < whole.size(); i += 3)
  {
    for (const char c : {'\xff', '\x7f', '\0'})
    {
      std::string flipped = whole;
      flipped[i] = c;
      for (const std::string& bytes : {flipped, whole.substr(0, i)})
      {
        const std::string path = folder.Write("a.s3d", bytes);
        test::ErrorText(
          [&]
          {
            Smoke3DFile smoke(path, Nodes, 0.5);
            std::vector<float> values;
            smoke.ReadFrame(smoke.FrameTimes().size() - 1, values);
          });
      }
    }
  }
}

TEST(Plot3DSeries, ReadsOneQuantityOfOneTime)
{
  test::Folder folder("plot3d");
  std::vector<float> values(60);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    values[i] = static_cast<float>(i);
  }
  for (const bool swapped : {false, true})
  {
    test::Records records(swapped);
    records.Add(std::vector<int>{3, 2, 2}).Add(std::vector<float>(4)).Add(values);
    const std::string path = folder.Write("a.q", records.Bytes());
    Plot3DSeries series({{300.0, folder.Path("gone.q")}, {600.0, path}}, 3, Nodes);
    EXPECT_THAT(series.FrameTimes(), ElementsAre(600.0));
    EXPECT_THAT(series.Damage(), HasSubstr("gone.q"));
    std::vector<float> read;
    series.ReadFrame(0, read);
    EXPECT_EQ(read, std::vector<float>(values.begin() + 36, values.begin() + 48));
    Plot3DSeries other({{600.0, path}}, 0, {4, 2, 2});
    EXPECT_THAT(test::ErrorText([&] { other.ReadFrame(0, read); }), HasSubstr("number of nodes"));
    folder.Write("a.q", records.Bytes().substr(0, records.Bytes().size() - 8));
    EXPECT_THAT(test::ErrorText([&] { series.ReadFrame(0, read); }), HasSubstr("five quantities"));
  }
  EXPECT_THAT(test::ErrorText(
                [&] {
                  Plot3DSeries none({{0.0, folder.Path("gone.q")}}, 0, Nodes);
                }),
    HasSubstr("none of the run's Plot3D files"));
}

// One mesh of 2 x 1 x 1 cells of 0.5 m with 8-bit smoke, Plot3D or both.
class WithoutSlices : public testing::Test
{
protected:
  WithoutSlices() { index_.Mesh("m", {2, 1, 1}, {0, 0, 0}, {1, 0.5, 0.5}); }

  void AddSmoke(int version)
  {
    folder_.Write("a.s3d", Smoke(version, {{255, 127, 12}}));
    folder_.Write("a.s3d.sz", "    1\n 0.0 12 3 2.0E-4\n");
    index_.Text("SMOKF3D     1   8700.0\n a.s3d\n SOOT DENSITY\n rho\n kg/m3\n");
    index_.Text("SMOKF3D     1   0.0\n b.s3d\n HRRPUV\n hrrpuv\n kW/m3\n");
  }

  void AddPlot3D()
  {
    std::vector<float> values(60, 1.0F);
    std::fill(values.begin() + 36, values.begin() + 48, 0.25F);
    test::Records records;
    records.Add(std::vector<int>{3, 2, 2}).Add(std::vector<float>(4)).Add(values);
    folder_.Write("a.q", records.Bytes());
    index_.Text("PL3D  7.5 1\n a.q\n A\n a\n 1\n B\n b\n 1\n C\n c\n 1\n"
                " SOOT EXTINCTION COEFFICIENT\n k\n 1/m\n E\n e\n m\n");
  }

  const SmvFile& Run()
  {
    run_ = std::make_unique<SmvFile>(folder_.Write("test.smv", index_.Bytes()));
    return *run_;
  }

  test::Folder folder_{"noslices"};
  test::Index index_;
  std::unique_ptr<SmvFile> run_;
};

TEST_F(WithoutSlices, TakesTheSmokeOfTheNodes)
{
  this->AddSmoke(1);
  ExtinctionSource source(this->Run(), {});
  EXPECT_THAT(source.Description(), HasSubstr("8-bit 3-D smoke a.s3d"));
  EXPECT_THAT(test::ReadCells(source, 0, 0.0, {}).Values, Each(FloatNear(0.87F, 1e-5F)));
}

TEST_F(WithoutSlices, TakesSolidsOutOfTheNodes)
{
  this->AddSmoke(1);
  ExtinctionSource source(this->Run(), {});
  // The first cell is solid: of the second one's nodes, four lie halfway in it and lack half.
  EXPECT_THAT(test::ReadCells(source, 0, 0.0, {1, 0}).Values,
    ElementsAre(0.0F, FloatNear(0.5F * 0.87F + 0.5F * 2 * 0.87F, 1e-5F)));
}

TEST_F(WithoutSlices, PrefersDensityToPlot3DAndPlot3DToOpacity)
{
  this->AddSmoke(1);
  this->AddPlot3D();
  EXPECT_THAT(ExtinctionSource(this->Run(), {}).Description(), HasSubstr("a.s3d"));
  folder_.Write("a.s3d", Smoke(0, {{255, 127, 12}}));
  ExtinctionSource source(this->Run(), {});
  EXPECT_THAT(source.Description(), HasSubstr("Plot3D a.q"));
  EXPECT_THAT(source.Times(), ElementsAre(7.5));
  EXPECT_THAT(test::ReadCells(source, 0, 0.0, {}).Values, Each(0.25F));
}

TEST_F(WithoutSlices, CompletesAPartialSliceFromTheSmoke)
{
  this->AddSmoke(1);
  folder_.Write("p.sf", test::SliceBytes("SOOT EXTINCTION COEFFICIENT", {0, 1, 0, 1, 0, 1},
                          {{0.0F, std::vector<float>(8, 2.0F)}}));
  index_.Slice(true, 1, {0, 1, 0, 1, 0, 1}, "p.sf", "SOOT EXTINCTION COEFFICIENT");
  ExtinctionSource source(this->Run(), {});
  EXPECT_THAT(
    test::ReadCells(source, 0, 0.0, {}).Values, ElementsAre(2.0F, FloatNear(0.87F, 1e-5F)));
  EXPECT_TRUE(source.Warnings().empty());
  // Without the file the part alone is used, and that is said.
  std::filesystem::remove(folder_.Path("a.s3d"));
  ExtinctionSource part(this->Run(), {});
  EXPECT_THAT(test::ReadCells(part, 0, 0.0, {}).Values, ElementsAre(2.0F, 0.0F));
  ASSERT_EQ(part.Warnings().size(), 2U);
  EXPECT_THAT(part.Warnings()[0], HasSubstr("a.s3d"));
  EXPECT_THAT(part.Warnings()[1], HasSubstr("only a part"));
}

TEST_F(WithoutSlices, AnUnnamedSliceIsNotAddedToNamedSmoke)
{
  this->AddSmoke(1);
  folder_.Write("k.sf", test::SliceBytes("EXTINCTION COEFFICIENT", {0, 2, 0, 1, 0, 1},
                          {{0.0F, std::vector<float>(12, 2.0F)}}));
  index_.Slice(true, 1, {0, 2, 0, 1, 0, 1}, "k.sf", "EXTINCTION COEFFICIENT");
  EXPECT_THAT(test::ReadCells(ExtinctionSource(this->Run(), {}), 0, 0.0, {}).Values, Each(2.0F));
}

} // namespace smokevis
