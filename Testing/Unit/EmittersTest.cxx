// Plates: their areas, signs, lights, and the closed forms of polygons' light.
#include "Emitters.h"
#include "Medium.h"
#include "PolygonLight.h"
#include "SmokeBorders.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;
using std::numbers::pi;
/// With its lights, which all shine directly, however large.
EmitterSet WithLights(std::vector<EmitterCell> cells, const SmokeBorders* borders = nullptr)
{
  EmitterSet set(std::move(cells), 1);
  set.FormLights(1e300, borders);
  return set;
}

/// A rectangle in the plane z = 0 with its front upwards.
EmitterCell Rectangle(double x0, double x1, double y0, double y1, double luminance, int signId)
{
  EmitterCell cell;
  cell.Vertices = {{x0, y0, 0}, {x1, y0, 0}, {x1, y1, 0}, {x0, y1, 0}};
  cell.Luminance = {luminance, luminance, luminance};
  cell.SignId = signId;
  return cell;
}

TEST(Emitters, AreaNormalCentre)
{
  EmitterCell triangle;
  triangle.Vertices = {{0, 0, 1}, {0, 3, 1}, {3, 0, 1}};
  EmitterCell hexagon;
  for (int corner = 0; corner < 6; ++corner)
  {
    hexagon.Vertices.emplace_back(
      5.0 + std::cos(pi / 3.0 * corner), std::sin(pi / 3.0 * corner), 2.0);
  }
  const EmitterSet set = WithLights({triangle, hexagon});
  EXPECT_DOUBLE_EQ(set.CellArea(0), 4.5);
  EXPECT_EQ(set.CellNormal(0), Vec3(0, 0, -1));
  EXPECT_LT(glm::length(set.CellCentre(0) - Vec3(1, 1, 1)), 1e-12);
  EXPECT_NEAR(set.CellArea(1), 1.5 * std::sqrt(3.0), 1e-12);
  EXPECT_LT(glm::length(set.CellCentre(1) - Vec3(5, 0, 2)), 1e-12);
}

// 2 pi L A / (n + 2): the integral of L cos^n cos over the hemisphere.
TEST(Emitters, Flux)
{
  EmitterCell lambertian = Rectangle(0, 2, 0, 1, 10.0, -1);
  EmitterCell narrow = Rectangle(5, 6, 0, 1, 10.0, -1);
  narrow.Exponent = 8.0;
  EXPECT_NEAR(WithLights({lambertian}).Flux(0), pi * 10.0 * 2.0, 1e-9);
  EXPECT_NEAR(WithLights({narrow}).Flux(0), 2.0 * pi * 10.0 / 10.0, 1e-9);
  EXPECT_NEAR(WithLights({lambertian, narrow}).Flux(0), pi * 20.0 + 2.0 * pi, 1e-9);
}

TEST(Emitters, SignsInOrderOfTheirIds)
{
  const EmitterSet set = WithLights({Rectangle(0, 1, 0, 1, 1.0, 7), Rectangle(5, 6, 0, 2, 1.0, 3),
    Rectangle(1, 2, 0, 1, 0.0, 7), Rectangle(9, 10, 0, 1, 1.0, -1)});
  ASSERT_EQ(set.Signs().size(), 2U);
  EXPECT_EQ(set.Signs()[0].Id, 3);
  EXPECT_EQ(set.Signs()[1].Id, 7);
  const Sign& sign = set.Signs()[1];
  EXPECT_EQ(sign.Cells, (std::vector<std::size_t>{0, 2}));
  EXPECT_LT(glm::length(sign.Centre - Vec3(1, 0.5, 0)), 1e-12);
  EXPECT_LT(glm::length(sign.Normal - Vec3(0, 0, 1)), 1e-12);
  EXPECT_NEAR(sign.Radius, 0.5 * std::sqrt(5.0), 1e-12);
  EXPECT_NEAR(glm::length(sign.Corners[1] - sign.Corners[0]), 2.0, 1e-12);
  EXPECT_NEAR(glm::length(sign.Corners[3] - sign.Corners[0]), 1.0, 1e-12);
  // Counter-clockwise from the front.
  const Vec3 turn =
    glm::cross(sign.Corners[1] - sign.Corners[0], sign.Corners[2] - sign.Corners[1]);
  EXPECT_GT(glm::dot(turn, sign.Normal), 0.0);
}

