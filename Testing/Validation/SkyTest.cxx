// Daylight: a uniform sky against closed forms.
#include "SceneLibrary.h"
#include "Solved.h"
#include "TestReport.h"

#include <cmath>
#include <numbers>
#include <numeric>

namespace
{

using namespace smokevis;
using std::numbers::pi;
constexpr double Sky = 1000.0;

/// E3(x), the exponential integral, by Simpson's rule over mu: integral of mu exp(-x / mu).
double E3(double x)
{
  constexpr int steps = 20000;
  double sum = 0.0;
  for (int i = 1; i <= steps; ++i)
  {
    const double mu = static_cast<double>(i) / steps;
    sum += (i == steps ? 1.0 : i % 2 == 1 ? 4.0 : 2.0) * mu * std::exp(-x / mu);
  }
  return sum / (3.0 * steps);
}

// Nothing hides the sky: illuminance pi L on every face, fluence 4 pi L, luminance L.
TEST(Sky, Unhidden)
{
  report::Head("Under an open sky of 1000 cd/m2");
  SceneDescription scene;
  scene.Sky = Sky;
  scene.Grids = {scenes::UniformSmoke(Vec3(0.0), {4, 4, 2}, {8, 8, 4}, 0.0)};
  scenes::AddRectangle(scene.Surfaces, {1, 1, 1}, {2, 0, 0}, {0, 2, 0}, 2, 2, 0.0);
  const Solved solved(std::move(scene), 1e-3);
  report::Relative("plate, above", pi * Sky, solved.Illuminance({0, 1, 2, 3}, 0).Mean, 1e-3);
  report::Relative("plate, below", pi * Sky, solved.Illuminance({0, 1, 2, 3}, 1).Mean, 1e-3);
  report::Relative("luminance", Sky, solved.Luminance({{0.5, 0.5, 1.5}, {0, 0, 1}}).Mean, 1e-12);
  SceneDescription empty;
  empty.Sky = Sky;
  empty.Grids = {scenes::UniformSmoke(Vec3(0.0), {4, 4, 2}, {8, 8, 4}, 0.0)};
  const Solved air(std::move(empty), 1e-3);
  std::vector<std::int64_t> cells(air.TheScene->Smoke().Cells());
  std::iota(cells.begin(), cells.end(), 0);
  report::Relative("fluence", 4.0 * pi * Sky, air.Fluence(cells).Mean, 1e-3);
}

/// A tunnel of 2 x 1 x 1 m, open at both ends.
SceneDescription OpenTunnel(double albedo, double reflectance, double patch, SmokeGrid smoke)
{
  SceneDescription scene;
  scene.Sky = Sky;
  scene.Albedo = albedo;
  scene.Grids = {std::move(smoke)};
  scenes::AddRoom(scene.Surfaces, Vec3(0.0), {2, 1, 1}, patch, reflectance);
  // Without the walls at low and high x.
  SurfaceMesh& mesh = scene.Surfaces;
  for (std::size_t i = mesh.Triangles.size(); i-- > 0;)
  {
    const auto& [a, b, c] = mesh.Triangles[i];
    if (mesh.Points[a].x == mesh.Points[b].x && mesh.Points[a].x == mesh.Points[c].x)
    {
      mesh.Triangles.erase(mesh.Triangles.begin() + static_cast<std::ptrdiff_t>(i));
      mesh.TriangleCell.erase(mesh.TriangleCell.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }
  return scene;
}

// What neither absorbs nor emits does not show under a sky that is the same all around: smoke of
// albedo 1 and white walls, open at both ends, have the sky's luminance everywhere.
TEST(Sky, Furnace)
{
  report::Head("White tunnel, white smoke, open at both ends, under a sky of 1000 cd/m2");
  const Solved solved(
    OpenTunnel(1.0, 1.0, 0.25, scenes::UniformSmoke(Vec3(0.0), {2, 1, 1}, {12, 6, 6}, 0.8)));
  std::vector<std::int64_t> cells(solved.TheScene->Smoke().Cells());
  for (std::size_t cell = 0; cell < cells.size(); ++cell)
  {
    cells[cell] = static_cast<std::int64_t>(cell);
  }
  const Estimate fluence = solved.Fluence(cells);
  // The start that has not settled is the bias that the tolerance of 0.01 allows.
  report::Relative("mean fluence", 4.0 * pi * Sky, fluence.Mean, 0.01, fluence.StandardError);
  const Estimate luminance = solved.Luminance({{1.9, 0.5, 0.5}, {-1, 0.1, 0.05}});
  report::Relative("luminance", Sky, luminance.Mean, 0.01, luminance.StandardError);
}

// The same with grey walls and noisy smoke against the path tracer, which is held to a closed form
// first: unhidden, a layer that absorbs lets 2 pi L E3(1) through.
TEST(Sky, GreyTunnel)
{
  report::Head("Daylight in a grey tunnel with noisy smoke, against the path tracer");
  SceneDescription layer;
  layer.Sky = Sky;
  layer.Albedo = 0.0;
  layer.Grids = {scenes::UniformSmoke({-500, -500, 0}, {500, 500, 1}, {1, 1, 1}, 1.0)};
  scenes::AddRectangle(layer.Surfaces, {-500, -500, 0}, {1000, 0, 0}, {0, 1000, 0}, 1, 1, 0.0);
  const Scene open(layer);
  const Estimate through = ReferenceIntegrator(open).Illuminance({0, 0, 0}, {0, 0, 1}, 200000, 1);
  report::Relative("the path tracer's light through a layer", 2.0 * pi * Sky * E3(1.0),
    through.Mean, 0.001, through.StandardError);

  const Solved solved(OpenTunnel(
    0.7, 0.5, 0.1, scenes::NoisySmoke(Vec3(0.0), Vec3(2, 1, 1), {12, 6, 6}, 0.2, 3.0, 3)));
  const ReferenceIntegrator reference(*solved.TheScene);
  for (const Vec3& towards : {Vec3(1.9, 0.2, 0.7), Vec3(1.0, 0.98, 0.3), Vec3(2.1, 0.5, 0.5)})
  {
    const Vec3 eye(0.9, 0.5, 0.45);
    const Ray ray{eye, glm::normalize(towards - eye)};
    const Estimate expected = reference.Radiance(ray, 400000, 2);
    const Estimate value = solved.Luminance(ray);
    report::Relative("luminance towards " + std::to_string(towards.x).substr(0, 3), expected.Mean,
      value.Mean, 0.01, std::hypot(expected.StandardError, value.StandardError));
  }
}

// Through smoke that absorbs: L exp(-K s) along a line, and under a wide layer of optical depth 1
// an illuminance of 2 pi L E3(1).
TEST(Sky, BeerLambert)
{
  report::Head("Sky through absorbing smoke");
  SceneDescription scene;
  scene.Sky = Sky;
  scene.Albedo = 0.0;
  scene.Grids = {scenes::UniformSmoke({-20, -20, 0}, {20, 20, 1}, {20, 20, 4}, 1.0)};
  scenes::AddRectangle(scene.Surfaces, {-20, -20, 0}, {40, 0, 0}, {0, 40, 0}, 10, 10, 0.0);
  const Solved solved(std::move(scene));
  const Vec3 up = glm::normalize(Vec3(0.3, 0.0, 1.0));
  report::Relative(
    "luminance", Sky * std::exp(-0.7 / up.z), solved.Luminance({{0, 0, 0.3}, up}).Mean, 1e-6);
  // From the patches in the middle the edge is 16 m away.
  std::vector<std::size_t> middle;
  for (std::size_t j = 1; j < 9; ++j)
  {
    for (std::size_t i = 1; i < 9; ++i)
    {
      middle.push_back(i + 10 * j);
    }
  }
  const Estimate below = solved.Illuminance(middle, 0);
  report::Relative("illuminance", 2.0 * pi * Sky * E3(1.0), below.Mean, 0.002, below.StandardError);
}

/// Configuration factor from a small plate to a rectangle, width a and height b, upright on the
/// plate's plane at a distance c, one of its lower corners straight ahead (Hottel 1931).
double WindowFactor(double a, double b, double c)
{
  const double y = std::hypot(b, c);
  return (std::atan(a / c) - c / y * std::atan(a / y)) / (2.0 * pi);
}

// A dark room with a window: on the floor E = pi L times the window's configuration factor. What
// its walls reflect, for there to be something to see, is at most a permille of that.
TEST(Sky, Window)
{
  report::Head("Daylight on the floor of a black room through a window [lx]");
  SceneDescription scene;
  scene.Sky = Sky;
  const Vec3 size(6, 4, 3);
  constexpr double dark = 1e-3;
  scenes::AddRoom(scene.Surfaces, Vec3(0.0), size, 10.0, dark);
  // The wall at low x comes first, one cell of two triangles; four around the window replace it.
  SurfaceMesh& mesh = scene.Surfaces;
  mesh.Triangles.erase(mesh.Triangles.begin(), mesh.Triangles.begin() + 2);
  mesh.TriangleCell.erase(mesh.TriangleCell.begin(), mesh.TriangleCell.begin() + 2);
  const double low = 1.0;
  const double high = 2.5;
  const double left = 1.0;
  const double right = 3.0;
  scenes::AddRectangle(mesh, {0, 0, 0}, {0, 4, 0}, {0, 0, low}, 1, 1, dark);
  scenes::AddRectangle(mesh, {0, 0, high}, {0, 4, 0}, {0, 0, 3 - high}, 1, 1, dark);
  scenes::AddRectangle(mesh, {0, 0, low}, {0, left, 0}, {0, 0, high - low}, 1, 1, dark);
  scenes::AddRectangle(mesh, {0, right, low}, {0, 4 - right, 0}, {0, 0, high - low}, 1, 1, dark);
  constexpr int across = 4;
  const std::size_t first =
    scenes::AddRectangle(mesh, {1, 1.5, 0.01}, {4, 0, 0}, {0, 1, 0}, across, 1, dark);
  const Solved solved(std::move(scene), 0.005);
  double sumOfExpected = 0.0;
  std::vector<std::size_t> all;
  for (int cell = 0; cell < across; ++cell)
  {
    // Mean over the cell, on the line through the middle of the window, by a fine sum.
    double sum = 0.0;
    constexpr int steps = 20;
    for (int i = 0; i < steps; ++i)
    {
      for (int j = 0; j < steps; ++j)
      {
        const double c = 1.0 + cell + (i + 0.5) / steps;
        const double y = 1.5 + (j + 0.5) / steps;
        for (const double a : {right - y, y - left})
        {
          sum += WindowFactor(a, high - 0.01, c) - WindowFactor(a, low - 0.01, c);
        }
      }
    }
    const Estimate value = solved.Illuminance({first + cell}, 0);
    const double expected = pi * Sky * sum / (steps * steps);
    report::Relative(std::to_string(1.5 + cell) + " m from the window", expected, value.Mean, 0.003,
      value.StandardError);
    sumOfExpected += expected;
    all.push_back(first + cell);
  }
  const Estimate mean = solved.Illuminance(all, 0);
  report::Relative("mean", sumOfExpected / across, mean.Mean, 0.003, mean.StandardError);
}

} // namespace
