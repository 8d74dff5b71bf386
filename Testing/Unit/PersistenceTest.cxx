// How long light lasts in parts of a scene, against closed forms.
#include "Persistence.h"
#include "Box.h"
#include "GlobalLines.h"
#include "Scene.h"
#include "SceneLibrary.h"

#include <vector>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

/// A room of 2 x 1 x 1 m with walls of one reflectance, in even smoke.
SceneDescription Room(double reflectance, double extinction, double albedo)
{
  SceneDescription description;
  description.Albedo = albedo;
  description.Grids = {scenes::UniformSmoke(Vec3(0.0), Vec3(2, 1, 1), {4, 2, 2}, extinction)};
  scenes::AddRoom(description.Surfaces, Vec3(0.0), Vec3(2, 1, 1), 0.5, reflectance);
  return description;
}

/// @param lines a draw
/// @param lit patches before this one, or all
double Longest(const SceneDescription& description, std::size_t lines, std::size_t lit)
{
  const Scene scene(description);
  std::vector<bool> sides(2 * scene.Patches(), false);
  for (std::size_t side = 0; side < sides.size(); ++side)
  {
    sides[side] = side / 2 < lit;
  }
  // Lines begin outside of the walls.
  const Box outer{scene.Lower() - 0.01, scene.Upper() + 0.01};
  return LongestPersistence(scene, GlobalLines(outer, lines), 0, sides);
}

constexpr std::size_t All = 1000000;

// From wall to wall without smoke: what they reflect, however few lines are drawn at once.
TEST(Persistence, ClosedRoom)
{
  for (const double reflectance : {0.0, 0.5, 0.999})
  {
    for (const std::size_t lines : {100, 10000})
    {
      EXPECT_NEAR(Longest(Room(reflectance, 0.0, 0.5), lines, All), reflectance, 1e-9);
    }
  }
}

// Thin smoke takes up what it absorbs along the mean chord, four volumes over the surface; what it
// scatters is still there.
TEST(Persistence, AbsorbingSmoke)
{
  const double chord = 4.0 * 2.0 / 10.0;
  // To the square of the optical depth, and what the lines' lengths differ by.
  EXPECT_NEAR(Longest(Room(0.9, 0.02, 0.0), 2000, All), 0.9 * (1.0 - 0.02 * chord), 0.0005);
  EXPECT_NEAR(Longest(Room(0.9, 0.1, 0.8), 2000, All), 0.9 * (1.0 - 0.02 * chord), 0.0005);
  EXPECT_NEAR(Longest(Room(0.9, 10.0, 1.0), 2000, All), 0.9, 1e-9);
}

// A white box in a dark room, lit and not.
TEST(Persistence, WhiteBoxInADarkRoom)
{
  SceneDescription description = Room(0.1, 0.0, 0.5);
  const std::size_t room = Scene(description).Patches();
  scenes::AddBlock(description.Surfaces, {0.4, 0.3, 0.3}, {0.9, 0.8, 0.8}, 0.5, 0.95);
  EXPECT_NEAR(Longest(description, 1000, All), 0.95, 0.01);
  EXPECT_LT(Longest(description, 1000, room), 0.11);
}

// Half of what a plate sends upwards leaves a scene at once that has no other surface: all of it.
TEST(Persistence, OpenScene)
{
  SceneDescription description = Room(0.9, 0.0, 0.5);
  description.Surfaces = SurfaceMesh();
  scenes::AddRectangle(description.Surfaces, Vec3(0.0), {2, 0, 0}, {0, 1, 0}, 4, 2, 0.9);
  EXPECT_EQ(Longest(description, 1000, All), 0.0);
}

} // namespace
