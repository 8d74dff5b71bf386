// Lamps right beside signs, and in smoke as thick as its cells: what the solver's README
// says of them.
#include "Contrast.h"
#include "RandomScenes.h"
#include "ReferenceSign.h"
#include "SceneLibrary.h"
#include "Solved.h"
#include "TestReport.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace
{

using namespace smokevis;

/// A barcode that only reflects and faces the low x side, every other bar white.
std::vector<EmitterCell> ReflectingBars(const Vec3& centre, double width, double height, int bars)
{
  std::vector<EmitterCell> cells =
    scenes::Barcode(centre, {-1, 0, 0}, {0, 0, 1}, width, height, bars, 0.0, 0, 0.05);
  for (std::size_t cell = 0; cell < cells.size(); cell += 2)
  {
    cells[cell].Reflectance.fill(0.8);
  }
  return cells;
}

// A sign that only reflects, 0.4 m below a lamp, which lights one end more than the other. Without
// what differs inside the blocks that the sign is seen in the contrast would come out 0.004 lower.
// What comes by way of smoke varies less, which paths as few as these hardly tell.
TEST(LampNearby, AboveASignThatReflects)
{
  report::Head("Contrast of signs that reflect, 0.4 m below a lamp");
  struct Case
  {
    double Reflectance, Albedo;
    int Bars;
  };
  for (const Case& each :
    {Case{0.0, 0.0, 5}, {0.3, 0.0, 5}, {0.0, 0.6, 5}, {0.3, 0.6, 5}, {0.3, 0.6, 25}})
  {
    SceneDescription scene;
    scene.Albedo = each.Albedo;
    scene.Grids = {scenes::UniformSmoke(Vec3(0.0), {6, 4, 3}, {24, 16, 12}, 0.3)};
    scenes::AddRoom(scene.Surfaces, Vec3(0.0), {6, 4, 3}, 0.25, each.Reflectance);
    scene.Emitters = ReflectingBars({5.99, 2, 1.8}, 0.4, 0.2, each.Bars);
    scene.Emitters.push_back(
      scenes::Plate({5.7, 2.0, 2.2}, {0.3, 0, -1}, {0, 1, 0}, 0.3, 0.1, 3000.0));
    const Solved solved(scene, 0.05);
    const Vec3 eye(1, 2, 1.7);
    const SignMeasurement sign = MeasureSign(*solved.TheView, 0, eye, Observer{0.0});
    const Estimate reference =
      MeasureByPaths(*solved.TheScene, eye, (each.Albedo > 0.0 ? 6000 : 20000) / each.Bars)
        .Contrast;
    report::Absolute("walls " + std::to_string(each.Reflectance).substr(0, 3) + ", albedo " +
                       std::to_string(each.Albedo).substr(0, 3) + ", " + std::to_string(each.Bars) +
                       " bars",
      reference.Mean, sign.Contrast, each.Albedo > 0.0 ? 0.003 : 0.001,
      std::hypot(reference.StandardError, sign.ContrastError));
  }
}

// A sign that only reflects, 0.3 m beside a lamp that shines away from it: smoke and walls alone
// light it, one end almost three times as much as the other. Were its light even, its contrast
// would come out at 0.28. What is left is 3 %: the smoke between a sign and a lamp so close is
// brighter than its cells tell.
TEST(LampNearby, SignLitByTheSmokeBesideALamp)
{
  report::Head("Contrast of a sign that smoke and walls light, beside a lamp");
  SceneDescription scene;
  scene.Albedo = 0.6;
  scene.Grids = {scenes::UniformSmoke(Vec3(0.0), {6, 4, 3}, {24, 16, 12}, 0.3)};
  scenes::AddRoom(scene.Surfaces, Vec3(0.0), {6, 4, 3}, 0.25, 0.3);
  scene.Emitters = ReflectingBars({5.7, 2, 2}, 0.6, 0.3, 5);
  scene.Emitters.push_back(
    scenes::Plate({5.65, 2.6, 2.0}, {-1, 0, 0}, {0, 0, 1}, 0.3, 0.2, 3000.0));
  const Solved solved(scene, 0.03);
  const Vec3 eye(1, 2, 1.7);
  const SignMeasurement sign = MeasureSign(*solved.TheView, 0, eye, Observer{0.0});
  const Estimate reference = MeasureByPaths(*solved.TheScene, eye, 3000).Contrast;
  report::Absolute("contrast", reference.Mean, sign.Contrast, 0.015,
    std::hypot(reference.StandardError, sign.ContrastError));
}

// What the smoke throws back on the dark bars of a sign, to which it glows less than to the lit
// ones beside them. A centre may differ from the mean over its cell by a few percent.
TEST(LampNearby, DarkBarsOfASign)
{
  report::Head("Indirect illuminance of the dark bars of signs, against the path tracer");
  for (const std::uint64_t seed : {12, 20})
  {
    const Solved solved(scenes::MakeRandomRoom(seed).Description);
    const ReferenceIntegrator reference(*solved.TheScene);
    const EmitterSet& lights = solved.TheScene->Lights();
    for (const std::size_t cell : lights.Signs()[0].Cells)
    {
      if (lights.Cells()[cell].Luminance[0] > 0.0)
      {
        continue;
      }
      const Estimate expected =
        reference.Illuminance(lights.CellCentre(cell), lights.CellNormal(cell), 100000, 1);
      const Estimate value = solved.Illuminance({solved.TheScene->SurfacePatches() + cell}, 0);
      report::Relative("room " + std::to_string(seed) + ", cell " + std::to_string(cell),
        expected.Mean, value.Mean, 0.05, std::hypot(expected.StandardError, value.StandardError));
    }
  }
}

// The dark bars of a sign beside a ceiling that it lights itself, in black smoke: what they reflect
// comes from two or three patches of 0.4 m, which get more at one end than at the other. What is
// reflected twice is that of whole patches.
TEST(LampNearby, DarkBarsBesideLargePatches)
{
  report::Head("Indirect illuminance of the dark bars of a sign below a ceiling of large patches");
  SceneDescription scene;
  scene.Albedo = 0.0;
  scene.Grids = {scenes::UniformSmoke(Vec3(0.0), {6, 4, 2.6}, {30, 20, 13}, 1.0)};
  scenes::AddRoom(scene.Surfaces, Vec3(0.0), {6, 4, 2.6}, 0.4, 0.8);
  scene.Emitters =
    scenes::Barcode({5.99, 2, 2}, {-1, 0, 0}, {0, 0, 1}, 0.5, 0.25, 7, 200.0, 0, 0.1);
  const Solved solved(scene);
  const ReferenceIntegrator reference(*solved.TheScene);
  for (const std::size_t cell : {1, 3, 5})
  {
    const EmitterSet& lights = solved.TheScene->Lights();
    const Estimate expected =
      reference.Illuminance(lights.CellCentre(cell), lights.CellNormal(cell), 200000, 1);
    const Estimate value = solved.Illuminance({solved.TheScene->SurfacePatches() + cell}, 0);
    report::Relative("cell " + std::to_string(cell), expected.Mean, value.Mean, 0.03,
      std::hypot(expected.StandardError, value.StandardError));
  }
}

// Fluence under a lamp in cells of one and of two mean free paths, against cells of half the size:
// in thick cells the light of a lamp does not get as far as it should.
TEST(LampNearby, InThickCells)
{
  constexpr double CellSize = 0.25;
  for (const auto& [depth, tolerance] : {std::pair{1.0, 0.05}, {2.0, 0.17}})
  {
    const auto solve = [&, depth = depth](int parts)
    {
      SceneDescription scene;
      scene.Albedo = 0.9;
      scene.Grids = {scenes::UniformSmoke(
        Vec3(0.0), {3, 3, 3}, {12 * parts, 12 * parts, 12 * parts}, depth / CellSize)};
      scenes::AddRoom(scene.Surfaces, Vec3(0.0), {3, 3, 3}, 0.5, 0.0);
      scene.Emitters = {scenes::Plate({1.5, 1.5, 2.99}, {0, 0, -1}, {1, 0, 0}, 0.6, 1.2, 1000.0)};
      return Solved(std::move(scene), 0.05);
    };
    const Solved coarse = solve(1);
    const Solved fine = solve(2);
    report::Head("Fluence under a lamp in cells of " + std::to_string(depth).substr(0, 3) +
                 " mean free paths [lx]");
    for (const double height : {0.125, 0.375, 0.625, 0.875, 1.125, 1.375})
    {
      std::vector<std::int64_t> parts;
      for (int part = 0; part < 8; ++part)
      {
        const Vec3 share(part % 2 - 0.5, part / 2 % 2 - 0.5, part / 4 - 0.5);
        parts.push_back(
          fine.TheScene->Smoke().Locate(Vec3(1.625, 1.625, 3.0 - height) + 0.5 * CellSize * share));
      }
      const Estimate reference = fine.Fluence(parts);
      const Estimate value = coarse.Fluence(Vec3(1.625, 1.625, 3.0 - height));
      report::Relative(std::to_string(height).substr(0, 5) + " m off", reference.Mean, value.Mean,
        tolerance, std::hypot(reference.StandardError, value.StandardError));
    }
  }
}

// Level lines of sight below the plane of a lamp, where its light falls off to nothing within a
// cell. From afar it follows a straight line: an exponential of the same mean place is a tenth
// above that at a fifth of the cell, a sixth below at two fifths and right at four. With the slope
// that the next cell tells alone, veils were half as bright again at a fifth, and a sixth too dark
// at four.
TEST(LampNearby, LevelWithItsPlane)
{
  report::Head("Veil of level lines below the plane of a lamp in black walls [cd/m2]");
  const Vec3 upper(6, 4, 3);
  for (const double height : {2.99, 2.5})
  {
    SceneDescription scene;
    scene.Albedo = 0.3;
    scene.Grids = {scenes::UniformSmoke(Vec3(0.0), upper, {24, 16, 12}, 0.1)};
    scenes::AddRoom(scene.Surfaces, Vec3(0.0), upper, 0.5, 0.0);
    scene.Emitters = {scenes::Plate({2.1, 3.0, height}, {0, 0, -1}, {1, 0, 0}, 0.3, 0.3, 4000.0)};
    const Solved solved(scene, 0.03);
    const ReferenceIntegrator reference(*solved.TheScene);
    for (const auto& [below, tolerance] : {std::pair{0.05, 0.2}, {0.1, 0.2}, {0.2, 0.08}})
    {
      const Vec3 eye(0.5, 0.5, height - below);
      const Ray ray{eye, glm::normalize(Vec3(6.0, 3.8, height - below) - eye)};
      const Estimate expected = reference.Veil(ray, 60000, 1);
      const RayLight light = solved.Trace(ray);
      report::Relative("plane at " + std::to_string(height).substr(0, 4) + " m, " +
                         std::to_string(below).substr(0, 4) + " m below",
        expected.Mean, light.Veil(), tolerance,
        std::hypot(expected.StandardError, StandardError(light.VeilMultiple)));
    }
  }
}

// What the smoke right before a luminous sign sends back to it, wherever in a cell the sign hangs:
// half comes from the first centimetres. A centimetre before the wall it was a tenth too little,
// and less than half in coarse cells that the plane of the sign cuts askew.
TEST(LampNearby, SignLitByItsOwnVeil)
{
  constexpr double Tolerance = 0.025;
  const Vec3 upper(6, 4, 3);
  struct Case
  {
    double From, Degrees;
    int CellsAMetre;
  };
  for (const Case& each : {Case{6.0, 0.0, 4}, {5.99, 0.0, 4}, {5.9, 0.0, 4}, {5.7, 25.0, 2}})
  {
    report::Head("Illuminance of a sign by its own veil, at " +
                 std::to_string(each.From).substr(0, 4) + " of 6 m, turned by " +
                 std::to_string(each.Degrees).substr(0, 4) + " degrees [lx]");
    SceneDescription scene;
    scene.Albedo = 0.6;
    const int cells = each.CellsAMetre;
    scene.Grids = {scenes::UniformSmoke(Vec3(0.0), upper, {6 * cells, 4 * cells, 3 * cells}, 0.1)};
    scenes::AddRoom(scene.Surfaces, Vec3(0.0), upper, 0.5, 0.0);
    const Vec3 normal = scenes::Rotation(each.Degrees, {0, 0, 1}) * Vec3(-1.0, 0.0, 0.0);
    scene.Emitters =
      scenes::Barcode({each.From, 2.2, 1.9}, normal, {0, 0, 1}, 0.6, 0.3, 5, 100.0, 0, 0.2);
    const Solved solved(scene, 0.005);
    const ReferenceIntegrator reference(*solved.TheScene);
    for (const std::size_t cell : {0, 1})
    {
      const EmitterCell& own = scene.Emitters[cell];
      Pcg32 random(1, cell);
      Estimate expected;
      constexpr int Places = 64;
      for (int i = 0; i < Places; ++i)
      {
        const Vec3 place = own.Vertices[0] +
                           random.Uniform() * (own.Vertices[1] - own.Vertices[0]) +
                           random.Uniform() * (own.Vertices[3] - own.Vertices[0]);
        const Estimate one = reference.Illuminance(place, normal, 15000, 64 * cell + i);
        expected.Mean += one.Mean / Places;
        expected.StandardError += std::pow(one.StandardError / Places, 2);
      }
      const std::size_t side =
        solved.Field->PatchIndex(0, solved.TheScene->SurfacePatches() + cell, 0);
      const Lanes& lanes = solved.Field->MultipleIlluminance[side];
      report::Relative(cell == 0 ? "a lit bar" : "a dark bar", expected.Mean,
        solved.Field->DirectIlluminance[side] + Mean(lanes), Tolerance,
        std::hypot(std::sqrt(expected.StandardError), StandardError(lanes)));
    }
  }
}

} // namespace
