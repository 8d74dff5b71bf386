// Meshes of smoke brought into one image: what is in each cell, and that no smoke is lost or
// doubled.
#include "SmokeImage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

namespace
{

using smokevis::DrawnMesh;
using smokevis::Lattice;

/// A mesh from low to low + size with cells of one size and, if squeeze is not 1, ever larger ones.
DrawnMesh Mesh(const std::array<double, 3>& low, const std::array<double, 3>& size,
  const std::array<int, 3>& cells, float extinction, double squeeze = 1.0)
{
  DrawnMesh mesh;
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int i = 0; i <= cells[axis]; ++i)
    {
      const double share = std::pow(static_cast<double>(i) / cells[axis], squeeze);
      mesh.Nodes[axis].push_back(low[axis] + size[axis] * share);
    }
  }
  mesh.Extinction.assign(static_cast<std::size_t>(cells[0]) * cells[1] * cells[2], extinction);
  return mesh;
}

/// Integral of K over a mesh's volume.
double Smoke(const DrawnMesh& mesh)
{
  double sum = 0.0;
  std::size_t cell = 0;
  for (int k = 0; k < mesh.Cells(2); ++k)
  {
    for (int j = 0; j < mesh.Cells(1); ++j)
    {
      for (int i = 0; i < mesh.Cells(0); ++i, ++cell)
      {
        sum += mesh.Extinction[cell] * (mesh.Nodes[0][i + 1] - mesh.Nodes[0][i]) *
               (mesh.Nodes[1][j + 1] - mesh.Nodes[1][j]) *
               (mesh.Nodes[2][k + 1] - mesh.Nodes[2][k]);
      }
    }
  }
  return sum;
}

std::vector<float> Sample(const std::vector<DrawnMesh>& meshes, const Lattice& lattice)
{
  return smokevis::SampleSmoke(meshes, lattice, {0, 0, 0}, lattice.Cells);
}

double Smoke(const std::vector<float>& values, const Lattice& lattice)
{
  return std::accumulate(values.begin(), values.end(), 0.0) * lattice.Spacing[0] *
         lattice.Spacing[1] * lattice.Spacing[2];
}

DrawnMesh RandomMesh(const std::array<double, 3>& low, const std::array<double, 3>& size,
  const std::array<int, 3>& cells, double squeeze, unsigned int seed)
{
  DrawnMesh mesh = Mesh(low, size, cells, 0.0F, squeeze);
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> extinction(0.0F, 3.0F);
  for (float& value : mesh.Extinction)
  {
    value = extinction(random);
  }
  return mesh;
}

} // namespace

TEST(SmokeImage, CellsThatFitKeepTheirValues)
{
  // In the coordinates of a city, where cells of 0.1 m are rounded.
  const DrawnMesh mesh =
    RandomMesh({455123.4, 5411000.7, 12.3}, {1.2, 0.7, 0.5}, {12, 7, 5}, 1.0, 1);
  const Lattice lattice = smokevis::LatticeOver({mesh}, 1e6, 1);
  ASSERT_EQ(lattice.Cells, (std::array<int, 3>{12, 7, 5}));
  const std::vector<float> values = Sample({mesh}, lattice);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    // Coordinates are known to 1e-9 m of 0.1 m.
    EXPECT_NEAR(values[i], mesh.Extinction[i], 1e-6F) << i;
  }
}

TEST(SmokeImage, NoSmokeIsLostOrDoubled)
{
  // Side by side, of other cells each, one stretched, one that ends within cells of the image.
  const std::vector<DrawnMesh> meshes = {
    RandomMesh({0, 0, 0}, {3.2, 2.4, 2.4}, {16, 12, 12}, 1.0, 2),
    RandomMesh({3.2, 0, 0}, {3.2, 2.4, 2.4}, {9, 7, 8}, 1.3, 3),
    RandomMesh({6.4, 0, 0}, {1.07, 2.4, 2.4}, {3, 5, 6}, 1.0, 4)};
  const double all = Smoke(meshes[0]) + Smoke(meshes[1]) + Smoke(meshes[2]);
  for (const double most : {1e6, 3000.0, 100.0, 1.0})
  {
    const Lattice lattice = smokevis::LatticeOver(meshes, most, 1);
    EXPECT_LE(double(lattice.Cells[0]) * lattice.Cells[1] * lattice.Cells[2], std::max(1.0, most));
    EXPECT_NEAR(Smoke(Sample(meshes, lattice), lattice) / all, 1.0, 2e-5) << most;
  }
}

