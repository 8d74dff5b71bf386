// What is left out must not be missed, not even where a scene is made to trip it up; and each skip
// says how often it was used.
#include "Sampler.h"
#include "SceneLibrary.h"
#include "SkipOutcome.h"
#include "TestReport.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

// Ways that are told are right to an optical depth of 0.004; that lamps far off are left out adds
// nothing that shows.
TEST(Skip, LampsFarOff)
{
  const SceneDescription scene = scenes::Corridor(1.0);
  const Outcome skipping = Solve(scene, true);
  const Outcome all = Solve(scene, false);
  report::Head("Corridor with 15 lamps: with all left out that may be, and with nothing left out");
  report::Absolute("largest change of fluence", 0.0, LargestChange(skipping, all), 0.005);
  std::printf("%.2f s instead of %.2f s; %.0f cells' lamps left out, %.0f ways told\n",
    skipping.Seconds, all.Seconds, skipping.Count("direct light of cells not computed"),
    skipping.Count("not walked"));
  EXPECT_GT(skipping.Count("direct light of cells not computed"), 10000.0);
  EXPECT_GT(skipping.Count("not walked"), 1000.0);
  EXPECT_EQ(all.Count("direct light of cells not computed"), 0.0);
  EXPECT_EQ(all.Count("not walked"), 0.0);
  // A cell that lies behind a plate is not lit by it, whatever is left out.
  const double unseen = skipping.Count("direct light of cells not looked for");
  EXPECT_GT(unseen, 1000.0);
  EXPECT_GE(unseen, all.Count("direct light of cells not looked for"));
}

// Where smoke changes from layer to layer, ways from around a block of cells, which say how light
// changes inside it, are told as those from its cells are.
TEST(Skip, WaysInLayers)
{
  SceneDescription scene = scenes::Corridor(1.0);
  std::vector<float>& extinction = scene.Grids.front().Extinction;
  const std::size_t layer = extinction.size() / 8;
  for (std::size_t cell = 0; cell < extinction.size(); ++cell)
  {
    extinction[cell] *= 0.5F + static_cast<float>(cell / layer) / 7.0F;
  }
  const Outcome skipping = Solve(scene, true);
  const Outcome all = Solve(scene, false);
  report::Head("Corridor with 15 lamps and layers of smoke: with ways told, and with all walked");
  report::Absolute("largest change of fluence", 0.0, LargestChange(skipping, all), 0.005);
  EXPECT_GT(skipping.Count("between cells and lights not walked"), 10000.0);
  EXPECT_GT(skipping.Count("around blocks of cells not walked"), 1000.0);
  EXPECT_EQ(all.Count("not walked"), 0.0);
}

// A lamp a hundred million times as strong at the far end outshines the near ones even through
// twenty optical depths, and must not be left out.
TEST(Skip, StrongLampFarOff)
{
  SceneDescription scene = scenes::Corridor(0.4);
  for (double& value : scene.Emitters.back().Luminance)
  {
    value *= 1e8;
  }
  const Outcome skipping = Solve(scene, true);
  const Outcome all = Solve(scene, false);
  report::Head("Corridor with one very strong lamp");
  report::Absolute("largest change of fluence", 0.0, LargestChange(skipping, all), 0.005);
}

/// The corridor with a wall of smoke, five metres thick, that lets light pass by a slot alone, one
/// cell wide; all lamps but the first four are taken away.
SceneDescription Slot()
{
  SceneDescription scene = scenes::Corridor(0.05);
  SmokeGrid& grid = scene.Grids[0];
  for (int z = 0; z < 8; ++z)
  {
    for (int y = 0; y < 8; ++y)
    {
      for (int x = 50; x < 60; ++x)
      {
        grid.Extinction[x + 120 * (y + 8 * z)] = y == 4 ? 0.0F : 20.0F;
      }
    }
  }
  scene.Emitters.erase(scene.Emitters.begin() + 4, scene.Emitters.end());
  return scene;
}

// Light of the lamps beyond reaches few cells of each block, and those by the slot alone.
TEST(Skip, ThinClearGap)
{
  const SceneDescription scene = Slot();
  const Outcome skipping = Solve(scene, true);
  const Outcome all = Solve(scene, false);
  report::Head("Corridor with a slot in a wall of smoke");
  report::Absolute("largest change of fluence", 0.0, LargestChange(skipping, all), 0.01);
}

// On the far side of the wall a lamp of its own outshines what comes through the smoke, but not
// what comes through the slot.
TEST(Skip, ThinClearGapBesideALamp)
{
  SceneDescription scene = Slot();
  scene.Emitters.push_back(scenes::Corridor(0.05).Emitters.back());
  const Outcome skipping = Solve(scene, true);
  const Outcome all = Solve(scene, false);
  report::Head("The same with another lamp on the far side");
  report::Absolute("largest change of fluence", 0.0, LargestChange(skipping, all), 0.01);
}

