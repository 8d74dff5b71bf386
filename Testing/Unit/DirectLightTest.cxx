// Light straight from a sign or a lamp: on surfaces before it, and close to it.
#include "DirectLight.h"
#include "NearLightScenes.h"
#include "Scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;
using std::numbers::pi;

/// A square of luminance 100 in the plane z, its front upwards.
EmitterCell Square(const Vec3& centre, double side, int sign)
{
  const double half = 0.5 * side;
  EmitterCell cell;
  cell.Vertices = {centre + Vec3(-half, -half, 0), centre + Vec3(half, -half, 0),
    centre + Vec3(half, half, 0), centre + Vec3(-half, half, 0)};
  cell.Luminance = {100, 100, 100};
  cell.SignId = sign;
  return cell;
}

/// A large room of clear air.
SceneDescription Room(std::vector<EmitterCell> emitters)
{
  SceneDescription scene;
  SmokeGrid grid;
  grid.Name = "air";
  for (std::vector<double>& nodes : grid.Nodes)
  {
    nodes = {-20.0, 20.0};
  }
  grid.Extinction = {0.0F};
  scene.Grids = {grid};
  scene.Emitters = std::move(emitters);
  return scene;
}

std::array<Spectrum, 2> OnTriangle(const SceneDescription& description, const Triangle& corners)
{
  const Scene scene(description);
  const Vec3 normal = glm::normalize(AreaVector(corners));
  return DirectLight(scene).TriangleIlluminance(0, corners, normal);
}

TEST(DirectLight, NothingLiesBeforeItsOwnPlane)
{
  const SceneDescription scene = Room({Square({0, 0, 2}, 1.0, 0), Square({1, 0, 2}, 1.0, 0)});
  // The sign itself, the wall that it is on, one that begins in its plane, and one behind it.
  for (const Triangle& corners :
    {Triangle{Vec3(-0.5, -0.5, 2), Vec3(0.5, -0.5, 2), Vec3(0.5, 0.5, 2)},
      {Vec3(-3, -3, 2), Vec3(3, -3, 2), Vec3(0, 3, 2)},
      {Vec3(3, -3, 2), Vec3(3, 3, 2), Vec3(3, 0, 0)},
      {Vec3(-1, -1, 1), Vec3(1, -1, 1), Vec3(0, 1, 1)}})
  {
    for (const Spectrum& side : OnTriangle(scene, corners))
    {
      EXPECT_EQ(side[0], 0.0);
    }
  }
}

// A sign does not light itself, nor a plate beside it in its plane, where rounding lifts a point of
// it off the plane; what is tilted or before it gets light.
TEST(DirectLight, NothingInItsPlaneIsLit)
{
  const Scene scene(Room({Square(Vec3(0.0), 0.4, 0)}));
  const DirectLight direct(scene);
  const Vec3 up(0, 0, 1);
  for (const double off : {0.0, 4e-16, 1e-9, -1e-9})
  {
    EXPECT_EQ(direct.Illuminance(0, {0.1, 0.05, off}, up)[0], 0.0) << off;
    EXPECT_EQ(direct.Illuminance(0, {0.3, 0.05, off}, up)[0], 0.0) << off;
  }
  EXPECT_GT(direct.Illuminance(0, {0.3, 0.05, 0.01}, glm::normalize(Vec3(-1, 0, 1)))[0], 1.0);
  EXPECT_GT(direct.Illuminance(0, {0.1, 0.05, 0.01}, -up)[0], 250.0);
}

TEST(DirectLight, WhatStandsBeforePartOfASignGetsItsLight)
{
  // Letters 0.1 m before the ground of their sign: their back sees the ground alone. The patch is
  // small against the gap, so that the closed form of its middle holds: below the middle of a
  // square of side a at the distance d, E = 4 L x / sqrt(1 + x^2) atan(x / sqrt(1 + x^2)) with
  // x = a / (2 d) (Howell, configuration factors, B-4).
  constexpr double Gap = 0.1;
  const SceneDescription scene = Room({Square({0, 0, 2}, 1.0, 0), Square({3, 0, 2 + Gap}, 0.2, 0)});
  const double x = 0.5 / Gap;
  const double share = x / std::sqrt(1.0 + x * x);
  const double expected = 4.0 * 100.0 * share * std::atan(share);
  const Triangle patch = {
    Vec3(-0.005, -0.005, 2 + Gap), Vec3(0.01, -0.005, 2 + Gap), Vec3(-0.005, 0.01, 2 + Gap)};
  const auto found = OnTriangle(scene, patch);
  EXPECT_EQ(found[0][0], 0.0);
  // The nearness of a part 0.1 m below is resolved to a percent, the far square adds nothing.
  EXPECT_NEAR(found[1][0] / expected, 1.0, 0.01);
  EXPECT_LT(found[1][0], 100.0 * pi);
}

