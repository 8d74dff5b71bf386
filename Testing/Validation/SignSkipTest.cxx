// Views of signs that are left out: nothing of them is seen, or they lie below a cut-off.
#include "Contrast.h"
#include "FloorMap.h"
#include "SceneLibrary.h"
#include "Solved.h"
#include "WorkCount.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

/// Places in a corridor, 5 m apart along it and three beside each other.
FloorMapOptions PlacesFrom(double x, int placesAlong)
{
  FloorMapOptions options;
  options.FirstPlace = {x, 1.0, 1.7};
  options.StepX = 5.0;
  options.StepY = 1.0;
  options.PlacesX = placesAlong;
  options.PlacesY = 3;
  return options;
}

// A sign that only reflects, and another in full light that is lost behind smoke: places of a map
// keep their value where signs are left out that lie below a cut-off, but for those that do so.
TEST(SignSkip, SignsBelowTheCutOff)
{
  SceneDescription scene = scenes::Corridor(0.25);
  scene.Emitters.resize(4);
  const auto add = [&scene](const Vec3& centre, double luminance, double reflectance, int id)
  {
    auto cells =
      scenes::Barcode(centre, {1, 0, 0}, {0, 0, 1}, 0.6, 0.3, 5, luminance, id, reflectance);
    if (luminance == 0.0)
    {
      for (std::size_t cell = 0; cell < cells.size(); cell += 2)
      {
        cells[cell].Reflectance.fill(0.05);
      }
    }
    scene.Emitters.insert(scene.Emitters.end(), cells.begin(), cells.end());
  };
  add({0.01, 1.5, 2.0}, 0.0, 0.8, 0);
  add({0.01, 2.8, 2.0}, 50.0, 0.1, 1);
  const Solved solved(scene, 0.1);
  FloorMapOptions options = PlacesFrom(2.0, 11);
  Progress progress;
  const FloorMap full = ComputeFloorMap(*solved.TheView, options, progress);
  options.CutOff = 0.05;
  const FloorMap cut = ComputeFloorMap(*solved.TheView, options, progress);
  int kept = 0;
  int left = 0;
  EXPECT_EQ(cut.Status, full.Status);
  EXPECT_EQ(WorkCount(full.Report, "views of signs skipped", "cut-off"), 0.0);
  EXPECT_GT(WorkCount(cut.Report, "views of signs skipped", "cut-off"), 3.0);
  for (std::size_t place = 0; place < full.Visibility.size(); ++place)
  {
    if (full.Visibility[place] >= options.CutOff)
    {
      EXPECT_EQ(cut.Visibility[place], full.Visibility[place]) << place;
      ++kept;
    }
    else
    {
      EXPECT_LT(cut.Visibility[place], options.CutOff) << place;
      ++left;
    }
  }
  EXPECT_GT(kept, 3);
  EXPECT_GT(left, 3);
}

// Signs that face away or stand behind a wall are not looked at, and nothing would be seen of them.
TEST(SignSkip, SignsOutOfView)
{
  SceneDescription scene = scenes::Corridor(0.25);
  scene.Emitters.resize(4);
  const auto add = [&scene](const Vec3& centre, const Vec3& normal, int id)
  {
    const auto cells = scenes::Barcode(centre, normal, {0, 0, 1}, 0.6, 0.3, 5, 50.0, id);
    scene.Emitters.insert(scene.Emitters.end(), cells.begin(), cells.end());
  };
  add({0.01, 2.0, 2.0}, {1, 0, 0}, 0);
  add({1.0, 2.0, 2.6}, {-1, 0, 0}, 1);
  scenes::AddRectangle(scene.Surfaces, {30, 0, 0}, {0, 4, 0}, {0, 0, 4}, 1, 1, 0.3);
  add({40.0, 2.0, 2.0}, {-1, 0, 0}, 2);
  const Solved solved(scene, 0.1);
  FloorMapOptions options = PlacesFrom(4.0, 5);
  Progress progress;
  const FloorMap map = ComputeFloorMap(*solved.TheView, options, progress);
  EXPECT_EQ(WorkCount(map.Report, "views of signs skipped", "faces away"), 15.0);
  options.SkipsAway = false;
  const FloorMap looked = ComputeFloorMap(*solved.TheView, options, progress);
  EXPECT_EQ(WorkCount(looked.Report, "views of signs skipped", "faces away"), 0.0);
  EXPECT_EQ(looked.PerceivedContrast, map.PerceivedContrast);
  EXPECT_EQ(looked.Status, map.Status);
  EXPECT_EQ(WorkCount(map.Report, "views of signs skipped", "hidden"), 15.0);
  EXPECT_EQ(WorkCount(map.Report, "hidden signs not looked at in parts"), 15.0);
  const View inParts(solved.TheScene, solved.Field, {.HiddenSigns = false});
  const FloorMap parted = ComputeFloorMap(inParts, options, progress);
  EXPECT_EQ(WorkCount(parted.Report, "views of signs skipped", "hidden"), 30.0);
  EXPECT_EQ(WorkCount(parted.Report, "hidden signs not looked at in parts"), 0.0);
  EXPECT_EQ(parted.PerceivedContrast, map.PerceivedContrast);
  EXPECT_EQ(parted.Status, map.Status);
  EXPECT_EQ(WorkCount(map.Report, "views of signs computed"), 15.0);
  for (int place = 0; place < 15; ++place)
  {
    const Vec3 eye =
      options.FirstPlace + Vec3(options.StepX * (place % 5), options.StepY * (place / 5), 0.0);
    const SignMeasurement seen = MeasureSign(*solved.TheView, 0, eye, Observer{});
    EXPECT_FLOAT_EQ(map.PerceivedContrast[place * 3], static_cast<float>(seen.PerceivedContrast));
    EXPECT_EQ(map.PerceivedContrast[place * 3 + 1], 0.0F);
    EXPECT_EQ(map.PerceivedContrast[place * 3 + 2], 0.0F);
    for (const int sign : {1, 2})
    {
      EXPECT_EQ(MeasureSign(*solved.TheView, sign, eye, Observer{}).VisibleFraction, 0.0) << place;
    }
  }
}

