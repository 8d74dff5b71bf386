// Which parts of a patch light can reach.
#include "Scene.h"
#include "SceneLibrary.h"

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

constexpr double FloorEdge = 2.0;
const Vec3 BoxLower(-0.5, -0.5, 0.0);
const Vec3 BoxUpper(0.5, 0.5, 1.0);

/// Adds a square around the box as one patch, its front upwards or downwards.
void AddFloor(SurfaceMesh& mesh, bool upwards = true)
{
  const Vec3 along(FloorEdge, 0.0, 0.0);
  const Vec3 across(0.0, FloorEdge, 0.0);
  scenes::AddRectangle(
    mesh, -0.5 * (along + across), upwards ? along : across, upwards ? across : along, 1, 1, 0.5);
}

/// Looks at the upper side of the floor, which is the patch given.
void ExpectOfFloor(
  const SurfaceMesh& mesh, std::size_t floor, double exposed, double enclosed, int side = 0)
{
  SceneDescription description;
  description.Surfaces = mesh;
  const Scene scene(std::move(description));
  EXPECT_NEAR(scene.ExposedArea(floor, side), exposed, 0.01 * FloorEdge * FloorEdge);
  EXPECT_NEAR(scene.EnclosedArea(floor, side), enclosed, 0.01 * FloorEdge * FloorEdge);
}

// Whichever of the floor and the bottom of the box that lies in it comes first in the model, and
// whichever way the floor's front is: under the box it is dark.
TEST(Exposure, OfAFloorThatABoxStandsOn)
{
  for (const bool upwards : {false, true})
  {
    SurfaceMesh floorFirst;
    AddFloor(floorFirst, upwards);
    scenes::AddBlock(floorFirst, BoxLower, BoxUpper, 0.3, 0.5);
    ExpectOfFloor(floorFirst, 0, 3.0, 1.0, upwards ? 0 : 1);
    SurfaceMesh boxFirst;
    scenes::AddBlock(boxFirst, BoxLower, BoxUpper, 0.3, 0.5);
    const std::size_t floor = boxFirst.CellReflectance.size();
    AddFloor(boxFirst, upwards);
    ExpectOfFloor(boxFirst, floor, 3.0, 1.0, upwards ? 0 : 1);
  }
}

TEST(Exposure, OfAFloorInTheCornerOfARoom)
{
  SurfaceMesh mesh;
  AddFloor(mesh);
  scenes::AddRoom(mesh, Vec3(-1.0, -1.0, 0.0), Vec3(1.0, 1.0, 2.0), FloorEdge, 0.5);
  scenes::AddBlock(mesh, Vec3(0.0), Vec3(1.0, 1.0, 2.0), 0.3, 0.5);
  ExpectOfFloor(mesh, 0, 3.0, 1.0);
}

// Within a box in the edge of a floor and a wall, both of which come first in the model, a line
// from one to the other meets the box's own backs.
TEST(Exposure, LinesWithinABoxMeetItsBacks)
{
  SceneDescription description;
  SurfaceMesh& mesh = description.Surfaces;
  scenes::AddRoom(mesh, Vec3(-1.0, -1.0, 0.0), Vec3(1.0, 1.0, 2.0), FloorEdge, 0.5);
  const std::size_t room = mesh.CellReflectance.size();
  scenes::AddBlock(mesh, Vec3(0.0, -0.5, 0.0), Vec3(1.0, 0.5, 1.0), 0.3, 0.5);
  const Scene scene(std::move(description));
  std::vector<Crossing> crossings;
  const Vec3 direction = glm::normalize(Vec3(1.0, 0.1, 1.0));
  scene.Shapes().Cross(Vec3(0.5, 0.03, 0.0) - 0.1 * direction, direction, 0.0, 3.0, crossings);
  ASSERT_EQ(crossings.size(), 2U);
  EXPECT_GE(scene.Patch(crossings[0].Leave), room);
  EXPECT_EQ(crossings[0].Leave.Side, 1);
  EXPECT_GE(scene.Patch(crossings[1].Arrive), room);
  EXPECT_EQ(crossings[1].Arrive.Side, 1);
}

// A solid does not stand on itself: what a plate touches of it from outside is free within.
TEST(Exposure, OfASolidsInside)
{
  SceneDescription description;
  scenes::AddBlock(description.Surfaces, BoxLower, BoxUpper, 1.0, 0.5);
  description.Emitters =
    scenes::Barcode({-0.5, 0.0, 0.5}, {-1, 0, 0}, {0, 0, 1}, 0.6, 0.3, 5, 100.0, 0);
  const Scene scene(std::move(description));
  double outside = 0.0;
  for (std::size_t face = 0; face < scene.SurfacePatches(); ++face)
  {
    EXPECT_NEAR(scene.ExposedArea(face, 1), 1.0, 0.01);
    EXPECT_EQ(scene.EnclosedArea(face, 1), 0.0);
    outside += scene.ExposedArea(face, 0);
  }
  // Less what the plate covers.
  EXPECT_NEAR(outside, 6.0 - 0.18, 0.01);
}

// A box without its bottom leaves the floor's own part, dark as it is.
TEST(Exposure, OfAFloorUnderAHood)
{
  SurfaceMesh mesh;
  AddFloor(mesh);
  scenes::AddBlock(mesh, BoxLower, BoxUpper, 0.3, 0.5);
  std::erase_if(mesh.Triangles,
    [&](const auto& corners)
    {
      return mesh.Points[corners[0]].z + mesh.Points[corners[1]].z + mesh.Points[corners[2]].z ==
               0.0 &&
             corners[0] >= 4;
    });
  mesh.TriangleCell.resize(mesh.Triangles.size());
  ExpectOfFloor(mesh, 0, 4.0, 0.0);
}

// A wall of two sheets is no solid, nor is one within a room whose fronts look outwards.
TEST(Exposure, OfSheetsThatLieInOneAnother)
{
  for (const bool within : {false, true})
  {
    SurfaceMesh mesh;
    AddFloor(mesh);
    scenes::AddRectangle(mesh, BoxLower, Vec3(0.0, 1.0, 0.0), Vec3(1.0, 0.0, 0.0), 1, 1, 0.5);
    if (within)
    {
      scenes::AddBlock(mesh, Vec3(-3.0), Vec3(3.0), 1.0, 0.5);
    }
    ExpectOfFloor(mesh, 0, 4.0, 0.0);
  }
}

} // namespace
