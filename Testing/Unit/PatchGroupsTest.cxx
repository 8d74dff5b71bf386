// Which small patches share their indirect illuminance.
#include "PatchGroups.h"
#include "Scene.h"
#include "SceneLibrary.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

constexpr double SquareEdge = 0.1;

/// Squares in the plane z = 0, each with corners of its own, in a row along x.
/// @param places of the squares, in their edges, and the reflectance of each
SceneDescription Row(const std::vector<std::pair<int, double>>& squares)
{
  SceneDescription description;
  SurfaceMesh& mesh = description.Surfaces;
  for (const auto& [place, reflectance] : squares)
  {
    const auto first = static_cast<std::uint32_t>(mesh.Points.size());
    const auto cell = static_cast<std::uint32_t>(mesh.CellReflectance.size());
    for (const Vec3& corner : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)})
    {
      mesh.Points.push_back(SquareEdge * corner + SquareEdge * Vec3(place, 0, 0));
    }
    mesh.Triangles.push_back({first, first + 1, first + 2});
    mesh.Triangles.push_back({first, first + 2, first + 3});
    mesh.TriangleCell.insert(mesh.TriangleCell.end(), 2, cell);
    mesh.CellReflectance.push_back({reflectance, reflectance, reflectance});
  }
  return description;
}

// A side of 0.01 m2 that a tenth of a line meets asks for 0.4 m2, which is nearest to a square of
// half the scene's size of 1.005 m, the first of which begins 0.4637 of that before the scene: of a
// row of ten the first three are put together, five, and the last two, although corners of
// neighbours differ by rounding; in whatever unit and wherever the scene lies.
TEST(PatchGroups, ShareWithinASquare)
{
  constexpr std::array<float, 10> hitsTogether = {
    0.3F, 0.3F, 0.3F, 0.5F, 0.5F, 0.5F, 0.5F, 0.5F, 0.2F, 0.2F};
  constexpr std::array<float, 10> means = {1, 1, 1, 5, 5, 5, 5, 5, 8.5F, 8.5F};
  std::vector<std::pair<int, double>> squares;
  for (int place = 0; place < 10; ++place)
  {
    squares.emplace_back(place, 0.5);
  }
  const SceneDescription row = Row(squares);
  EXPECT_NE(row.Surfaces.Points[4 * 5 + 1].x, row.Surfaces.Points[4 * 6].x);
  for (const auto& [factor, offset] : {std::pair(1.0, 0.0), {1.0, 1e6}, {1e3, -1e6}, {1e-3, 0.0}})
  {
    const Scene scene(scenes::Moved(scenes::Scaled(row, factor), Vec3(offset)));
    std::vector<float> hits(20, 0.1F);
    const PatchGroups groups(scene, 0, hits);
    std::vector<float> illuminance(20, 0.0F);
    for (std::size_t patch = 0; patch < 10; ++patch)
    {
      EXPECT_FLOAT_EQ(hits[2 * patch], hitsTogether[patch]);
      EXPECT_FLOAT_EQ(hits[2 * patch + 1], hitsTogether[patch]);
      illuminance[2 * patch] = static_cast<float>(patch);
    }
    groups.Average(illuminance);
    for (std::size_t patch = 0; patch < 10; ++patch)
    {
      EXPECT_FLOAT_EQ(illuminance[2 * patch], means[patch]) << factor << " " << offset;
      EXPECT_EQ(illuminance[2 * patch + 1], 0.0F);
    }
  }
}

// The third is missing, and the last reflects otherwise: all would fit into one square.
TEST(PatchGroups, HangTogetherAndReflectAlike)
{
  std::vector<float> hits(8, 0.02F);
  const Scene scene(Row({{0, 0.5}, {1, 0.5}, {3, 0.5}, {4, 0.3}}));
  const PatchGroups groups(scene, 0, hits);
  EXPECT_EQ(hits, std::vector<float>({0.04F, 0.04F, 0.04F, 0.04F, 0.02F, 0.02F, 0.02F, 0.02F}));
  std::vector<float> illuminance = {1, 10, 3, 30, 5, 50, 7, 70};
  groups.Average(illuminance);
  EXPECT_EQ(illuminance, std::vector<float>({2, 20, 2, 20, 5, 50, 7, 70}));
}

// What enough lines meet stands for itself, and so does what none meets.
TEST(PatchGroups, LeaveOutWhatIsMetOftenOrNever)
{
  std::vector<float> hits = {0.1F, 0.1F, 0.1F, 2.0F, 0.0F, 0.0F};
  const std::vector<float> before = hits;
  const PatchGroups groups(Scene(Row({{0, 0.5}, {1, 0.5}, {2, 0.5}})), 0, hits);
  EXPECT_EQ(hits, before);
}

} // namespace