/// What a look at the first sign gives without a cut-off is what it gives with one below that.
void ExpectKept(const SceneDescription& scene, const Vec3& eye, double cutOff)
{
  const Solved solved(scene, 0.1);
  const Observer observer;
  const double contrast = MeasureSign(*solved.TheView, 0, eye, observer).PerceivedContrast;
  EXPECT_GT(contrast, cutOff);
  EXPECT_EQ(MeasureSign(*solved.TheView, 0, eye, observer, cutOff).PerceivedContrast, contrast);
}

// Signs that show in a small part only: one whose uppermost bar stands out of thick smoke, and one
// that only reflects, with a weak lamp close to one of its ends.
TEST(SignSkip, SignsThatShowInAPart)
{
  SceneDescription layered;
  layered.Albedo = 0.0;
  SmokeGrid grid = scenes::UniformSmoke(Vec3(0.0), Vec3(6, 4, 4), {6, 4, 2}, 6.0);
  grid.Nodes[2] = {0.0, 2.0, 4.0};
  std::fill(grid.Extinction.begin() + 24, grid.Extinction.end(), 0.0F);
  layered.Grids = {grid};
  scenes::AddRoom(layered.Surfaces, Vec3(0.0), Vec3(6, 4, 4), 2.0, 0.0);
  layered.Emitters = {scenes::Plate({0.01, 2, 1.5}, {1, 0, 0}, {0, 0, 1}, 0.5, 1.0, 0.0, 0.0, 0),
    scenes::Plate({0.01, 2, 2.02}, {1, 0, 0}, {0, 0, 1}, 0.5, 0.04, 100.0, 0.0, 0)};
  ExpectKept(layered, {5.0, 2.0, 2.1}, 1.0);

  SceneDescription reflecting;
  reflecting.Albedo = 0.0;
  scenes::AddRoom(reflecting.Surfaces, Vec3(0.0), Vec3(6, 4, 4), 2.0, 0.0);
  reflecting.Emitters = {scenes::Plate({0.01, 2, 2}, {1, 0, 0}, {0, 0, 1}, 1.0, 0.2, 0.0, 0.8, 0),
    scenes::Plate({0.06, 1.55, 2}, {-1, 0, 0}, {0, 0, 1}, 0.02, 0.02, 10.0, 0.0)};
  ExpectKept(reflecting, {5.0, 2.0, 2.0}, 0.1);
}

// Where nothing reaches between eye and sign its parts are not looked at, and where anything does
// they are: a bar that hides a strip of it, one that ends beside it, and one behind it.
TEST(SignSkip, LooksAtWhatNothingHides)
{
  SceneDescription scene = scenes::Corridor(0.25);
  scene.Emitters = scenes::Barcode({59.99, 2.0, 2.0}, {-1, 0, 0}, {0, 0, 1}, 1.0, 0.5, 5, 200.0, 0);
  struct Bar
  {
    /// Distance from the sign, and where it begins sideways [m].
    double Before, From;
    bool Clear, Hides;
  };
  // The sign reaches to 2.5 m sideways, and half way to the eye to 2.25. What lies right beside the
  // lines of sight is looked at, since no plane across an axis parts it from them.
  for (const Bar& bar : {Bar{5.0, 3.9, true, false}, {5.0, 2.24, false, true},
         {5.0, 2.26, false, false}, {0.005, 2.0, false, true}, {-0.005, 2.0, true, false}})
  {
    SceneDescription barred = scene;
    scenes::AddRectangle(barred.Surfaces, {59.99 - bar.Before, bar.From, 0.5},
      {0, 4.0 - bar.From, 0}, {0, 0, 3}, 1, 1, 0.3);
    const Solved solved(barred, 0.1);
    const View looking(solved.TheScene, solved.Field, ViewSkips{.Looks = false});
    const Vec3 eye(49.99, 2.0, 2.0);
    const SignMeasurement left = MeasureSign(*solved.TheView, 0, eye, Observer{});
    const SignMeasurement looked = MeasureSign(looking, 0, eye, Observer{});
    EXPECT_EQ(left.Clear, bar.Clear) << bar.Before << " " << bar.From;
    EXPECT_FALSE(looked.Clear);
    EXPECT_EQ(looked.VisibleFraction < 1.0, bar.Hides) << bar.Before << " " << bar.From;
    EXPECT_EQ(left.VisibleFraction, looked.VisibleFraction);
    EXPECT_EQ(left.Contrast, looked.Contrast);
    EXPECT_EQ(left.MeanLuminance, looked.MeanLuminance);
    Progress progress;
    FloorMapOptions options;
    options.FirstPlace = eye;
    options.PlacesX = 1;
    options.PlacesY = 1;
    const FloorMap map = ComputeFloorMap(*solved.TheView, options, progress);
    EXPECT_EQ(
      WorkCount(map.Report, "views of signs not looked at in parts"), bar.Clear ? 1.0 : 0.0);
  }
}

