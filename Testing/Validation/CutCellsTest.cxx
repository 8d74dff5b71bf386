// Walls that lie askew to the cells of the smoke, which they cut.
#include "Contrast.h"
#include "ReferenceSign.h"
#include "SceneLibrary.h"
#include "Solved.h"
#include "TestReport.h"

#include <cmath>
#include <numbers>
#include <string>

namespace
{

using namespace smokevis;
using std::numbers::pi;

const Vec3 Axis{0.3, -0.5, 1.0};
const Vec3 Half{1.1, 0.8, 0.6};

/// Smoke in cells of 0.2 m around the origin.
SmokeGrid EvenSmoke(double extinction)
{
  return scenes::UniformSmoke(Vec3(-2.0), Vec3(2.0), {20, 20, 20}, extinction);
}

/// Rays across a turned room and, a tenth of a cell before them, along its walls.
std::vector<Ray> RaysInRoom(const glm::dmat3& turn)
{
  const Vec3 low = -0.93 * Half;
  const std::array<std::pair<Vec3, Vec3>, 4> ways = {
    {{{-1.0, -0.7, -0.5}, {1.1, 0.6, 0.5}}, {{-1.0, -0.78, 0.1}, {1.1, -0.78, 0.2}},
      {{-1.0, 0.3, 0.58}, {1.1, -0.2, 0.58}}, {low, {1.1, low.y, low.z}}}};
  std::vector<Ray> rays;
  for (const auto& [from, to] : ways)
  {
    rays.push_back({turn * from, glm::normalize(turn * (to - from))});
  }
  return rays;
}

void CheckUniform(const SceneDescription& scene, double exact, double tolerance)
{
  for (const double degrees : {0.0, 17.3, 71.9, 123.4})
  {
    const glm::dmat3 turn = scenes::Rotation(degrees, Axis);
    const Solved solved(scenes::Turned(scene, turn));
    int number = 0;
    for (const Ray& ray : RaysInRoom(turn))
    {
      const Estimate seen = solved.Luminance(ray);
      report::Relative(
        std::to_string(degrees).substr(0, 5) + " degrees, ray " + std::to_string(number++), exact,
        seen.Mean, tolerance, seen.StandardError);
    }
  }
}

// A room that is closed and loses nothing at its walls, with smoke that emits what it absorbs: the
// luminance is the smoke's, everywhere and at any albedo. All sources are even, so that only noise
// in cells of which slivers are left in the room is told: 0.3 %.
TEST(CutCells, FurnaceOfSmoke)
{
  report::Head("White room around glowing smoke, turned by odd angles");
  SceneDescription scene;
  scene.Albedo = 0.8;
  scene.Grids = {EvenSmoke(1.0)};
  scene.Grids[0].EmittedLuminance.assign(scene.Grids[0].Extinction.size(), 1.0F);
  scenes::AddRoom(scene.Surfaces, -Half, Half, 0.4, 1.0);
  CheckUniform(scene, 1.0, 0.003);
}

// Walls that emit 1 and reflect 0.5 around smoke that only scatters: 2 everywhere. 1 %, the
// promise: direct light in a cell beside its source is a sum over points.
TEST(CutCells, FurnaceOfWalls)
{
  report::Head("Glowing room around white smoke, turned by odd angles");
  SceneDescription scene;
  scene.Albedo = 1.0;
  scene.Grids = {EvenSmoke(1.0)};
  scene.Emitters = scenes::EmittingRoom(-Half, Half, 4, 1.0, 0.5);
  CheckUniform(scene, 2.0, 0.01);
}

SceneDescription SmokeAround(double albedo, double extinction)
{
  SceneDescription scene;
  scene.Albedo = albedo;
  scene.Grids = {EvenSmoke(extinction)};
  return scene;
}

/// Looks from an eye at two cells of the sign and along other rays. Luminance within 1 % and
/// contrast within 0.005, the promise.
void CheckScene(const SceneDescription& scene, const Vec3& eye, const std::vector<Ray>& others,
  std::uint64_t samples)
{
  const Solved solved(scene);
  const ReferenceIntegrator reference(*solved.TheScene);
  const auto checkVeil = [&](const std::string& name, const Ray& ray)
  {
    const RayLight light = solved.Trace(ray);
    const Estimate veil = reference.Veil(ray, samples, 1);
    report::Relative("veil " + name, veil.Mean, light.Veil(), 0.01,
      std::hypot(veil.StandardError, StandardError(light.VeilMultiple)));
  };
  for (const std::size_t cell : {std::size_t{0}, std::size_t{1}})
  {
    const std::string name = cell == 0 ? "before a lit cell" : "before an unlit cell";
    const Ray ray{eye, glm::normalize(solved.TheScene->Lights().CellCentre(cell) - eye)};
    checkVeil(name, ray);
    const RayLight light = solved.Trace(ray);
    const Estimate all = reference.Radiance(ray, samples, 2);
    report::Relative("all " + name, all.Mean, light.Total(), 0.01,
      std::hypot(all.StandardError, StandardError(light.TotalLanes())));
  }
  for (std::size_t i = 0; i < others.size(); ++i)
  {
    checkVeil("aside " + std::to_string(i), others[i]);
  }
  const Estimate contrast = MeasureByPaths(*solved.TheScene, eye, samples / 20).Contrast;
  const SignMeasurement sign = MeasureSign(*solved.TheView, 0, eye, Observer{0.0});
  report::Absolute("contrast", contrast.Mean, sign.Contrast, 0.005,
    std::hypot(contrast.StandardError, sign.ContrastError));
}

/// Two rooms side by side, parted by a wall without thickness, all askew to the cells. That with
/// the sign has a lamp, the other has one a thirtieth as strong.
void CheckThinWall(std::uint64_t samples)
{
  report::Head("Thin wall between a bright and a dim room, askew");
  SceneDescription scene = SmokeAround(0.9, 1.0);
  scenes::AddRoom(scene.Surfaces, {-1.2, -0.9, -0.7}, {1.2, 0.9, 0.7}, 0.3, 0.4);
  scenes::AddRectangle(scene.Surfaces, {-1.2, 0.0, -0.7}, {2.4, 0, 0}, {0, 0, 1.4}, 8, 5, 0.4);
  scene.Emitters =
    scenes::Barcode({1.2, 0.4, 0.1}, {-1, 0, 0}, {0, 0, 1}, 0.5, 0.25, 5, 100.0, 0, 0.1);
  scene.Emitters.push_back(scenes::Plate({-0.4, 0.5, 0.6}, {0, 0, -1}, {1, 0, 0}, 0.3, 0.2, 60.0));
  scene.Emitters.push_back(scenes::Plate({0.4, -0.5, 0.6}, {0, 0, -1}, {1, 0, 0}, 0.3, 0.2, 2.0));
  const glm::dmat3 turn = scenes::Rotation(29.0, Axis);
  const auto ray = [&turn](const Vec3& from, const Vec3& to) {
    return Ray{turn * from, glm::normalize(turn * (to - from))};
  };
  // Along the wall on its bright and on its dim side, and across the dim room.
  CheckScene(scenes::Turned(scene, turn), turn * Vec3(-0.9, 0.15, 0.1),
    {ray({-1.1, 0.05, 0.2}, {1.2, 0.05, -0.2}), ray({-1.1, -0.04, 0.2}, {1.2, -0.06, -0.1}),
      ray({-1.1, -0.7, 0.2}, {1.2, -0.3, -0.1})},
    samples);
}

/// A room between cell faces but for its ceiling, which slopes.
void CheckSlopedCeiling(std::uint64_t samples)
{
  report::Head("Sloped ceiling");
  SceneDescription scene = SmokeAround(0.8, 0.8);
  // Patches that go on behind the ceiling have one illuminance before and behind it: small ones.
  scenes::AddRoom(scene.Surfaces, {-1.2, -0.8, -0.8}, {1.2, 0.8, 1.6}, 0.1, 0.5);
  scenes::AddRectangle(scene.Surfaces, {-1.2, -0.8, 1.23}, {0, 1.6, 0}, {2.4, 0, -0.91}, 5, 8, 0.5);
  scene.Emitters =
    scenes::Barcode({1.2, 0.1, -0.1}, {-1, 0, 0}, {0, 0, 1}, 0.5, 0.25, 5, 100.0, 0, 0.1);
  scene.Emitters.push_back(
    scenes::Plate({-0.3, 0.3, 0.7}, {0, 0, -1}, {1, 0, 0}, 0.3, 0.2, 30.0, 0.5));
  CheckScene(scene, {-1.0, -0.1, 0.2},
    {{{-1.1, -0.6, 1.1}, glm::normalize(Vec3(2.4, 0.6, -0.92))},
      {{-1.1, 0.0, 0.9}, glm::normalize(Vec3(2.2, 0.1, -0.7))}},
    samples);
}

/// A column of 24 sides between the observer and a lamp, in a room between cell faces.
void CheckColumn(std::uint64_t samples)
{
  report::Head("Round column");
  SceneDescription scene = SmokeAround(0.8, 0.8);
  scenes::AddRoom(scene.Surfaces, {-1.4, -1.0, -0.8}, {1.4, 1.0, 0.8}, 0.3, 0.5);
  constexpr int Sides = 24;
  const Vec3 foot(0.13, 0.17, -0.8);
  const auto corner = [&foot](int side)
  {
    const double angle = 2.0 * pi * side / Sides;
    return foot + 0.33 * Vec3(std::cos(angle), std::sin(angle), 0.0);
  };
  for (int side = 0; side < Sides; ++side)
  {
    scenes::AddRectangle(
      scene.Surfaces, corner(side), corner(side + 1) - corner(side), {0, 0, 1.6}, 1, 5, 0.5);
  }
  scene.Emitters =
    scenes::Barcode({1.4, -0.5, 0.1}, {-1, 0, 0}, {0, 0, 1}, 0.5, 0.25, 5, 100.0, 0, 0.1);
  scene.Emitters.push_back(
    scenes::Plate({0.9, 0.6, 0.7}, {0, 0, -1}, {1, 0, 0}, 0.3, 0.2, 60.0, 0.5));
  // Past the column on its dark side, where half the cells are its inside, and on its bright one.
  CheckScene(scene, {-1.1, -0.4, 0.1},
    {{{-1.3, -0.27, 0.2}, glm::normalize(Vec3(2.6, 0.25, -0.1))},
      {{0.52, -0.9, 0.0}, glm::normalize(Vec3(0.02, 1.8, 0.2))}},
    samples);
}

TEST(CutCells, ThinWall)
{
  CheckThinWall(30000);
}

TEST(CutCells, SlopedCeiling)
{
  CheckSlopedCeiling(30000);
}

TEST(CutCells, RoundColumn)
{
  CheckColumn(30000);
}

TEST(CutCells, AllLong)
{
  CheckThinWall(1000000);
  CheckSlopedCeiling(1000000);
  CheckColumn(1000000);
}

} // namespace