TEST(SmokeImage, TheFinerMeshCounts)
{
  const std::vector<DrawnMesh> meshes = {
    Mesh({1, 1, 1}, {1, 1, 1}, {10, 10, 10}, 5.0F), Mesh({0, 0, 0}, {4, 4, 4}, {8, 8, 8}, 0.25F)};
  for (const double most : {1e6, 8000.0})
  {
    // Cells of 0.1 and 0.2 m, both of which divide the meshes.
    const Lattice lattice = smokevis::LatticeOver(meshes, most, 1);
    EXPECT_NEAR(Smoke(Sample(meshes, lattice), lattice), 5.0 + 0.25 * 63.0, 1e-3) << most;
  }
  std::vector<DrawnMesh> turned = {meshes[1], meshes[0]};
  const Lattice lattice = smokevis::LatticeOver(meshes, 1e6, 1);
  EXPECT_EQ(Sample(meshes, lattice), Sample(turned, lattice));
}

TEST(SmokeImage, BlocksMakeTheWhole)
{
  const std::vector<DrawnMesh> meshes = {RandomMesh({0, 0, 0}, {2, 1, 1}, {11, 5, 4}, 1.2, 5),
    RandomMesh({1, 0, 0}, {2, 1, 1}, {25, 12, 13}, 1.0, 6)};
  const Lattice lattice = smokevis::LatticeOver(meshes, 1e5, 7);
  const std::vector<float> whole = Sample(meshes, lattice);
  const int middle = lattice.Cells[0] / 3;
  const auto left =
    smokevis::SampleSmoke(meshes, lattice, {0, 0, 0}, {middle, lattice.Cells[1], lattice.Cells[2]});
  const auto right = smokevis::SampleSmoke(meshes, lattice, {middle, 0, 0}, lattice.Cells);
  std::size_t cell = 0, fromLeft = 0, fromRight = 0;
  for (int row = 0; row < lattice.Cells[1] * lattice.Cells[2]; ++row)
  {
    for (int i = 0; i < lattice.Cells[0]; ++i, ++cell)
    {
      ASSERT_EQ(whole[cell], i < middle ? left[fromLeft++] : right[fromRight++]);
    }
  }
}

TEST(SmokeImage, LatticesOfOddScenes)
{
  EXPECT_TRUE(smokevis::LatticeOver({}, 1e6, 1).Empty());
  DrawnMesh bounds = Mesh({0, 0, 0}, {1, 1, 1}, {1, 1, 1}, 1.0F);
  bounds.Extinction.clear();
  EXPECT_TRUE(smokevis::LatticeOver({bounds}, 1e6, 1).Empty());
  // More processes than layers: each has one.
  const Lattice few = smokevis::LatticeOver({Mesh({0, 0, 0}, {1, 1, 1}, {2, 2, 2}, 1.0F)}, 1e6, 16);
  EXPECT_EQ(few.Cells[few.LongestAxis()], 16);
  // A tunnel of 10 km in cells of 1 cm: no axis and no image too large for a picture.
  const Lattice tunnel =
    smokevis::LatticeOver({Mesh({0, 0, 0}, {1e4, 0.02, 0.02}, {1000000, 2, 2}, 1.0F)}, 4e6, 1);
  EXPECT_LE(tunnel.Cells[0], 2048);
  EXPECT_EQ(tunnel.Cells[1], 2);
}
