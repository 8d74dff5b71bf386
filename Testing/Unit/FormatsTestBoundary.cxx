// Boundary files: patches, frames, and what is refused.
#include "BoundaryFile.h"
#include "ErrorText.h"
#include "FormatsTestRun.h"

#include <gmock/gmock.h>

#include <limits>

using testing::ElementsAre;
using testing::HasSubstr;

namespace smokevis
{

namespace
{

// A mesh of 2 x 1 x 1 cells.
SmvMesh Mesh()
{
  SmvMesh mesh;
  mesh.Name = "m";
  mesh.Nodes = {{{0.0, 1.0, 2.0}, {0.0, 1.0}, {0.0, 1.0}}};
  return mesh;
}

// The floor, and a side of the second obstruction; two frames.
std::string Sample(
  bool swapped = false, const std::vector<int>& first = {0, 2, 0, 1, 0, 0, 3, 0, 1})
{
  test::Records records(swapped);
  records.AddLabel("WALL TEMPERATURE").AddLabel("temp").AddLabel("C").Add(std::vector<int>{2});
  records.Add(first).Add(std::vector<int>{1, 1, 0, 1, 0, 1, -1, 2, 1});
  for (const float time : {-2.0F, 8.0F})
  {
    records.Add(std::vector<float>{time}).Add(std::vector<float>{1, 2, 3, 4, 5, 6});
    records.Add(std::vector<float>{7, 8, 9, time});
  }
  return records.Bytes();
}

std::string BoundaryError(const std::string& path)
{
  return test::ErrorText([&] { BoundaryFile(path, Mesh()); });
}

} // namespace

TEST(BoundaryFile, ReadsPatchesInEitherByteOrder)
{
  const test::Folder folder("boundary");
  for (const bool swapped : {false, true})
  {
    BoundaryFile file(folder.Write("a.bf", Sample(swapped)), Mesh());
    EXPECT_THAT(file.FrameTimes(), ElementsAre(-2.0, 8.0));
    EXPECT_EQ(file.Damage(), "");
    ASSERT_EQ(file.Patches().size(), 2U);
    EXPECT_EQ(file.Patches()[0].Axis, 2);
    EXPECT_EQ(file.Patches()[0].Obstruction, -1);
    EXPECT_EQ(file.Patches()[1].Axis, 0);
    EXPECT_EQ(file.Patches()[1].Obstruction, 1);
    std::vector<float> values;
    file.ReadFrame(1, values);
    EXPECT_THAT(values, ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9, 8));
  }
}

TEST(BoundaryFile, AnyCutLeavesTheFramesBeforeOrIsRefused)
{
  const test::Folder folder("boundary-cut");
  const std::string whole = Sample();
  const std::size_t frame = 12 + 32 + 24;
  for (std::size_t size = 0; size < whole.size(); ++size)
  {
    const std::string path = folder.Write("a.bf", whole.substr(0, size));
    if (size < whole.size() - frame)
    {
      EXPECT_THAT(BoundaryError(path), HasSubstr(path)) << size;
      continue;
    }
    BoundaryFile file(path, Mesh());
    EXPECT_EQ(file.FrameTimes().size(), 1U);
    EXPECT_EQ(file.Damage().empty(), size == whole.size() - frame);
  }
}

TEST(BoundaryFile, RefusesWhatCannotBe)
{
  const test::Folder folder("boundary-bad");
  const auto with = [&](const std::vector<int>& patch)
  { return BoundaryError(folder.Write("a.bf", Sample(false, patch))); };
  // Beyond the mesh, not flat, along no axis, backwards.
  for (const std::vector<int>& patch :
    std::vector<std::vector<int>>{{0, 3, 0, 1, 0, 0, 3, 0, 1}, {0, 2, 0, 1, 0, 1, 3, 0, 1},
      {0, 2, 0, 1, 0, 0, 0, 0, 1}, {0, 2, 0, 1, 0, 0, 4, 0, 1}, {2, 0, 0, 1, 0, 0, 3, 0, 1},
      {-1, 2, 0, 1, 0, 0, 3, 0, 1}, {0, 2, 0, 1, 0, 0, std::numeric_limits<int>::min(), 0, 1}})
  {
    EXPECT_THAT(with(patch), HasSubstr("patch 1 of the boundary file is no rectangle"));
  }
  std::string many = Sample();
  const std::size_t count = 3 * 38 + 4;
  many.replace(count, 4, "\xff\xff\xff\x7f");
  EXPECT_THAT(BoundaryError(folder.Write("a.bf", many)), HasSubstr("claims 2147483647 patches"));
  EXPECT_THAT(BoundaryError(folder.Path("none.bf")), HasSubstr("cannot be opened"));
}

TEST(BoundaryFile, ReadsTheRoom)
{
  const SmvFile index(SMOKEVIS_DATA_DIR "/Room/fds/room.smv");
  ASSERT_EQ(index.Boundaries.size(), 2U);
  EXPECT_EQ(index.Boundaries[0].Quantity.LongLabel, "WALL TEMPERATURE");
  EXPECT_FALSE(index.Boundaries[0].CellCentred);
  const std::array<std::size_t, 2> patches{19, 16};
  for (std::size_t i = 0; i < 2; ++i)
  {
    const SmvBoundary& boundary = index.Boundaries[i];
    BoundaryFile file(index.Resolve(boundary.File), index.Meshes[boundary.Mesh]);
    EXPECT_EQ(file.Patches().size(), patches[i]);
    EXPECT_EQ(file.Damage(), "");
    EXPECT_EQ(file.FrameTimes().front(), -2.0);
    std::vector<float> values;
    file.ReadFrame(0, values);
    // The walls begin at the ambient temperature.
    EXPECT_THAT(values, testing::Each(testing::FloatNear(20.0F, 1e-3F)));
  }
}

} // namespace smokevis
