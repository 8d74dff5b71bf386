// Lights that surfaces go through.
#include "PolygonClip.h"
#include "Scene.h"
#include "SceneLibrary.h"
#include "Solved.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

/// A lamp of 0.4 x 0.2 m that shines down, its middle 2 m above the origin.
SceneDescription Lamp()
{
  SceneDescription scene;
  scene.Emitters = {scenes::Plate({0, 0, 2}, {0, 0, -1}, {0, 1, 0}, 0.4, 0.2, 100.0)};
  scene.Grids = {scenes::UniformSmoke(Vec3(-2.0), Vec3(2.0, 2.0, 4.0), {4, 4, 6}, 0.1)};
  return scene;
}

/// Areas of the lights, smallest first.
std::vector<double> Areas(const SceneDescription& description)
{
  const Scene scene(description);
  std::vector<double> areas;
  for (std::size_t light = 0; light < scene.Lights().Lights().size(); ++light)
  {
    areas.push_back(scene.Lights().Root(light).Area);
    EXPECT_NEAR(scene.Lights().Root(light).Intensity[0], 100.0 * areas.back(), 1e-6);
  }
  std::sort(areas.begin(), areas.end());
  return areas;
}

void ExpectAreas(const SceneDescription& scene, const std::vector<double>& expected)
{
  const std::vector<double> areas = Areas(scene);
  ASSERT_EQ(areas.size(), expected.size());
  for (std::size_t i = 0; i < areas.size(); ++i)
  {
    EXPECT_NEAR(areas[i], expected[i], 1e-6);
  }
}

TEST(SurfaceCuts, WallThroughALamp)
{
  ExpectAreas(Lamp(), {0.08});
  SceneDescription scene = Lamp();
  scenes::AddBlock(scene.Surfaces, {0.1, -1.0, 0.0}, {0.15, 1.0, 3.0}, 0.5, 0.5);
  ExpectAreas(scene, {0.01, 0.01, 0.06});
}

// A post below the lamp covers what is right above it, whether it goes through or ends there.
TEST(SurfaceCuts, PostThatStandsOnALamp)
{
  for (const double top : {2.0, 2.5})
  {
    SceneDescription scene = Lamp();
    scenes::AddBlock(scene.Surfaces, {-0.05, -0.3, 0.0}, {0.05, 0.05, top}, 0.5, 0.5);
    const std::vector<double> areas = Areas(scene);
    EXPECT_GE(areas.size(), 4U);
    EXPECT_NEAR(std::accumulate(areas.begin(), areas.end(), 0.0), 0.08, 1e-9);
    EXPECT_TRUE(std::any_of(
      areas.begin(), areas.end(), [](double area) { return std::abs(area - 0.1 * 0.15) < 1e-6; }));
  }
}

// Neither what a lamp hangs on, lies in or ends at divides it, nor what comes close to it,
// or covers as little of its edge as a frame.
TEST(SurfaceCuts, WhatDoesNotGoThroughIt)
{
  const std::vector<std::pair<Vec3, Vec3>> blocks = {{{-1, -1, 2}, {1, 1, 3}},
    {{-0.1, -0.05, 2}, {0.1, 0.05, 3}}, {{0.2, -1, 0}, {0.5, 1, 3}}, {{-1, -1, 0}, {1, 1, 1.99}},
    {{0.194, -1, 0}, {0.5, 1, 3}}};
  for (const auto& [lower, upper] : blocks)
  {
    SceneDescription scene = Lamp();
    scenes::AddBlock(scene.Surfaces, lower, upper, 0.5, 0.5);
    ExpectAreas(scene, {0.08});
  }
}

// A round shape of many triangles makes no swarm of lights.
TEST(SurfaceCuts, BallInALamp)
{
  SceneDescription scene = Lamp();
  constexpr int Steps = 24;
  SurfaceMesh& mesh = scene.Surfaces;
  const auto point = [](int i, int j)
  {
    const double theta = std::numbers::pi * i / Steps;
    const double phi = 2.0 * std::numbers::pi * j / Steps;
    return Vec3(0.08 * std::sin(theta) * std::cos(phi), 0.08 * std::sin(theta) * std::sin(phi),
      2.0 + 0.08 * std::cos(theta));
  };
  for (int i = 0; i < Steps; ++i)
  {
    for (int j = 0; j < Steps; ++j)
    {
      const auto first = static_cast<std::uint32_t>(mesh.Points.size());
      mesh.Points.insert(
        mesh.Points.end(), {point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)});
      mesh.Triangles.push_back({first, first + 1, first + 2});
      mesh.Triangles.push_back({first, first + 2, first + 3});
      mesh.TriangleCell.insert(mesh.TriangleCell.end(), 2, 0);
    }
  }
  mesh.CellReflectance = {{0.5, 0.5, 0.5}};
  ExpectAreas(scene, {0.08});
}