/// Sums what the leaves under a group hold, and checks that they lie within its radius.
void AddLeaves(
  const EmitterSet& set, int index, const LightGroup& root, double& intensity, double& area)
{
  const LightGroup& group = set.Groups()[static_cast<std::size_t>(index)];
  if (group.FirstChild >= 0)
  {
    AddLeaves(set, group.FirstChild, root, intensity, area);
    AddLeaves(set, group.FirstChild + 1, root, intensity, area);
    return;
  }
  intensity += group.Intensity[0];
  area += group.Area;
  for (const Vec3& corner : group.Corners)
  {
    EXPECT_LE(glm::length(corner - root.Centre), root.Radius * (1.0 + 1e-12));
  }
}

// Faces back to back cancel but for rounding, however they are tilted: the first one's front
// counts.
TEST(Emitters, SignWithTwoFaces)
{
  for (int tilt = 1; tilt < 200; ++tilt)
  {
    const Vec3 u(std::cos(0.1 * tilt), std::sin(0.1 * tilt), 0.0);
    const Vec3 v = glm::normalize(glm::cross(u, Vec3(std::sin(0.07 * tilt), 0.3, 1.0)));
    EmitterCell front = Rectangle(0, 1, 0, 1, 1.0, 0);
    front.Vertices = {
      Vec3(0.1), Vec3(0.1) + 0.6 * u, Vec3(0.1) + 0.6 * u + 0.2 * v, Vec3(0.1) + 0.2 * v};
    EmitterCell back = front;
    std::reverse(back.Vertices.begin(), back.Vertices.end());
    const EmitterSet set = WithLights({front, back});
    EXPECT_GT(glm::dot(set.Signs()[0].Normal, set.CellNormal(0)), 1.0 - 1e-9) << tilt;
    EXPECT_NEAR(set.Signs()[0].Radius, 0.5 * std::hypot(0.6, 0.2), 1e-9) << tilt;
  }
}

// The lit cells of a sign form one light, each lamp is one, dark cells none.
TEST(Emitters, LightsAndTheirGroups)
{
  std::vector<EmitterCell> cells;
  for (int bar = 0; bar < 9; ++bar)
  {
    cells.push_back(Rectangle(bar, bar + 1, 0, 4, bar % 2 == 0 ? 3.0 : 0.0, 0));
  }
  cells.push_back(Rectangle(20, 21, 0, 1, 5.0, -1));
  cells.push_back(Rectangle(22, 23, 0, 1, 5.0, -1));
  const EmitterSet set = WithLights(cells);
  ASSERT_EQ(set.Lights().size(), 3U);
  const std::array<double, 3> intensities = {5 * 4 * 3.0, 5.0, 5.0};
  const std::array<double, 3> areas = {5 * 4.0, 1.0, 1.0};
  for (std::size_t light = 0; light < 3; ++light)
  {
    const LightGroup& root = set.Groups()[static_cast<std::size_t>(set.Lights()[light])];
    double intensity = 0.0;
    double area = 0.0;
    AddLeaves(set, set.Lights()[light], root, intensity, area);
    EXPECT_NEAR(intensity, intensities[light], 1e-12);
    EXPECT_NEAR(area, areas[light], 1e-12);
    EXPECT_NEAR(root.Intensity[0], intensity, 1e-12);
    EXPECT_NEAR(root.Area, area, 1e-12);
  }
}

// Boards of one sign in planes of their own are lights of their own, however many cells they have;
// what single precision moves does not make more boards.
TEST(Emitters, BoardsOfASign)
{
  const Vec3 u = glm::normalize(Vec3(3, 1, 2));
  const Vec3 v = glm::normalize(glm::cross(Vec3(1, 5, -2), u));
  const Vec3 n = glm::cross(u, v);
  std::vector<EmitterCell> cells;
  for (int bar = 0; bar < 60; ++bar)
  {
    EmitterCell cell = Rectangle(0.01 * bar, 0.01 * bar + 0.008, 0.0, 0.2, 3.0, 4);
    for (Vec3& vertex : cell.Vertices)
    {
      const double step = bar % 2 == 0 ? 0.0 : 0.3;
      vertex =
        Vec3(glm::vec3(Vec3(20, 30, 3) + vertex.x * u + vertex.y * v + (vertex.z + step) * n));
    }
    cells.push_back(cell);
  }
  const EmitterSet set = WithLights(cells);
  ASSERT_EQ(set.Lights().size(), 2U);
  EXPECT_NEAR(glm::dot(set.Root(1).Centre - set.Root(0).Centre, n), 0.3, 1e-5);
  for (const std::size_t light : {0, 1})
  {
    EXPECT_TRUE(set.Root(light).Plane());
    EXPECT_NEAR(set.Root(light).Intensity[0], 30 * 0.008 * 0.2 * 3.0, 1e-5);
  }
}

