// Which rooms count as closed, and what direct light is scaled by there.
#include "SceneLibrary.h"
#include "Solved.h"
#include "WorkCount.h"

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

/// A lamp in a black room of smoke that differs from cell to cell like noise.
SceneDescription NoisyRoom()
{
  SceneDescription scene;
  scene.Albedo = 0.5;
  const Vec3 upper(4, 3, 2.5);
  scene.Grids = {scenes::NoisySmoke(Vec3(0.0), upper, {16, 12, 10}, 0.1, 2.0, 3)};
  scenes::AddRoom(scene.Surfaces, Vec3(0.0), upper, 0.5, 0.0);
  scene.Emitters = {scenes::Plate({0.9, 1.1, 2.3}, {0, 0, -1}, {1, 0, 0}, 0.3, 0.3, 100.0)};
  return scene;
}

/// Lights, summed over the bands, that were scaled.
double Scaled(const Solved& solved)
{
  return WorkCount(solved.Field->Report, "lights held to their power");
}

TEST(DirectBalance, ClosedRoomInEachBand)
{
  SceneDescription scene = NoisyRoom();
  scene.Bands = 3;
  scene.ExtinctionScale = {1.0, 0.5, 2.0};
  const Solved solved(scene, 0.3);
  EXPECT_EQ(Scaled(solved), 3.0);
  const double flux = solved.TheScene->Lights().Flux(0);
  // Of the thousandth that quadratures are off by here, what light known from close by may have in
  // it is left, about an eighth.
  EXPECT_NEAR((solved.AbsorbedInSmoke().Mean + solved.AbsorbedOnSurfaces().Mean) / flux, 1.0, 2e-4);
  EXPECT_NEAR(solved.PowerBeforeBalance() / flux, 1.0, 0.01);
}

// What leaves through a hole below the lamp is not made up for.
TEST(DirectBalance, RoomWithAHole)
{
  SceneDescription scene = NoisyRoom();
  scene.Surfaces = {};
  scenes::AddRectangle(scene.Surfaces, Vec3(-9, -9, 3), {20, 0, 0}, {0, 20, 0}, 1, 1, 0.0);
  scenes::AddRectangle(scene.Surfaces, Vec3(1.0, -9, -1), {20, 0, 0}, {0, 20, 0}, 1, 1, 0.0);
  EXPECT_EQ(Scaled(Solved(scene, 0.3)), 0.0);
}

// Half of the lamp's light is taken up inside the block that it is sunk into.
TEST(DirectBalance, LampSunkIntoABlock)
{
  SceneDescription scene = NoisyRoom();
  scenes::AddBlock(scene.Surfaces, {0.9, 0.5, 2.0}, {1.5, 1.7, 2.4}, 0.5, 0.0);
  const Solved solved(scene, 0.3);
  EXPECT_NEAR(solved.PowerBeforeBalance() / solved.TheScene->Lights().Flux(0), 1.0, 0.02);
}

// Without any smoke surfaces take up all.
TEST(DirectBalance, ClearRoom)
{
  SceneDescription scene = NoisyRoom();
  scene.Grids.clear();
  const Solved solved(scene, 0.3);
  EXPECT_EQ(Scaled(solved), 1.0);
  EXPECT_NEAR(solved.AbsorbedOnSurfaces().Mean / solved.TheScene->Lights().Flux(0), 1.0, 1e-5);
}

} // namespace
