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
