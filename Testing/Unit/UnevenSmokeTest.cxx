// Light of a far sign that smoke dims unevenly: through the border of a layer.
#include "DirectLight.h"
#include "LightField.h"
#include "RisingProgress.h"
#include "Scene.h"
#include "SceneLibrary.h"
#include "Solved.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

/// Fluence by a sum over many places of each cell of the sign, each with its own way.
double Summed(const Scene& scene, const Vec3& point)
{
  constexpr int Across = 4;
  constexpr int Up = 80;
  double sum = 0.0;
  for (const EmitterCell& cell : scene.Lights().Cells())
  {
    Vec3 across = cell.Vertices[1] - cell.Vertices[0];
    Vec3 up = cell.Vertices[3] - cell.Vertices[0];
    if (std::abs(across.z) > std::abs(up.z))
    {
      std::swap(across, up);
    }
    const double area = glm::length(glm::cross(across, up)) / (Across * Up);
    for (int i = 0; i < Across * Up && cell.Luminance[0] > 0.0; ++i)
    {
      const Vec3 place =
        cell.Vertices[0] + (i % Across + 0.5) / Across * across + (i / Across + 0.5) / Up * up;
      const double distance = glm::length(point - place);
      const Vec3 way = (point - place) / distance;
      const double depth = scene.Smoke().OpticalDepth(place, way, 0.0, distance);
      sum += cell.Luminance[0] * area * std::abs(way.x) / (distance * distance) * std::exp(-depth);
    }
  }
  return sum;
}

double AtPoint(const Scene& scene, const Vec3& point)
{
  const DirectLight direct(scene);
  double sum = 0.0;
  for (std::size_t light = 0; light < scene.Lights().Lights().size(); ++light)
  {
    sum += direct.Fluence(light, point)[0];
  }
  return sum;
}

// Below the layer, far from the sign, its upper part is seen through the layer; from within it ways
// to the upper edge are far longer in it than those to the lower. One way for all was up to 15 %
// off.
TEST(UnevenSmoke, FarPlateAtAPoint)
{
  for (const double height : {1.8, 1.9, 1.98, 2.05})
  {
    const Scene scene(scenes::LayeredCorridor(height, 0.0, 0.0));
    for (const Vec3& point : {Vec3(26, 1.2, 1.9), Vec3(22, 0.7, 1.7), Vec3(15, 1.2, 0.5),
           Vec3(5, 1.9, 1.6), Vec3(22, 1.2, 2.3), Vec3(26, 1.2, 2.1)})
    {
      // The way to the centre stands for all where that is right to a percent.
      EXPECT_NEAR(AtPoint(scene, point) / Summed(scene, point), 1.0, 0.012)
        << height << ": " << point.x << ' ' << point.z;
    }
  }
}

// Means over thin cells.
TEST(UnevenSmoke, CellMeans)
{
  const Solved solved(scenes::LayeredCorridor(1.98, 0.0, 0.0), 0.01);
  const Scene& scene = *solved.TheScene;
  for (const Vec3& point :
    {Vec3(24.1, 1.1, 1.9), Vec3(20.1, 1.1, 1.5), Vec3(12.1, 1.1, 0.3), Vec3(6.1, 0.3, 1.9)})
  {
    constexpr int Edge = 6;
    const std::int64_t cell = scene.Smoke().Locate(point);
    const Box box = scene.Smoke().BoxOf(cell);
    double mean = 0.0;
    for (int i = 0; i < Edge * Edge * Edge; ++i)
    {
      const Vec3 place(i % Edge, i / Edge % Edge, i / (Edge * Edge));
      mean += Summed(scene, box.Lower + (place + 0.5) / double{Edge} * box.Size());
    }
    mean /= Edge * Edge * Edge;
    // Two places stand for the cell.
    EXPECT_NEAR(solved.Fluence(box.Centre()).Mean / mean, 1.0, 0.015) << point.x << ' ' << point.z;
  }
}

/// The end of the corridor on cells far smaller than its sign, with the smoke of a coarser grid
/// that is like noise below the layer.
SceneDescription FineCorridor()
{
  SceneDescription scene = scenes::LayeredCorridor(1.98, 0.0, 0.0);
  const Vec3 lower(18.0, 0.0, 0.0);
  const Vec3 upper(30.0, 2.4, 2.7);
  const SmokeGrid coarse = scenes::NoisySmoke(lower, upper, {30, 6, 9}, 0.05, 0.2, 1);
  SmokeGrid fine = scenes::UniformSmoke(lower, upper, {120, 24, 27}, 1.0);
  for (int number = 0; number < 120 * 24 * 20; ++number)
  {
    const int i = number % 120;
    const int j = number / 120 % 24;
    const int k = number / (120 * 24);
    fine.Extinction[number] = coarse.Extinction[i / 4 + 30 * (j / 4 + 6 * (k / 3))];
  }
  scene.Grids = {fine};
  return scene;
}

// Cells at the corners of a block tell of others how unevenly smoke dims the sign, and the centre
// of a fine cell tells of all of it: against all cells by themselves, and, where the two differ
// most, against a sum over places of the sign (so are both right to 3 % at worst).
TEST(UnevenSmoke, FineCellsTellOfOthers)
{
  const Solved told(FineCorridor(), 0.01);
  LightFieldOptions options;
  options.Skips = false;
  RisingProgress progress;
  const LightField alone = SolveLightField(*told.TheScene, options, progress);
  const double brightest =
    *std::max_element(alone.DirectFluence.begin(), alone.DirectFluence.end());
  double squares = 0.0;
  std::size_t count = 0;
  std::size_t changed = 0;
  for (std::size_t cell = 0; cell < alone.Cells; ++cell)
  {
    if (!(alone.DirectFluence[cell] > 1e-6 * brightest))
    {
      continue;
    }
    const double change = told.Field->DirectFluence[cell] / alone.DirectFluence[cell] - 1.0;
    squares += change * change;
    ++count;
    changed += std::abs(change) > 1e-4 ? 1 : 0;
    if (std::abs(change) > 0.02)
    {
      const Vec3 centre = told.TheScene->Smoke().CellCentre(static_cast<std::int64_t>(cell));
      const double summed = Summed(*told.TheScene, centre);
      EXPECT_NEAR(told.Field->DirectFluence[cell] / summed, 1.0, 0.03)
        << centre.x << ' ' << centre.y << ' ' << centre.z;
    }
  }
  EXPECT_GT(changed, 1000U);
  const char* const what = "looks at far lights through uneven smoke not taken";
  EXPECT_GT(WorkCount(told.Field->Report, what), 1000.0);
  EXPECT_EQ(WorkCount(alone.Report, what), 0.0);
  EXPECT_LT(std::sqrt(squares / static_cast<double>(count)), 0.002);
}

} // namespace