// FDS meshes often reach beyond the walls. Cells there see no lamp; those inside, though they share
// blocks with them, need not walk their ways each by itself, and their light is the same.
TEST(Skip, WaysInBlocksThatReachBehindWalls)
{
  SceneDescription scene = scenes::Corridor(1.0, 1);
  SmokeGrid& grid = scene.Grids[0];
  // One layer of cells below the floor, three above the ceiling, behind the lamp.
  const std::array<int, 3> cells = {124, 12, 12};
  grid = scenes::UniformSmoke({-1.0, -1.0, -0.5}, {61.0, 5.0, 5.5}, cells, 0.0);
  double inside = 0.0;
  for (int z = 1; z < 9; ++z)
  {
    for (int y = 2; y < 10; ++y)
    {
      for (int x = 2; x < 122; ++x)
      {
        grid.Extinction[x + cells[0] * (y + cells[1] * z)] = 0.2F + 0.02F * static_cast<float>(z);
        inside += 1.0;
      }
    }
  }
  const Outcome skipping = Solve(scene, true);
  const Outcome all = Solve(scene, false);
  report::Head("Corridor of layered smoke in a mesh that reaches beyond its walls");
  report::Absolute("largest change of fluence", 0.0, LargestChange(skipping, all), 0.005);
  std::printf("%.0f of %.0f cells' ways told\n", skipping.Count("not walked"), inside);
  // Blocks of four cells an edge that lie wholly inside hold a quarter of the cells.
  EXPECT_GT(skipping.Count("not walked"), 0.3 * inside);
}

// A curtain of smoke leaves one layer of cells clear; which of a block's eight it is must not
// matter.
TEST(Skip, AnyClearLayer)
{
  report::Head("Light of a lamp through one clear layer of a curtain, with ways told and without");
  const Vec3 upper(12.0, 2.4, 2.4);
  for (int layer = 8; layer < 16; ++layer)
  {
    SceneDescription scene;
    scene.Albedo = 0.0;
    scene.Grids = {scenes::UniformSmoke(Vec3(0.0), upper, {120, 24, 24}, 0.05)};
    std::vector<float>& extinction = scene.Grids[0].Extinction;
    for (int z = 0; z < 24; ++z)
    {
      for (int y = 0; y < 24; ++y)
      {
        for (int x = 80; x < 90; ++x)
        {
          extinction[x + 120 * (y + 24 * z)] = z == layer ? 0.0F : 2.0F;
        }
      }
    }
    scenes::AddRoom(scene.Surfaces, Vec3(0.0), upper, 2.0, 0.0);
    scene.Emitters = {
      scenes::Plate({0.1, 1.2, 0.1 * layer + 0.05}, {1, 0, 0}, {0, 0, 1}, 0.1, 0.1, 1e5)};
    report::Absolute("layer " + std::to_string(layer), 0.0,
      LargestChange(Solve(scene, true), Solve(scene, false)), 0.005);
  }
}

// Light grazes a layer of dense smoke: of each cell only the skin is lit, far more than ways from
// the centres of cells tell. What a lamp above sends through the layer is not all there is.
TEST(Skip, LightThatGrazesALayer)
{
  report::Head("Light of a lamp that grazes a layer, with ways told and without");
  const Vec3 upper(12.0, 2.4, 2.4);
  constexpr std::size_t Floor = 120 * 24;
  for (const double thickness : {4.0, 15.0, 60.0})
  {
    SceneDescription scene;
    scene.Albedo = 0.0;
    scene.Grids = {scenes::UniformSmoke(Vec3(0.0), upper, {120, 24, 24}, 0.0)};
    std::fill_n(
      scene.Grids[0].Extinction.begin() + 12 * Floor, 4 * Floor, static_cast<float>(thickness));
    scenes::AddRoom(scene.Surfaces, Vec3(0.0), upper, 2.0, 0.0);
    scene.Emitters = {
      scenes::Plate({0.01, 1.2, 1.1}, {1, 0, 0}, {0, 0, 1}, 0.1, 0.1, 100.0),
      scenes::Plate({8.0, 1.2, 2.39}, {0, 0, -1}, {1, 0, 0}, 0.1, 0.1, 1.0),
    };
    report::Absolute("layer of " + std::to_string(thickness).substr(0, 2) + " /m", 0.0,
      LargestChange(Solve(scene, true), Solve(scene, false)), 0.01);
  }
}

