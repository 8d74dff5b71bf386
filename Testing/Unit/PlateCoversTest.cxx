// Plates in the plane of a wall: what they hide of it, and whose the light there is.
#include "PlateCovers.h"
#include "Scene.h"
#include "SceneLibrary.h"
#include "Solved.h"

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

constexpr double WallEdge = 2.0;

/// A black wall in the plane z = 0 in so many patches along an edge, a lamp before it that shines
/// on it, and a dark plate in its plane, askew, across the patches' borders.
/// @param up 1: the plate's front is to the lamp; -1: to the other side; 0: there is none
SceneDescription LampBeforeAWall(int patches, double up)
{
  SceneDescription scene;
  scenes::AddRectangle(
    scene.Surfaces, Vec3(0.0), {WallEdge, 0, 0}, {0, WallEdge, 0}, patches, patches, 0.0);
  scene.Emitters = {scenes::Plate({0.7, 0.9, 0.2}, {0, 0, -1}, {1, 0, 0}, 0.1, 0.1, 100.0)};
  if (up != 0.0)
  {
    scene.Emitters.push_back(
      scenes::Plate({0.8, 1.0, 0.0}, {0, 0, up}, glm::normalize(Vec3(3, 1, 0)), 0.6, 0.5, 0.0));
  }
  return scene;
}

double CoveredArea(const Scene& scene, int side)
{
  const PlateCovers covers(scene.Shapes(), scene.EmitterMesh());
  double area = 0.0;
  scene.ForEachTriangle(
    [&](std::size_t patch, const Triangle& corners)
    {
      if (patch < scene.SurfacePatches())
      {
        const auto parts = covers.On(corners);
        for (const Triangle& part : parts[side])
        {
          area += AreaOf(part);
        }
      }
    });
  return area;
}

/// Light from the lamp on the side of the wall, and of the plate, that it shines on [lm].
double PowerOnWall(const Solved& solved)
{
  const Scene& scene = *solved.TheScene;
  double power = 0.0;
  for (std::size_t patch = 0; patch < scene.Patches(); ++patch)
  {
    for (int side = 0; side < 2; ++side)
    {
      const bool lit = patch < scene.SurfacePatches() || side == 0;
      power += lit ? scene.ExposedArea(patch, side) *
                       solved.Field->DirectIlluminance[solved.Field->PatchIndex(0, patch, side)]
                   : 0.0;
    }
  }
  return power;
}

TEST(PlateCovers, TheSideBeforeTheFront)
{
  for (const double up : {1.0, -1.0})
  {
    const Scene scene(LampBeforeAWall(5, up));
    EXPECT_NEAR(CoveredArea(scene, up > 0.0 ? 0 : 1), 0.3, 1e-12);
    EXPECT_EQ(CoveredArea(scene, up > 0.0 ? 1 : 0), 0.0);
  }
  EXPECT_EQ(CoveredArea(Scene(LampBeforeAWall(5, 0.0)), 0), 0.0);
}

// A wall and a plate on it take up what the bare wall does: exposed areas are known to a hundredth.
TEST(PlateCovers, LightCountsOnce)
{
  for (const int patches : {1, 5})
  {
    const double bare = PowerOnWall(Solved(LampBeforeAWall(patches, 0.0)));
    EXPECT_NEAR(PowerOnWall(Solved(LampBeforeAWall(patches, 1.0))) / bare, 1.0, 0.005) << patches;
  }
}

} // namespace
