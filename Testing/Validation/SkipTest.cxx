// What is left out must not be missed, not even where a scene is made to trip it up; and each skip
// says how often it was used.
#include "Sampler.h"
#include "ScatterBound.h"
#include "SceneLibrary.h"
#include "Solved.h"
#include "TestReport.h"
#include "WorkCount.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <tuple>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

struct Outcome
{
  std::shared_ptr<const Scene> TheScene;
  std::shared_ptr<const LightField> Field;
  double Seconds;

  double Count(const std::string& what) const { return WorkCount(this->Field->Report, what); }
};

Outcome Solve(const SceneDescription& description, bool skips, double tolerance = 0.1)
{
  Outcome run;
  run.TheScene = std::make_shared<const Scene>(description);
  LightFieldOptions options;
  options.Tolerance = tolerance;
  options.Skips = skips;
  Progress progress;
  const auto start = std::chrono::steady_clock::now();
  run.Field = std::make_shared<const LightField>(SolveLightField(*run.TheScene, options, progress));
  run.Seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return run;
}

/// Largest change of the direct fluence of smoky cells, over what is there.
double LargestChange(const Outcome& skipping, const Outcome& all)
{
  double worst = 0.0;
  for (std::size_t i = 0; i < all.Field->Cells; ++i)
  {
    const double value = all.Field->DirectFluence[i];
    if (value > 0.0 && all.TheScene->Smoke().Extinction(static_cast<std::int64_t>(i)) > 0.0F)
    {
      worst = std::max(worst, std::abs(skipping.Field->DirectFluence[i] - value) / value);
    }
  }
  return worst;
}

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

/// What is not direct of the fluence, in the cell where it comes nearest to its bound, as a share
/// of that; the noise is left out.
double LargestShareOfBound(const Outcome& all)
{
  const auto bound = ScatterBound::Of(*all.TheScene, 0);
  EXPECT_TRUE(bound.has_value());
  double largest = 0.0;
  for (std::size_t cell = 0; cell < all.Field->Cells && bound; ++cell)
  {
    const Lanes& lanes = all.Field->MultipleFluence[cell];
    largest = std::max(largest,
      (Mean(lanes) - 4.0 * StandardError(lanes)) / bound->Fluence(static_cast<std::int64_t>(cell)));
  }
  return largest;
}

/// Largest share, over lines of sight from anywhere to anywhere, of the light that is not direct in
/// the light that is, or in a tenth of its mean where there is less.
double LargestLater(const Outcome& all)
{
  const Scene& scene = *all.TheScene;
  const View view(all.TheScene, all.Field);
  const EvenPoints points(3);
  std::vector<double> direct;
  std::vector<double> later;
  double mean = 0.0;
  constexpr int Lines = 200;
  for (int line = 0; line < Lines; ++line)
  {
    const auto at = points.Point(line);
    const Vec3 eye = scene.Lower() + Vec3(at[0], at[1], at[2]) * (scene.Upper() - scene.Lower());
    const double angle = 6.2831853 * at[3];
    const Vec3 direction =
      glm::normalize(Vec3(std::cos(angle), std::sin(angle), 0.7 * std::sin(5.0 * angle)));
    const double end = view.FirstHit(eye, direction).Distance;
    const RayLight light = view.TraceVeil(eye, direction, 0.0, end, 0);
    direct.push_back(light.VeilDirect);
    later.push_back(Mean(light.VeilMultiple));
    mean += light.VeilDirect / Lines;
  }
  double largest = 0.0;
  for (std::size_t line = 0; line < direct.size(); ++line)
  {
    largest = std::max(largest, later[line] / std::max(direct[line], 0.1 * mean));
  }
  return largest;
}

