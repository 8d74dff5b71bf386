#include "GridRefinement.h"

#include "Errors.h"
#include "Scene.h"
#include "SceneLibrary.h"

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

constexpr std::size_t Plenty = 1000000;

/// Eight cells of a metre in a row.
SceneDescription Row(double extinction, double albedo)
{
  SceneDescription scene;
  scene.Albedo = albedo;
  scene.Grids = {scenes::UniformSmoke(Vec3(0.0), {8, 1, 1}, {8, 1, 1}, extinction)};
  return scene;
}

TEST(GridRefinement, KeepsWhereSmokeIs)
{
  SmokeGrid grid;
  grid.Name = "two layers";
  grid.Nodes = {{{0.0, 1.0, 4.0}, {-1.0, 0.0}, {2.0, 3.0, 3.5}}};
  grid.Extinction = {1.0F, 2.0F, 3.0F, 4.0F};
  grid.EmittedLuminance = {0.0F, 0.0F, 7.0F, 0.0F};
  GridRefinement refinement;
  EXPECT_TRUE(refinement.None());
  refinement.Parts = {{{1, 3}, {1}, {2, 1}}};
  EXPECT_FALSE(refinement.None());
  EXPECT_EQ(refinement.Cells(), 12U);
  const std::vector<std::int64_t> parents = {0, 1, 1, 1, 0, 1, 1, 1, 2, 3, 3, 3};
  EXPECT_EQ(refinement.Parents(), parents);

  const SmokeGrid fine = Refined(grid, refinement);
  EXPECT_EQ(fine.Name, grid.Name);
  EXPECT_EQ(fine.Nodes[0], (std::vector<double>{0.0, 1.0, 2.0, 3.0, 4.0}));
  EXPECT_EQ(fine.Nodes[1], grid.Nodes[1]);
  EXPECT_EQ(fine.Nodes[2], (std::vector<double>{2.0, 2.5, 3.0, 3.5}));
  for (std::size_t cell = 0; cell < parents.size(); ++cell)
  {
    EXPECT_EQ(fine.Extinction[cell], grid.Extinction[parents[cell]]);
    EXPECT_EQ(fine.EmittedLuminance[cell], grid.EmittedLuminance[parents[cell]]);
  }
}

TEST(GridRefinement, LeavesWhatIsThin)
{
  // Three quarters of a mean free path of scattered light; of soot, four fifths of all counts as
  // such.
  for (const auto& [extinction, albedo] :
    {std::pair(0.75, 1.0), {0.83, 0.9}, {0.9375, 0.3}, {50.0, 0.0}})
  {
    const ThickSmoke thick = FindThickSmoke(Row(extinction, albedo), Plenty);
    EXPECT_EQ(thick.Thick, 0U);
    EXPECT_FALSE(thick.IsRefined());
  }
}

TEST(GridRefinement, CutsWhatIsThick)
{
  for (const auto& [extinction, albedo, parts] : {std::tuple(0.76, 1.0, 2), {4.0, 1.0, 8},
         {4.0, 0.9, 8}, {2.0, 0.1, 4}, {10.0, 1.0, 20}, {14.9, 1.0, 20}})
  {
    SceneDescription scene = Row(extinction, albedo);
    const ThickSmoke thick = FindThickSmoke(scene, Plenty);
    const std::size_t cells = 8U * parts * parts * parts;
    EXPECT_EQ(thick.Thick, 8U);
    EXPECT_EQ(thick.Cells, cells);
    EXPECT_EQ(thick.Depth, 0.5);
    EXPECT_EQ(thick.Refinements.front().Parts[0], std::vector<int>(8, parts));
    Refine(scene.Grids, thick.Refinements);
    EXPECT_EQ(scene.Grids.front().Extinction.size(), cells);
  }
  // Blue light is dimmed most.
  SceneDescription colours = Row(0.5, 1.0);
  colours.Bands = 3;
  colours.ExtinctionScale = {1.0, 1.5, 2.0};
  EXPECT_EQ(FindThickSmoke(colours, Plenty).Refinements.front().Parts[1], std::vector<int>{2});
  // A single band is the first one.
  colours.Bands = 1;
  EXPECT_EQ(FindThickSmoke(colours, Plenty).Thick, 0U);
}

// Numbers that are round but for rounding make no stripes, whatever the unit of length and the
// place of the origin.
TEST(GridRefinement, IsEvenInEvenSmoke)
{
  for (const auto& [extinction, parts] :
    {std::pair(7.5, 1), {10.0, 2}, {15.0, 3}, {50.0, 10}, {100.0, 20}})
  {
    for (const double unit : {1e-3, 1.0, 1e3})
    {
      for (const double origin : {0.0, 0.3, 7.0, 1e4})
      {
        SceneDescription scene;
        scene.Albedo = 1.0;
        scene.Grids = {scenes::UniformSmoke(unit * Vec3(origin),
          unit * (Vec3(origin) + Vec3(1.0, 0.2, 0.2)), {10, 2, 2}, extinction / unit)};
        const ThickSmoke thick = FindThickSmoke(scene, 4 * Plenty);
        EXPECT_EQ(thick.IsRefined(), parts > 1);
        if (thick.IsRefined())
        {
          EXPECT_EQ(thick.Refinements.front().Parts[0], std::vector<int>(10, parts));
        }
      }
    }
  }
}