/// Looks at the first sign along the corridor, with and without the veil that smoke ahead hides.
/// Adds to the rays that were cut short.
void ExpectAlike(const SceneDescription& scene, double tolerance, const std::vector<double>& from,
  std::size_t& cutShort)
{
  const Solved solved(scene, tolerance);
  const View whole(solved.TheScene, solved.Field, ViewSkips{.HiddenSmoke = false});
  for (const double x : from)
  {
    const Vec3 eye(x, 2.1, 1.7);
    const SignMeasurement expected = MeasureSign(whole, 0, eye, Observer{});
    const SignMeasurement value = MeasureSign(*solved.TheView, 0, eye, Observer{});
    ASSERT_GT(expected.MeanLuminance, 0.0);
    // A hundredth of the tolerance from close to the plate, and as much from before.
    EXPECT_NEAR(value.MeanLuminance / expected.MeanLuminance, 1.0, 0.02 * tolerance) << x;
    EXPECT_NEAR(value.Contrast, expected.Contrast, 0.02 * tolerance) << x;
  }
  EXPECT_EQ(whole.RaysCutShort(), 0U);
  cutShort += solved.TheView->RaysCutShort();
}

/// A corridor with a sign at its end.
SceneDescription CorridorToASign(double extinction)
{
  SceneDescription scene = scenes::Corridor(extinction, 15, 0.8);
  const auto sign =
    scenes::Barcode({59.99, 2.0, 2.0}, {-1, 0, 0}, {0, 0, 1}, 0.6, 1.0, 5, 200.0, 0, 0.3);
  scene.Emitters.insert(scene.Emitters.begin(), sign.begin(), sign.end());
  return scene;
}

// Rays are cut short where smoke ahead hides what lies behind, and only there: not before a lamp,
// or a flame, ten million times as bright as others, and not where the smoke before a part of the
// sign has a gap.
TEST(SignSkip, VeilBehindSmokeThatHidesIt)
{
  const std::vector<double> places = {5.0, 20.0, 35.0, 45.0, 55.0};
  std::size_t few = 0;
  ExpectAlike(CorridorToASign(1.0), 0.1, places, few);
  EXPECT_GT(few, 60U);
  const Solved solved(CorridorToASign(1.0), 0.1);
  Progress progress;
  const FloorMap map = ComputeFloorMap(*solved.TheView, PlacesFrom(5.0, 10), progress);
  EXPECT_GT(WorkCount(map.Report, "rays cut short"), 300.0);

  std::size_t cutShort = 0;
  SceneDescription lamp = CorridorToASign(1.0);
  lamp.Emitters.push_back(scenes::Plate({57.0, 2.0, 3.99}, {0, 0, -1}, {1, 0, 0}, 0.3, 0.3, 1e10));
  ExpectAlike(lamp, 0.1, places, cutShort);

  SceneDescription flame = CorridorToASign(1.0);
  std::vector<float>& emitted = flame.Grids[0].EmittedLuminance;
  emitted.assign(flame.Grids[0].Extinction.size(), 0.0F);
  for (std::size_t cell = 0; cell < emitted.size(); ++cell)
  {
    emitted[cell] = cell % 120 == 112 ? 1e10F : 0.0F;
  }
  ExpectAlike(flame, 0.1, places, cutShort);

  SceneDescription gap = CorridorToASign(3.0);
  for (std::size_t cell = 0; cell < gap.Grids[0].Extinction.size(); ++cell)
  {
    const bool level = cell / (std::size_t{120} * 8) == 4;
    gap.Grids[0].Extinction[cell] = level ? 0.02F : 3.0F;
  }
  ExpectAlike(gap, 0.1, places, cutShort);
}

TEST(SignSkip, VeilBehindSmokeThatHidesItLong)
{
  std::size_t cutShort = 0;
  ExpectAlike(CorridorToASign(1.0), 0.03, {5.0, 20.0, 35.0, 45.0, 55.0}, cutShort);
  EXPECT_GT(cutShort, 60U);
}

} // namespace