/// A luminous ring of radius 1 m, 0.1 m wide.
std::vector<EmitterCell> Ring()
{
  std::vector<EmitterCell> ring;
  constexpr int Sides = 120;
  for (int i = 0; i < Sides; ++i)
  {
    const double a = 2.0 * pi * i / Sides;
    const double b = 2.0 * pi * (i + 1) / Sides;
    EmitterCell cell;
    cell.Vertices = {{0.9 * std::cos(a), 0.9 * std::sin(a), 0}, {std::cos(a), std::sin(a), 0},
      {std::cos(b), std::sin(b), 0}, {0.9 * std::cos(b), 0.9 * std::sin(b), 0}};
    cell.Luminance.fill(3.0);
    ring.push_back(cell);
  }
  return ring;
}

// A line of light along an L of many cells is two lights, for the rectangle around both is empty;
// so are two boards of a sign in one plane, and a ring is eight.
TEST(Emitters, LightsFillTheirRectangles)
{
  std::vector<EmitterCell> line;
  for (int i = 0; i < 12; ++i)
  {
    line.push_back(Rectangle(0.5 * i, 0.5 * i + 0.5, 0.0, 0.1, 3.0, -1));
    line.push_back(Rectangle(0.0, 0.1, 0.5 * i + 0.1, 0.5 * i + 0.6, 3.0, -1));
  }
  std::vector<EmitterCell> boards;
  for (int i = 0; i < 40; ++i)
  {
    const double begin = 0.01 * i + (i < 25 ? 0.0 : 6.0);
    boards.push_back(Rectangle(begin, begin + 0.01, 0.0, 0.2, i % 2 == 0 ? 3.0 : 0.0, 0));
  }
  for (const auto& [cells, count] : {std::pair{line, 2U}, {boards, 2U}, {Ring(), 8U}})
  {
    const EmitterSet set = WithLights(cells);
    EXPECT_EQ(set.Lights().size(), count);
    double intensity = 0.0;
    for (std::size_t light = 0; light < set.Lights().size(); ++light)
    {
      double sum = 0.0;
      double area = 0.0;
      AddLeaves(set, set.Lights()[light], set.Root(light), sum, area);
      EXPECT_NEAR(sum, set.Root(light).Intensity[0], 1e-9);
      intensity += sum;
    }
    EXPECT_NEAR(pi * intensity, set.Flux(0), 1e-9);
  }
}

// The lattice of a ring lies along the ring.
TEST(Emitters, LatticeOfARing)
{
  const EmitterSet set = WithLights(Ring());
  for (const LightGroup& group : set.Groups())
  {
    for (const Vec3& corner : group.Corners)
    {
      EXPECT_TRUE(group.FirstChild >= 0 || std::abs(glm::length(corner) - 0.95) <= 0.06)
        << corner.x;
    }
  }
}

// The distance from a triangle is that from its nearest place, whichever corner comes first.
TEST(Emitters, DistanceFromATriangle)
{
  for (int first = 0; first < 3; ++first)
  {
    EmitterCell cell;
    cell.Vertices = {{0, 0, 0}, {4, 0, 0}, {4, 1, 0}};
    std::rotate(cell.Vertices.begin(), cell.Vertices.begin() + first, cell.Vertices.end());
    cell.Luminance.fill(1.0);
    const EmitterSet set = WithLights({cell});
    const LightGroup& light = set.Root(0);
    EXPECT_NEAR(light.Distance({3, 0.5, 2}), 2.0, 1e-12) << first;
    EXPECT_NEAR(light.Distance({5, 0.5, 0}), 1.0, 1e-12) << first;
    EXPECT_NEAR(light.Distance({0, 1, 0}), 4.0 / std::sqrt(17.0), 1e-12) << first;
    EXPECT_NEAR(light.Distance({-3, 0, 4}), 5.0, 1e-12) << first;
  }
}