TEST(GridRefinement, LeavesWhatIsOpaque)
{
  SceneDescription scene = Row(15.1, 1.0);
  const ThickSmoke opaque = FindThickSmoke(scene, Plenty);
  EXPECT_FALSE(opaque.IsRefined());
  EXPECT_EQ(opaque.Thick, 0U);
  EXPECT_EQ(opaque.Opaque, 8U);
  scene.Grids.front().Extinction[5] = 1.0F;
  const ThickSmoke thick = FindThickSmoke(scene, Plenty);
  EXPECT_EQ(thick.Thick, 1U);
  EXPECT_EQ(thick.Refinements.front().Parts[0], (std::vector<int>{1, 1, 1, 1, 1, 2, 1, 1}));
  EXPECT_EQ(thick.Refinements.front().Parts[1], std::vector<int>{2});
  // Slender cells are not opaque across.
  scene.Grids = {scenes::UniformSmoke(Vec3(0.0), {100, 0.2, 0.2}, {1, 2, 2}, 5.0)};
  EXPECT_EQ(FindThickSmoke(scene, Plenty).Refinements.front().Parts,
    (std::array<std::vector<int>, 3>{{{20}, {1, 1}, {1, 1}}}));
}

// Flames of a few cells are not worth slabs of finer cells through all the hall.
TEST(GridRefinement, LeavesTheFewCellsOfAFlame)
{
  SceneDescription scene;
  scene.Albedo = 0.5;
  scene.Grids = {scenes::UniformSmoke(Vec3(0.0), {10, 10, 2}, {10, 10, 2}, 0.1)};
  scene.Grids.push_back(scenes::UniformSmoke({20, 0, 0}, {30, 10, 2}, {10, 10, 2}, 0.1));
  scene.Grids[0].Extinction[55] = 5.0F;
  scene.Grids[0].Extinction[155] = 5.0F;
  EXPECT_EQ(FindThickSmoke(scene, Plenty).Thick, 0U);
  // Of half as much smoke, the same are too many; and only the grid that they lie in is refined.
  // Traces, as simulations leave them in clear air, are no smoke.
  std::fill(
    scene.Grids[0].Extinction.begin() + 60, scene.Grids[0].Extinction.begin() + 155, 1e-30F);
  const ThickSmoke thick = FindThickSmoke(scene, Plenty);
  EXPECT_EQ(thick.Thick, 2U);
  EXPECT_EQ(thick.Jutting, 2U);
  EXPECT_EQ(thick.Refinements[0].Parts[2], (std::vector<int>{16, 16}));
  std::vector<int> column(10, 1);
  column[5] = 16;
  EXPECT_EQ(thick.Refinements[0].Parts[0], column);
  EXPECT_TRUE(thick.Refinements[1].None());
  EXPECT_EQ(thick.Cells, 25U * 25U * 32U);
}

// The finest that there is room for. The cells of thin grids take none of it.
TEST(GridRefinement, TakesNoMoreCellsThanItMay)
{
  SceneDescription scene = Row(3.0, 1.0);
  scene.Grids.push_back(scenes::UniformSmoke({20, 0, 0}, {30, 10, 10}, {10, 10, 10}, 0.1));
  const auto parts = [&scene](std::size_t most)
  {
    const ThickSmoke thick = FindThickSmoke(scene, most);
    EXPECT_EQ(thick.Thick, 8U);
    EXPECT_EQ(thick.IsRefined(), thick.Depth > 0.0);
    return thick.IsRefined() ? thick.Refinements.front().Parts[1].front() : 1;
  };
  EXPECT_EQ(parts(8 * 8 * 216), 6);
  EXPECT_EQ(parts(8 * 8 * 216 - 1), 4);
  EXPECT_EQ(parts(8 * 64), 4);
  EXPECT_EQ(parts(8 * 64 - 1), 3);
  EXPECT_EQ(parts(8 * 27 - 1), 2);
  EXPECT_EQ(parts(8 * 8 - 1), 1);
  EXPECT_EQ(parts(0), 1);
  EXPECT_EQ(FindThickSmoke(scene, 0).Cells, 8U * 8U);
  // Cells that a coarser aim leaves whole are not said to be refined.
  const ThickSmoke whole = FindThickSmoke(Row(0.9, 1.0), 63);
  EXPECT_FALSE(whole.IsRefined());
  EXPECT_EQ(whole.Thick, 8U);
  EXPECT_EQ(whole.Cells, 64U);
}

