// How ways to a light get deeper within smoke cells, against closed forms.
#include "LightWays.h"
#include "SceneLibrary.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

constexpr double LayerExtinction = 12.0;
constexpr double CellEdge = 0.05;
/// Height below which there is smoke.
constexpr double Top = 0.6;

LightGroup LightAt(const Vec3& place)
{
  LightGroup light;
  light.Centre = place;
  light.Corners.fill(place);
  return light;
}

/// A mesh of 2 x 1 x 1 m with a layer of smoke on its floor.
Medium Layer()
{
  SmokeGrid grid = scenes::UniformSmoke(Vec3(0.0), {2, 1, 1}, {40, 20, 20}, LayerExtinction);
  for (std::size_t cell = 0; cell < grid.Extinction.size(); ++cell)
  {
    const double height = CellEdge * (static_cast<double>(cell / 800) + 0.5);
    grid.Extinction[cell] = height < Top ? LayerExtinction : 0.0F;
  }
  return Medium({grid});
}

// Above the layer, at a height h above its top, a light shines through a depth z of it along a way
// of length D: the optical depth is K D z / (z + h).
TEST(Deepening, LightFallsAslantIntoALayer)
{
  const Medium smoke = Layer();
  const Vec3 place(0.05, 0.47, 1.1);
  const LightGroup light = LightAt(place);
  const LightWays ways(smoke, 1.0, light);
  // The last cells before the mesh ends have none behind them.
  for (const glm::dvec2& column : {glm::dvec2(0.225, 0.525), glm::dvec2(0.625, 0.525),
         glm::dvec2(1.025, 0.525), glm::dvec2(1.775, 0.525), glm::dvec2(1.975, 0.525),
         glm::dvec2(0.625, 0.975), glm::dvec2(1.975, 0.975)})
  {
    for (const double depth : {0.025, 0.075, 0.225, 0.525, 0.575})
    {
      const Vec3 centre(column, Top - depth);
      const Vec3 from = centre - place;
      const Deepening around = ways.DeepeningOf(smoke.Locate(centre));
      const auto exact = [&](const Vec3& step)
      {
        const Vec3 way = from + step;
        return LayerExtinction * glm::length(way) * (depth - step.z) / -way.z;
      };
      const double here = exact(Vec3(0.0));
      EXPECT_NEAR(around.Mean, here / glm::length(from), 1e-6 * LayerExtinction);
      for (int axis = 0; axis < 3; ++axis)
      {
        Vec3 step(0.0);
        for (const double size : {-0.5 * CellEdge, 0.5 * CellEdge})
        {
          step[axis] = size;
          // Of the depth along an edge in even smoke, a fiftieth; twice that where nothing tells of
          // what is behind.
          const bool last = column.x > 1.95 || column.y > 0.95 || depth > 0.55;
          EXPECT_NEAR(around.At(from, step), exact(step) - here,
            (last ? 0.04 : 0.02) * LayerExtinction * CellEdge)
            << "at " << column.x << ", " << column.y << ", depth " << depth << ", axis " << axis
            << ", step " << size;
        }
      }
    }
  }
}

// In even smoke the depth goes with the distance.
TEST(Deepening, EvenSmoke)
{
  const Medium smoke({scenes::UniformSmoke(Vec3(0.0), {2, 1, 1}, {40, 20, 20}, LayerExtinction)});
  const Vec3 place(0.21, 0.47, 0.93);
  const LightGroup light = LightAt(place);
  const LightWays ways(smoke, 1.0, light);
  const Vec3 centre(0.525, 0.325, 0.425);
  const Vec3 from = centre - place;
  const Deepening around = ways.DeepeningOf(smoke.Locate(centre));
  const Vec3 step(0.02, -0.013, 0.017);
  EXPECT_NEAR(
    around.At(from, step), LayerExtinction * (glm::length(from + step) - glm::length(from)), 1e-9);
  EXPECT_NEAR(around.Moved(from, step).At(from + step, -step), -around.At(from, step), 1e-9);
}

/// The same of two of three cells, unless a finer mesh covers them, from those of halves of blocks.
/// @param visit(cell, alone, in a block)
/// @return how many ways from around the blocks were told
template <class Visit>
std::size_t ForEachInBlocks(
  const Medium& smoke, const LightGroup& light, const std::optional<double>& allowed, Visit&& visit)
{
  std::size_t told = 0;
  const LightWays alone(smoke, 1.0, light);
  for (const Medium::Block& whole : smoke.Blocks(8))
  {
    const LightWays ways(smoke, 1.0, light, whole);
    const int half = (whole.Size[0] + 1) / 2;
    for (const int first : {0, half})
    {
      Medium::Block block = whole;
      block.First[0] += first;
      block.Size[0] = std::min(half, whole.Size[0] - first);
      std::vector<bool> asked(block.Cells());
      for (std::size_t cell = 0; cell < asked.size(); ++cell)
      {
        asked[cell] = cell % 3 != 1;
      }
      // Of some cells the ways are known.
      std::vector<double> known(block.Cells(), std::numeric_limits<double>::quiet_NaN());
      block.ForEachCell(
        [&](const std::array<int, 3>& place)
        {
          if (place[1] % 2 == 0)
          {
            known[block.Number(place)] = alone.Extinction(smoke.Cell(block, place));
          }
        });
      const std::vector<Deepening> around =
        ways.DeepeningIn(block, asked, known, allowed, false, told);
      block.ForEachCell(
        [&](const std::array<int, 3>& place)
        {
          const std::int64_t cell = smoke.Cell(block, place);
          const std::size_t number = block.Number(place);
          if (asked[number] && !smoke.Covered(cell))
          {
            visit(cell, alone.DeepeningOf(cell), around[number]);
          }
        });
    }
  }
  return told;
}

