// Rays against surfaces and plates: distance, side, and who wins where shapes touch.
#include "Geometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

/// A quadrilateral of two triangles, cell by cell.
void AddQuad(SurfaceMesh& mesh, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  const auto first = static_cast<std::uint32_t>(mesh.Points.size());
  const auto cell = static_cast<std::uint32_t>(mesh.CellReflectance.size());
  mesh.Points.insert(mesh.Points.end(), {a, b, c, d});
  mesh.Triangles.push_back({first, first + 1, first + 2});
  mesh.Triangles.push_back({first, first + 2, first + 3});
  mesh.TriangleCell.insert(mesh.TriangleCell.end(), 2, cell);
  mesh.CellReflectance.push_back({0.5, 0.5, 0.5});
}

/// A square of half width h at a height z, front upwards or downwards.
SurfaceMesh Square(double z, double h = 1.0, bool up = true, const Vec3& offset = Vec3(0.0))
{
  SurfaceMesh mesh;
  const Vec3 a = offset + Vec3(-h, -h, z);
  const Vec3 b = offset + Vec3(h, -h, z);
  const Vec3 c = offset + Vec3(h, h, z);
  const Vec3 d = offset + Vec3(-h, h, z);
  up ? AddQuad(mesh, a, b, c, d) : AddQuad(mesh, a, d, c, b);
  return mesh;
}

constexpr double Far = 1e3;

/// Of a cube of 4 m around the origin.
Vec3 AnyPlace(std::mt19937& random)
{
  std::uniform_real_distribution<double> place(-2.0, 2.0);
  const double x = place(random);
  const double y = place(random);
  return {x, y, place(random)};
}

/// Quadrilaterals all over that cube.
SurfaceMesh Scattered(int count, std::mt19937& random)
{
  SurfaceMesh mesh;
  for (int i = 0; i < count; ++i)
  {
    const Vec3 corner = AnyPlace(random);
    AddQuad(mesh, corner, corner + Vec3(0.7, 0.1, 0), corner + Vec3(0.6, 0.8, 0.2),
      corner + Vec3(0, 0.7, 0.1));
  }
  return mesh;
}

TEST(Geometry, DistanceSideAndNormal)
{
  const Geometry shapes(Square(0.0), {});
  EXPECT_FALSE(shapes.Empty());
  const Hit above = shapes.Intersect({0.2, 0.3, 2}, {0, 0, -1}, 0.0, Far);
  ASSERT_TRUE(above.Found());
  EXPECT_DOUBLE_EQ(above.Distance, 2.0);
  EXPECT_EQ(above.Side, 0);
  EXPECT_FALSE(above.Emitter);
  EXPECT_EQ(shapes.Cell(above), 0U);
  EXPECT_EQ(shapes.Normal(above), Vec3(0, 0, 1));
  const Hit below = shapes.Intersect({0.2, 0.3, -2}, {0, 0, 1}, 0.0, Far);
  ASSERT_TRUE(below.Found());
  EXPECT_EQ(below.Side, 1);
  EXPECT_FALSE(shapes.Intersect({2, 0, 2}, {0, 0, -1}, 0.0, Far).Found());
  EXPECT_FALSE(shapes.Intersect({0, 0, 2}, {0, 0, 1}, 0.0, Far).Found());
  // Only between the two distances.
  EXPECT_FALSE(shapes.Intersect({0, 0, 2}, {0, 0, -1}, 0.0, 1.9).Found());
  EXPECT_FALSE(shapes.Intersect({0, 0, 2}, {0, 0, -1}, 2.1, Far).Found());
}

// Distances are those of the planes in double precision, also far away from the origin.
TEST(Geometry, DistancesInDoublePrecision)
{
  const Vec3 offset(1e6, -1e6, 1e6);
  const Geometry shapes(Square(0.0, 5.0, true, offset), {});
  const Vec3 direction = glm::normalize(Vec3(0.3, 0.4, -0.7));
  const Hit hit = shapes.Intersect(offset + Vec3(0, 0, 3), direction, 0.0, Far);
  ASSERT_TRUE(hit.Found());
  EXPECT_NEAR(hit.Distance, -3.0 / direction.z, 1e-8);
}