/// Illuminance of the underside of a horizontal surface, of all lights.
double FromBelow(const SceneDescription& description, const Vec3& point)
{
  const Scene scene(description);
  const DirectLight direct(scene);
  double sum = 0.0;
  for (std::size_t light = 0; light < scene.Lights().Lights().size(); ++light)
  {
    sum += direct.Illuminance(light, point, {0, 0, -1})[0];
  }
  return sum;
}

// A wall that goes through a lamp hides a part of it from afar, too, on either side the one beyond
// it: what is seen is as bright as a lamp that ends at the wall.
TEST(DirectLight, OfALampThatAWallGoesThrough)
{
  const SceneDescription whole = Room({Square(Vec3(0.0), 0.1, -1)});
  for (const double wall : {0.01, 0.0, -0.043})
  {
    SceneDescription crossed = whole;
    crossed.Surfaces.Points = {{wall, -1, -1}, {wall, 1, -1}, {wall, 1, 1}, {wall, -1, 1}};
    crossed.Surfaces.Triangles = {{0, 1, 2}, {0, 2, 3}};
    crossed.Surfaces.TriangleCell = {0, 0};
    crossed.Surfaces.CellReflectance = {{0.0, 0.0, 0.0}};
    EXPECT_EQ(Scene(crossed).Lights().Lights().size(), 2U);
    for (const double side : {-1.0, 1.0})
    {
      SceneDescription part = whole;
      for (Vec3& corner : part.Emitters[0].Vertices)
      {
        corner.x = side * std::max(side * corner.x, side * wall);
      }
      const Vec3 point(1.5 * side, 0.0, 2.0);
      EXPECT_NEAR(FromBelow(crossed, point) / FromBelow(part, point), 1.0, 1e-4) << wall;
    }
  }
}

// A high wall that ends in the middle of a lamp hides some of each part from somewhere, however
// far: all around the lamp it is told to 5 % of what it sends there unhidden, a sum over 100 x 100
// places before the plate being right.
TEST(DirectLight, OfALampThatAWallEndsIn)
{
  SceneDescription description = Room({Square(Vec3(0.0), 0.4, -1)});
  description.Surfaces.Points = {{0, -1, -1}, {0, 0, -1}, {0, 0, 19}, {0, -1, 19}};
  description.Surfaces.Triangles = {{0, 1, 2}, {0, 2, 3}};
  description.Surfaces.TriangleCell = {0, 0};
  description.Surfaces.CellReflectance = {{0.0, 0.0, 0.0}};
  const Scene scene(description);
  constexpr int Steps = 100;
  for (int direction = 0; direction < 36; ++direction)
  {
    const double angle = (direction + 0.37) * pi / 18.0;
    const Vec3 point(10.0 * std::cos(angle), 10.0 * std::sin(angle), 6.0);
    double expected = 0.0;
    double unhidden = 0.0;
    for (int i = 0; i < Steps * Steps; ++i)
    {
      const Vec3 place(0.4 * ((i % Steps + 0.5) / Steps - 0.5),
        0.4 * ((i / Steps + 0.5) / Steps - 0.5), 10.0 * scene.Shapes().Tolerance());
      const Vec3 way = point - place;
      const double light =
        100.0 * 0.16 / (Steps * Steps) * way.z * way.z / std::pow(glm::length(way), 4);
      unhidden += light;
      expected += scene.Shapes().Visible(point, place) ? light : 0.0;
    }
    EXPECT_NEAR(FromBelow(description, point), expected, 0.05 * unhidden) << direction;
  }
}

/// Fluence at a point of a plate of luminance 100 that may be any quadrilateral, its corners as
/// EmitterCell's: a sum over 200 x 200 places, each dimmed along its own way.
double SumOver(const Scene& scene, const std::vector<Vec3>& corners, const Vec3& point)
{
  constexpr int Steps = 200;
  const Vec3 along = corners[1] - corners[0];
  const Vec3 up = corners[3] - corners[0];
  const Vec3 twist = corners[2] - corners[3] - along;
  double sum = 0.0;
  for (int i = 0; i < Steps * Steps; ++i)
  {
    const double u = (i % Steps + 0.5) / Steps;
    const double v = (i / Steps + 0.5) / Steps;
    const Vec3 to = corners[0] + u * along + v * (up + u * twist) - point;
    const double distance = glm::length(to);
    const double area =
      glm::length(glm::cross(along + v * twist, up + u * twist)) / (Steps * Steps);
    sum += 100.0 * area * std::abs(to.z) / std::pow(distance, 3) *
           std::exp(-scene.Smoke().OpticalDepth(point, to / distance, 0.0, distance));
  }
  return sum;
}