/// A box of thicker smoke in the middle of thin smoke, in cells of a metre.
SceneDescription CloudInThinSmoke(int cells, int cloud, double extinction)
{
  SceneDescription scene;
  scene.Albedo = 1.0;
  scene.Grids = {scenes::UniformSmoke(Vec3(0.0), Vec3(cells), {cells, cells, cells}, 0.05)};
  const auto inside = [&](int place) { return std::abs(2 * place + 1 - cells) <= cloud; };
  for (int i = 0; i < cells * cells * cells; ++i)
  {
    if (inside(i % cells) && inside(i / cells % cells) && inside(i / (cells * cells)))
    {
      scene.Grids[0].Extinction[i] = static_cast<float>(extinction);
    }
  }
  return scene;
}

// Along the edges and at the corners of a cloud cells are thick sooner, as long as that is cheap;
// layers have no such cells.
TEST(GridRefinement, CutsWhatJutsOut)
{
  const SceneDescription scene = CloudInThinSmoke(10, 4, 0.7);
  const ThickSmoke thick = FindThickSmoke(scene, Plenty);
  EXPECT_EQ(thick.Thick, 0U);
  EXPECT_EQ(thick.Jutting, 8U + 12U * 2U);
  EXPECT_EQ(thick.JuttingDepth, 0.25);
  EXPECT_EQ(thick.Refinements[0].Parts[0], (std::vector<int>{1, 1, 1, 3, 3, 3, 3, 1, 1, 1}));
  EXPECT_EQ(thick.Cells, 18U * 18U * 18U);
  EXPECT_EQ(FindThickSmoke(scene, Plenty, 0.02).Jutting, thick.Jutting);
  EXPECT_EQ(FindThickSmoke(scene, Plenty, 0.03).Jutting, 0U);
  // Coarser, and not at all, where there is room for fewer cells.
  const ThickSmoke coarser = FindThickSmoke(scene, 8 * 18 * 18 * 18 - 1);
  EXPECT_EQ(coarser.JuttingDepth, 0.4);
  EXPECT_EQ(coarser.Cells, 14U * 14U * 14U);
  const ThickSmoke left = FindThickSmoke(scene, 8 * 14 * 14 * 14 - 1);
  EXPECT_FALSE(left.IsRefined());
  EXPECT_EQ(left.Jutting, 32U);
  EXPECT_FALSE(FindThickSmoke(CloudInThinSmoke(10, 4, 0.29), Plenty).IsRefined());
  // Few of them in much smoke, and the border of a layer.
  EXPECT_EQ(FindThickSmoke(CloudInThinSmoke(16, 4, 0.7), Plenty).Jutting, 0U);
  SceneDescription layer = CloudInThinSmoke(4, 0, 0.0);
  std::fill(layer.Grids[0].Extinction.begin() + 32, layer.Grids[0].Extinction.end(), 0.7F);
  EXPECT_EQ(FindThickSmoke(layer, Plenty).Jutting, 0U);
  // What is thick is cut all the same, where what juts out is not.
  const SceneDescription both = CloudInThinSmoke(10, 4, 1.0);
  EXPECT_EQ(FindThickSmoke(both, Plenty).Refinements[0].Parts[1][4], 4);
  const ThickSmoke alone = FindThickSmoke(both, 8 * 16 * 16 * 16);
  EXPECT_EQ(alone.Refinements[0].Parts[1][4], 2);
}

// Of two grids the finer one counts where they overlap, and goes on to when the other one is
// refined to smaller cells than it has.
TEST(GridRefinement, CountsAsBeforeWhereGridsOverlap)
{
  const SmokeGrid coarse = scenes::UniformSmoke(Vec3(0.0), Vec3(4.0), {2, 2, 2}, 4.0);
  const SmokeGrid fine = scenes::UniformSmoke(Vec3(0.0), {4, 4, 1}, {4, 4, 1}, 0.1);
  GridRefinement refinement;
  refinement.Parts = {{{4, 4}, {4, 4}, {4, 4}}};
  for (const SmokeGrid& grid : {coarse, Refined(coarse, refinement)})
  {
    const Medium smoke({grid, fine});
    EXPECT_EQ(smoke.Extinction(smoke.Locate({1.0, 1.0, 0.5})), 0.1F);
    EXPECT_EQ(smoke.Extinction(smoke.Locate({1.0, 1.0, 1.5})), 4.0F);
  }
}

TEST(GridRefinement, RefusesBrokenGrids)
{
  SceneDescription scene = Row(3.0, 1.0);
  scene.Grids.front().Nodes[0][4] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(FindThickSmoke(scene, Plenty), Error);
}

} // namespace