// Ways that the cells of a block share are the same as those that each cell walks for itself, also
// those from beyond the block's faces and beyond the mesh, where a finer mesh begins.
TEST(Deepening, OfCellsThatShareTheirWays)
{
  SmokeGrid coarse = scenes::UniformSmoke(Vec3(0.0), {2, 1, 1}, {20, 10, 10}, LayerExtinction);
  SmokeGrid fine = scenes::UniformSmoke(Vec3(0.55, 0.2, 0.3), {1.2, 1, 1.25}, {13, 16, 19}, 2.0);
  for (std::size_t cell = 0; cell < coarse.Extinction.size(); ++cell)
  {
    coarse.Extinction[cell] *= 0.1F + static_cast<float>(cell * 37 % 101) / 50.0F;
  }
  const Medium smoke({coarse, fine});
  const std::size_t told = ForEachInBlocks(smoke, LightAt({0.05, 0.47, 1.6}), std::nullopt,
    [](std::int64_t cell, const Deepening& alone, const Deepening& shared)
    {
      EXPECT_EQ(shared.Slope, alone.Slope) << "cell " << cell;
      EXPECT_EQ(shared.Bend, alone.Bend) << "cell " << cell;
      EXPECT_EQ(shared.Entry, alone.Entry) << "cell " << cell;
      EXPECT_EQ(shared.Mean, alone.Mean) << "cell " << cell;
    });
  EXPECT_EQ(told, 0U);
}

// Where smoke changes slowly, a few ways from the layer across a face of a block tell the others,
// to the error that is allowed: a slope is off by no more than that over the length of a cell.
TEST(Deepening, ToldFromBeyondABlock)
{
  SmokeGrid grid = scenes::UniformSmoke(Vec3(0.0), {2, 1, 1}, {40, 20, 20}, LayerExtinction);
  for (std::size_t cell = 0; cell < grid.Extinction.size(); ++cell)
  {
    grid.Extinction[cell] *= 1.0F + 0.3F * std::sin(0.05F * static_cast<float>(cell % 40));
  }
  const Medium smoke({grid});
  constexpr double allowed = 0.004;
  double largest = 0.0;
  const std::size_t told = ForEachInBlocks(smoke, LightAt({6.0, 4.0, 3.0}), allowed,
    [&](std::int64_t, const Deepening& alone, const Deepening& shared)
    {
      const Vec3 off = glm::abs(shared.Slope - alone.Slope);
      largest = std::max({largest, off.x, off.y, off.z});
    });
  EXPECT_GT(largest, 0.0);
  EXPECT_LE(largest * CellEdge, allowed);
  EXPECT_GT(told, 1000U);
}

// From the light's own place ways lead to all sides alike.
TEST(Deepening, AtTheLight)
{
  const Medium smoke = Layer();
  const Vec3 centre(0.525, 0.525, 0.575);
  const LightGroup light = LightAt(centre);
  const Deepening around = LightWays(smoke, 1.0, light).DeepeningOf(smoke.Locate(centre));
  const Vec3 step(0.0, 0.01, 0.02);
  EXPECT_EQ(around.Slope, Vec3(0.0));
  EXPECT_NEAR(around.At(Vec3(0.0), step), LayerExtinction * glm::length(step), 1e-9);
  EXPECT_NEAR(around.Moved(Vec3(0.0), step).At(step, -step), -around.At(Vec3(0.0), step), 1e-9);
}

// Beside the smoke's edge, which the light shines along, ways are as deep as farther inside.
TEST(Deepening, BesideALateralBorder)
{
  SmokeGrid grid = scenes::UniformSmoke(Vec3(0.0), {2, 1, 1}, {40, 20, 20}, LayerExtinction);
  for (std::size_t cell = 0; cell < grid.Extinction.size(); ++cell)
  {
    grid.Extinction[cell] = cell % 40 < 20 ? LayerExtinction : 0.0F;
  }
  const Medium smoke({grid});
  const LightGroup light = LightAt({0.4, 0.5, 3.0});
  const LightWays ways(smoke, 1.0, light);
  const Vec3 inside(0.925, 0.525, 0.225);
  const Vec3 beside(0.975, 0.525, 0.225);
  const double far = ways.DeepeningOf(smoke.Locate(inside)).Slope.x;
  const double near = ways.DeepeningOf(smoke.Locate(beside)).Slope.x;
  EXPECT_GT(far, 0.0);
  EXPECT_GE(near, 0.0);
  EXPECT_LE(near, 2.0 * far);
}

} // namespace
