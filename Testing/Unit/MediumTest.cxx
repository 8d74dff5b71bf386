// The walk of rays through rectilinear smoke, cell by cell.
#include "Medium.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

SmokeGrid Grid(
  std::vector<double> x, std::vector<double> y, std::vector<double> z, float extinction)
{
  SmokeGrid grid;
  grid.Name = "test";
  grid.Nodes = {std::move(x), std::move(y), std::move(z)};
  grid.Extinction.assign(
    (grid.Nodes[0].size() - 1) * (grid.Nodes[1].size() - 1) * (grid.Nodes[2].size() - 1),
    extinction);
  return grid;
}

/// 2 x 2 x 2 cells of unequal width, extinctions 1 to 8.
SmokeGrid Numbered()
{
  SmokeGrid grid = Grid({0, 1, 3}, {0, 2, 3}, {0, 1, 2}, 0.0F);
  for (std::size_t cell = 0; cell < 8; ++cell)
  {
    grid.Extinction[cell] = static_cast<float>(cell + 1);
  }
  return grid;
}

std::vector<Segment> WalkOf(const Medium& medium, const Vec3& origin, const Vec3& direction,
  double end = std::numeric_limits<double>::infinity())
{
  std::vector<Segment> pieces;
  medium.Walk(origin, direction, 0.0, end, pieces);
  return pieces;
}

TEST(Medium, CellsAndPlaces)
{
  const Medium medium({Numbered()});
  EXPECT_EQ(medium.Cells(), 8U);
  EXPECT_FALSE(medium.Empty());
  EXPECT_FALSE(medium.Emits());
  EXPECT_FLOAT_EQ(medium.MaximumExtinction(), 8.0F);
  EXPECT_EQ(medium.Lower(), Vec3(0.0));
  EXPECT_EQ(medium.Upper(), Vec3(3, 3, 2));
  EXPECT_EQ(medium.CellCentre(7), Vec3(2, 2.5, 1.5));
  EXPECT_EQ(medium.CellSize(7), Vec3(2, 1, 1));
  for (std::int64_t cell = 0; cell < 8; ++cell)
  {
    EXPECT_EQ(medium.Locate(medium.CellCentre(cell)), cell);
  }
  EXPECT_EQ(medium.Locate({-0.1, 1, 1}), -1);
  EXPECT_EQ(medium.Locate({3.1, 1, 1}), -1);
  for (const double x : {0.0, 1.0 + 5e-7, 3.0})
  {
    EXPECT_TRUE(medium.FacesAt(0, x));
  }
  for (const double x : {-1.0, 0.1, 1.0 + 3e-6, 2.0, 4.0})
  {
    EXPECT_FALSE(medium.FacesAt(0, x));
  }
  // The outer faces belong to the smoke.
  EXPECT_EQ(medium.Locate({3, 3, 2}), 7);
  EXPECT_EQ(medium.Locate(Vec3(0.0)), 0);
}

TEST(Medium, Neighbours)
{
  const Medium medium({Numbered()});
  EXPECT_EQ(medium.Neighbour(0, 0, 1), 1);
  EXPECT_EQ(medium.Neighbour(1, 0, 0), 0);
  EXPECT_EQ(medium.Neighbour(0, 1, 1), 2);
  EXPECT_EQ(medium.Neighbour(0, 2, 1), 4);
  EXPECT_EQ(medium.Neighbour(0, 0, 0), -1);
  EXPECT_EQ(medium.Neighbour(7, 2, 1), -1);
}

TEST(Medium, NeighbourInAnotherGrid)
{
  const Medium medium({Grid({0, 1}, {0, 1}, {0, 1}, 1.0F), Grid({1, 2}, {0, 1}, {0, 1}, 2.0F)});
  EXPECT_EQ(medium.Neighbour(0, 0, 1), 1);
  EXPECT_EQ(medium.Neighbour(1, 0, 0), 0);
  EXPECT_EQ(medium.Neighbour(1, 0, 1), -1);
}