// A checkerboard of many cells lights as a lattice with the same intensity, in the same rectangle.
TEST(Emitters, PatternsOfManyCellsAreCoarsened)
{
  std::vector<EmitterCell> cells;
  constexpr int columns = 30;
  constexpr int rows = 14;
  double intensity = 0.0;
  for (int i = 0; i < columns; ++i)
  {
    for (int j = 0; j < rows; ++j)
    {
      const double luminance = (i + j) % 2 == 0 ? 3.0 + i : 0.0;
      cells.push_back(Rectangle(0.1 * i, 0.1 * i + 0.1, 0.1 * j, 0.1 * j + 0.1, luminance, 0));
      intensity += 0.01 * luminance;
    }
  }
  const EmitterSet set = WithLights(cells);
  ASSERT_EQ(set.Lights().size(), 1U);
  EXPECT_LT(set.Groups().size(), 80U);
  const LightGroup& root = set.Groups()[static_cast<std::size_t>(set.Lights()[0])];
  double sum = 0.0;
  double area = 0.0;
  AddLeaves(set, set.Lights()[0], root, sum, area);
  EXPECT_NEAR(sum, intensity, 1e-9);
  EXPECT_NEAR(root.Intensity[0], intensity, 1e-9);
  EXPECT_NEAR(area, 3.0 * 1.4, 1e-9);
  EXPECT_NEAR(set.Flux(0), pi * intensity, 1e-9);
}

// Large lights are left to the lines: a sign counts with all its lit cells.
TEST(Emitters, LargeLightsAreLeftToLines)
{
  EmitterSet set({Rectangle(0, 1, 0, 1, 1.0, 0), Rectangle(1, 2, 0, 1, 1.0, 0),
                   Rectangle(5, 6, 0, 1, 1.0, -1), Rectangle(7, 9, 0, 1, 1.0, -1)},
    1);
  set.FormLights(1.5);
  EXPECT_TRUE(set.LeftToLines(0));
  EXPECT_TRUE(set.LeftToLines(1));
  EXPECT_FALSE(set.LeftToLines(2));
  EXPECT_TRUE(set.LeftToLines(3));
  EXPECT_EQ(set.Lights().size(), 1U);
  EXPECT_NEAR(set.Flux(0), 5.0 * pi, 1e-12);
  EXPECT_NEAR(set.CellFlux(3, 0), 2.0 * pi, 1e-12);
}

// A cube's face takes a sixth of the sphere seen from its centre.
TEST(PolygonLight, SolidAngle)
{
  const Vec3 a(-1, -1, 1);
  const Vec3 b(1, -1, 1);
  const Vec3 c(1, 1, 1);
  const Vec3 d(-1, 1, 1);
  const Vec3 point(0.0);
  EXPECT_NEAR(SolidAngle(point, {a, b, c, d}), 4.0 * pi / 6.0, 1e-12);
  // Right at a large polygon: half of the sphere. In its plane beside it: nothing.
  const Vec3 wide(100, 100, 1);
  const Vec3 close(0.1, 0.2, 1 - 1e-9);
  const double near = SolidAngle(close, {wide * a, wide * b, wide * c, wide * d});
  EXPECT_NEAR(near, 2.0 * pi, 1e-6);
  EXPECT_NEAR(SolidAngle({5, 5, 1}, a, b, c), 0.0, 1e-12);
}

// A quadrilateral takes what the triangles on either side of a diagonal take, also from within its
// plane and from its edges, and one with a corner twice is a triangle.
TEST(PolygonLight, SolidAngleOfTwoTriangles)
{
  const std::array<Vec3, 4> corners = {
    Vec3(-1, -1, 1), Vec3(2, -1, 1), Vec3(1, 1, 1), Vec3(-1, 2, 1)};
  for (const Vec3& point : {Vec3(0.0), Vec3(3, -4, 0.5), Vec3(0.3, 0.2, 1 - 1e-6), Vec3(0, 0, 1e4),
         Vec3(0.5, -0.5, 1), Vec3(4, 4, 1), Vec3(0, -1, 1), Vec3(0, 0, 1), corners[1]})
  {
    const double sum = SolidAngle(point, corners[0], corners[1], corners[2]) +
                       SolidAngle(point, corners[0], corners[2], corners[3]);
    EXPECT_NEAR(SolidAngle(point, corners), sum, 1e-12 * sum) << point.x << " " << point.y;
    EXPECT_DOUBLE_EQ(SolidAngle(point, {corners[0], corners[1], corners[2], corners[2]}),
      SolidAngle(point, corners[0], corners[1], corners[2]));
  }
}

