// Rays through smoke grids along faces, edges and diagonals: every metre is counted exactly once.
#include "Medium.h"
#include "ReferenceIntegrator.h"
#include "SceneLibrary.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;
constexpr double Infinity = std::numeric_limits<double>::infinity();

/// Length of a ray inside a box, in double precision.
double LengthInBox(const Vec3& origin, const Vec3& direction, const Vec3& lower, const Vec3& upper)
{
  double enter = 0.0;
  double leave = Infinity;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (std::abs(direction[axis]) < std::numeric_limits<double>::min())
    {
      if (origin[axis] < lower[axis] || origin[axis] > upper[axis])
      {
        return 0.0;
      }
      continue;
    }
    const double a = (lower[axis] - origin[axis]) / direction[axis];
    const double b = (upper[axis] - origin[axis]) / direction[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return std::max(0.0, leave - enter);
}

/// Sum of a walk's pieces; expects them to follow each other without overlap.
double WalkedLength(const Medium& medium, const Vec3& origin, const Vec3& direction)
{
  std::vector<Segment> pieces;
  medium.Walk(origin, direction, 0.0, Infinity, pieces);
  double sum = 0.0;
  double at = 0.0;
  for (const Segment& piece : pieces)
  {
    EXPECT_GE(piece.Begin, at);
    EXPECT_GT(piece.End, piece.Begin);
    EXPECT_GE(piece.Cell, 0);
    EXPECT_LT(piece.Cell, static_cast<std::int64_t>(medium.Cells()));
    at = piece.End;
    sum += piece.End - piece.Begin;
  }
  return sum;
}

/// The promised 1e-12, relative to the distances that the sum is made of.
void ExpectWhole(const Medium& medium, const Vec3& origin, const Vec3& direction)
{
  const double expected = LengthInBox(origin, direction, medium.Lower(), medium.Upper());
  const double reach = glm::length(medium.Upper() - origin) + glm::length(medium.Lower() - origin);
  EXPECT_NEAR(WalkedLength(medium, origin, direction), expected, 1e-12 * reach)
    << "from " << origin.x << " " << origin.y << " " << origin.z << " along " << direction.x << " "
    << direction.y << " " << direction.z;
}

/// All directions with components -1, 0 and 1: along faces, edges and diagonals of cells.
std::vector<Vec3> LatticeDirections()
{
  std::vector<Vec3> directions;
  for (int x = -1; x <= 1; ++x)
  {
    for (int y = -1; y <= 1; ++y)
    {
      for (int z = -1; z <= 1; ++z)
      {
        if (x != 0 || y != 0 || z != 0)
        {
          directions.push_back(glm::normalize(Vec3(x, y, z)));
        }
      }
    }
  }
  return directions;
}

// Rays that start in nodes, on edges, in faces and in the middle of cells, in and out of the smoke.
TEST(Walk, AlongFacesEdgesAndDiagonals)
{
  const Medium medium({scenes::UniformSmoke(Vec3(0.0), Vec3(0.8, 0.8, 0.8), {8, 8, 8}, 1.0)});
  for (const Vec3& direction : LatticeDirections())
  {
    for (int i = -4; i <= 20; i += 3)
    {
      for (int j = 0; j <= 16; j += 2)
      {
        ExpectWhole(medium, Vec3(0.05 * i, 0.05 * j, 0.4), direction);
        ExpectWhole(medium, Vec3(0.05 * i, 0.05 * j, 0.0), direction);
        ExpectWhole(medium, Vec3(0.05 * i, 0.05 * j, 0.43), direction);
      }
    }
  }
}

// Directions that miss a face or a diagonal by rounding errors and by a little more.
TEST(Walk, NearlyAlongFaces)
{
  const Medium medium({scenes::UniformSmoke(Vec3(0.0), Vec3(3, 2, 1), {30, 20, 10}, 1.0)});
  for (const double tilt : {1e-310, 1e-300, 1e-18, 1e-16, 1e-12, 1e-8})
  {
    for (const double sign : {-1.0, 1.0})
    {
      for (const Vec3& direction : LatticeDirections())
      {
        const Vec3 tilted = glm::normalize(direction + sign * tilt * Vec3(0.3, -0.7, 1.1));
        ExpectWhole(medium, {1.0, 1.0, 0.5}, tilted);
        ExpectWhole(medium, Vec3(1.0, 1.0, 0.5) - 10.0 * tilted, tilted);
        ExpectWhole(medium, Vec3(0.0), tilted);
        ExpectWhole(medium, {3.0, 2.0, 1.0}, tilted);
      }
    }
  }
}

// Grids that overlap, are nested 1:8 in cell size and given in any order cover a box; a length is
// counted once wherever the ray runs, and each piece lies in the cell that counts there.
TEST(Walk, OverlappingAndNestedMeshes)
{
  std::vector<SmokeGrid> grids = {scenes::UniformSmoke(Vec3(0.0), Vec3(4, 2, 2), {5, 3, 2}, 1.0),
    scenes::UniformSmoke({0.8, 0.5, 0.5}, {2.4, 1.5, 1.5}, {16, 10, 10}, 2.0),
    scenes::UniformSmoke({1.6, 0.75, 0.75}, {1.8, 1.25, 1.25}, {16, 40, 40}, 3.0),
    scenes::UniformSmoke({1.2, 0.0, 0.0}, {4.0, 2.0, 1.0}, {28, 20, 10}, 4.0)};
  Pcg32 random(4, 4);
  for (int order = 0; order < 4; ++order)
  {
    std::rotate(grids.begin(), grids.begin() + 1, grids.end());
    const Medium medium(grids);
    for (int i = 0; i < 2000; ++i)
    {
      Vec3 origin = Vec3(4, 2, 2) * Vec3(random.Uniform(), random.Uniform(), random.Uniform());
      Vec3 direction = Vec3(random.Uniform(), random.Uniform(), random.Uniform()) - Vec3(0.5);
      if (i % 4 == 0)
      {
        // In a face that several grids share.
        origin.z = 1.0;
        direction.z = 0.0;
      }
      direction = glm::normalize(direction);
      ExpectWhole(medium, origin, direction);
      std::vector<Segment> pieces;
      medium.Walk(origin, direction, 0.0, Infinity, pieces);
      for (const Segment& piece : pieces)
      {
        // Pieces of a few rounding errors may lie on either side, and so may rays in a face.
        if (piece.End - piece.Begin > 1e-12 && i % 4 != 0)
        {
          EXPECT_EQ(
            medium.Locate(origin + 0.5 * (piece.Begin + piece.End) * direction), piece.Cell);
        }
      }
    }
  }
}

// A gap of 1e-9 m between two meshes loses that much and no more; an overlap of 1e-9 m counts once.
TEST(Walk, HairBetweenMeshes)
{
  for (const double gap : {1e-9, 1e-15, 0.0, -1e-15, -1e-9})
  {
    const Medium medium({scenes::UniformSmoke(Vec3(0.0), Vec3(1, 1, 1), {10, 10, 10}, 1.0),
      scenes::UniformSmoke({1.0 + gap, 0, 0}, {2, 1, 1}, {10, 10, 10}, 1.0)});
    Pcg32 random(5, 5);
    for (int i = 0; i < 500; ++i)
    {
      const Vec3 from(0.0, random.Uniform(), random.Uniform());
      const Vec3 to(2.0, random.Uniform(), random.Uniform());
      const double length = glm::length(to - from);
      const Vec3 direction = (to - from) / length;
      const double lost = std::max(0.0, gap) * length / 2.0;
      EXPECT_NEAR(WalkedLength(medium, from, direction), length - lost, 1e-12 * length) << gap;
    }
    // In the common face: one metre, of either mesh. In a gap there is no smoke.
    const double inFace = WalkedLength(medium, {1.0 + 0.5 * gap, -1.0, 0.5}, {0, 1, 0});
    EXPECT_TRUE(std::abs(inFace - 1.0) < 1e-12 || (gap > 0.0 && inFace == 0.0)) << inFace;
  }
}

// A million metres from the origin doubles resolve 1e-10 m: lengths keep that.
TEST(Walk, FarFromTheOrigin)
{
  const Vec3 offset(1e6, -1e6, 1e6);
  const Medium medium({scenes::UniformSmoke(offset, offset + Vec3(1, 1, 1), {10, 10, 10}, 1.0)});
  for (const Vec3& direction : LatticeDirections())
  {
    const Vec3 middle = offset + Vec3(0.5, 0.52, 0.54);
    EXPECT_NEAR(WalkedLength(medium, middle, direction),
      LengthInBox(middle, direction, medium.Lower(), medium.Upper()), 1e-9);
  }
}

} // namespace
