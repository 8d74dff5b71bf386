// Attenuation through many cells of different smoke: an analytic sum.
#include "Contrast.h"
#include "SceneLibrary.h"
#include "Solved.h"
#include "TestReport.h"

#include <array>
#include <cmath>
#include <string>

namespace
{

using namespace smokevis;

/// Sum of extinction times the length in each cell, by clipping the line against every cell.
double AnalyticDepth(const SmokeGrid& grid, const Vec3& from, const Vec3& to)
{
  const Vec3 offset = to - from;
  double depth = 0.0;
  std::size_t cell = 0;
  for (std::size_t k = 1; k < grid.Nodes[2].size(); ++k)
  {
    for (std::size_t j = 1; j < grid.Nodes[1].size(); ++j)
    {
      for (std::size_t i = 1; i < grid.Nodes[0].size(); ++i, ++cell)
      {
        const std::array<std::size_t, 3> index = {i, j, k};
        double enter = 0.0;
        double leave = 1.0;
        for (int axis = 0; axis < 3; ++axis)
        {
          const double low = (grid.Nodes[axis][index[axis] - 1] - from[axis]) / offset[axis];
          const double high = (grid.Nodes[axis][index[axis]] - from[axis]) / offset[axis];
          enter = std::max(enter, std::min(low, high));
          leave = std::min(leave, std::max(low, high));
        }
        depth += grid.Extinction[cell] * std::max(0.0, leave - enter) * glm::length(offset);
      }
    }
  }
  return depth;
}

// Rounding of sums of a few hundred pieces in double precision is far below 1e-6; that figure
// leaves room for float cell values only.
TEST(BeerLambert, SignThroughHeterogeneousSmoke)
{
  report::Head("Beer-Lambert through 40 x 20 x 20 random cells");
  SceneDescription description;
  description.Albedo = 0.0;
  description.Grids = {scenes::NoisySmoke(Vec3(0.0), Vec3(6, 3, 3), {40, 20, 20}, 0.0, 2.0, 3)};
  description.Emitters = {
    scenes::Plate({6, 1.5, 1.5}, {-1, 0, 0}, {0, 0, 1}, 0.4, 0.4, 100.0, 0.0, 0)};
  const SmokeGrid grid = description.Grids[0];
  const Solved solved(description);
  Pcg32 random(1, 1);
  for (int i = 0; i < 10; ++i)
  {
    const Vec3 eye(3.0 * random.Uniform(), 3.0 * random.Uniform(), 3.0 * random.Uniform());
    const Vec3 target(6.0, 1.3 + 0.4 * random.Uniform(), 1.3 + 0.4 * random.Uniform());
    const RayLight light = solved.Trace({eye, glm::normalize(target - eye)});
    const double depth = AnalyticDepth(grid, eye, target);
    const std::string name = "ray " + std::to_string(i);
    report::Relative(name + " optical depth", depth, light.OpticalDepth, 1e-6);
    report::Relative(name + " luminance", 100.0 * std::exp(-depth), light.Total(), 1e-6);
  }
}

/// Standard deviation over mean of what is seen of a sign through smoke that scatters nothing and
/// glows with one luminance [cd/m2], by solid angle over many places of each of its cells; and the
/// mean [cd/m2].
std::array<double, 2> SeenThrough(const SceneDescription& scene, const Vec3& eye, double glow)
{
  constexpr int Places = 40;
  double solid = 0.0;
  double first = 0.0;
  double second = 0.0;
  for (const EmitterCell& cell : scene.Emitters)
  {
    const Vec3 along = cell.Vertices[1] - cell.Vertices[0];
    const Vec3 up = cell.Vertices[3] - cell.Vertices[0];
    const Vec3 normal = glm::cross(along, up);
    for (int i = 0; i < Places; ++i)
    {
      for (int j = 0; j < Places; ++j)
      {
        const Vec3 place = cell.Vertices[0] + (i + 0.5) / Places * along + (j + 0.5) / Places * up;
        const double distance = glm::length(place - eye);
        const double weight = std::abs(glm::dot(normal, place - eye)) / std::pow(distance, 3.0);
        const double through = std::exp(-AnalyticDepth(scene.Grids[0], eye, place));
        const double luminance = cell.Luminance[0] * through + glow * (1.0 - through);
        solid += weight;
        first += weight * luminance;
        second += weight * luminance * luminance;
      }
    }
  }
  const double mean = first / solid;
  return {std::sqrt(second / solid - mean * mean) / mean, mean};
}

/// A layer of smoke with a soft lower edge under the ceiling, in front of a sign.
SceneDescription LayerBeforeSign(double extinction, double edge)
{
  constexpr int Layers = 30;
  SceneDescription scene;
  scene.Albedo = 0.0;
  scene.Grids = {scenes::UniformSmoke(Vec3(0.0), Vec3(12, 4, 3), {1, 1, Layers}, 0.0)};
  for (int layer = 0; layer < Layers; ++layer)
  {
    const double height = 3.0 * (layer + 0.5) / Layers;
    scene.Grids[0].Extinction[layer] =
      static_cast<float>(0.05 + extinction / (1.0 + std::exp(-(height - edge) / 0.1)));
  }
  return scene;
}

// At the edge of a layer smoke dims one row of a sign much more than the next. What is asked of
// contrasts at any place is asked here, too.
TEST(BeerLambert, SignAtTheEdgeOfALayer)
{
  report::Head("Contrast and mean luminance of a sign at the edge of a layer, by Beer-Lambert");
  for (const double extinction : {1.0, 2.0, 4.0})
  {
    for (const double edge : {1.9, 2.1, 2.2})
    {
      SceneDescription scene = LayerBeforeSign(extinction, edge);
      scene.Emitters = scenes::Barcode({12, 2, 2.2}, {-1, 0, 0}, {0, 0, 1}, 0.4, 0.2, 5, 200.0, 0);
      const Solved solved(scene);
      for (const double x : {3.0, 9.0})
      {
        const Vec3 eye(x, 1.5, 1.7);
        const auto [contrast, mean] = SeenThrough(scene, eye, 0.0);
        const SignMeasurement sign = MeasureSign(*solved.TheView, 0, eye, Observer{0.0});
        const std::string name = std::to_string(extinction).substr(0, 1) + " per m from " +
                                 std::to_string(edge).substr(0, 3) + " m, from " +
                                 std::to_string(12.0 - x).substr(0, 1) + " m off: ";
        report::Absolute(name + "contrast", contrast, sign.Contrast, 0.005);
        report::Relative(name + "mean", mean, sign.MeanLuminance, 0.005);
      }
    }
  }
}

// Where smoke glows, what it adds grows where it dims a sign: the sign fades away with its
// surroundings, and one as bright as the smoke shows nothing at all. The veil before a plate is
// known along a few rays, which leaves 0.006; aslant and close by, 0.5 % of a mean luminance.
TEST(BeerLambert, SignBehindALayerThatGlows)
{
  report::Head("Contrast of a sign behind the edge of a layer that glows");
  for (const double glow : {20.0, 60.0, 200.0})
  {
    SceneDescription scene = LayerBeforeSign(1.0, 2.1);
    scene.Grids[0].EmittedLuminance.assign(
      scene.Grids[0].Extinction.size(), static_cast<float>(glow));
    for (const bool whole : {false, true})
    {
      const Vec3 centre(12, 2, 2.2);
      scene.Emitters =
        scenes::Barcode(centre, {-1, 0, 0}, {0, 0, 1}, 0.4, 0.2, whole ? 1 : 5, 200.0, 0);
      const Solved solved(scene);
      for (const Vec3& eye :
        {Vec3(3, 1.5, 1.7), Vec3(9, 1.5, 1.7), Vec3(11.2, 0.2, 1.7), Vec3(11.5, 0.2, 1.7)})
      {
        const auto [contrast, mean] = SeenThrough(scene, eye, glow);
        const SignMeasurement sign = MeasureSign(*solved.TheView, 0, eye, Observer{0.0});
        const std::string name = "glow of " + std::to_string(static_cast<int>(glow)) + ", " +
                                 (whole ? "plate" : "bars") + ", from " +
                                 std::to_string(12.0 - eye.x).substr(0, 3) + " m off: ";
        report::Absolute(name + "contrast", contrast, sign.Contrast, 0.008);
        report::Relative(name + "mean", mean, sign.MeanLuminance, eye.x > 11.0 ? 0.01 : 0.005);
      }
    }
  }
}

// An optical depth of 1e6 leaves nothing, without underflow doing harm.
TEST(BeerLambert, ExtremeDepths)
{
  report::Head("Beer-Lambert at extreme depths, 4 m path");
  for (const double extinction : {0.0, 1e-30, 1e-9, 10.0, 2.5e5})
  {
    SceneDescription description = scenes::Tunnel(extinction, 0.0);
    const Solved solved(description);
    const Vec3 eye = scenes::TunnelEye;
    const RayLight light = solved.Trace({eye, {1, 0, 0}});
    const double depth = static_cast<float>(extinction) * 3.999;
    report::Relative("optical depth", depth, light.OpticalDepth, 1e-6);
    report::Relative("luminance", std::exp(-depth), light.Total(), 1e-6);
  }
}

} // namespace
