// Where most light is sent on or out, and what share of it.
#include "BrightBodies.h"
#include "SceneLibrary.h"
#include "Solved.h"

#include <utility>

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
std::vector<BrightBody> BodiesOf(
  const SceneDescription& description, decltype(BrightBodies)* find = BrightBodies)
{
  const Solved solved(description, 0.5);
  const Scene& scene = *solved.TheScene;
  return find(scene, *solved.Field, 0, {scene.Lower(), scene.Upper()});
}

std::vector<BrightBody> GlowingBodiesOf(const SceneDescription& description)
{
  return BodiesOf(description, GlowingBodies);
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

// Of ten bodies the eight strongest; none of those that are as strong as one left out.
TEST(BrightBodies, NotTooMany)
{
  SceneDescription scene = Duct();
  for (int body = 0; body < 10; ++body)
  {
    Ignite(scene, 2 * body, body < 2 ? 0.9F : 1.0F);
  }
  EXPECT_EQ(BodiesOf(scene).size(), 8U);
  Ignite(scene, 4, 0.9F);
  EXPECT_EQ(BodiesOf(scene).size(), 7U);
}

// A chequerboard has more bodies than are worth a look, and all are alike.
TEST(BrightBodies, NoneOfMany)
{
  SceneDescription scene = Duct();
  scene.Grids = {scenes::UniformSmoke(Vec3(0.0), Vec3(1.0), {16, 16, 16}, 1.0)};
  for (int cell = 0; cell < 16 * 16 * 16; ++cell)
  {
    const bool odd = (cell + cell / 16 + cell / 256) % 2 == 1;
    scene.Grids[0].EmittedLuminance.push_back(odd ? 1.0F : 0.0F);
  }
  EXPECT_TRUE(BodiesOf(scene).empty());
}

// Two bodies of 2 x 1 x 1 m with a gap of 0.5 m fit into one box as well, with one of 1 m they do
// not: 22 m2 against twice 10, and 20 for 4.5 m.
TEST(BrightBodies, CloseOnesAreOne)
{
  for (const auto& [second, expected] : {std::pair(5, 1U), {6, 2U}})
  {
    SceneDescription scene = Duct();
    for (int layer = 0; layer < 4; ++layer)
    {
      for (int i = 0; i < 4; ++i)
      {
        Ignite(scene, 20 * layer + i, 1.0F);
        Ignite(scene, 20 * layer + second + i, 1.0F);
      }
    }
    const std::vector<BrightBody> bodies = BodiesOf(scene);
    ASSERT_EQ(bodies.size(), expected);
    EXPECT_NEAR(bodies[0].Share, 1.0 / expected, 1e-6);
  }
}

// Seven cells make just seven tenths of the light, in any unit.
TEST(BrightBodies, RoundingsDoNotDecide)
{
  for (const float unit : {0.1F, 0.3F, 1.0F, 30.0F, 3500.0F})
  {
    SceneDescription scene = Duct();
    for (int i = 0; i < 13; ++i)
    {
      Ignite(scene, i, i < 7 ? unit : 0.5F * unit);
    }
    const std::vector<BrightBody> bodies = BodiesOf(scene);
    ASSERT_EQ(bodies.size(), 1U);
    EXPECT_NEAR(bodies[0].Share, 0.7, 1e-6) << unit;
  }
}

// Of a flame in broad daylight not much is seen elsewhere.
TEST(BrightBodies, UnderTheSky)
{
  SceneDescription scene = Duct();
  Ignite(scene, 2, 1.0F);
  scene.Sky = 1000.0;
  const std::vector<BrightBody> bodies = BodiesOf(scene);
  ASSERT_EQ(bodies.size(), 1U);
  EXPECT_LT(bodies[0].Share, 1e-4);
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
  EXPECT_LT(glm::length(alone[0].Bounds.Lower), 1e-9);
  EXPECT_LE(alone[0].Bounds.Upper.x, 2.0);
  scenes::AddRoom(scene.Surfaces, Vec3(0.0), {10, 1, 1}, 0.5, 0.5);
  const std::vector<BrightBody> walled = BodiesOf(scene);
  ASSERT_EQ(walled.size(), 1U);
  EXPECT_LT(walled[0].Share, 0.7 * alone[0].Share);
}

// A lamp is brighter than the flame, of which one cell makes more than nine tenths.
TEST(BrightBodies, FlamesAlone)
{
  SceneDescription scene = Duct();
  EXPECT_TRUE(GlowingBodiesOf(scene).empty());
  scene.Emitters = {scenes::Plate({0.01, 0.5, 0.5}, {1, 0, 0}, {0, 1, 0}, 0.4, 0.4, 100.0)};
  EXPECT_TRUE(GlowingBodiesOf(scene).empty());
  Ignite(scene, 15, 30.0F);
  Ignite(scene, 17, 3.0F);
  const std::vector<BrightBody> bodies = GlowingBodiesOf(scene);
  ASSERT_EQ(bodies.size(), 1U);
  EXPECT_LT(glm::length(bodies[0].Bounds.Lower - Vec3(7.5, 0, 0)), 1e-9);
  EXPECT_LT(glm::length(bodies[0].Bounds.Upper - Vec3(8.0, 0.5, 0.5)), 1e-9);
  EXPECT_GT(bodies[0].Share, 0.0);
  EXPECT_LT(bodies[0].Share, 0.9);
}

} // namespace
