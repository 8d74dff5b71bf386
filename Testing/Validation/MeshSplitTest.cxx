// A volume cut into two meshes is the same volume.
#include "Contrast.h"
#include "SceneLibrary.h"
#include "Solved.h"
#include "TestReport.h"

#include <cmath>
#include <map>
#include <tuple>

namespace
{

using namespace smokevis;

struct Key
{
  Vec3 Centre;
  bool operator<(const Key& other) const
  {
    return std::tuple(this->Centre.x, this->Centre.y, this->Centre.z) <
           std::tuple(other.Centre.x, other.Centre.y, other.Centre.z);
  }
};

// The same cells, only numbered otherwise: all that may differ is the rounding of sums.
TEST(MeshSplit, SameNumbersAsOneMesh)
{
  for (const int axis : {0, 2})
  {
    report::Head(std::string("One mesh cut in two across ") + "xyz"[axis]);
    SceneDescription whole = scenes::Tunnel(1.0, 0.9);
    whole.Grids = {scenes::NoisySmoke(Vec3(0.0), Vec3(4, 1, 1), {40, 10, 10}, 0.5, 1.5, 11)};
    SceneDescription cut = whole;
    const auto parts = scenes::Split(whole.Grids[0], axis, axis == 0 ? 17 : 4);
    cut.Grids = {parts.first, parts.second};
    const Solved one(whole);
    const Solved two(cut);

    const Medium& smoke = one.TheScene->Smoke();
    std::map<Key, std::int64_t> cellAt;
    for (std::size_t i = 0; i < smoke.Cells(); ++i)
    {
      const auto cell = static_cast<std::int64_t>(i);
      cellAt[{smoke.CellCentre(cell)}] = cell;
    }
    double worstDirect = 0.0;
    double worstTotal = 0.0;
    for (std::size_t i = 0; i < two.TheScene->Smoke().Cells(); ++i)
    {
      const auto cell = static_cast<std::int64_t>(i);
      const auto same = cellAt.find({two.TheScene->Smoke().CellCentre(cell)});
      ASSERT_NE(same, cellAt.end());
      const double a = one.Field->DirectFluence[static_cast<std::size_t>(same->second)];
      const double b = two.Field->DirectFluence[i];
      worstDirect = std::max(worstDirect, std::abs(a - b) / a);
      const double c = one.Fluence(std::vector{same->second}).Mean;
      const double d = two.Fluence(std::vector{cell}).Mean;
      worstTotal = std::max(worstTotal, std::abs(c - d) / c);
    }
    report::Absolute("largest relative change, direct fluence", 0.0, worstDirect, 1e-6);
    // Sums of float tallies, taken in another order, keep 1e-6 each; sweeps feed back on
    // themselves.
    report::Absolute("largest relative change, fluence", 0.0, worstTotal, 1e-5);

    const Vec3 eye = scenes::TunnelEye;
    const RayLight rayOne = one.Trace({eye, glm::normalize(Vec3(4, 0.7, 0.6) - eye)});
    const RayLight rayTwo = two.Trace({eye, glm::normalize(Vec3(4, 0.7, 0.6) - eye)});
    report::Relative("optical depth", rayOne.OpticalDepth, rayTwo.OpticalDepth, 1e-6);
    const Observer observer{0.0};
    const SignMeasurement a = MeasureSign(*one.TheView, 0, eye, observer);
    const SignMeasurement b = MeasureSign(*two.TheView, 0, eye, observer);
    report::Relative("lit luminance", a.LitLuminance, b.LitLuminance, 1e-6);
    report::Relative("unlit luminance", a.UnlitLuminance, b.UnlitLuminance, 1e-5);
    report::Relative("contrast", a.Contrast, b.Contrast, 1e-6);
  }
}

/// A room full of smoke, on cells of 0.5 m and, in its first half, of 0.25 m.
/// @param from where the coarse cells begin
/// @param to where the fine ones end
SceneDescription HalfFineRoom(double from, double to)
{
  SceneDescription scene;
  scene.Albedo = 0.9;
  const Vec3 upper(4, 4, 3);
  scene.Grids = {
    scenes::UniformSmoke({from, 0, 0}, upper, {static_cast<int>(2.0 * (4.0 - from)), 8, 6}, 0.7),
    scenes::UniformSmoke(Vec3(0.0), {to, 4, 3}, {static_cast<int>(4.0 * to), 16, 12}, 0.7)};
  scenes::AddRoom(scene.Surfaces, Vec3(0.0), upper, 0.5, 0.5);
  scene.Emitters = scenes::Barcode({0.01, 2, 2}, {1, 0, 0}, {0, 0, 1}, 0.4, 0.2, 5, 500.0, 0, 0.1);
  return scene;
}

// Coarse cells that a finer mesh lies over hold no light: the finer mesh wins, in the balance of
// powers too, and where it ends inside cells. What is emitted is taken in, to the promised 0.1 %,
// and the light is that of meshes side by side, to the 1 % that is promised.
TEST(MeshSplit, FinerMeshOverCoarse)
{
  const Solved beside(HalfFineRoom(2.0, 2.0), 0.005);
  for (const double to : {2.0, 2.25})
  {
    report::Head("A fine mesh over a coarse one, as far as " + std::to_string(to) + " m");
    const Solved over(HalfFineRoom(0.0, to), 0.005);
    const Estimate smoke = over.AbsorbedInSmoke();
    const Estimate surfaces = over.AbsorbedOnSurfaces();
    report::Relative("power taken in [lm]", over.TheScene->Lights().Flux(0),
      over.PowerBeforeBalance(), 1e-3, std::hypot(smoke.StandardError, surfaces.StandardError));
    for (const Vec3& point : {Vec3(1.1, 2.1, 1.1), Vec3(3.1, 2.1, 1.1), Vec3(3.8, 3.8, 2.8)})
    {
      const Estimate a = beside.Fluence(point);
      const Estimate b = over.Fluence(point);
      EXPECT_LT(b.StandardError, 0.01 * b.Mean);
      report::Relative("fluence at " + std::to_string(point.x) + " m [lx]", a.Mean, b.Mean, 0.01,
        std::hypot(a.StandardError, b.StandardError));
    }
  }
}

// A lamp in what a finer mesh leaves of a coarse cell: that much smoke takes up all of its light.
TEST(MeshSplit, LampInACellPartlyUnderAFinerMesh)
{
  report::Head("Direct light taken up where a finer mesh begins in the middle of cells [lm]");
  for (const double extinction : {0.2, 2.0, 2000.0})
  {
    SceneDescription scene;
    scene.Albedo = 0.0;
    scene.Grids = {scenes::UniformSmoke(Vec3(0.0), Vec3(4.0), {4, 4, 4}, extinction),
      scenes::UniformSmoke(Vec3(0.0), Vec3(1.5), {12, 12, 12}, extinction)};
    scenes::AddRoom(scene.Surfaces, Vec3(0.0), Vec3(4.0), 0.5, 0.0);
    scene.Emitters = {scenes::Plate({1.9, 1.25, 1.3}, {-1, 0, 0}, {0, 0, 1}, 0.2, 0.2, 100.0)};
    const Solved solved(scene);
    report::Relative("extinction " + std::to_string(extinction).substr(0, 6),
      solved.TheScene->Lights().Flux(0), solved.PowerBeforeBalance(), 0.01);
  }
}

// A screen that parts cells of which a finer mesh leaves little: each part is what lines meet of
// it. In their first steps parts took up more light than comes to them, and ever more.
TEST(MeshSplit, ScreenInCellsPartlyUnderAFinerMesh)
{
  report::Head("Power where a screen stands in cells partly under a finer mesh [lm]");
  for (const double albedo : {0.5, 0.99})
  {
    SceneDescription scene;
    scene.Albedo = albedo;
    scene.Grids = {scenes::UniformSmoke(Vec3(0.0), Vec3(4.0), {4, 4, 4}, 8.0),
      scenes::UniformSmoke(Vec3(0.0), {4.0, 4.0, 1.9}, {16, 16, 8}, 8.0)};
    scenes::AddRoom(scene.Surfaces, Vec3(0.0), Vec3(4.0), 0.5, 0.3);
    scenes::AddRectangle(scene.Surfaces, {0.3, 0.2, 1.5}, {3.2, 0, 0.3}, {0, 3.5, 0.25}, 4, 4, 0.5);
    scene.Emitters = {scenes::Plate({2, 2, 2.6}, {0, 0, -1}, {0, 1, 0}, 0.4, 0.4, 100.0)};
    const Solved solved(scene, 0.03);
    const Estimate smoke = solved.AbsorbedInSmoke();
    const Estimate surfaces = solved.AbsorbedOnSurfaces();
    report::Relative("albedo " + std::to_string(albedo).substr(0, 4),
      solved.TheScene->Lights().Flux(0), solved.PowerBeforeBalance(), 0.005,
      std::hypot(smoke.StandardError, surfaces.StandardError));
  }
}

} // namespace