// A point sees backs alone where each direction ends on the back of a surface or on a plate; a
// front, or nothing, in any of them tells otherwise, and plates alone tell nothing.
TEST(Geometry, SeesBacksAlone)
{
  SurfaceMesh outward = Square(2.0);
  const SurfaceMesh floor = Square(-1.0, 1.0, false);
  AddQuad(outward, floor.Points[0], floor.Points[1], floor.Points[2], floor.Points[3]);
  const SurfaceMesh plate = Square(1.0, 0.5, false);
  const Geometry shapes(outward, plate);
  const Vec3 under(0.8, 0.8, 0.0);
  const Vec3 behindPlate(0.0, 0.0, 0.0);
  const std::array<Vec3, 2> bothWays = {Vec3(0, 0, 1), Vec3(0, 0, -1)};
  EXPECT_TRUE(shapes.SeesBacks(under, bothWays));
  EXPECT_TRUE(shapes.SeesBacks(behindPlate, bothWays));
  EXPECT_FALSE(shapes.SeesBacks(behindPlate, std::span(bothWays).first(1)));
  const std::array<Vec3, 2> aside = {Vec3(0, 0, 1), Vec3(1, 0, 0)};
  EXPECT_FALSE(shapes.SeesBacks(under, aside));
  EXPECT_FALSE(shapes.SeesBacks({0.8, 0.8, 3.0}, bothWays));
}

TEST(Geometry, Nothing)
{
  const Geometry none;
  EXPECT_TRUE(none.Empty());
  const Geometry empty(SurfaceMesh{}, SurfaceMesh{});
  EXPECT_TRUE(empty.Empty());
  EXPECT_FALSE(empty.Intersect(Vec3(0.0), {1, 0, 0}, 0.0, Far).Found());
  EXPECT_FALSE(empty.Occluded(Vec3(0.0), {1, 0, 0}, 0.0, Far));
  EXPECT_TRUE(empty.Visible(Vec3(0.0), Vec3(1.0)));
}

TEST(Geometry, TrianglesWithoutAreaAreLeftOut)
{
  SurfaceMesh mesh;
  mesh.Points = {Vec3(0.0), Vec3(1.0), Vec3(2.0)};
  mesh.Triangles = {{0, 1, 2}, {0, 0, 1}, {2, 2, 2}};
  mesh.TriangleCell = {0, 0, 0};
  mesh.CellReflectance = {{}};
  EXPECT_TRUE(Geometry(mesh, {}).Empty());
}

/// Distances of a plate above a wall that faces up: in it, and so near that the two touch.
class PlateOnWall : public testing::TestWithParam<double>
{
};

