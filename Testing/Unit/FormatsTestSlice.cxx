// Slice files: frames by seeking, byte order, ghost layers, and files cut short or damaged.
#include "ErrorText.h"
#include "FormatsTestRun.h"
#include "SliceFile.h"

#include <gmock/gmock.h>

#include <limits>
#include <numeric>

using testing::ElementsAre;
using testing::HasSubstr;

namespace smokevis
{

namespace
{

// Frame f of a range with n values holds 100 f, 100 f + 1, ...
std::string Frames(const std::vector<int>& range, int count, bool swapped = false)
{
  const int n = (range[1] - range[0] + 1) * (range[3] - range[2] + 1) * (range[5] - range[4] + 1);
  std::vector<std::pair<float, std::vector<float>>> frames;
  for (int f = 0; f < count; ++f)
  {
    std::vector<float> values(n);
    std::iota(values.begin(), values.end(), 100.0F * static_cast<float>(f));
    frames.emplace_back(1.5F * static_cast<float>(f) - 2.0F, std::move(values));
  }
  return test::SliceBytes("SOOT DENSITY", range, frames, swapped);
}

std::string SliceError(const std::string& path)
{
  return test::ErrorText(
    [&]
    {
      SliceFile slice(path, false);
      std::vector<float> values;
      slice.ReadFrame(slice.FrameTimes().size() - 1, values);
    });
}

constexpr int HeaderBytes = 3 * 38 + 32;

} // namespace

TEST(SliceFile, ReadsOneFrameOfEitherByteOrder)
{
  test::Folder folder("slice");
  for (const bool swapped : {false, true})
  {
    const std::string path = folder.Write("a.sf", Frames({2, 4, 0, 1, 3, 3}, 3, swapped));
    SliceFile slice(path, false);
    EXPECT_EQ(slice.Quantity().LongLabel, "SOOT DENSITY");
    EXPECT_EQ(slice.Quantity().Unit, "1/m");
    EXPECT_THAT(slice.Range(), ElementsAre(2, 4, 0, 1, 3, 3));
    EXPECT_THAT(slice.Dimensions(), ElementsAre(3, 2, 1));
    EXPECT_THAT(slice.FrameTimes(), ElementsAre(-2.0, -0.5, 1.0));
    EXPECT_EQ(slice.Damage(), "");
    std::vector<float> values;
    slice.ReadFrame(1, values);
    EXPECT_THAT(values, ElementsAre(100, 101, 102, 103, 104, 105));
  }
}

TEST(SliceFile, DropsTheGhostLayersOfCells)
{
  test::Folder folder("ghost");
  // 3 x 3 x 2 values are stored, i fastest; cells are the upper 2 x 2 x 1.
  SliceFile volume(folder.Write("a.sf", Frames({0, 2, 0, 2, 0, 1}, 1)), true);
  EXPECT_THAT(volume.Dimensions(), ElementsAre(2, 2, 1));
  std::vector<float> values;
  volume.ReadFrame(0, values);
  EXPECT_THAT(values, ElementsAre(13, 14, 16, 17));
  // In a plane only the in-plane axes have a ghost.
  SliceFile plane(folder.Write("b.sf", Frames({0, 2, 0, 1, 4, 4}, 1)), true);
  EXPECT_THAT(plane.Dimensions(), ElementsAre(2, 1, 1));
  plane.ReadFrame(0, values);
  EXPECT_THAT(values, ElementsAre(4, 5));
}

TEST(SliceFile, AFrameCutShortLeavesTheOthers)
{
  test::Folder folder("cut");
  const std::string whole = Frames({0, 1, 0, 1, 0, 1}, 2);
  const int frameBytes = (static_cast<int>(whole.size()) - HeaderBytes) / 2;
  SliceFile slice(folder.Write("a.sf", whole.substr(0, whole.size() - 1)), false);
  EXPECT_THAT(slice.FrameTimes(), ElementsAre(-2.0));
  EXPECT_EQ(slice.Damage(),
    "frame 2 at byte " + std::to_string(HeaderBytes + frameBytes) + " is cut short");
  std::vector<float> values;
  slice.ReadFrame(0, values);
  EXPECT_THAT(values, ElementsAre(0, 1, 2, 3, 4, 5, 6, 7));
}

TEST(SliceFile, NamesWhatIsWrong)
{
  test::Folder folder("wrong");
  const std::string whole = Frames({0, 1, 0, 1, 0, 1}, 2);
  EXPECT_THAT(SliceError(folder.Path("none.sf")), HasSubstr("cannot be opened"));
  EXPECT_THAT(SliceError(folder.Write("a.sf", "")), HasSubstr("is empty"));
  EXPECT_THAT(
    SliceError(folder.Write("a.sf", "not a slice file at all")), HasSubstr("first record"));
  EXPECT_THAT(SliceError(folder.Write("a.sf", whole.substr(0, 60))), HasSubstr("byte 38"));
  EXPECT_THAT(
    SliceError(folder.Write("a.sf", whole.substr(0, HeaderBytes))), HasSubstr("no whole frame"));

  std::string marker = whole;
  marker[HeaderBytes] = 5;
  EXPECT_THAT(
    SliceError(folder.Write("a.sf", marker)), HasSubstr("frame 1 at byte 146 is damaged"));
  // Ranges that would make billions of values must not be believed.
  const auto ranged = [](const std::vector<int>& range)
  { return test::Records().AddLabel("A").AddLabel("B").AddLabel("C").Add(range).Bytes(); };
  constexpr int most = std::numeric_limits<int>::max();
  EXPECT_THAT(
    SliceError(folder.Write("a.sf", ranged({0, most, 0, most, 0, most}))), HasSubstr("too large"));
  EXPECT_THAT(SliceError(folder.Write("a.sf", ranged({0, 100000000, 0, 0, 0, 0}))),
    HasSubstr("no whole frame"));
  EXPECT_THAT(SliceError(folder.Write("a.sf", ranged({4, 3, 0, 1, 0, 1}))), HasSubstr("reversed"));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(
    SliceError(folder.Write("a.sf", test::SliceBytes("A", {0, 0, 0, 0, 0, 0}, {{nan, {1}}}))),
    HasSubstr("time of frame 1"));
}

TEST(SliceFile, AnyCutOrFlippedByteIsReadOrRefused)
{
  test::Folder folder("fuzz");
  const std::string whole = Frames({0, 1, 0, 1, 0, 1}, 2);
  for (std::size_t i = 0; i < whole.size(); i += 3)
  {
    SliceError(folder.Write("a.sf", whole.substr(0, i)));
    for (const char c : {'\xff', '\x7f', '\0'})
    {
      std::string flipped = whole;
      flipped[i] = c;
      SliceError(folder.Write("a.sf", flipped));
    }
  }
}

} // namespace smokevis
