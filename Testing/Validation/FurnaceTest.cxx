// Closed furnaces, whose radiance is known everywhere.
#include "Box.h"
#include "SceneLibrary.h"
#include "Solved.h"
#include "TestReport.h"
#include "WorkCount.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

namespace
{

using namespace smokevis;
using std::numbers::pi;

std::vector<std::int64_t> AllCells(const Solved& solved)
{
  std::vector<std::int64_t> cells(solved.TheScene->Smoke().Cells());
  std::iota(cells.begin(), cells.end(), 0);
  return cells;
}

/// Looks at a furnace of uniform radiance in every way there is.
void CheckUniform(const Solved& solved, double exact, double tolerance, const std::string& name)
{
  const Vec3 lower = solved.TheScene->Lower();
  const Vec3 size = solved.TheScene->Upper() - lower;
  Pcg32 random(5, 5);
  for (int i = 0; i < 3; ++i)
  {
    const Vec3 origin =
      lower + size * Vec3(0.1 + 0.8 * random.Uniform(), 0.1 + 0.8 * random.Uniform(),
                       0.1 + 0.8 * random.Uniform());
    const Vec3 target = lower + size * Vec3(random.Uniform(), random.Uniform(), 1.0);
    const Estimate seen = solved.Luminance({origin, glm::normalize(target - origin)});
    report::Relative(name + " luminance", exact, seen.Mean, tolerance, seen.StandardError);
  }
  std::vector<std::size_t> patches(solved.TheScene->Patches());
  for (std::size_t patch = 0; patch < patches.size(); ++patch)
  {
    patches[patch] = patch;
  }
  const Estimate onWalls = solved.Illuminance(patches, 0);
  report::Relative(
    name + " mean illuminance", pi * exact, onWalls.Mean, tolerance, onWalls.StandardError);
  if (!solved.TheScene->Smoke().Empty())
  {
    const Estimate inSmoke = solved.Fluence(AllCells(solved));
    report::Relative(
      name + " mean fluence", 4.0 * pi * exact, inSmoke.Mean, tolerance, inSmoke.StandardError);
  }
}

// Walls emit 1 and reflect rho, smoke loses nothing: L = 1 / (1 - rho) everywhere. 0.2 % is what
// the solver's sources of error that are not noise (quadrature of the direct light) may take.
TEST(Furnace, WhiteBoxWithoutSmoke)
{
  report::Head("White furnace, no smoke");
  for (const double rho : {0.0, 0.2, 0.5, 0.8, 0.9})
  {
    SceneDescription description;
    description.Emitters = scenes::EmittingRoom(Vec3(0.0), Vec3(2, 1, 1), 4, 1.0, rho);
    CheckUniform(
      Solved(description), 1.0 / (1.0 - rho), 0.002, "rho " + std::to_string(rho).substr(0, 3));
  }
}

TEST(Furnace, WhiteBoxWithScatteringSmoke)
{
  report::Head("White furnace, smoke of albedo 1, extinction 0.1 to 3");
  for (const double rho : {0.0, 0.2, 0.5, 0.8, 0.9})
  {
    SceneDescription description;
    description.Albedo = 1.0;
    description.Grids = {scenes::NoisySmoke(Vec3(0.0), Vec3(2, 1, 1), {12, 6, 6}, 0.1, 3.0, 5)};
    description.Emitters = scenes::EmittingRoom(Vec3(0.0), Vec3(2, 1, 1), 4, 1.0, rho);
    CheckUniform(
      Solved(description), 1.0 / (1.0 - rho), 0.002, "rho " + std::to_string(rho).substr(0, 3));
  }
}

// Walls and smoke of one luminance: uniform at any albedo, because smoke emits what it absorbs.
TEST(Furnace, EmittingSmokeAtTheWallsLuminance)
{
  report::Head("Smoke and walls of one luminance");
  for (const double albedo : {0.0, 0.5, 0.9})
  {
    SceneDescription description;
    description.Albedo = albedo;
    description.Grids = {scenes::NoisySmoke(Vec3(0.0), Vec3(2, 1, 1), {12, 6, 6}, 0.1, 3.0, 5)};
    description.Grids[0].EmittedLuminance.assign(12 * 6 * 6, 1.0F);
    description.Emitters = scenes::EmittingRoom(Vec3(0.0), Vec3(2, 1, 1), 4, 1.0, 0.0);
    const Solved solved(description);
    const Estimate seen = solved.Luminance({{0.2, 0.4, 0.3}, glm::normalize(Vec3(1.0, 0.2, 0.3))});
    report::Relative("albedo " + std::to_string(albedo).substr(0, 3) + " luminance", 1.0, seen.Mean,
      0.002, seen.StandardError);
  }
}

/// A thousand cells of smoke, as far as a given place from the middle of a room, and perhaps
/// further smoke.
std::vector<SmokeGrid> Smoke(
  double extinction, double farthest = 1.0, const std::optional<SmokeGrid>& inner = std::nullopt)
{
  std::vector<SmokeGrid> grids = {
    scenes::UniformSmoke(Vec3(-farthest), Vec3(farthest), {10, 10, 10}, extinction)};
  if (inner)
  {
    grids.push_back(*inner);
  }
  return grids;
}

/// Smoke that glows as bright as the walls of the room around it, whatever they reflect: all of it
/// is at one temperature.
SceneDescription Isothermal(std::vector<SmokeGrid> smoke, double albedo, double reflectance)
{
  SceneDescription description;
  description.Albedo = albedo;
  description.Grids = std::move(smoke);
  for (SmokeGrid& grid : description.Grids)
  {
    grid.EmittedLuminance.assign(grid.Extinction.size(), 1.0F);
  }
  description.Emitters =
    scenes::EmittingRoom(Vec3(-1.0), Vec3(1.0), 4, 1.0 - reflectance, reflectance);
  return description;
}

// Light that smoke and walls send on for long, in cells of 1 and of 4 mean free paths: what sweeps
// have yet to find is completed, which leaves hardly more than noise.
TEST(Furnace, WhiteSmokeBetweenReflectingWalls)
{
  report::Head("Isothermal white smoke between reflecting walls, fluence");
  for (const double extinction : {5.0, 20.0})
  {
    for (const double albedo : {0.99, 0.999})
    {
      for (const double reflectance : {0.11, 0.3, 0.8, 0.95})
      {
        const Solved solved(Isothermal(Smoke(extinction), albedo, reflectance), 0.03);
        const std::string name = "extinction " + std::to_string(static_cast<int>(extinction)) +
                                 ", albedo " + std::to_string(albedo).substr(0, 5) +
                                 ", reflectance " + std::to_string(reflectance).substr(0, 4);
        const std::vector<std::int64_t> cells = AllCells(solved);
        EXPECT_EQ(WorkCount(solved.Field->Report, "coarse cells"),
          extinction > 10.0 ? static_cast<double>(cells.size()) : 0.0);
        const Estimate mean = solved.Fluence(cells);
        report::Relative(name + ", mean", 4.0 * pi, mean.Mean, 0.0005, mean.StandardError);
        const Estimate middle = solved.Fluence(Vec3(0.1));
        report::Relative(name + ", middle", 4.0 * pi, middle.Mean, 0.001, middle.StandardError);
      }
    }
  }
}

// Cells that are seven times as small as others around them are met by lines of their own: what is
// told of their errors is true of each.
TEST(Furnace, FineMeshWithinACoarseOne)
{
  report::Head("Isothermal smoke, a mesh within another, root mean square of z of the fine cells");
  constexpr std::int64_t coarse = 1000;
  constexpr std::int64_t fine = 8000;
  constexpr double extinction = 2.0;
  for (const double albedo : {0.3, 0.9})
  {
    const Solved solved(
      Isothermal(Smoke(extinction, 1.0,
                   scenes::UniformSmoke(Vec3(-0.3), Vec3(0.25), {20, 20, 20}, extinction)),
        albedo, 0.3),
      0.03);
    double sum = 0.0;
    double error = 0.0;
    for (std::int64_t cell = coarse; cell < coarse + fine; ++cell)
    {
      const Estimate fluence = solved.Fluence(std::vector<std::int64_t>{cell});
      ASSERT_GT(fluence.StandardError, 0.0) << "cell " << cell;
      sum += std::pow((fluence.Mean - 4.0 * pi) / fluence.StandardError, 2.0) / fine;
      error += fluence.StandardError / (4.0 * pi) / fine;
    }
    // A standard error of 16 batches is itself known to a fifth, which makes tails of z longer.
    report::Absolute(
      "albedo " + std::to_string(albedo).substr(0, 3), 1.0, std::sqrt(sum), 0.15, 0.0);
    EXPECT_LT(error, 0.3);
  }
}

// A fine mesh begins in the middle of coarse cells: the middle of what is left of them lies right
// beside it, or in it. Hardly any light is lost, so that all cells are known to a thousandth.
TEST(Furnace, FineMeshAcrossCoarseCells)
{
  report::Head("Isothermal white smoke, a mesh across the cells of another, farthest cell");
  for (const double low : {-0.548, -0.544, -0.54, -0.51})
  {
    const Solved solved(
      Isothermal(
        Smoke(20.0, 1.0, scenes::UniformSmoke(Vec3(low, -0.5, -0.5), Vec3(0.25), {24, 6, 6}, 60.0)),
        1.0, 0.99),
      0.03);
    double farthest = 0.0;
    for (const std::int64_t cell : AllCells(solved))
    {
      const Estimate fluence = solved.Fluence(std::vector<std::int64_t>{cell});
      const double deviation = fluence.Mean / (4.0 * pi) - 1.0;
      if (solved.TheScene->Smoke().OwnVolume(cell) > 0.0 &&
          std::abs(deviation) > std::abs(farthest))
      {
        farthest = deviation;
      }
    }
    report::Absolute("from " + std::to_string(low).substr(0, 6), 0.0, farthest, 0.01, 0.0);
  }
}

// A white box stands on a white floor with a face of its own there, full of cold smoke: around it
// the floor is as bright as everything else. What is covered of a patch is known to a percent.
TEST(Furnace, PatchesThatABoxStandsOn)
{
  report::Head("Isothermal smoke around a box on the floor, illuminance of patches partly covered");
  const Box box{Vec3(-0.2, -0.2, -1.0), Vec3(0.2, 0.4, 0.2)};
  for (const bool boxFirst : {false, true})
  {
    SceneDescription description = Isothermal(Smoke(2.0), 0.5, 0.5);
    SmokeGrid& smoke = description.Grids[0];
    std::size_t cell = 0;
    for (const double z : scenes::Linear(-0.9, 0.9, 9))
    {
      for (const double y : scenes::Linear(-0.9, 0.9, 9))
      {
        for (const double x : scenes::Linear(-0.9, 0.9, 9))
        {
          const bool inside = box.Contains({x, y, z});
          smoke.Extinction[cell] = inside ? 50.0F : smoke.Extinction[cell];
          smoke.EmittedLuminance[cell] = inside ? 0.0F : 1.0F;
          ++cell;
        }
      }
    }
    std::erase_if(description.Emitters,
      [](const EmitterCell& wall)
      {
        return std::all_of(wall.Vertices.begin(), wall.Vertices.end(),
          [](const Vec3& vertex) { return vertex.z == -1.0; });
      });
    std::size_t floor = 0;
    const auto addFloor = [&]
    {
      floor = scenes::AddRectangle(
        description.Surfaces, Vec3(-1.0), Vec3(2.0, 0.0, 0.0), Vec3(0.0, 2.0, 0.0), 4, 4, 1.0);
    };
    if (!boxFirst)
    {
      addFloor();
    }
    scenes::AddBlock(description.Surfaces, box.Lower, box.Upper, 0.3, 1.0);
    if (boxFirst)
    {
      addFloor();
    }
    const Solved solved(description, 0.005);
    for (const std::size_t patch : {5, 6, 9, 10})
    {
      const Estimate seen = solved.Illuminance({floor + patch}, 0);
      report::Relative(
        (boxFirst ? "box first, patch " : "floor first, patch ") + std::to_string(patch), pi,
        seen.Mean, 0.01, seen.StandardError);
    }
  }
}

// Light that walls outside of all smoke send back.
TEST(Furnace, WhiteSmokeAmidAWhiteRoom)
{
  report::Head("Isothermal white smoke a tenth of a metre from reflecting walls, fluence");
  for (const double extinction : {5.0, 20.0})
  {
    for (const double reflectance : {0.3, 0.9, 0.99})
    {
      const Solved solved(Isothermal(Smoke(extinction, 0.9), 0.99, reflectance), 0.03);
      const std::string name = "K " + std::to_string(extinction).substr(0, 4) + ", reflectance " +
                               std::to_string(reflectance).substr(0, 4);
      const Estimate mean = solved.Fluence(AllCells(solved));
      report::Relative(name + ", mean", 4.0 * pi, mean.Mean, 0.0005, mean.StandardError);
      const Estimate middle = solved.Fluence(Vec3(0.1));
      report::Relative(name + ", middle", 4.0 * pi, middle.Mean, 0.001, middle.StandardError);
    }
  }
}

/// A sphere of radius 1 m whose wall emits 1 cd/m2, full of smoke that only absorbs.
/// @param level 80 triangles stand for it at 1, 320 at 2
SceneDescription GlowingSphere(double reflectance, double depth, int level)
{
  SceneDescription description;
  description.Albedo = 0.0;
  description.Grids = {scenes::UniformSmoke(Vec3(-1.1), Vec3(1.1), {1, 1, 1}, depth)};
  description.Emitters = scenes::EmittingSphere(Vec3(0.0), 1.0, level, true, 1.0, reflectance);
  return description;
}

/// Luminance of the wall as seen from the middle, taken back through the smoke: facets lie at
/// different distances.
Estimate WallOf(const Solved& sphere)
{
  constexpr int Directions = 50;
  Pcg32 random(3, 3);
  Estimate wall;
  for (int i = 0; i < Directions; ++i)
  {
    const double z = 1.0 - 2.0 * random.Uniform();
    const double azimuth = 2.0 * pi * random.Uniform();
    const double r = std::sqrt(1.0 - z * z);
    const RayLight light =
      sphere.Trace({Vec3(0.0), {r * std::cos(azimuth), r * std::sin(azimuth), z}});
    const double back = std::exp(light.OpticalDepth) / Directions;
    wall.Mean += back * light.Total();
    wall.StandardError += back * StandardError(light.TotalLanes());
  }
  return wall;
}

// The mean chord 4 V / S of the triangles that stand for the sphere is the sphere's: K, the mean
// transmittance of chords, is then right to first order in the optical depth. By the reference
// integrator L = 1 / (1 - a K) is 0.34 % larger in 80 triangles for a = 0.5 and depth 1, and 0.05 %
// for a = 0.9 and depth 0.1; what 320 leave falls to a quarter of that.
TEST(Furnace, AbsorbingSphere)
{
  report::Head("Furnace sphere with absorbing smoke");
  const report::ReferenceTable table("furnace_sphere_absorbing.csv");
  for (std::size_t row = 0; row < table.Rows(); ++row)
  {
    const double reflectance = table.Number(row, "wall_albedo_a");
    const double depth = table.Number(row, "sigma_a_R");
    const Estimate wall = WallOf(Solved(GlowingSphere(reflectance, depth, 2), 0.05));
    report::Relative(
      "rho " + table.Text(row, "wall_albedo_a") + " depth " + table.Text(row, "sigma_a_R"),
      table.Number(row, "L_wall_outgoing"), wall.Mean, 0.004, wall.StandardError);
  }
}

// In a cell of eleven mean free paths what comes to the wall is known so roughly that noise may
// pass for light that goes on to drift, where next to none is sent on: that is no reason to refuse
// the scene.
TEST(Furnace, ThickSootBeforeDarkWallsSettles)
{
  report::Head("Sphere of thick soot whose wall reflects next to nothing");
  for (const double reflectance : {0.0, 0.01})
  {
    const Estimate wall = WallOf(Solved(GlowingSphere(reflectance, 5.0, 1)));
    report::Relative("rho " + std::to_string(reflectance).substr(0, 4), 1.0 + 0.02 * reflectance,
      wall.Mean, 0.001, wall.StandardError);
  }
}

} // namespace
