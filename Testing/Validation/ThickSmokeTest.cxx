// Smoke in cells so thick that light varies in them, as SmokeLightField refines it.
#include "Contrast.h"
#include "DeepScenes.h"
#include "GridRefinement.h"
#include "Solved.h"
#include "TestReport.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

/// As many cells as the filter refines smoke to, if it is not told otherwise.
constexpr std::size_t Most = 500000;
constexpr double SolvedTo = 0.02;

// As they come the bars are 0.48 to 1.7 times as bright as they are. Of smoke of a mean free path
// as wide as the duct, two cells are left across it, and the bars 3 to 3.5 % too dark.
TEST(ThickSmoke, DarkBarsInADuct)
{
  constexpr double Tolerance = 0.05;
  report::Head("Dark bars of the tunnel's sign, in refined cells that were [cd/m2]");
  const report::ReferenceTable table("deep_tunnel_own.csv");
  for (std::size_t row = 0; row < table.Rows(); ++row)
  {
    const double extinction = table.Number(row, "extinction");
    const double albedo = table.Number(row, "albedo");
    for (const int across : {1, 2, 4})
    {
      const double depth = extinction / across;
      if (std::max(0.8, albedo) * depth <= 0.75)
      {
        continue;
      }
      SceneDescription scene = scenes::Tunnel(extinction, albedo);
      scene.Grids = {
        scenes::UniformSmoke(Vec3(0.0), {4, 1, 1}, {4 * across, across, across}, extinction)};
      const ThickSmoke thick = FindThickSmoke(scene, Most, SolvedTo);
      ASSERT_TRUE(thick.IsRefined());
      Refine(scene.Grids, thick.Refinements);
      const Solved solved(scene, SolvedTo);
      const SignMeasurement sign =
        MeasureSign(*solved.TheView, 0, scenes::TunnelEye, Observer{0.0});
      report::Relative(table.Text(row, "name") + ", of " + std::to_string(depth).substr(0, 4),
        table.Number(row, "dark"), sign.UnlitLuminance, Tolerance,
        std::hypot(table.Number(row, "dark_error"), sign.MeanLuminanceError));
    }
  }
}

// A room that one lamp lights, in cells of four mean free paths, against the path tracer. The path
// tracer and the solver leave a standard error of one to two hundredths each. Patches are a mean
// free path wide: light beside the lamp varies over them, too.
void CheckRoomInThickCells(double albedo)
{
  constexpr double Tolerance = 0.04;
  constexpr std::uint64_t Samples = 150000;
  report::Head(
    "Room in refined cells of four mean free paths, albedo " + std::to_string(albedo).substr(0, 4));
  SceneDescription scene;
  scene.Albedo = albedo;
  const Vec3 size(4.0, 2.0, 2.0);
  scene.Grids = {scenes::UniformSmoke(Vec3(0.0), size, {8, 4, 4}, 8.0)};
  scenes::AddRoom(scene.Surfaces, Vec3(0.0), size, 0.125, 0.3);
  scene.Emitters.push_back(
    scenes::Plate({1.0, 1.0, 1.99}, {0, 0, -1}, {1, 0, 0}, 0.6, 0.6, 100.0, 0.0));
  const Scene coarse(scene);
  const ReferenceIntegrator reference(coarse);
  const ThickSmoke thick = FindThickSmoke(scene, Most, SolvedTo);
  ASSERT_TRUE(thick.IsRefined());
  Refine(scene.Grids, thick.Refinements);
  const Solved solved(scene, SolvedTo);
  for (const Vec3& point : {Vec3(1.0, 1.0, 1.6), Vec3(1.4, 0.8, 1.7), Vec3(0.7, 1.3, 1.4)})
  {
    // Of the refined cell that holds it.
    const Medium& smoke = solved.TheScene->Smoke();
    const Box cell = smoke.CellBounds(smoke.Locate(point));
    const Estimate expected =
      reference.MeanFluence([&](Pcg32& random) { return PlaceIn(cell, random); }, Samples, 1);
    const Estimate fluence = solved.Fluence(point);
    report::Relative("fluence at x " + std::to_string(point.x).substr(0, 3), expected.Mean,
      fluence.Mean, Tolerance, std::hypot(expected.StandardError, fluence.StandardError));
  }
  const Ray ray{{1.7, 0.4, 1.4}, glm::normalize(Vec3(-1.0, 0.6, 0.2))};
  const Estimate expected = reference.Veil(ray, Samples, 2);
  const RayLight light = solved.Trace(ray);
  report::Relative("veil", expected.Mean, light.Veil(), Tolerance,
    std::hypot(expected.StandardError, StandardError(light.VeilMultiple)));
}

// As they come, white smoke is a quarter to a third too dark.
TEST(ThickSmoke, WhiteRoomInCellsOfFourMeanFreePaths)
{
  CheckRoomInThickCells(0.98);
}

TEST(ThickSmoke, RoomInCellsOfFourMeanFreePathsLong)
{
  CheckRoomInThickCells(0.6);
}

} // namespace