// Lamps several times as wide as cells, and close, in smoke that gets thicker along x and upwards:
// also those that are no rectangles.
TEST(DirectLight, CloseToAWideLamp)
{
  const std::vector<std::vector<Vec3>> lamps = {
    {{0.7, 0.7, 2}, {0.7, 1.3, 2}, {1.3, 1.3, 2}, {1.3, 0.7, 2}},
    {{0.9, 0.7, 2}, {0.7, 1.3, 2}, {1.3, 1.3, 2}, {1.1, 0.7, 2}},
    {{0.95, 0.7, 2}, {0.6, 1.3, 2}, {1.4, 1.3, 2}, {1.05, 0.7, 2}}};
  for (const std::vector<Vec3>& corners : lamps)
  {
    SceneDescription description;
    description.Grids = {scenes::UniformSmoke(Vec3(0.0), Vec3(2.0), {20, 20, 20}, 0.0)};
    for (std::size_t cell = 0; cell < description.Grids[0].Extinction.size(); ++cell)
    {
      description.Grids[0].Extinction[cell] =
        0.1F + 0.05F * static_cast<float>(cell % 20) + 0.03F * static_cast<float>(cell / 400);
    }
    EmitterCell cell;
    cell.Vertices = corners;
    cell.Luminance = {100, 100, 100};
    description.Emitters = {cell};
    const Scene scene(description);
    const DirectLight direct(scene);
    for (const double height : {0.02, 0.05, 0.1, 0.2, 0.4})
    {
      for (const Vec3& beside : {Vec3(1.0, 1.0, 2.0), Vec3(0.83, 1.21, 2.0), Vec3(1.35, 0.8, 2.0)})
      {
        const Vec3 point = beside - Vec3(0.0, 0.0, height);
        EXPECT_NEAR(direct.Fluence(0, point)[0] / SumOver(scene, corners, point), 1.0, 0.004)
          << corners[0].x << ' ' << beside.x << ' ' << height;
      }
    }
  }
}

// Right before the middle of a plate its fluence is 2 pi L / (n + 1), farther off what a sum over
// 400 x 400 places of the plate gives; beams far sharper than the plate is wide among them.
TEST(DirectLight, SteepLawsCloseToThePlate)
{
  for (const double exponent : {0.0, 1.0, 3.0, 8.0, 16.0, 50.0})
  {
    const Scene scene(test::CeilingLamp(exponent, 0.0));
    const DirectLight direct(scene);
    for (const double height : {1e-6, 1e-5, 1e-4, 1e-3})
    {
      const double closed = 2000.0 * pi / (exponent + 1.0);
      EXPECT_NEAR(direct.Fluence(0, {2, 2, 3 - height})[0] / closed, 1.0, 0.006)
        << exponent << ' ' << height;
    }
    for (const double height : {0.05, 0.15, 0.45, 0.6, 0.9, 1.5})
    {
      const Vec3 point(2.1, 1.8, 3 - height);
      constexpr int Steps = 400;
      double sum = 0.0;
      for (int i = 0; i < Steps * Steps; ++i)
      {
        const Vec3 to =
          Vec3(1.7 + 0.6 * (i % Steps + 0.5) / Steps, 1.4 + 1.2 * (i / Steps + 0.5) / Steps, 3.0) -
          point;
        const double distance = glm::length(to);
        sum += 1000.0 * 0.72 / (Steps * Steps) * std::pow(to.z / distance, exponent + 1.0) /
               (distance * distance);
      }
      EXPECT_NEAR(direct.Fluence(0, point)[0] / sum, 1.0, 0.006) << exponent << ' ' << height;
    }
  }
}

// Cells before a plate see it whole; those that its plane goes through do so from what lies before
// that, unless a post hides some of it, however thin; those behind it see nothing. So do those
// before a plate that is askew to the cells.
TEST(DirectLight, ClearCells)
{
  SceneDescription description;
  description.Grids = {scenes::UniformSmoke(Vec3(0.0), Vec3(3.0), {3, 3, 3}, 0.3)};
  description.Emitters = {Square({1.5, 1.5, 1.4}, 0.5, 0)};
  const auto clear = [&description](const Vec3& place)
  {
    const Scene scene(description);
    const std::int64_t cell = scene.Smoke().Locate(place);
    const DirectLight direct(scene);
    return std::pair(direct.Clear(0, cell), direct.ClearBefore(0, cell));
  };
  const std::pair whole(true, true);
  const std::pair before(false, true);
  const std::pair hidden(false, false);
  for (const double slope : {0.0, 0.05})
  {
    SCOPED_TRACE(slope);
    for (Vec3& vertex : description.Emitters[0].Vertices)
    {
      vertex.z += slope * (vertex.x - 1.5);
    }
    description.Surfaces = {};
    EXPECT_EQ(clear({1.5, 1.5, 2.5}), whole);
    EXPECT_EQ(clear({2.5, 1.5, 1.5}), before);
    EXPECT_EQ(clear({1.5, 1.5, 0.5}), hidden);
    scenes::AddRectangle(
      description.Surfaces, {1.9, 1.5, 1.42}, {0.0, 0.001, 0.0}, {0.0, 0.0, 0.02}, 1, 1, 0.0);
    EXPECT_TRUE(clear({1.5, 1.5, 2.5}).first);
    EXPECT_EQ(clear({2.5, 1.5, 1.5}), hidden);
    EXPECT_EQ(clear({0.5, 1.5, 1.5}), before);
  }
}

} // namespace