// Configuration factors of unit squares at distance 1: parallel 0.1998 is between areas; the point
// form for a square of half width 1 at height 1, seen from below its centre, is
// (4 / (2 pi)) * 2 * (1 / sqrt 2) atan(1 / sqrt 2) (Howell's catalogue, B-4).
TEST(PolygonLight, ProjectedSolidAngle)
{
  const std::array<Vec3, 4> square = {
    Vec3(-1, -1, 1), Vec3(-1, 1, 1), Vec3(1, 1, 1), Vec3(1, -1, 1)};
  const double factor = 4.0 / (2.0 * pi) * 2.0 / std::sqrt(2.0) * std::atan(1.0 / std::sqrt(2.0));
  EXPECT_NEAR(ProjectedSolidAngle(Vec3(0.0), {0, 0, 1}, square), pi * factor, 1e-12);
  // A vertical plane sees the half of the square before it.
  const std::array<Vec3, 4> half = {Vec3(0, -1, 1), Vec3(0, 1, 1), Vec3(1, 1, 1), Vec3(1, -1, 1)};
  EXPECT_NEAR(ProjectedSolidAngle(Vec3(0.0), {1, 0, 0}, square),
    ProjectedSolidAngle(Vec3(0.0), {1, 0, 0}, half), 1e-12);
  EXPECT_GT(ProjectedSolidAngle(Vec3(0.0), {1, 0, 0}, half), 0.1);
  EXPECT_NEAR(ProjectedSolidAngle(Vec3(0.0), {0, 0, -1}, square), 0.0, 1e-12);
}

/// Smoke of two extinctions below and above x = 0.5.
Medium TwoLayers(float below, float above)
{
  SmokeGrid grid;
  grid.Nodes = {{{-1.0, 0.5, 3.0}, {-1.0, 2.0}, {-1.0, 1.0}}};
  grid.Extinction = {below, above};
  return Medium({grid});
}

// A quarter of the plate lies in the one smoke, and three in the other.
TEST(Emitters, BordersOfSmokeDivideLights)
{
  const std::vector<EmitterCell> plate = {Rectangle(0, 2, 0, 1, 10.0, -1)};
  for (const bool dense : {true, false})
  {
    const Medium smoke = TwoLayers(0.0F, dense ? 0.2F : 0.05F);
    const SmokeBorders borders(smoke, 1.0);
    const EmitterSet set = WithLights(plate, &borders);
    ASSERT_EQ(set.Lights().size(), dense ? 2U : 1U);
    double intensity = 0.0;
    double least = 1e300;
    for (std::size_t light = 0; light < set.Lights().size(); ++light)
    {
      intensity += set.Root(light).Intensity[0];
      least = std::min(least, set.Root(light).Intensity[0]);
    }
    EXPECT_NEAR(intensity, 20.0, 1e-12);
    EXPECT_NEAR(least, dense ? 5.0 : 20.0, 1e-12);
  }
  // Red is dimmed less than other light.
  const Medium thin = TwoLayers(0.0F, 0.05F);
  const SmokeBorders blue(thin, 4.0);
  EXPECT_EQ(WithLights(plate, &blue).Lights().size(), 2U);
}

// A plate that ends the smoke is divided, whichever way rounding places it, and one on its back,
// before which there is none, is not.
TEST(Emitters, BordersOfSmokeDivideLightsInItsOuterFace)
{
  SmokeGrid grid;
  grid.Nodes = {{{-1.0, 0.5, 3.0}, {-1.0, 2.0}, {-1.0, 0.0}}};
  grid.Extinction = {0.0F, 0.2F};
  const Medium under({grid});
  grid.Nodes[2] = {0.0, 1.0};
  const Medium over({grid});
  for (const double off : {-1e-15, 0.0, 1e-15})
  {
    std::vector<EmitterCell> plate = {Rectangle(0, 2, 0, 1, 10.0, -1)};
    for (Vec3& vertex : plate[0].Vertices)
    {
      vertex.z += off;
    }
    const SmokeBorders behind(under, 1.0);
    const SmokeBorders before(over, 1.0);
    EXPECT_EQ(WithLights(plate, &before).Lights().size(), 2U) << off;
    EXPECT_EQ(WithLights(plate, &behind).Lights().size(), 1U) << off;
  }
}

// A light in smoke that varies from cell to cell stays few.
TEST(Emitters, NoisySmokeMakesNoSwarmOfLights)
{
  SmokeGrid grid;
  for (std::vector<double>& nodes : grid.Nodes)
  {
    for (int node = -10; node <= 30; ++node)
    {
      nodes.push_back(0.1 * node + 0.05);
    }
  }
  for (std::size_t cell = 0; cell < 40 * 40 * 40; ++cell)
  {
    grid.Extinction.push_back(cell * 7919 % 13 < 6 ? 0.5F : 5.0F);
  }
  const Medium smoke({grid});
  const SmokeBorders borders(smoke, 1.0);
  const EmitterSet set = WithLights({Rectangle(0, 2, 0, 1, 10.0, -1)}, &borders);
  EXPECT_LE(set.Lights().size(), 16U);
}

} // namespace
