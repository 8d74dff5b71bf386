// How many lines sweeps draw for what.
#include "LineChoice.h"
#include "LightField.h"
#include "Scene.h"
#include "SceneLibrary.h"

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

/// A room with black walls, and in it a grey lamp.
/// @param edge of the lamp [m]
SceneDescription RoomWithLamp(double extinction, double edge = 0.01)
{
  SceneDescription description;
  description.Albedo = 0.9;
  description.Grids = {scenes::UniformSmoke(Vec3(0.0), {4, 4, 3}, {8, 8, 6}, extinction)};
  scenes::AddRoom(description.Surfaces, Vec3(0.0), {4, 4, 3}, 1.0, 0.0);
  EmitterCell lamp;
  lamp.Vertices = {
    {2.0, 2.0, 1.5}, {2.0, 2.0 + edge, 1.5}, {2.0 + edge, 2.0 + edge, 1.5}, {2.0 + edge, 2.0, 1.5}};
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

/// Direct illuminance of the lamp at which it sends on a hundredth of all light in the smoky room
/// [lx].
/// @param edge of the lamp [m]
double ForAHundredth(double edge)
{
  return 43.2 / 99.0 / (0.5 * edge * edge);
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
  EXPECT_NEAR(
    static_cast<double>(LinesOf(smoky, ForAHundredth(0.01))), 1.2 * 0.5 * Flood, 0.05 * Flood);
  SceneDescription glowing = smoky;
  glowing.Grids[0].EmittedLuminance.assign(glowing.Grids[0].Extinction.size(), 1.0F);
  EXPECT_GT(LinesOf(glowing, 0.0), Flood);
  SceneDescription open = smoky;
  open.Surfaces = {};
  open.Sky = 1.0;
  EXPECT_GT(LinesOf(open, 0.0), Flood);
}

// A lamp of a square decimetre is to be met one and a half times by the lines through a room of
// 80 m2, and a fifth more lines join far places: in proportion to the light that it sends on.
TEST(LineChoice, FewerLinesInProportion)
{
  const SceneDescription smoky = RoomWithLamp(1.0, 0.1);
  const double all = 1.2 * 1.5 * 80.0 / (2.0 * 0.01);
  EXPECT_NEAR(static_cast<double>(LinesOf(smoky, 1e6)), all, 0.02 * all);
  EXPECT_NEAR(static_cast<double>(LinesOf(smoky, ForAHundredth(0.1))), 0.5 * all, 0.02 * all);
}

// Outside of the smoke there is nothing else that sends light on, and lines have nothing else to
// meet there.
TEST(LineChoice, NoFewerOutsideOfTheSmoke)
{
  constexpr std::size_t Most = 20000;
  SceneDescription description = RoomWithLamp(1.0);
  description.Grids = {scenes::UniformSmoke(Vec3(0.0), {1, 1, 1}, {2, 2, 2}, 1.0)};
  EXPECT_GT(LinesOf(description, 0.0), Most);
}

} // namespace
