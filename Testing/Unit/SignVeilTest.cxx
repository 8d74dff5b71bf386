// The veil over a sign's plate, from a few rays, against many.
#include "SignVeil.h"
#include "SceneLibrary.h"
#include "View.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

constexpr int Bars = 9;

/// A luminous sign on a wall of a room of even smoke, of bars that stand or lie.
SceneDescription SignInSmoke(double extinction, bool lie)
{
  SceneDescription scene;
  scene.Albedo = 0.9;
  scene.Grids = {scenes::UniformSmoke(Vec3(0.0), {6, 4, 3}, {24, 16, 12}, extinction)};
  scenes::AddRoom(scene.Surfaces, Vec3(0.0), {6, 4, 3}, 1.0, 0.2);
  scene.Emitters = scenes::Barcode(
    {1.2, 0.05, 2.0}, {0, 1, 0}, lie ? Vec3(1, 0, 0) : Vec3(0, 0, 1), 0.6, 0.3, Bars, 300.0, 0);
  return scene;
}

/// Mean of the veil over a bar from many rays.
double MeanOverBar(const View& view, const Sign& sign, const PlateColumns& columns,
  const PlateColumns& rows, std::size_t bar, const Vec3& eye)
{
  constexpr int Across = 8;
  constexpr int Along = 40;
  const bool stand = rows.Count() == 1;
  const PlateColumns& bars = stand ? columns : rows;
  double sum = 0.0;
  for (int i = 0; i < Across; ++i)
  {
    for (int j = 0; j < Along; ++j)
    {
      const double across =
        bars.Ends[bar] + (i + 0.5) / Across * (bars.Ends[bar + 1] - bars.Ends[bar]);
      const double along = (j + 0.5) / Along;
      const Vec3 to = OnPlate(sign, stand ? across : along, stand ? along : across) - eye;
      const double distance = glm::length(to);
      const RayLight light = view.TraceVeil(eye, to / distance, 0.0, distance, 0);
      sum += light.VeilDirect + Mean(light.VeilMultiple);
    }
  }
  return sum / (Across * Along);
}

View Solve(double extinction, bool lie)
{
  const auto scene = std::make_shared<const Scene>(SignInSmoke(extinction, lie));
  LightFieldOptions options;
  options.Tolerance = 0.1;
  Progress progress;
  return {scene, std::make_shared<LightField>(SolveLightField(*scene, options, progress))};
}

/// Largest error of the mean veil before any bar, over that bar's.
double LargestError(const View& view, const Vec3& eye)
{
  const EmitterSet& lights = view.TheScene().Lights();
  const Sign& sign = lights.Signs()[0];
  const PlateColumns columns(lights, sign, 0);
  const PlateColumns rows(lights, sign, 1);
  EXPECT_EQ(columns.Count() * rows.Count(), static_cast<std::size_t>(Bars));
  const bool stand = rows.Count() == 1;
  const PlateColumns& bars = stand ? columns : rows;
  std::vector<SeenPlace> places;
  constexpr int Places = 16;
  for (std::size_t bar = 0; bar < Bars; ++bar)
  {
    for (int i = 0; i < Places; ++i)
    {
      const double across = glm::mix(bars.Ends[bar], bars.Ends[bar + 1], (i % 4 + 0.5) / 4.0);
      const double along = (i + 0.5) / Places;
      const glm::dvec2 at(stand ? across : along, stand ? along : across);
      places.push_back({at, OnPlate(sign, at.x, at.y), 1.0 / (Bars * Places)});
    }
  }
  const PlateVeil veil(view, eye, 0, places, sign, columns, rows);
  double largest = 0.0;
  for (std::size_t bar = 0; bar < Bars; ++bar)
  {
    double told = 0.0;
    for (int i = 0; i < Places; ++i)
    {
      told += Mean(veil.At(bar * Places + i)) / Places;
    }
    const double mean = MeanOverBar(view, sign, columns, rows, bar, eye);
    EXPECT_GT(mean, 0.0);
    EXPECT_TRUE(std::isfinite(told));
    largest = std::max(largest, std::abs(told / mean - 1.0));
  }
  return largest;
}

// Before the plate and aslant (77 degrees off its normal). In thin smoke the veil is a hundredth of
// the sign's light, in thick smoke as bright as that.
TEST(PlateVeil, BeforeBars)
{
  for (const bool lie : {false, true})
  {
    for (const double extinction : {0.2, 0.5, 3.0})
    {
      const View view = Solve(extinction, lie);
      for (const Vec3& eye : {Vec3(4.5, 3.2, 1.6), Vec3(4.5, 0.8, 1.6)})
      {
        EXPECT_LT(LargestError(view, eye), extinction < 1.0 ? 0.05 : 0.01)
          << extinction << ", " << lie << ", y " << eye.y;
      }
    }
  }
}

} // namespace
