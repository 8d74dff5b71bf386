// Where most light is sent on or out, and what share of it.
#include "BrightBodies.h"
#include "SceneLibrary.h"
#include "Solved.h"

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

/// Smoke of 10 m x 1 m x 1 m in cells of 0.5 m.
SceneDescription Duct()
{
  SceneDescription scene;
  scene.Albedo = 0.5;
  scene.Grids = {scenes::UniformSmoke(Vec3(0.0), {10, 1, 1}, {20, 2, 2}, 1.0)};
  scene.Grids[0].EmittedLuminance.assign(80, 0.0F);
  return scene;
}

/// Of a scene whose direct light is solved.
std::vector<BrightBody> BodiesOf(const SceneDescription& description)
{
  const Solved solved(description, 0.5);
  return BrightBodies(*solved.TheScene, *solved.Field, 0);
}

void Ignite(SceneDescription& scene, int x, float luminance)
{
  scene.Grids[0].EmittedLuminance[x] = luminance;
}

TEST(BrightBodies, NoneInBlackSmoke)
{
  SceneDescription scene = Duct();
  scene.Albedo = 0.0;
  scene.Emitters = {scenes::Plate({0.01, 0.5, 0.5}, {1, 0, 0}, {0, 1, 0}, 0.4, 0.4, 100.0)};
  EXPECT_TRUE(BodiesOf(scene).empty());
}

// Two cells that touch are one body, another far off is one by itself, and what glows faintly all
// over is none.
TEST(BrightBodies, ByStrength)
{
  SceneDescription scene = Duct();
  scene.Grids[0].EmittedLuminance.assign(80, 0.1F);
  Ignite(scene, 2, 30.0F);
  Ignite(scene, 15, 40.0F);
  Ignite(scene, 16, 35.0F);
  const std::vector<BrightBody> bodies = BodiesOf(scene);
  ASSERT_EQ(bodies.size(), 2U);
  const double all = 105.0 + 77 * 0.1;
  EXPECT_NEAR(bodies[1].Share, 75.0 / all, 1e-6);
  EXPECT_NEAR(bodies[0].Share, 30.0 / all, 1e-6);
  EXPECT_LT(glm::length(bodies[1].Bounds.Lower - Vec3(7.5, 0, 0)), 1e-9);
  EXPECT_LT(glm::length(bodies[1].Bounds.Upper - Vec3(8.5, 0.5, 0.5)), 1e-9);
  EXPECT_LT(glm::length(bodies[0].Bounds.Lower - Vec3(1.0, 0, 0)), 1e-9);
  EXPECT_LT(glm::length(bodies[0].Bounds.Upper - Vec3(1.5, 0.5, 0.5)), 1e-9);
}

// Of ten bodies the eight strongest, but all where they are alike.
TEST(BrightBodies, NotTooMany)
{
  SceneDescription scene = Duct();
  for (int body = 0; body < 10; ++body)
  {
    Ignite(scene, 2 * body, body < 4 ? 0.9F : 1.0F);
  }
  // The first four are alike: seven tenths of the light come from some of them, too.
  EXPECT_EQ(BodiesOf(scene).size(), 10U);
  Ignite(scene, 0, 0.95F);
  Ignite(scene, 2, 0.95F);
  EXPECT_EQ(BodiesOf(scene).size(), 8U);
}

// Cells at which a box around both is hardly larger than around each are one body.
TEST(BrightBodies, CloseOnesAreOne)
{
  SceneDescription scene = Duct();
  Ignite(scene, 2, 1.0F);
  Ignite(scene, 4, 1.0F);
  Ignite(scene, 17, 1.0F);
  const std::vector<BrightBody> bodies = BodiesOf(scene);
  ASSERT_EQ(bodies.size(), 3U);
  // The layer above closes the gap.
  Ignite(scene, 3 + 20, 1.0F);
  Ignite(scene, 2 + 20, 1.0F);
  Ignite(scene, 4 + 20, 1.0F);
  EXPECT_EQ(BodiesOf(scene).size(), 2U);
}

// A body in two meshes.
TEST(BrightBodies, AcrossMeshes)
{
  SceneDescription scene = Duct();
  scene.Grids = {scenes::UniformSmoke(Vec3(0.0), {5, 1, 1}, {10, 2, 2}, 1.0),
    scenes::UniformSmoke({5, 0, 0}, {10, 1, 1}, {10, 2, 2}, 1.0)};
  scene.Grids[0].EmittedLuminance.assign(40, 0.0F);
  scene.Grids[1].EmittedLuminance.assign(40, 0.0F);
  scene.Grids[0].EmittedLuminance[9] = 1.0F;
  scene.Grids[1].EmittedLuminance[0] = 1.0F;
  const std::vector<BrightBody> bodies = BodiesOf(scene);
  ASSERT_EQ(bodies.size(), 1U);
  EXPECT_NEAR(bodies[0].Share, 1.0, 1e-6);
  EXPECT_LT(glm::length(bodies[0].Bounds.Size() - Vec3(1.0, 0.5, 0.5)), 1e-9);
}

// Before a lamp smoke scatters most of its light, and a wall that reflects has a share.
TEST(BrightBodies, BeforeALamp)
{
  SceneDescription scene = Duct();
  scene.Emitters = {scenes::Plate({0.01, 0.5, 0.5}, {1, 0, 0}, {0, 1, 0}, 0.4, 0.4, 100.0)};
  const std::vector<BrightBody> alone = BodiesOf(scene);
  ASSERT_EQ(alone.size(), 1U);
  EXPECT_GE(alone[0].Share, 0.7);
  EXPECT_LT(glm::length(alone[0].Bounds.Lower), 1e-9);
  EXPECT_LE(alone[0].Bounds.Upper.x, 2.0);
  scenes::AddRoom(scene.Surfaces, Vec3(0.0), {10, 1, 1}, 0.5, 0.5);
  const std::vector<BrightBody> walled = BodiesOf(scene);
  ASSERT_EQ(walled.size(), 1U);
  EXPECT_LT(walled[0].Share, 0.7 * alone[0].Share);
}

} // namespace
