// Where smoke shines by itself, and what share of the light that is.
#include "GlowingBodies.h"
#include "SceneLibrary.h"

#include <numbers>

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

void Ignite(SceneDescription& scene, int x, float luminance)
{
  scene.Grids[0].EmittedLuminance[x] = luminance;
}

TEST(GlowingBodies, NoneWhereNoSmokeEmits)
{
  EXPECT_TRUE(GlowingBodies(Scene(Duct()), 0).empty());
  SceneDescription scene = Duct();
  scene.Grids[0].EmittedLuminance.clear();
  EXPECT_TRUE(GlowingBodies(Scene(scene), 0).empty());
  // White smoke sends out nothing of its own.
  Ignite(scene = Duct(), 3, 1.0F);
  scene.Albedo = 1.0;
  EXPECT_TRUE(GlowingBodies(Scene(scene), 0).empty());
}

// Two cells that touch are one body, another far off is one by itself, and what glows faintly all
// over is none.
TEST(GlowingBodies, ByStrength)
{
  SceneDescription scene = Duct();
  scene.Grids[0].EmittedLuminance.assign(80, 0.1F);
  Ignite(scene, 2, 30.0F);
  Ignite(scene, 15, 40.0F);
  Ignite(scene, 16, 20.0F);
  const std::vector<GlowingBody> bodies = GlowingBodies(Scene(scene), 0);
  ASSERT_EQ(bodies.size(), 2U);
  const double all = 90.0 + 77 * 0.1;
  EXPECT_NEAR(bodies[0].Share, 60.0 / all, 1e-6);
  EXPECT_NEAR(bodies[1].Share, 30.0 / all, 1e-6);
  EXPECT_LT(glm::length(bodies[0].Bounds.Lower - Vec3(7.5, 0, 0)), 1e-9);
  EXPECT_LT(glm::length(bodies[0].Bounds.Upper - Vec3(8.5, 0.5, 0.5)), 1e-9);
  EXPECT_LT(glm::length(bodies[1].Bounds.Lower - Vec3(1.0, 0, 0)), 1e-9);
  EXPECT_LT(glm::length(bodies[1].Bounds.Upper - Vec3(1.5, 0.5, 0.5)), 1e-9);
}

// Cells at which a box around both is hardly larger than around each are one body.
TEST(GlowingBodies, CloseOnesAreOne)
{
  SceneDescription scene = Duct();
  Ignite(scene, 2, 1.0F);
  Ignite(scene, 4, 1.0F);
  Ignite(scene, 17, 1.0F);
  const std::vector<GlowingBody> bodies = GlowingBodies(Scene(scene), 0);
  ASSERT_EQ(bodies.size(), 3U);
  // The layer above closes the gap.
  Ignite(scene, 3 + 20, 1.0F);
  Ignite(scene, 2 + 20, 1.0F);
  Ignite(scene, 4 + 20, 1.0F);
  EXPECT_EQ(GlowingBodies(Scene(scene), 0).size(), 2U);
}

// A body in two meshes, and a lamp that sends out as much as it does.
TEST(GlowingBodies, AcrossMeshesBesideALamp)
{
  SceneDescription scene = Duct();
  scene.Grids = {scenes::UniformSmoke(Vec3(0.0), {5, 1, 1}, {10, 2, 2}, 1.0),
    scenes::UniformSmoke({5, 0, 0}, {10, 1, 1}, {10, 2, 2}, 1.0)};
  scene.Grids[0].EmittedLuminance.assign(40, 0.0F);
  scene.Grids[1].EmittedLuminance.assign(40, 0.0F);
  scene.Grids[0].EmittedLuminance[9] = 1.0F;
  scene.Grids[1].EmittedLuminance[0] = 1.0F;
  // 4 pi times what is absorbed of 1 cd/m2 in an eighth of a cubic metre, twice.
  const double power = 4.0 * std::numbers::pi * 0.5 * 0.125 * 2.0;
  scene.Emitters = {
    scenes::Plate({1, 0.5, 1}, {0, 0, -1}, {1, 0, 0}, 0.2, 0.2, power / 0.04 / std::numbers::pi)};
  const std::vector<GlowingBody> bodies = GlowingBodies(Scene(scene), 0);
  ASSERT_EQ(bodies.size(), 1U);
  EXPECT_NEAR(bodies[0].Share, 0.5, 1e-6);
  EXPECT_LT(glm::length(bodies[0].Bounds.Size() - Vec3(1.0, 0.5, 0.5)), 1e-9);
}

} // namespace