// Multiple scattering is left out in thin smoke between black walls, and only there: whenever it
// is, what it would have added lies below the tolerance, and it never exceeds its bound.
TEST(Skip, MultipleScatteringOverOpticalDepth)
{
  report::Head(
    "Corridor of 60 m with black walls: light scattered more than once over direct light");
  int skipped = 0;
  int computed = 0;
  for (const double extinction : {1e-5, 1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 0.1, 1.0})
  {
    SceneDescription scene = scenes::Corridor(extinction);
    const Outcome skipping = Solve(scene, true);
    const Outcome all = Solve(scene, false);
    const double later = LargestLater(all);
    const bool left = skipping.Count("multiple scattering skipped") > 0.0;
    std::printf("| extinction %-8g | adds at most %.5f | of the bound %.3f | %s |\n", extinction,
      later, LargestShareOfBound(all), left ? "left out" : "computed");
    EXPECT_EQ(all.Count("multiple scattering skipped"), 0.0);
    EXPECT_LT(LargestShareOfBound(all), 1.0) << extinction;
    (left ? skipped : computed) += 1;
    if (left)
    {
      EXPECT_LT(later, 0.1) << extinction;
      EXPECT_EQ(Mean(skipping.Field->MultipleFluence[1000]), 0.0);
    }
  }
  EXPECT_GT(skipped, 1);
  EXPECT_GT(computed, 2);
}

// Thin smoke in which all is well lit, but for what only comes by a detour: round a wall from a
// lamp much stronger than the others, from a far one, by a slot, or from a surface.
TEST(Skip, MultipleScatteringByDetours)
{
  constexpr double extinction = 1e-4;
  const auto expectComputed = [](const char* name, const SceneDescription& scene)
  {
    const Outcome run = Solve(scene, true);
    EXPECT_EQ(run.Count("multiple scattering skipped"), 0.0) << name;
    EXPECT_LT(LargestShareOfBound(run), 1.0) << name;
  };
  const SceneDescription plain = scenes::Corridor(extinction);
  EXPECT_GT(Solve(plain, true).Count("multiple scattering skipped"), 0.0);

  SceneDescription behind = plain;
  behind.Emitters[3].Luminance.fill(1e10);
  scenes::AddBlock(behind.Surfaces, {11.5, 0.5, 0.0}, {12.0, 3.5, 4.0}, 1.0, 0.0);
  expectComputed("a strong lamp behind a block", behind);

  SceneDescription far = plain;
  far.Emitters.back().Luminance.fill(1e11);
  scenes::AddBlock(far.Surfaces, {50.0, 0.0, 0.0}, {50.5, 4.0, 3.8}, 1.0, 0.0);
  expectComputed("a strong lamp far off behind a wall that leaves a gap", far);

  SceneDescription slot = plain;
  for (std::size_t cell = 0; cell < slot.Grids[0].Extinction.size(); ++cell)
  {
    const std::size_t x = cell % 120;
    slot.Grids[0].Extinction[cell] = x >= 50 && x < 60 && cell / 120 % 8 != 4 ? 20.0F : 1e-4F;
  }
  expectComputed("a slot in thick smoke", slot);

  SceneDescription reflected = plain;
  reflected.Surfaces = {};
  scenes::AddRoom(reflected.Surfaces, Vec3(0.0), {60, 4, 4}, 2.0, 0.1);
  expectComputed("walls that reflect a little", reflected);

  SceneDescription mirror = plain;
  scenes::AddRectangle(mirror.Surfaces, {1, 1, 0.1}, {1, 0, 0}, {0, 1, 0}, 1, 1, 0.5);
  expectComputed("a plate that reflects", mirror);
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

// Black smoke between black walls scatters nothing; smoke that scatters next to nothing, with all
// of it followed, comes to the same.
TEST(Skip, NoScattering)
{
  SceneDescription scene = scenes::Corridor(0.25);
  scene.Albedo = 0.0;
  const Outcome black = Solve(scene, true);
  EXPECT_GT(black.Count("multiple scattering skipped"), 0.0);
  scene.Albedo = 1e-9;
  const Outcome followed = Solve(scene, false);
  EXPECT_EQ(followed.Count("multiple scattering skipped"), 0.0);
  EXPECT_LT(LargestChange(black, followed), 0.004);
  for (std::size_t cell = 0; cell < black.Field->Cells; ++cell)
  {
    EXPECT_EQ(Mean(black.Field->MultipleFluence[cell]), 0.0F);
    EXPECT_LT(Mean(followed.Field->MultipleFluence[cell]), 1e-6);
  }
}

} // namespace
