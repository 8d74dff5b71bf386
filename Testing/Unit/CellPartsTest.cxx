// Cells that walls cut, and their parts.
#include "Scene.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

/// Eight cells with edges of 1 m around the origin, and triangles among them.
/// @param finer a finer grid over them
Scene CutBy(const std::vector<Triangle>& walls, const std::vector<SmokeGrid>& finer = {})
{
  SceneDescription scene;
  SmokeGrid grid;
  for (std::vector<double>& nodes : grid.Nodes)
  {
    nodes = {-1.0, 0.0, 1.0};
  }
  grid.Extinction.assign(8, 1.0F);
  grid.Extinction[0] = 0.0F;
  scene.Grids = {grid};
  scene.Grids.insert(scene.Grids.end(), finer.begin(), finer.end());
  for (const auto& wall : walls)
  {
    const auto first = static_cast<std::uint32_t>(scene.Surfaces.Points.size());
    scene.Surfaces.Points.insert(scene.Surfaces.Points.end(), wall.begin(), wall.end());
    scene.Surfaces.Triangles.push_back({first, first + 1, first + 2});
    scene.Surfaces.TriangleCell.push_back(
      static_cast<std::uint32_t>(scene.Surfaces.CellReflectance.size()));
    scene.Surfaces.CellReflectance.push_back({0.5, 0.5, 0.5});
  }
  return Scene(std::move(scene));
}

/// A wide triangle in the plane through a point with a normal.
Triangle Wide(const Vec3& point, const Vec3& normal)
{
  const Vec3 u = glm::normalize(glm::cross(normal, Vec3(0.3, 0.5, 0.7)));
  const Vec3 v = glm::normalize(glm::cross(normal, u));
  return {point + 20.0 * u, point - 10.0 * u + 15.0 * v, point - 10.0 * u - 15.0 * v};
}

/// Volumes of the parts of a cell.
std::vector<double> Volumes(const Scene& scene, std::int64_t cell)
{
  std::vector<double> volumes;
  scene.Smoke().Parts().ForEachPart(
    cell, [&](std::int64_t number) { volumes.push_back(scene.Smoke().CellVolume(number)); });
  std::sort(volumes.begin(), volumes.end());
  return volumes;
}

TEST(CellParts, WallsInFacesCutNothing)
{
  const Scene scene = CutBy({Wide(Vec3(0.0), {1, 0, 0}), Wide(Vec3(1e-4), {0, 1, 0}),
    Wide({0, 0, 1}, {0, 0, 1}), Wide({0, 0, 5}, {0, 0, 1})});
  EXPECT_TRUE(scene.Smoke().Parts().Empty());
  EXPECT_EQ(scene.Smoke().Cells(), 8U);
  EXPECT_EQ(scene.Smoke().GridCells(), 8U);
}

TEST(CellParts, OnePlane)
{
  // x + y + z = 1 cuts a tetrahedron of 1/6 off the corner of the cell above the origin.
  const Scene scene = CutBy({Wide({1, 0, 0}, {1, 1, 1})});
  const Medium& smoke = scene.Smoke();
  const std::int64_t cell = 7;
  const auto volumes = Volumes(scene, cell);
  ASSERT_EQ(volumes.size(), 2U);
  EXPECT_NEAR(volumes[0], 1.0 / 6.0, 1e-12);
  EXPECT_NEAR(volumes[1], 5.0 / 6.0, 1e-12);
  EXPECT_EQ(smoke.GridCells(), 8U);
  // The cell without smoke stays whole; so do those that the plane touches only.
  EXPECT_EQ(Volumes(scene, 0), std::vector<double>{1.0});
  const std::int64_t inside = smoke.Locate({0.2, 0.2, 0.2});
  EXPECT_NEAR(smoke.CellVolume(inside), 1.0 / 6.0, 1e-12);
  EXPECT_LT(glm::length(smoke.CellCentre(inside) - Vec3(0.25)), 1e-12);
  // Variance 3/80 of each coordinate of that tetrahedron.
  EXPECT_NEAR(smoke.CellSize(inside).x, std::sqrt(12.0 * 3.0 / 80.0), 0.05);
  EXPECT_NE(smoke.Locate({0.5, 0.5, 0.5}), inside);
  EXPECT_EQ(smoke.Extinction(inside), 1.0F);
  double share = 0.0;
  Vec3 middle(0.0);
  for (const PartSample& sample : smoke.Parts().Find(inside)->Fine)
  {
    share += sample.Share;
    middle += static_cast<double>(sample.Share) * Vec3(sample.Offset);
  }
  EXPECT_NEAR(share, 1.0, 1e-6);
  EXPECT_LT(glm::length(middle), 0.01);
}

