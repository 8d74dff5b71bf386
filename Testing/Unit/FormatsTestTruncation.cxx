// Real files cut short at every byte: what is read must be frames of the whole file, and what is
// wrong must be told with file, byte and quantity.
#include "Errors.h"
#include "FormatsTestRun.h"
#include "Plot3DSeries.h"
#include "SliceFile.h"
#include "Smoke3DFile.h"
#include "SmvFile.h"

#include <gmock/gmock.h>

#include <functional>

using testing::AllOf;
using testing::HasSubstr;

namespace smokevis
{

namespace
{

const std::string RoomFolder = std::string(SMOKEVIS_DATA_DIR) + "/Room/fds/";

std::string BytesOf(const std::string& path)
{
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return bytes.str();
}

using Open = std::function<std::unique_ptr<FrameFile>(const std::string& path)>;

// Cuts a file of frames at every step-th byte, in a copy of the same name.
void CutAnywhere(const std::string& name, std::size_t step, const Open& open)
{
  test::Folder folder("cut");
  const std::string bytes = BytesOf(RoomFolder + name);
  ASSERT_FALSE(bytes.empty());
  const std::string copy = folder.Write(name, bytes);
  if (std::filesystem::exists(RoomFolder + name + ".sz"))
  {
    folder.Write(name + ".sz", BytesOf(RoomFolder + name + ".sz"));
  }
  std::vector<std::vector<float>> frames;
  const std::unique_ptr<FrameFile> whole = open(copy);
  for (std::size_t i = 0; i < whole->FrameTimes().size(); ++i)
  {
    whole->ReadFrame(i, frames.emplace_back());
  }
  EXPECT_EQ(whole->Damage(), "");
  std::size_t last = 0;
  std::vector<float> values;
  for (std::size_t size = 0; size < bytes.size(); size += step)
  {
    folder.Write(name, bytes.substr(0, size));
    try
    {
      const std::unique_ptr<FrameFile> cut = open(copy);
      const std::size_t count = cut->FrameTimes().size();
      ASSERT_GE(count, last) << size;
      if (count < frames.size() && count == last && size % 64 != 0)
      {
        continue; // the frames were compared before
      }
      last = count;
      for (std::size_t i = 0; i < count; ++i)
      {
        cut->ReadFrame(i, values);
        ASSERT_EQ(values, frames[i]) << size;
      }
      // A cut between two frames is what a run that still goes leaves.
      if (!cut->Damage().empty())
      {
        ASSERT_THAT(cut->Damage(),
          AllOf(HasSubstr("frame " + std::to_string(count + 1)), HasSubstr("at byte")));
      }
    }
    catch (const Error& error)
    {
      ASSERT_EQ(last, 0U) << size;
      ASSERT_THAT(
        error.what(), AllOf(HasSubstr(copy), HasSubstr("byte"), HasSubstr("TEST QUANTITY")))
        << size;
    }
  }
  EXPECT_EQ(last, frames.size() - 1);
}

} // namespace

TEST(Truncation, OfASlice)
{
  for (const char* name : {"room_2_7.sf", "room_2_8.sf"})
  {
    CutAnywhere(name, 1,
      [](const std::string& path)
      { return std::make_unique<SliceFile>(path, path.ends_with("8.sf"), "TEST QUANTITY"); });
  }
}

TEST(Truncation, OfSmoke)
{
  CutAnywhere("room_2_1.s3d", 1,
    [](const std::string& path)
    {
      return std::make_unique<Smoke3DFile>(
        path, std::array<int, 3>{17, 13, 13}, 0.15, "TEST QUANTITY");
    });
  CutAnywhere("room_2_2.s3d", 1,
    [](const std::string& path)
    {
      return std::make_unique<Smoke3DFile>(
        path, std::array<int, 3>{17, 13, 13}, std::array<double, 2>{0.0, 1200.0}, "TEST QUANTITY");
    });
}

TEST(Truncation, OfPlot3D)
{
  // One frame a file: all of it or an error.
  test::Folder folder("cutq");
  const std::string bytes = BytesOf(RoomFolder + "room_2_28p01.q");
  const auto read = [&](const std::string& part)
  {
    Plot3DSeries series({{0.0, folder.Write("a.q", part)}}, 3, {17, 13, 13}, "TEST QUANTITY");
    std::vector<float> values;
    series.ReadFrame(0, values);
    return values;
  };
  EXPECT_EQ(read(bytes).size(), 17U * 13U * 13U);
  for (std::size_t size = 0; size < bytes.size(); ++size)
  {
    try
    {
      read(bytes.substr(0, size));
      FAIL() << size;
    }
    catch (const Error& error)
    {
      ASSERT_THAT(error.what(), AllOf(HasSubstr("a.q, byte "), HasSubstr("TEST QUANTITY"))) << size;
    }
  }
}

TEST(Truncation, OfTheGreatestDensities)
{
  test::Folder folder("cutsz");
  const std::string smoke = folder.Write("a.s3d", BytesOf(RoomFolder + "room_2_1.s3d"));
  folder.Write("a.s3dd", BytesOf(RoomFolder + "room_2_1.s3dd"));
  const std::string text = BytesOf(RoomFolder + "room_2_1.s3d.sz");
  for (std::size_t size = 0; size < text.size(); ++size)
  {
    folder.Write("a.s3d.sz", text.substr(0, size));
    try
    {
      Smoke3DFile file(smoke, {17, 13, 13}, 0.15, "TEST QUANTITY");
      std::vector<float> values;
      file.ReadFrame(file.FrameTimes().size() - 1, values);
      ASSERT_TRUE(
        file.FrameTimes().size() == 4 || file.Damage().find("a.s3d.sz") != std::string::npos);
    }
    catch (const Error& error)
    {
      ASSERT_THAT(error.what(), HasSubstr("a.s3d")) << size;
    }
  }
}

TEST(Truncation, OfTheIndex)
{
  test::Folder folder("cutsmv");
  const std::string text = BytesOf(RoomFolder + "room.smv");
  const SmvFile whole(folder.Write("whole.smv", text));
  std::size_t slices = 0;
  // The part before the first slice is refused, what follows is kept.
  for (std::size_t size = 0; size < text.size(); ++size)
  {
    const std::string path = folder.Write("cut.smv", text.substr(0, size));
    try
    {
      const SmvFile cut(path);
      ASSERT_GE(cut.Slices.size(), slices) << size;
      slices = cut.Slices.size();
      for (std::size_t i = 0; i + 1 < slices; ++i)
      {
        ASSERT_EQ(cut.Slices[i].File, whole.Slices[i].File) << size;
        ASSERT_EQ(cut.Slices[i].Range, whole.Slices[i].Range) << size;
      }
    }
    catch (const Error& error)
    {
      ASSERT_EQ(slices, 0U) << size << error.what();
      ASSERT_THAT(error.what(), HasSubstr("cut.smv")) << size;
    }
  }
}

TEST(Truncation, FortyBytesCannotClaimABillionCells)
{
  test::Folder folder("claims");
  // A slice's header is longer; its range claims 1000 x 1000 x 1000 nodes.
  const std::string slice = test::Records()
                              .AddLabel("A")
                              .AddLabel("B")
                              .AddLabel("C")
                              .Add(std::vector<int>{0, 999, 0, 999, 0, 999})
                              .Bytes();
  EXPECT_THROW(SliceFile(folder.Write("a.sf", slice), false), Error);
  const std::string smoke =
    test::Records().Add(std::vector<int>{1, 0, 0, 999, 0, 999, 0, 999}).Bytes();
  ASSERT_EQ(smoke.size(), 40U);
  EXPECT_THROW(Smoke3DFile(folder.Write("a.s3d", smoke), {1000, 1000, 1000}, 0.1), Error);
  // With a frame that says so, too: its 12 bytes cannot unpack to that many.
  const std::string frame = test::Records()
                              .Add(std::vector<int>{1, 0, 0, 999, 0, 999, 0, 999})
                              .Add(std::vector<float>{0.0F})
                              .Add(std::vector<int>{1000000000, 12})
                              .Add(std::vector<unsigned char>(12, 7))
                              .Bytes();
  Smoke3DFile claims(folder.Write("a.s3d", frame), {1000, 1000, 1000}, 0.1);
  std::vector<float> values;
  EXPECT_THROW(claims.ReadFrame(0, values), Error);
  EXPECT_EQ(values.capacity(), 0U);
  const std::string plot = test::Records().Add(std::vector<int>{1000, 1000, 1000}).Bytes();
  Plot3DSeries series({{0.0, folder.Write("a.q", plot)}}, 0, {1000, 1000, 1000});
  EXPECT_THROW(series.ReadFrame(0, values), Error);
  EXPECT_EQ(values.capacity(), 0U);
  EXPECT_THROW(SmvFile(folder.Write("a.smv", "GRID m\n 1000 1000 1000\nTRNX\n 0\n 0 0.\n")), Error);
}

} // namespace smokevis