TEST(Medium, RayAlongAnAxis)
{
  const Medium medium({Numbered()});
  const auto pieces = WalkOf(medium, {-1, 1, 0.5}, {1, 0, 0});
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_EQ(pieces[0].Cell, 0);
  EXPECT_DOUBLE_EQ(pieces[0].Begin, 1.0);
  EXPECT_DOUBLE_EQ(pieces[0].End, 2.0);
  EXPECT_EQ(pieces[1].Cell, 1);
  EXPECT_DOUBLE_EQ(pieces[1].End, 4.0);
  EXPECT_DOUBLE_EQ(medium.OpticalDepth({-1, 1, 0.5}, {1, 0, 0}, 0.0, 10.0), 1.0 + 2.0 * 2.0);
  // Only the second half of the first cell, and nothing behind a point.
  EXPECT_DOUBLE_EQ(medium.OpticalDepth({-1, 1, 0.5}, {1, 0, 0}, 1.5, 2.0), 0.5);
  EXPECT_TRUE(WalkOf(medium, {-1, 1, 0.5}, {-1, 0, 0}).empty());
}

TEST(Medium, RaysBackwardsThroughFacesEdgesAndCorners)
{
  const Medium medium({Numbered()});
  // Back along x.
  EXPECT_DOUBLE_EQ(medium.OpticalDepth({4, 1, 0.5}, {-1, 0, 0}, 0.0, 10.0), 5.0);
  // In a face between cells: either side's smoke, but once, and all the way.
  const double inFace = medium.OpticalDepth({-1, 2, 0.5}, {1, 0, 0}, 0.0, 10.0);
  EXPECT_TRUE(inFace == 1.0 + 2.0 * 2.0 || inFace == 3.0 + 2.0 * 4.0) << inFace;
  // Along the outer face.
  EXPECT_DOUBLE_EQ(medium.OpticalDepth({-1, 0, 0}, {1, 0, 0}, 0.0, 10.0), 5.0);
  // Through the inner corner (1, 2, 1), both ways.
  const Vec3 direction = glm::normalize(Vec3(1, 2, 1));
  const double forth = medium.OpticalDepth(Vec3(0.0), direction, 0.0, 10.0);
  const double back = medium.OpticalDepth(Vec3(0.0) + 10.0 * direction, -direction, 0.0, 10.0);
  EXPECT_NEAR(forth, std::sqrt(6.0) * (1.0 + 0.5 * 8.0), 1e-12);
  EXPECT_NEAR(back, forth, 1e-12);
}

// Pieces adjoin, and add up to the length of the ray in the box.
TEST(Medium, PiecesTelescope)
{
  SmokeGrid grid = Grid({0, 0.3, 0.35, 1, 2}, {-1, 0, 0.1, 0.9}, {5, 6, 6.5}, 1.0F);
  const Medium medium({grid});
  for (int i = 0; i < 200; ++i)
  {
    const double a = 0.1 * i;
    const Vec3 direction = glm::normalize(Vec3(std::cos(a), std::sin(1.3 * a), std::sin(2.1 * a)));
    const Vec3 inside(1.0 + 0.9 * std::sin(3.0 * a), 0.0, 5.75);
    const auto pieces = WalkOf(medium, inside - 10.0 * direction, direction);
    ASSERT_FALSE(pieces.empty());
    for (std::size_t p = 1; p < pieces.size(); ++p)
    {
      EXPECT_EQ(pieces[p].Begin, pieces[p - 1].End);
      EXPECT_NE(pieces[p].Cell, pieces[p - 1].Cell);
      EXPECT_LT(pieces[p].Begin, pieces[p].End);
    }
    double enter = 0.0;
    double leave = 100.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double start = (inside - 10.0 * direction)[axis];
      const double low = (medium.Lower()[axis] - start) / direction[axis];
      const double high = (medium.Upper()[axis] - start) / direction[axis];
      enter = std::max(enter, std::min(low, high));
      leave = std::min(leave, std::max(low, high));
    }
    EXPECT_NEAR(pieces.front().Begin, enter, 1e-12);
    EXPECT_NEAR(pieces.back().End, leave, 1e-12);
    for (const Segment& piece : pieces)
    {
      const Vec3 middle = inside + (0.5 * (piece.Begin + piece.End) - 10.0) * direction;
      EXPECT_EQ(medium.Locate(middle), piece.Cell);
    }
  }
}

