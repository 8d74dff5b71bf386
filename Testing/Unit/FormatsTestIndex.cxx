// The .smv index: what it says, and what it says when it is broken.
#include "ErrorText.h"
#include "Errors.h"
#include "FormatsTestRun.h"
#include "SmvFile.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <sys/stat.h>

using testing::ElementsAre;
using testing::HasSubstr;

namespace smokevis
{

namespace
{

std::string IndexError(const std::string& path)
{
  return test::ErrorText([&] { SmvFile index(path); });
}

test::Index OneMesh()
{
  test::Index index;
  index.Mesh("room one", {4, 3, 2}, {0, 0, 0}, {4, 3, 2});
  index.Obstruction({1, 2, 0, 3, 0, 1}, test::Index::Wall);
  index.Obstruction({0, 1, 0, 1, 0, 1}, test::Index::Wall, "-3 -1 0.25 0.5 0.75 1.0");
  index.Vent({0, 0, 0, 3, 0, 2}, test::Index::Open, 1);
  return index;
}

} // namespace

TEST(SmvFile, ReadsWhatTheRunSays)
{
  test::Folder folder("index");
  const std::string text =
    OneMesh()
      .Text("ALBEDO\n 0.25\nTIMES\n -2.0 30.0\nTEMP_MINMAX\n 20. 1500.\n"
            "CSVF\n devc\n test_devc.csv\nUNKNOWN_KEYWORD\n 1 2 3\n"
            "DEVICE\n K 1 % EXTINCTION COEFFICIENT\n 1.5 2.5 1.7 0 0 -1 0 0 % null\n"
            "SMOKF3D     1   8500.0\n test_1_1.s3d\n SOOT DENSITY\n rho\n kg/m3\n"
            "PL3D  3.5 1\n a.q\n A\n a\n 1\n B\n b\n 1\n C\n c\n 1\n D\n d\n 1\n"
            " E\n e\n m\n")
      .Slice(true, 1, {0, 4, 0, 3, 0, 2}, "sub\\my slice.sf", "SOOT DENSITY")
      .Text("HIDE_OBST     1\n     2     15.0\nSHOW_OBST     1\n     2     20.0\n")
      .Bytes();
  const SmvFile index(folder.Write("test.smv", text));
  EXPECT_EQ(index.Chid, "test");
  EXPECT_EQ(index.Title, "A test");
  EXPECT_EQ(index.Version, "FDS-6.10.1");
  EXPECT_EQ(index.Albedo, 0.25);
  EXPECT_THAT(index.Times, ElementsAre(-2.0, 30.0));
  EXPECT_THAT(index.TemperatureRange, ElementsAre(20.0, 1500.0));
  EXPECT_THAT(index.HeatReleaseRange, ElementsAre(0.0, 1200.0));
  EXPECT_THAT(
    index.Tables, ElementsAre(std::pair<std::string, std::string>("devc", "test_devc.csv")));
  ASSERT_EQ(index.Meshes.size(), 1U);
  EXPECT_EQ(index.Meshes[0].Name, "room one");
  EXPECT_THAT(index.Meshes[0].Nodes[0], ElementsAre(0, 1, 2, 3, 4));
  EXPECT_EQ(index.Meshes[0].Cells(2), 2);
  ASSERT_EQ(index.Meshes[0].Obstructions.size(), 2U);
  EXPECT_EQ(index.Meshes[0].Obstructions[0].Name, "block");
  EXPECT_FALSE(index.Meshes[0].Obstructions[0].Color);
  EXPECT_THAT(index.Meshes[0].Obstructions[1].Color.value(), ElementsAre(0.25, 0.5, 0.75, 1.0));
  ASSERT_EQ(index.Meshes[0].Vents.size(), 1U);
  EXPECT_EQ(index.Meshes[0].Vents[0].Orientation, 1);
  EXPECT_EQ(index.Surfaces[index.Meshes[0].Vents[0].Surface].Name, "OPEN");
  EXPECT_EQ(index.Surfaces[index.DefaultSurface()].Name, "WALL");
  ASSERT_EQ(index.Smoke3D.size(), 1U);
  EXPECT_EQ(index.Smoke3D[0].MassExtinction, 8500.0);
  ASSERT_EQ(index.Plot3D.size(), 1U);
  EXPECT_EQ(index.Plot3D[0].Time, 3.5);
  EXPECT_EQ(index.Plot3D[0].Quantities[4].Unit, "m");
  ASSERT_EQ(index.Devices.size(), 1U);
  EXPECT_EQ(index.Devices[0].Name, "K 1");
  EXPECT_THAT(index.Devices[0].Position, ElementsAre(1.5, 2.5, 1.7));
  ASSERT_EQ(index.Slices.size(), 1U);
  EXPECT_TRUE(index.Slices[0].CellCentred);
  EXPECT_TRUE(index.Slices[0].IsVolume());
  EXPECT_EQ(index.Resolve(index.Slices[0].File), folder.Path("sub/my slice.sf"));
  // A run that was moved: absolute paths of another machine, files beside the index.
  folder.Write("moved.sf", "");
  for (const char* elsewhere : {"C:\\run\\moved.sf", "/home/else/moved.sf", "gone/moved.sf"})
  {
    EXPECT_EQ(index.Resolve(elsewhere), folder.Path("moved.sf")) << elsewhere;
  }
  EXPECT_TRUE(index.Warnings.empty());

  const std::vector<SmvEvent>& events = index.Meshes[0].Obstructions[1].Events;
  EXPECT_TRUE(IsOn(events, 14.9));
  EXPECT_FALSE(IsOn(events, 15.0));
  EXPECT_TRUE(IsOn(events, 20.0));
}

TEST(SmvFile, FindsNamesInOtherLetters)
{
  test::Folder folder("letters");
  const SmvFile index(folder.Write("test.smv", OneMesh().Bytes()));
  std::filesystem::create_directory(folder.Path("Results"));
  folder.Write("TEST_1_1.SF", "");
  folder.Write("Results/Part.sf", "");
  for (const char* name :
    {"test_1_1.sf", "Test_1_1.Sf", "C:\\run\\test_1_1.sf", "gone/test_1_1.sf"})
  {
    EXPECT_EQ(index.Resolve(name), folder.Path("TEST_1_1.SF")) << name;
  }
  EXPECT_EQ(index.Resolve("results\\PART.sf"), folder.Path("Results/Part.sf"));
  // One called as it should be comes first; of two others it is not clear which is meant.
  folder.Write("one.sf", "");
  folder.Write("ONE.sf", "");
  const SmvFile again(folder.Path("test.smv"));
  EXPECT_EQ(again.Resolve("one.sf"), folder.Path("one.sf"));
  EXPECT_EQ(again.Resolve("ONE.sf"), folder.Path("ONE.sf"));
  EXPECT_EQ(again.Resolve("One.sf"), folder.Path("One.sf"));
  EXPECT_EQ(again.Resolve("none.sf"), folder.Path("none.sf"));
}

TEST(SmvFile, ReadsWindowsLineEnds)
{
  test::Folder folder("crlf");
  std::string windows;
  for (const char c : OneMesh().Bytes())
  {
    windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  }
  const SmvFile index(folder.Write("test.smv", windows));
  EXPECT_EQ(index.Meshes.at(0).Name, "room one");
  EXPECT_EQ(index.Chid, "test");
}

TEST(SmvFile, SomethingShownLaterIsHiddenBefore)
{
  EXPECT_FALSE(IsOn({{10.0, true}}, 9.0));
  EXPECT_TRUE(IsOn({{10.0, true}}, 10.0));
  EXPECT_TRUE(IsOn({}, 0.0));
}

TEST(SmvFile, SkipsStretchingLines)
{
  test::Folder folder("stretch");
  std::string text = OneMesh().Bytes();
  text.replace(text.find("TRNX\n 0\n"), 8, "TRNX\n 2\n -1 4.8 4.4\n 2 0.1 0.2\n");
  EXPECT_THAT(
    SmvFile(folder.Write("test.smv", text)).Meshes[0].Nodes[0], ElementsAre(0, 1, 2, 3, 4));
}

TEST(SmvFile, AnIndexCutShortKeepsWhatIsWhole)
{
  test::Folder folder("cut");
  std::string text = OneMesh().Slice(false, 1, {0, 4, 0, 3, 0, 2}, "a.sf", "SOOT DENSITY").Bytes();
  text += "SLCF     1 # STRUCTURED & 0 4 0 3 0 2 ! 2 0 0\n b.sf\n";
  const SmvFile index(folder.Write("test.smv", text));
  EXPECT_EQ(index.Slices.size(), 1U);
  ASSERT_EQ(index.Warnings.size(), 1U);
  EXPECT_THAT(index.Warnings[0], HasSubstr("ends inside the entry SLCF"));
}

TEST(SmvFile, NamesWhatIsWrong)
{
  test::Folder folder("wrong");
  EXPECT_THAT(IndexError(folder.Path("none.smv")), HasSubstr("cannot be opened"));
  EXPECT_THAT(IndexError(folder.Path("")), HasSubstr("cannot be opened"));
  EXPECT_THAT(IndexError(folder.Write("a.smv", "")), HasSubstr("is empty"));
  EXPECT_THAT(IndexError(folder.Write("a.smv", "hello\nworld\n")), HasSubstr("names no mesh"));
  EXPECT_THAT(IndexError(folder.Write("a.smv", "GRID a\n 2 2 2\n")), HasSubstr("no TRNX"));
  EXPECT_THAT(
    IndexError(folder.Write("a.smv", "GRID a\n 2 0 2\n")), HasSubstr("positive cell counts"));
  EXPECT_THAT(IndexError(folder.Write("a.smv", "OBST\n 0\n")), HasSubstr("before any mesh"));
  EXPECT_THAT(IndexError(folder.Write("a.smv", "GRID a\n 2000000000 2000000000 2\n")),
    HasSubstr("more cells"));
  // Counts that no file of this size can hold.
  EXPECT_THAT(IndexError(folder.Write("a.smv", "GRID a\n 2000000000 1 1\nTRNX\n 0\n 0 0.0\n")),
    HasSubstr("ends inside the entry TRNX"));
  EXPECT_THAT(IndexError(folder.Write("a.smv", "GRID a\n 1 1 1\nOBST\n 2000000000\n")),
    HasSubstr("ends inside the entry OBST"));
  EXPECT_THAT(
    IndexError(folder.Write("a.smv", "GRID a\n 1 1 1\nTRNX\n -5\n")), HasSubstr("not a count"));
  EXPECT_THAT(IndexError(folder.Write("a.smv", "GRID a\n 1 1 1\nTRNX\n 0\n 0 1.0\n 1 1.0\n\n")),
    HasSubstr("do not increase"));
  test::Index twice = OneMesh();
  EXPECT_THAT(IndexError(folder.Write("a.smv", twice.Text("TRNX\n 0\n 0 0.\n").Bytes())),
    HasSubstr("ends inside the entry TRNX"));
  test::Index again = OneMesh();
  EXPECT_THAT(IndexError(folder.Write(
                "a.smv", again.Text("TRNX\n 0\n 0 0.\n 1 1.\n 2 2.\n 3 3.\n 4 4.\n").Bytes())),
    HasSubstr("node coordinates twice"));

  const auto with = [&](test::Index& index)
  { return IndexError(folder.Write("a.smv", index.Bytes())); };
  test::Index outside = OneMesh();
  EXPECT_THAT(with(outside.Slice(true, 1, {0, 5, 0, 3, 0, 2}, "a.sf", "X")),
    HasSubstr("index range outside of mesh 'room one'"));
  test::Index reversed = OneMesh();
  EXPECT_THAT(with(reversed.Slice(true, 1, {3, 2, 0, 3, 0, 2}, "a.sf", "X")),
    HasSubstr("index range outside"));
  test::Index mesh = OneMesh();
  EXPECT_THAT(with(mesh.Slice(true, 2, {0, 4, 0, 3, 0, 2}, "a.sf", "X")), HasSubstr("mesh 2 of 1"));
  test::Index plot = OneMesh();
  EXPECT_THAT(with(plot.Text("PL3D 1.0 33333333333333333333\n a.q\n")), HasSubstr("mesh -1 of 1"));
  test::Index surface;
  surface.Mesh("m", {1, 1, 1}, {0, 0, 0}, {1, 1, 1}).Obstruction({0, 1, 0, 1, 0, 1}, 17);
  EXPECT_THAT(with(surface), HasSubstr("surface number 17 of 6"));
}

TEST(SmvFile, AnEndlessFileIsRefusedUnread)
{
  test::Folder folder("endless");
  const std::string path = folder.Write("a.smv", "CHID\n a\n");
  std::error_code full;
  std::filesystem::resize_file(path, std::uintmax_t{1} << 37, full);
  if (full)
  {
    GTEST_SKIP() << "no files with holes here";
  }
  try
  {
    SmvFile index(path);
    FAIL() << "it was read";
  }
  catch (const Error& error)
  {
    EXPECT_THAT(error.what(), HasSubstr("137438953472 bytes, more than the index of any run"));
  }
}

TEST(SmvFile, PipesAreNotWaitedFor)
{
  test::Folder folder("pipe");
  ASSERT_EQ(::mkfifo(folder.Path("a.smv").c_str(), 0600), 0);
  EXPECT_THROW(SmvFile(folder.Path("a.smv")), Error);
}

TEST(SmvFile, NamesMayHoldTheMarksBetweenFields)
{
  test::Folder folder("marks");
  const std::string text = OneMesh().Bytes();
  const SmvFile index(folder.Write("a.smv",
    text + "SLCC     1 # STRUCTURED % door & hall ! 3 &     0    4    0    3    0    2 !      1" +
      "      1      0\n a.sf\n SOOT DENSITY\n rho\n kg/m3\n" +
      "DEVICE\n door 50% open % TEMPERATURE\n 0.5 1.5 2.0 0 0 0 0 0\n"));
  EXPECT_EQ(index.Slices.back().Range, (IndexRange{0, 4, 0, 3, 0, 2}));
  EXPECT_EQ(index.Devices.back().Name, "door 50% open");
  EXPECT_EQ(index.Devices.back().Quantity, "TEMPERATURE");
}

TEST(SmvFile, LabelsAreMadePrintable)
{
  test::Folder folder("labels");
  test::Index text;
  text.Mesh("m\x1B[31m", {1, 1, 1}, {0, 0, 0}, {1, 1, 1});
  const SmvFile index(folder.Write("a.smv", text.Bytes() + "CHID\n r\xFCn\n"));
  EXPECT_EQ(index.Chid, "r\\xFCn");
  EXPECT_EQ(index.Meshes.at(0).Name, "m\\x1B[31m");
}

TEST(SmvFile, ADevicesPlaceMayBeTooWideForItsField)
{
  test::Folder folder("wide");
  const std::string text = OneMesh().Text("").Bytes();
  const SmvFile index(folder.Write(
    "a.smv", text + "DEVICE\n far % TEMPERATURE\n************     1.50000     2.00000 0 0 0 0 0\n" +
               "DEVICE\n near % TEMPERATURE\n     0.50000     1.50000     2.00000 0 0 0 0 0\n"));
  const std::size_t last = index.Devices.size() - 1;
  EXPECT_TRUE(std::isnan(index.Devices.at(last - 1).Position[0]));
  EXPECT_EQ(index.Devices.at(last).Position[2], 2.0);
}

TEST(SmvFile, ChangesOfWhatIsNotThereAreLeftOut)
{
  test::Folder folder("changes");
  const auto warnings = [&](const std::string& changes)
  {
    const SmvFile index(folder.Write("a.smv", OneMesh().Text(changes).Bytes()));
    EXPECT_FALSE(IsOn(index.Meshes.at(0).Obstructions.at(1).Events, 15.0)) << changes;
    return index.Warnings;
  };
  const std::string good = "HIDE_OBST 1\n 2 15.0\n";
  EXPECT_THAT(warnings(good), testing::IsEmpty());
  const std::string text = OneMesh().Text("").Bytes();
  const auto line = std::to_string(std::count(text.begin(), text.end(), '\n') + 2);
  EXPECT_THAT(warnings("HIDE_OBST 1\n 9 1.0\n" + good),
    ElementsAre(testing::AllOf(HasSubstr("a.smv, line " + line + ": "),
      HasSubstr("names obstruction 9 of mesh 'room one', which has 2."))));
  EXPECT_THAT(warnings(good + "SHOW_OBST 1\n 0 1.0\nOPEN_VENT 1\n 2 1.0\nCLOSE_VENT 7\n 1 1.0\n"),
    ElementsAre(testing::AllOf(HasSubstr("obstruction 0"), HasSubstr("and 2 more"))));
  EXPECT_THAT(warnings("CLOSE_VENT 7\n 1 1.0\n" + good), ElementsAre(HasSubstr("mesh 7 of 1")));
  EXPECT_THAT(
    warnings("HIDE_OBST 1\n 99999999999 1.0\n" + good), ElementsAre(HasSubstr("which has 2")));
}

TEST(SmvFile, AnyCutOrFlippedByteIsReadOrRefused)
{
  test::Folder folder("fuzz");
  const std::string text =
    OneMesh().Slice(true, 1, {0, 4, 0, 3, 0, 2}, "a.sf", "SOOT DENSITY").Bytes();
  for (std::size_t i = 0; i < text.size(); i += 7)
  {
    IndexError(folder.Write("cut.smv", text.substr(0, i)));
    for (const char c : {'9', '-', '\n'})
    {
      std::string flipped = text;
      flipped[i] = c;
      IndexError(folder.Write("flipped.smv", flipped));
    }
  }
}

} // namespace smokevis