TEST_P(PlateOnWall, IsSeenFromItsFrontOnly)
{
  for (const bool wallUp : {true, false})
  {
    const Geometry shapes(Square(0.0, 1.0, wallUp), Square(GetParam(), 0.5));
    for (const double slant : {0.0, 0.3, 1.0, 3.0})
    {
      const Vec3 down = glm::normalize(Vec3(slant, 0.2 * slant, -1));
      const Hit front = shapes.Intersect(Vec3(0.1, 0.1, 0) - down, down, 0.0, Far);
      ASSERT_TRUE(front.Found());
      EXPECT_TRUE(front.Emitter) << slant;
      EXPECT_EQ(front.Side, 0);
      const Vec3 up = glm::normalize(Vec3(slant, 0.2 * slant, 1));
      const Hit back = shapes.Intersect(Vec3(0.1, 0.1, 0) - up, up, 0.0, Far);
      ASSERT_TRUE(back.Found());
      EXPECT_FALSE(back.Emitter) << slant;
      // Beside the plate the wall shows.
      const Hit beside = shapes.Intersect(Vec3(0.8, 0.1, 0) - down, down, 0.0, Far);
      ASSERT_TRUE(beside.Found());
      EXPECT_FALSE(beside.Emitter);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
  Geometry, PlateOnWall, testing::Values(0.0, 1e-9, -1e-9, 1e-6, -1e-6, 1e-5, -1e-5));

TEST(Geometry, PlateBeforeAndBehindTheWall)
{
  const Geometry before({Square(0.0)}, Square(0.01, 0.5));
  EXPECT_TRUE(before.Intersect({0, 0, 1}, {0, 0, -1}, 0.0, Far).Emitter);
  const Geometry behind({Square(0.0)}, Square(-0.01, 0.5));
  EXPECT_FALSE(behind.Intersect({0, 0, 1}, {0, 0, -1}, 0.0, Far).Emitter);
}

TEST(Geometry, OcclusionAndSight)
{
  const Geometry shapes(Square(0.0), Square(1.0, 0.5));
  EXPECT_TRUE(shapes.Occluded({0, 0, 0.5}, {0, 0, -1}, 0.0, 1.0));
  EXPECT_TRUE(shapes.Occluded({0, 0, 0.5}, {0, 0, 1}, 0.0, 1.0));
  EXPECT_FALSE(shapes.Occluded({0, 0, 0.5}, {1, 0, 0}, 0.0, Far));
  EXPECT_FALSE(shapes.Occluded({0, 0, 0.5}, {0, 0, -1}, 0.0, 0.4));
  // What touches the ends does not hide them.
  EXPECT_TRUE(shapes.Visible({0, 0, 0}, {0, 0, 1}));
  EXPECT_TRUE(shapes.Visible({0.1, 0.2, 0}, {-0.3, 0.2, 1}));
  EXPECT_FALSE(shapes.Visible({0, 0, -0.5}, {0, 0, 0.5}));
  EXPECT_FALSE(shapes.Visible({0, 0, -0.5}, {0, 0, 1}));
  EXPECT_TRUE(shapes.Visible({0, 0, 0.5}, {0, 0, 0.5}));
}

// Lines asked for together are seen as each by itself, whether or not they fill up packets; a line
// without length, and one from beyond what single precision reaches, among them.
TEST(Geometry, ManyLinesAtOnce)
{
  std::mt19937 random(5);
  const Geometry geometry(Scattered(20, random), Square(0.5, 0.4));
  std::vector<LineOfSight> lines = {
    {Vec3(0.3), Vec3(0.3)}, {Vec3(1e30, 0, 0), Vec3(0.0)}, {Vec3(0, 0, 1), Vec3(0, 0, 0.5)}};
  for (int i = 0; i < 2000; ++i)
  {
    const Vec3 from = AnyPlace(random);
    lines.push_back({from, AnyPlace(random)});
  }
  const std::vector<bool> seen = geometry.Visible(lines);
  ASSERT_EQ(seen.size(), lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i)
  {
    EXPECT_EQ(seen[i], geometry.Visible(lines[i].From, lines[i].To)) << "line " << i;
  }
  const auto clear = std::count(seen.begin(), seen.end(), true);
  EXPECT_GT(clear, 500);
  EXPECT_LT(clear, 1800);
  EXPECT_TRUE(geometry.Visible(std::span<const LineOfSight>()).empty());
  EXPECT_EQ(Geometry().Visible(std::span(lines).first(3)), std::vector<bool>(3, true));
}

// A line through a stack finds every shape once, in order, with both its sides.
TEST(Geometry, CrossingsOfALine)
{
  SurfaceMesh stack = Square(0.0);
  AddQuad(stack, {-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1});
  const Geometry shapes(stack, Square(0.0, 0.5));
  std::vector<Crossing> crossings;
  shapes.Cross({0.1, 0.2, 5}, {0, 0, -1}, 0.0, Far, crossings);
  ASSERT_EQ(crossings.size(), 2U);
  // The plate lies on the first square: its front arrives, the square's back leaves.
  EXPECT_TRUE(crossings[0].Arrive.Emitter);
  EXPECT_EQ(crossings[0].Arrive.Side, 0);
  EXPECT_FALSE(crossings[0].Leave.Emitter);
  EXPECT_EQ(crossings[0].Leave.Side, 1);
  EXPECT_NEAR(crossings[0].Arrive.Distance, 5.0, 1e-9);
  EXPECT_NEAR(crossings[1].Arrive.Distance, 6.0, 1e-9);
  EXPECT_EQ(crossings[1].Arrive.Side, 0);
  EXPECT_EQ(crossings[1].Leave.Side, 1);
}

/// A closed box of 1 m, fronts inwards.
SurfaceMesh ClosedBox()
{
  SurfaceMesh box;
  AddQuad(box, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  AddQuad(box, {0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1});
  AddQuad(box, {0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0});
  AddQuad(box, {0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1});
  AddQuad(box, {0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1});
  AddQuad(box, {1, 0, 0}, {1, 0, 1}, {1, 1, 1}, {1, 1, 0});
  return box;
}

// A line that cuts an edge of a closed box, however close to it, comes out again: none goes on
// inside, nor takes light of the inside along.
TEST(Geometry, LinesCutEdges)
{
  const Geometry shapes(ClosedBox(), {});
  std::vector<Crossing> crossings;
  int cut = 0;
  for (const double depth : {3e-6, 1e-5, 2e-5, 1e-4, 1e-2})
  {
    for (int i = 1; i < 40; ++i)
    {
      // Across the edge, outwards of it at an angle, and along it a little.
      const double angle = 0.03 * i;
      const Vec3 direction = glm::normalize(Vec3(std::cos(angle), -std::sin(angle), 0.01 * i));
      for (int axis = 0; axis < 3; ++axis)
      {
        const auto turned = [axis](const Vec3& v)
        { return Vec3(v[axis], v[(axis + 1) % 3], v[(axis + 2) % 3]); };
        const Vec3 point = turned(Vec3(depth, depth, 0.31));
        shapes.Cross(point - 3.0 * turned(direction), turned(direction), 0.0, Far, crossings);
        int side = 1;
        for (const Crossing& crossing : crossings)
        {
          EXPECT_EQ(crossing.Arrive.Side, side) << depth << " " << angle << " " << axis;
          side = crossing.Leave.Side;
        }
        EXPECT_EQ(side, 1) << depth << " " << angle << " " << axis;
        cut += crossings.size() == 1 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(cut, 150);
}

// Rays that meet or just miss edges meet or miss them in whatever unit of length, and wherever
// shapes lie: single precision knows them by their place among each other.
TEST(Geometry, EdgesInAnyUnitOfLength)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const SurfaceMesh mesh = Scattered(40, random);
  const Geometry plain(mesh, {});
  for (const auto& [factor, offset] : {std::pair(1e3, 0.0), {1e-3, 0.0}, {1.0, 1e4}})
  {
    SurfaceMesh other = mesh;
    for (Vec3& corner : other.Points)
    {
      corner = factor * corner + Vec3(offset);
    }
    const Geometry moved(other, {});
    int found = 0;
    for (int i = 0; i < 20000; ++i)
    {
      // Within some 1e-7 of an edge.
      const Vec3& corner = mesh.Points[4 * (i % 40)];
      const Vec3& next = mesh.Points[4 * (i % 40) + 1];
      const Vec3 target = glm::mix(corner, next, share(random)) + 1e-7 * AnyPlace(random);
      const Vec3 origin = AnyPlace(random);
      const Vec3 direction = glm::normalize(target - origin);
      const Hit a = plain.Intersect(origin, direction, 0.0, 20.0);
      const Hit b = moved.Intersect(factor * origin + Vec3(offset), direction, 0.0, factor * 20.0);
      ASSERT_EQ(a.Found(), b.Found()) << factor << " " << offset << " ray " << i;
      EXPECT_EQ(a.Triangle, b.Triangle);
      EXPECT_EQ(a.Side, b.Side);
      found += a.Found() ? 1 : 0;
    }
    EXPECT_GT(found, 5000);
    EXPECT_LT(found, 20000);
  }
}

// A closed box has no cracks: rays through its edges and corners do not get out.
TEST(Geometry, WatertightAtSharedEdges)
{
  const Geometry shapes(ClosedBox(), {});
  const Vec3 centre(0.41, 0.52, 0.37);
  for (int i = 0; i <= 20; ++i)
  {
    for (int j = 0; j <= 20; ++j)
    {
      for (const Vec3& target : {Vec3(0.05 * i, 0.05 * j, 0), Vec3(0.05 * i, 0.05 * j, 1),
             Vec3(0.05 * i, 0, 0.05 * j), Vec3(1, 0.05 * i, 0.05 * j)})
      {
        const Vec3 direction = glm::normalize(target - centre);
        const Hit hit = shapes.Intersect(centre, direction, 0.0, Far);
        ASSERT_TRUE(hit.Found());
        EXPECT_NEAR(hit.Distance, glm::length(target - centre), 1e-5);
      }
    }
  }
}

// Triangles that are there twice, either way round, are crossed once.
TEST(Geometry, DuplicatesAreCrossedOnce)
{
  SurfaceMesh mesh = Square(0.0);
  for (std::size_t i = 0; i < 2; ++i)
  {
    mesh.Triangles.push_back(mesh.Triangles[i]);
    mesh.TriangleCell.push_back(0);
  }
  const Geometry shapes(mesh, {});
  std::vector<Crossing> crossings;
  for (const Vec3& origin : {Vec3(0.3, 0.1, 2), Vec3(0, 0, 2), Vec3(0.5, 0.5, 2)})
  {
    // Through the middle of a triangle, and through the diagonal that two of them share.
    shapes.Cross(origin, {0, 0, -1}, 0.0, Far, crossings);
    ASSERT_EQ(crossings.size(), 1U);
    EXPECT_NEAR(crossings[0].Arrive.Distance, 2.0, 1e-9);
    EXPECT_EQ(crossings[0].Arrive.Side, 0);
    EXPECT_EQ(crossings[0].Leave.Side, 1);
  }
}

// A sliver a nanometre wide between two squares neither hides them nor adds a hit that is not
// there.
TEST(Geometry, SliversDoNoHarm)
{
  SurfaceMesh mesh = Square(0.0);
  const auto first = static_cast<std::uint32_t>(mesh.Points.size());
  mesh.Points.insert(mesh.Points.end(), {{-1, 0.2, 1}, {1, 0.2, 1}, {1, 0.2 + 1e-9, 1}});
  mesh.Triangles.push_back({first, first + 1, first + 2});
  mesh.TriangleCell.push_back(0);
  const Geometry shapes(mesh, {});
  for (const double y : {-0.5, 0.1999, 0.2001, 0.7})
  {
    const Hit hit = shapes.Intersect({0.1, y, 2}, {0, 0, -1}, 0.0, Far);
    ASSERT_TRUE(hit.Found());
    EXPECT_DOUBLE_EQ(hit.Distance, 2.0);
    EXPECT_EQ(shapes.Normal(hit), Vec3(0, 0, 1));
  }
}

// Sight and occlusion a million metres from the origin, where floats resolve six centimetres.
TEST(Geometry, SightFarFromTheOrigin)
{
  const Vec3 offset(1e6, -1e6, 1e6);
  const Geometry shapes(Square(0.0, 1.0, true, offset), {});
  EXPECT_FALSE(shapes.Visible(offset + Vec3(0.3, 0.2, -0.01), offset + Vec3(0.3, 0.2, 0.01)));
  EXPECT_TRUE(shapes.Visible(offset + Vec3(0.3, 0.2, 0.01), offset + Vec3(-0.9, 0.2, 0.02)));
  EXPECT_TRUE(shapes.Visible(offset + Vec3(1.01, 0.2, -1), offset + Vec3(1.01, 0.2, 1)));
}

// Rays in the plane of a surface pass along it; what stands across is found.
TEST(Geometry, RaysInThePlaneOfASurface)
{
  SurfaceMesh mesh = Square(0.0);
  AddQuad(mesh, {0.5, -1, -1}, {0.5, 1, -1}, {0.5, 1, 1}, {0.5, -1, 1});
  const Geometry shapes(mesh, {});
  const Hit hit = shapes.Intersect({-3, 0.1, 0}, {1, 0, 0}, 0.0, Far);
  ASSERT_TRUE(hit.Found());
  EXPECT_NEAR(hit.Distance, 3.5, 1e-6);
  EXPECT_EQ(shapes.Cell(hit), 1U);
}

// From where single precision does not reach, and from nowhere, nothing is met, and nothing breaks.
TEST(Geometry, RaysFromBeyondSinglePrecision)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Geometry shapes(Square(0.0), {});
  std::vector<Crossing> crossings;
  for (const double height : {1e19, 1e60, 1e300, infinity, std::nan("")})
  {
    const Vec3 eye(0.1, 0.1, height);
    EXPECT_FALSE(shapes.Intersect(eye, {0, 0, -1}, 0.0, infinity).Found()) << height;
    shapes.Cross(eye, {0, 0, -1}, 0.0, infinity, crossings);
    EXPECT_TRUE(crossings.empty()) << height;
    EXPECT_FALSE(shapes.Occluded(eye, {0, 0, -1}, 0.0, infinity)) << height;
  }
  EXPECT_FALSE(shapes.Intersect({0, 0, 1}, Vec3(std::nan("")), 0.0, infinity).Found());
}

} // namespace