// A duct of one cell by one cell runs clear through the smoke, whichever cells of a block it takes:
// they see a lamp before it through next to no smoke.
TEST(Skip, ADuctOfOneCell)
{
  report::Head("Light of a lamp through a duct of one cell by one, with ways told and without");
  const Vec3 upper(12.0, 2.4, 2.4);
  // So far from the lamp that ways to cells two and more beside the duct do not pass through it.
  constexpr int DuctBegin = 30;
  for (const auto& [row, layer, thickness] : {std::tuple{9, 14, 2.0}, {10, 8, 2.0}, {10, 8, 0.9},
         {10, 8, 0.5}, {9, 9, 0.5}, {13, 11, 2.0}, {15, 15, 2.0}})
  {
    SceneDescription scene;
    scene.Albedo = 0.0;
    scene.Grids = {scenes::UniformSmoke(Vec3(0.0), upper, {120, 24, 24}, thickness)};
    for (int x = DuctBegin; x < 120; ++x)
    {
      scene.Grids[0].Extinction[x + 120 * (row + 24 * layer)] = 0.0F;
    }
    scenes::AddRoom(scene.Surfaces, Vec3(0.0), upper, 2.0, 0.0);
    scene.Emitters = {scenes::Plate({0.01, 0.1 * row + 0.05, 0.1 * layer + 0.05}, {1, 0, 0},
                        {0, 0, 1}, 0.08, 0.08, 1e5),
      scenes::Plate({11.99, 1.2, 1.2}, {-1, 0, 0}, {0, 0, 1}, 0.5, 0.5, 100.0)};
    const Outcome skipping = Solve(scene, true);
    const Outcome all = Solve(scene, false);
    double worst = 0.0;
    for (int x = DuctBegin; x < 120; ++x)
    {
      const std::size_t cell = x + 120 * (row + 24 * layer);
      worst = std::max(worst,
        std::abs(skipping.Field->DirectFluence[cell] / all.Field->DirectFluence[cell] - 1.0));
    }
    EXPECT_GT(skipping.Count("not walked"), 1000.0);
    report::Absolute("row " + std::to_string(row) + ", layer " + std::to_string(layer) +
                       ", smoke of " + std::to_string(thickness).substr(0, 3) + " /m",
      0.0, worst, 0.005);
  }
}

// Rays that leap over clear air meet the same smoke at the same distances: the light field and what
// is seen in it are the same to the bit. A layer under the ceiling, a wall that cuts cells, and a
// clear passage through the smoke.
TEST(Skip, ClearAir)
{
  SceneDescription description;
  description.Albedo = 0.5;
  const Vec3 upper(20, 4, 4);
  description.Grids = {scenes::UniformSmoke(Vec3(0.0), upper, {100, 20, 20}, 1.0)};
  for (std::size_t cell = 0; cell < description.Grids[0].Extinction.size(); ++cell)
  {
    const std::size_t x = cell % 100;
    const std::size_t z = cell / 2000;
    if (z < 11 || (x >= 40 && x < 80))
    {
      description.Grids[0].Extinction[cell] = 0.0F;
    }
  }
  scenes::AddRoom(description.Surfaces, Vec3(0.0), upper, 2.0, 0.3);
  scenes::AddRectangle(description.Surfaces, {6, 0, 0}, {1.1, 4, 0}, {0, 0, 4}, 2, 2, 0.3);
  for (const double x : {3.0, 15.0})
  {
    description.Emitters.push_back(
      scenes::Plate({x, 2, 3.99}, {0, 0, -1}, {1, 0, 0}, 0.3, 0.3, 1000.0, 0.1));
  }
  description.Grids[0].EmittedLuminance.assign(description.Grids[0].Extinction.size(), 0.0F);
  description.Grids[0].EmittedLuminance[95 + 100 * (10 + 20 * 15)] = 50.0F;
  std::array<Outcome, 2> runs;
  for (const bool leaps : {true, false})
  {
    description.LeapsClearAir = leaps;
    runs[leaps ? 0 : 1] = Solve(description, true);
  }
  const auto& [leaping, stepping] = runs;
  EXPECT_GT(leaping.TheScene->Smoke().Parts().Added(), 0);
  EXPECT_EQ(leaping.Count("clear smoke cells"), 100 * 20 * 11 + 40 * 20 * 9);
  EXPECT_EQ(stepping.Count("clear smoke cells"), 0.0);
  EXPECT_EQ(leaping.Field->DirectFluence, stepping.Field->DirectFluence);
  EXPECT_EQ(leaping.Field->DirectIlluminance, stepping.Field->DirectIlluminance);
  for (std::size_t cell = 0; cell < leaping.Field->Cells; ++cell)
  {
    for (int batch = 0; batch < Batches; ++batch)
    {
      ASSERT_EQ(
        leaping.Field->MultipleFluence[cell][batch], stepping.Field->MultipleFluence[cell][batch]);
    }
  }
  const View leapt(leaping.TheScene, leaping.Field);
  const View stepped(stepping.TheScene, stepping.Field);
  for (int ray = 0; ray < 300; ++ray)
  {
    const EvenPoints points(7);
    const auto at = points.Point(ray);
    const Vec3 eye = upper * Vec3(at[0], at[1], at[2]);
    const double angle = 6.2831853 * at[3];
    const Vec3 direction =
      glm::normalize(Vec3(std::cos(angle), std::sin(angle), std::sin(7.0 * angle)));
    const Hit hit = leapt.FirstHit(eye, direction);
    const RayLight one = leapt.Trace(eye, direction, hit, 0);
    const RayLight other = stepped.Trace(eye, direction, hit, 0);
    EXPECT_EQ(one.OpticalDepth, other.OpticalDepth);
    EXPECT_EQ(one.Surface, other.Surface);
    EXPECT_EQ(one.Veil(), other.Veil());
  }
}