TEST(CellParts, CornerOfThreeWalls)
{
  // Walls that end in their common corner: what they enclose is one part.
  const Vec3 corner(0.3, 0.4, 0.35);
  const Vec3 x(3, 0, 0);
  const Vec3 y(0, 3, 0);
  const Vec3 z(0, 0, 3);
  const Scene scene = CutBy({{corner, corner + x, corner + y}, {corner, corner + y, corner + z},
    {corner, corner + z, corner + x}});
  const Medium& smoke = scene.Smoke();
  EXPECT_NEAR(smoke.CellVolume(smoke.Locate({0.9, 0.9, 0.9})), 0.7 * 0.6 * 0.65, 1e-12);
  const auto volumes = Volumes(scene, 7);
  EXPECT_LE(volumes.size(), 3U);
  EXPECT_NEAR(std::accumulate(volumes.begin(), volumes.end(), 0.0), 1.0, 1e-12);
}

TEST(CellParts, TwoSheets)
{
  const Scene scene = CutBy({Wide({0.3, 0, 0}, {1, 0, 0}), Wide({0.4, 0, 0}, {-1, 0, 0})});
  const auto volumes = Volumes(scene, 7);
  ASSERT_EQ(volumes.size(), 3U);
  EXPECT_NEAR(volumes[0], 0.1, 1e-12);
  EXPECT_NEAR(volumes[1], 0.3, 1e-12);
  EXPECT_NEAR(volumes[2], 0.6, 1e-12);
}

// A finer grid over the half of a cell below z = 1/2, in which x + y + z = 1 cuts off a
// tetrahedron: of its 1/6 there is left 1/48 above that.
TEST(CellParts, PartlyUnderAFinerGrid)
{
  SmokeGrid finer;
  finer.Nodes = {{{0.0, 0.5, 1.0}, {0.0, 0.5, 1.0}, {0.0, 0.25, 0.5}}};
  finer.Extinction.assign(8, 0.0F);
  const Scene scene = CutBy({Wide({1, 0, 0}, {1, 1, 1})}, {finer});
  const Medium& smoke = scene.Smoke();
  const std::int64_t inside = smoke.Locate({0.1, 0.1, 0.6});
  const std::int64_t outside = smoke.Locate({0.9, 0.9, 0.9});
  ASSERT_NE(inside, outside);
  EXPECT_NEAR(smoke.OwnVolume(inside), 1.0 / 48.0, 1e-12);
  EXPECT_NEAR(smoke.OwnVolume(outside), 0.5 - 1.0 / 48.0, 1e-12);
  EXPECT_NEAR(smoke.CellVolume(inside), 1.0 / 6.0, 1e-12);
}

TEST(CellParts, SmallWallLeavesTheCellWhole)
{
  const Scene scene = CutBy({{Vec3(0.5, 0.5, 0.5), Vec3(0.6, 0.5, 0.5), Vec3(0.5, 0.6, 0.55)}});
  EXPECT_TRUE(scene.Smoke().Parts().Empty());
}

// Pieces follow each other without gaps and lie where Locate finds them; the wall parts them.
TEST(CellParts, Walk)
{
  const Scene scene = CutBy({Wide({0.2, 0.1, 0.3}, {1.0, 0.4, -0.3}),
    Wide({0.5, 0.1, -0.2}, {0.2, -1.0, 0.3}), Wide({-0.4, 0.2, 0.1}, {0.5, 0.2, 1.0})});
  const Medium& smoke = scene.Smoke();
  ASSERT_FALSE(smoke.Parts().Empty());
  double volume = 0.0;
  for (std::size_t cell = 0; cell < smoke.Cells(); ++cell)
  {
    volume += smoke.CellVolume(static_cast<std::int64_t>(cell));
  }
  EXPECT_NEAR(volume, 8.0, 1e-11);
  std::vector<Segment> pieces;
  for (int i = 0; i < 200; ++i)
  {
    const Vec3 origin(-2.0, 1.7 * std::sin(i * 1.3), 1.7 * std::cos(i * 2.1));
    const Vec3 target(1.0, std::sin(i * 0.7), std::cos(i * 0.9));
    const Vec3 direction = glm::normalize(target - origin);
    smoke.Walk(origin, direction, 0.0, 5.0, pieces);
    for (std::size_t piece = 0; piece < pieces.size(); ++piece)
    {
      const Segment& own = pieces[piece];
      EXPECT_GT(own.End, own.Begin);
      EXPECT_EQ(smoke.Locate(origin + 0.5 * (own.Begin + own.End) * direction), own.Cell);
      if (piece > 0)
      {
        EXPECT_EQ(own.Begin, pieces[piece - 1].End);
        EXPECT_NE(own.Cell, pieces[piece - 1].Cell);
      }
    }
  }
}

} // namespace
