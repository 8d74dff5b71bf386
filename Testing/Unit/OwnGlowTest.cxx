// What smoke that glows brings to its own light.
#include "OwnGlow.h"
#include "Scene.h"

#include <numbers>
#include <utility>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

constexpr float Luminance = 5.0F;

/// A glowing cell of a metre, and a dark one.
Scene TwoCells(float extinction, double albedo)
{
  SceneDescription description;
  description.Albedo = albedo;
  SmokeGrid grid;
  grid.Nodes = {{{0.0, 1.0, 2.0}, {0.0, 1.0}, {0.0, 1.0}}};
  grid.Extinction = {extinction, extinction};
  grid.EmittedLuminance = {Luminance, 0.0F};
  description.Grids = {grid};
  return Scene(std::move(description));
}

double ShareOfGlow(float extinction, double albedo)
{
  const Scene scene = TwoCells(extinction, albedo);
  return OwnGlow(scene, 0).Fluence(0) / (4.0 * std::numbers::pi * Luminance);
}

// In the depth of smoke all light is its own, however often it is scattered.
TEST(OwnGlow, IsAllLightOfOpaqueSmoke)
{
  EXPECT_NEAR(ShareOfGlow(1e6F, 0.0), 1.0, 1e-5);
  EXPECT_NEAR(ShareOfGlow(1e6F, 0.99), 1.0, 1e-3);
}

// In thin smoke light leaves the cell first: of what is emitted along a mean chord of 2/3 m, no
// more than that share is met there again.
TEST(OwnGlow, IsNextToNothingInThinSmoke)
{
  EXPECT_LT(ShareOfGlow(0.03F, 0.0), 0.02 * 0.02);
  EXPECT_EQ(ShareOfGlow(1.0F, 1.0), 0.0);
}

TEST(OwnGlow, LeavesTheRestToVary)
{
  const Scene scene = TwoCells(3.0F, 0.5);
  const OwnGlow glow(scene, 0);
  const double own = glow.Fluence(0);
  EXPECT_NEAR(glow.VaryingShare(0, 4.0 * own), 0.75, 1e-12);
  EXPECT_EQ(glow.VaryingShare(0, 0.5 * own), 0.0);
  EXPECT_EQ(glow.VaryingShare(1, 1.0), 1.0);
}

} // namespace