// Two equal bands are one; the second has other random numbers where it is solved for itself.
TEST(Skip, EqualBands)
{
  SceneDescription scene = scenes::Corridor(0.5);
  scene.Emitters.resize(2);
  scene.Bands = 3;
  for (EmitterCell& cell : scene.Emitters)
  {
    cell.Luminance = {1000.0, 1000.0, 500.0};
  }
  const Outcome skipping = Solve(scene, true, 0.01);
  const Outcome all = Solve(scene, false, 0.01);
  EXPECT_EQ(skipping.Count("band 1 skipped"), 1.0);
  EXPECT_EQ(all.Count("band 1 skipped"), 0.0);
  // Each has noise of its own.
  const auto sum = [](const LightField& field)
  {
    Lanes lanes{};
    for (std::size_t cell = 0; cell < field.Cells; ++cell)
    {
      Add(lanes, field.MultipleFluence[field.CellIndex(1, cell)], 1.0F);
    }
    return lanes;
  };
  const Lanes one = sum(*all.Field);
  const Lanes other = sum(*skipping.Field);
  report::Head("A band solved for itself against the equal one that stands for it");
  report::Relative("sum of multiply scattered fluence", Mean(one), Mean(other), 0.005,
    std::hypot(StandardError(one), StandardError(other)));
}

// Bands that differ in one place alone are none for each other: a patch far from all light that
// sends back a little more of one, a lamp a million times weaker than the others, and smoke that
// dims one by a millionth more.
TEST(Skip, BandsThatDifferInOnePlace)
{
  SceneDescription grey = scenes::Corridor(0.3, 2, 0.5, 0.5);
  grey.Bands = 3;
  // A plate that only reflects, right beside a lamp that shines past it.
  EmitterCell plate = grey.Emitters.back();
  for (Vec3& vertex : plate.Vertices)
  {
    vertex += Vec3(0.0, 0.35, 0.0);
  }
  plate.Luminance.fill(0.0);
  plate.Reflectance.fill(0.8);
  plate.SignId = 0;
  grey.Emitters.push_back(plate);
  const Outcome equal = Solve(grey, true);
  EXPECT_EQ(equal.Count("band 1 skipped"), 1.0);
  const std::size_t patch0 = equal.TheScene->SurfacePatches() + grey.Emitters.size() - 1;
  EXPECT_NE(equal.Field->GradientOn(0, patch0), Vec3(0.0));
  EXPECT_EQ(equal.Field->GradientOn(1, patch0), equal.Field->GradientOn(0, patch0));
  SceneDescription patch = grey;
  patch.Surfaces.CellReflectance.back()[1] += 1e-6;
  SceneDescription lamp = grey;
  lamp.Emitters.push_back(scenes::Plate({59.0, 2.0, 3.99}, {0, 0, -1}, {1, 0, 0}, 0.1, 0.1, 1e-3));
  lamp.Emitters.back().Luminance[1] = 0.9e-3;
  SceneDescription smoke = grey;
  smoke.ExtinctionScale[1] = 1.000001;
  for (const SceneDescription* const scene : {&patch, &lamp, &smoke})
  {
    const Outcome skipping = Solve(*scene, true);
    EXPECT_EQ(skipping.Count("band 1 skipped"), 0.0);
    EXPECT_EQ(skipping.Count("band 2 skipped"), 1.0);
    // Band 1 has noise of its own.
    const std::size_t cell = skipping.Field->CellIndex(1, 0);
    EXPECT_NE(skipping.Field->MultipleFluence[cell][0], skipping.Field->MultipleFluence[0][0]);
  }
}

} // namespace
