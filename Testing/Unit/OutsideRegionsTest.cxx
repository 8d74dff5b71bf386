// Where light goes that leaves all smoke.
#include "OutsideRegions.h"
#include "SceneLibrary.h"

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

/// A room of 2 m around its middle, as patches of half a metre.
SceneDescription Room(const Vec3& smokeLower, const Vec3& smokeUpper)
{
  SceneDescription description;
  description.Grids = {scenes::UniformSmoke(smokeLower, smokeUpper, {4, 4, 4}, 1.0)};
  scenes::AddRoom(description.Surfaces, Vec3(-1.0), Vec3(1.0), 0.5, 0.5);
  return description;
}

TEST(OutsideRegions, AroundSmokeAmidARoom)
{
  const Scene scene(Room(Vec3(-0.5), Vec3(0.5)));
  const OutsideRegions regions(scene);
  EXPECT_EQ(regions.Faces().size(), 6U * 16U);
  ASSERT_EQ(regions.Count(), 1U);
  EXPECT_EQ(regions.EscapingShare(0), 0.0);
  EXPECT_NEAR(regions.BoundingArea(0), 24.0 + 6.0, 1e-9);
  for (std::size_t patch = 0; patch < scene.Patches(); ++patch)
  {
    EXPECT_EQ(regions.OfSide(2 * patch), 0);
    EXPECT_EQ(regions.OfSide(2 * patch + 1), -1) << "no light is behind the walls";
  }
}

TEST(OutsideRegions, BelowAndAboveALayer)
{
  const Scene scene(Room(Vec3(-1.0, -1.0, -0.5), Vec3(1.0, 1.0, 0.5)));
  const OutsideRegions regions(scene);
  EXPECT_EQ(regions.Faces().size(), 2U * 16U);
  ASSERT_EQ(regions.Count(), 2U);
  for (std::size_t face = 0; face < regions.Faces().size(); ++face)
  {
    EXPECT_EQ(regions.OfFace(face),
      regions.OfFace(0) ^ (regions.Faces()[face].Side == regions.Faces()[0].Side ? 0 : 1));
  }
}

// A hole of 0.2 x 0.2 m in the middle of the wall between two rooms, smoke in one of them.
TEST(OutsideRegions, TwoRoomsAndAHole)
{
  constexpr double reach = 0.1;
  SceneDescription description = Room(Vec3(-0.5), Vec3(0.5));
  SurfaceMesh& mesh = description.Surfaces;
  scenes::AddRoom(mesh, Vec3(1.0, -1.0, -1.0), Vec3(3.0, 1.0, 1.0), 0.5, 0.5);
  std::erase_if(mesh.Triangles,
    [&](const auto& corners)
    {
      return mesh.Points[corners[0]].x + mesh.Points[corners[1]].x + mesh.Points[corners[2]].x ==
             3.0;
    });
  mesh.TriangleCell.resize(mesh.Triangles.size());
  const auto addWall = [&mesh](double y, double z, double width, double height)
  {
    const Vec3 along(0.0, width, 0.0);
    const Vec3 up(0.0, 0.0, height);
    scenes::AddRectangle(mesh, {1.0, y, z}, along, up, 4, 4, 0.5);
  };
  addWall(-1.0, -1.0, 2.0, 1.0 - reach);
  addWall(-1.0, reach, 2.0, 1.0 - reach);
  addWall(-1.0, -reach, 1.0 - reach, 2.0 * reach);
  addWall(reach, -reach, 1.0 - reach, 2.0 * reach);
  const Scene scene(std::move(description));
  const OutsideRegions regions(scene);
  ASSERT_EQ(regions.Count(), 2U);
  ASSERT_EQ(regions.Passages().size(), 1U);
  const double hole = 4.0 * reach * reach;
  EXPECT_NEAR(regions.Passages().begin()->second, hole, 0.25 * hole);
  for (std::size_t face = 0; face < regions.Faces().size(); ++face)
  {
    EXPECT_EQ(regions.OfFace(face), regions.OfFace(0));
  }
  const std::size_t other = 1 - static_cast<std::size_t>(regions.OfFace(0));
  EXPECT_NEAR(regions.BoundingArea(other), 24.0 - hole, 0.05);
}

// What light of even fluence escapes through the missing ceiling, 4 m2 of it, comes from all else.
TEST(OutsideRegions, RoomWithoutACeiling)
{
  SceneDescription description = Room(Vec3(-0.5), Vec3(0.5));
  SurfaceMesh& mesh = description.Surfaces;
  std::erase_if(mesh.Triangles,
    [&](const auto& corners)
    {
      return mesh.Points[corners[0]].z + mesh.Points[corners[1]].z + mesh.Points[corners[2]].z ==
             3.0;
    });
  mesh.TriangleCell.resize(mesh.Triangles.size());
  const Scene scene(std::move(description));
  const OutsideRegions regions(scene);
  ASSERT_EQ(regions.Count(), 1U);
  EXPECT_NEAR(regions.EscapingShare(0), 4.0 / (20.0 + 6.0), 0.015);
}

TEST(OutsideRegions, AroundSmokeInTheOpen)
{
  SceneDescription description;
  description.Grids = {scenes::UniformSmoke(Vec3(0.0), Vec3(1.0), {4, 4, 4}, 1.0)};
  const OutsideRegions regions{Scene(std::move(description))};
  EXPECT_GT(regions.Count(), 0U);
  for (std::size_t region = 0; region < regions.Count(); ++region)
  {
    EXPECT_EQ(regions.EscapingShare(region), 1.0);
  }
}

} // namespace