// The finer of two grids counts where they overlap, whichever is given first.
TEST(Medium, FinestGridWins)
{
  const SmokeGrid coarse = Grid({0, 4}, {0, 4}, {0, 4}, 1.0F);
  const SmokeGrid fine = Grid({1, 1.5, 2, 2.5, 3}, {1, 2, 3}, {1, 2, 3}, 10.0F);
  for (const bool coarseFirst : {true, false})
  {
    const Medium medium(
      coarseFirst ? std::vector<SmokeGrid>{coarse, fine} : std::vector<SmokeGrid>{fine, coarse});
    EXPECT_DOUBLE_EQ(
      medium.OpticalDepth({-1, 1.7, 1.7}, {1, 0, 0}, 0.0, 10.0), 1.0 + 2.0 * 10.0 + 1.0);
    EXPECT_DOUBLE_EQ(medium.OpticalDepth({-1, 0.5, 0.5}, {1, 0, 0}, 0.0, 10.0), 4.0);
    EXPECT_FLOAT_EQ(medium.Extinction(medium.Locate({2, 2, 2})), 10.0F);
    EXPECT_FLOAT_EQ(medium.Extinction(medium.Locate({0.5, 2, 2})), 1.0F);
  }
}

// No smoke lies in the gap between two grids, and a ray in their common face counts once.
TEST(Medium, GapsAndCommonFaces)
{
  const Medium gap({Grid({0, 1}, {0, 1}, {0, 1}, 1.0F), Grid({3, 4}, {0, 1}, {0, 1}, 1.0F)});
  EXPECT_DOUBLE_EQ(gap.OpticalDepth({-1, 0.5, 0.5}, {1, 0, 0}, 0.0, 10.0), 2.0);
  const Medium touching({Grid({0, 1}, {0, 1}, {0, 1}, 1.0F), Grid({0, 1}, {1, 2}, {0, 1}, 1.0F)});
  EXPECT_DOUBLE_EQ(touching.OpticalDepth({-1, 1, 0.5}, {1, 0, 0}, 0.0, 10.0), 1.0);
}

TEST(Medium, FarFromTheOrigin)
{
  const double far = 1e6;
  const Medium medium({Grid({far, far + 1, far + 2}, {-far, 1 - far}, {far, far + 1}, 2.0F)});
  EXPECT_NEAR(
    medium.OpticalDepth({far - 1, 0.5 - far, far + 0.5}, {1, 0, 0}, 0.0, 10.0), 4.0, 1e-8);
}

TEST(Medium, None)
{
  const Medium medium(std::vector<SmokeGrid>{});
  EXPECT_TRUE(medium.Empty());
  EXPECT_EQ(medium.Locate(Vec3(0.0)), -1);
  EXPECT_DOUBLE_EQ(medium.OpticalDepth(Vec3(0.0), {1, 0, 0}, 0.0, 10.0), 0.0);
}

TEST(Medium, EmissionOfOneGridOnly)
{
  SmokeGrid flame = Grid({0, 1}, {0, 1}, {0, 1}, 1.0F);
  flame.EmittedLuminance = {5.0F};
  const Medium medium({flame, Grid({1, 2}, {0, 1}, {0, 1}, 1.0F)});
  EXPECT_TRUE(medium.Emits());
  EXPECT_FLOAT_EQ(medium.EmittedLuminance(0), 5.0F);
  EXPECT_FLOAT_EQ(medium.EmittedLuminance(1), 0.0F);
}

TEST(Medium, BlocksHoldEveryCellOnce)
{
  SmokeGrid grid;
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int node = 0; node <= 9 + axis; ++node)
    {
      grid.Nodes[axis].push_back(node);
    }
  }
  grid.Extinction.assign(9 * 10 * 11, 1.0F);
  const Medium medium({grid});
  std::vector<int> met(medium.Cells(), 0);
  for (const Medium::Block& block : medium.Blocks(8))
  {
    std::size_t number = 0;
    block.ForEachCell(
      [&](const std::array<int, 3>& place)
      {
        ++met[medium.Cell(block, place)];
        EXPECT_EQ(block.Number(place), number++);
      });
    EXPECT_EQ(block.Cells(), number);
  }
  EXPECT_EQ(std::count(met.begin(), met.end(), 1), static_cast<std::ptrdiff_t>(met.size()));
}

} // namespace
