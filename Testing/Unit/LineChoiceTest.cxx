// How many lines sweeps draw for what.
#include "LineChoice.h"
#include "LightField.h"
#include "Scene.h"
#include "SceneLibrary.h"

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

/// A room with black walls, and in it a grey lamp of a square centimetre.
SceneDescription RoomWithLamp(double extinction)
{
  SceneDescription description;
  description.Albedo = 0.9;
  description.Grids = {scenes::UniformSmoke(Vec3(0.0), {4, 4, 3}, {8, 8, 6}, extinction)};
  scenes::AddRoom(description.Surfaces, Vec3(0.0), {4, 4, 3}, 1.0, 0.0);
  EmitterCell lamp;
  lamp.Vertices = {{2.0, 2.0, 1.5}, {2.0, 2.01, 1.5}, {2.01, 2.01, 1.5}, {2.01, 2.0, 1.5}};
  lamp.Luminance = {1.0, 1.0, 1.0};
  lamp.Reflectance = {0.5, 0.5, 0.5};
  description.Emitters = {lamp};
  return description;
}

/// @param onLamp direct illuminance of the lamp [lx], while direct light brings 1 lx to the smoke,
/// of which it scatters 43 lm
std::size_t LinesOf(const SceneDescription& description, double onLamp)
{
  const Scene scene(description);
  LightField field;
  field.Cells = scene.Smoke().Cells();
  field.Patches = scene.Patches();
  field.DirectFluence.assign(field.Cells, 1.0F);
  field.DirectIlluminance.assign(2 * field.Patches, 0.0F);
  field.DirectIlluminance[field.PatchIndex(0, scene.SurfacePatches(), 0)] =
    static_cast<float>(onLamp);
  return ChooseLines(scene, field, 0, 0.03).Count();
}

// A flood of lines would be needed to meet the lamp; it is drawn where the lamp matters: where
// nothing else sends light on, where most light comes to it, and where nobody knows yet where light
// comes to, under a sky and in smoke that glows.
TEST(LineChoice, SmallPatchesThatMatter)
{
  constexpr std::size_t Flood = 20000;
  constexpr std::size_t Few = 2000;
  const SceneDescription smoky = RoomWithLamp(1.0);
  EXPECT_LT(LinesOf(smoky, 0.0), Few);
  EXPECT_LT(LinesOf(smoky, 1.0), Few);
  EXPECT_GT(LinesOf(smoky, 1e7), Flood);
  EXPECT_GT(LinesOf(RoomWithLamp(0.0), 1.0), Flood);
  // One that sends a hundredth of all light gets half of them.
  const double hundredth = 43.2 / 99.0 / (0.5 * 1e-4);
  EXPECT_NEAR(static_cast<double>(LinesOf(smoky, hundredth)), 1.2 * 0.5 * Flood, 0.05 * Flood);
  SceneDescription glowing = smoky;
  glowing.Grids[0].EmittedLuminance.assign(glowing.Grids[0].Extinction.size(), 1.0F);
  EXPECT_GT(LinesOf(glowing, 0.0), Flood);
  SceneDescription open = smoky;
  open.Surfaces = {};
  open.Sky = 1.0;
  EXPECT_GT(LinesOf(open, 0.0), Flood);
}

} // namespace