/// A room with a lamp of which a share is in it, the rest behind the wall x = 0.
/// @param turn of the lamp about the vertical [degrees]
/// @param trimmed whether the rest is left out
SceneDescription LampInAWall(double inside, double turn, bool trimmed)
{
  constexpr double Side = 0.4;
  SceneDescription scene;
  scene.Albedo = 0.6;
  scenes::AddRoom(scene.Surfaces, Vec3(0.0), {4.0, 4.0, 3.0}, 0.5, 0.5);
  scene.Grids = {scenes::UniformSmoke(Vec3(0.0), {4.0, 4.0, 3.0}, {16, 16, 12}, 0.3)};
  EmitterCell lamp =
    scenes::Plate({(inside - 0.5) * Side, 0.0, 2.5}, {0, 0, -1}, {0, 1, 0}, Side, Side, 1000.0);
  for (Vec3& corner : lamp.Vertices)
  {
    corner = Vec3(0.0, 2.0, 0.0) + scenes::Rotation(turn, {0, 0, 1}) * corner;
  }
  if (trimmed)
  {
    const std::vector<Vec3> corners = lamp.Vertices;
    KeepSide(
      corners, [](const Vec3& corner) { return corner.x; }, lamp.Vertices);
  }
  scene.Emitters = {lamp};
  return scene;
}

// What of a lamp is behind a wall lights nothing in the room: it gets what the rest alone would
// bring, in all cells to 3 % (those right beside the lamp are cut for it in other boxes), and all
// together to 0.2 %.
TEST(SurfaceCuts, LightOfALampInAWall)
{
  for (const double inside : {0.2, 0.5, 0.8})
  {
    for (const double turn : {0.0, 23.0})
    {
      const Solved whole(LampInAWall(inside, turn, false), 0.05);
      const Solved rest(LampInAWall(inside, turn, true), 0.05);
      const std::vector<float>& fluence = whole.Field->DirectFluence;
      const std::vector<float>& expected = rest.Field->DirectFluence;
      double sum = 0.0;
      double total = 0.0;
      for (std::size_t cell = 0; cell < fluence.size(); ++cell)
      {
        sum += fluence[cell];
        total += expected[cell];
      }
      EXPECT_NEAR(sum / total, 1.0, 2e-3);
      const double least = 0.01 * total / static_cast<double>(fluence.size());
      for (std::size_t cell = 0; cell < fluence.size(); ++cell)
      {
        EXPECT_NEAR(fluence[cell], expected[cell], 0.03 * std::max<double>(expected[cell], least))
          << inside << " inside, turned by " << turn << ", cell " << cell;
      }
    }
  }
}

// A turned sign in the same wall, of few bars and of so many that a lattice stands for them, in
// clear air: what it sends into the room comes to its sides, half of what all of the sign emits.
TEST(SurfaceCuts, SignInAWall)
{
  for (const int bars : {5, 9, 31})
  {
    for (const double turn : {23.0, 45.0})
    {
      SceneDescription scene = LampInAWall(0.5, 0.0, false);
      scene.Grids.clear();
      scene.Emitters = scenes::Barcode(Vec3(0.0), {0, 0, -1}, {0, 1, 0}, 0.6, 0.3, bars, 1000.0, 0);
      for (EmitterCell& cell : scene.Emitters)
      {
        for (Vec3& corner : cell.Vertices)
        {
          corner = Vec3(0.0, 2.0, 2.5) + scenes::Rotation(turn, {0, 0, 1}) * corner;
        }
      }
      const Solved solved(scene, 0.1);
      double power = 0.0;
      for (std::size_t patch = 0; patch < scene.Surfaces.CellReflectance.size(); ++patch)
      {
        power += solved.Field->DirectIlluminance[solved.Field->PatchIndex(0, patch, 0)] *
                 solved.TheScene->PatchArea(patch);
      }
      EXPECT_NEAR(power / (0.5 * solved.TheScene->Lights().Flux(0)), 1.0, 0.01)
        << bars << " bars, turned by " << turn;
    }
  }
}

// Parts beside a wall through the corners of a plate have no corner twice where a leaf begins.
TEST(SurfaceCuts, WallThroughCorners)
{
  std::vector<Vec3> corners;
  for (int corner = 0; corner < 6; ++corner)
  {
    const double angle = std::numbers::pi / 3.0 * corner;
    corners.emplace_back(0.5 * std::cos(angle), 0.5 * std::sin(angle), 0.0);
  }
  for (int first = 0; first < 6; ++first)
  {
    SceneDescription scene = Lamp();
    scene.Emitters[0].Vertices = corners;
    scenes::AddRectangle(scene.Surfaces, {-1, 0, -1}, {2, 0, 0}, {0, 0, 2}, 1, 1, 0.5);
    const Scene made(scene);
    const std::vector<double> areas = Areas(scene);
    EXPECT_NEAR(std::accumulate(areas.begin(), areas.end(), 0.0), made.Lights().CellArea(0), 1e-6);
    for (const LightGroup& group : made.Lights().Groups())
    {
      EXPECT_GT(glm::length(group.Corners[1] - group.Corners[0]), 1e-3);
    }
    std::rotate(corners.begin(), corners.begin() + 1, corners.end());
  }
}

} // namespace
