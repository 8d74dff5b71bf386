// Neighbours that are found once for a block, against those that the smoke tells of each cell.
#include "CellsAround.h"
#include "Medium.h"
#include "SceneLibrary.h"

#include <set>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

/// Checks all blocks of so many cells an edge; returns how many neighbours lie outside their block.
std::size_t CheckBlocks(const Medium& smoke, int edge)
{
  std::size_t outside = 0;
  for (const Medium::Block& block : smoke.Blocks(edge))
  {
    const CellsAround around(smoke, block);
    std::set<std::int64_t> cells;
    for (std::size_t number = 0; number < around.Count(); ++number)
    {
      EXPECT_TRUE(cells.insert(around.Cell(number)).second);
      const Box expected = smoke.CellBounds(around.Cell(number));
      EXPECT_EQ(around.Bounds(number).Lower, expected.Lower);
      EXPECT_EQ(around.Bounds(number).Upper, expected.Upper);
    }
    block.ForEachCell(
      [&](const std::array<int, 3>& place)
      {
        const std::size_t number = block.Number(place);
        const std::int64_t cell = smoke.Cell(block, place);
        EXPECT_EQ(around.Cell(number), cell);
        for (int face = 0; face < 6; ++face)
        {
          const std::uint32_t beside = around.Beside(number)[face];
          const std::int64_t expected = smoke.Neighbour(cell, face / 2, face % 2);
          EXPECT_EQ(beside == CellsAround::None ? -1 : around.Cell(beside), expected);
        }
      });
    outside += around.Count() - block.Cells();
  }
  return outside;
}

// One grid of 9 x 5 x 6 cells in blocks of four: of each face between blocks both sides.
TEST(CellsAround, BlocksOfAGrid)
{
  const Medium smoke({scenes::UniformSmoke({0, 0, 0}, {9, 5, 6}, {9, 5, 6}, 1.0)});
  EXPECT_EQ(CheckBlocks(smoke, 4), 2U * (2 * 5 * 6 + 9 * 6 + 9 * 5));
}

// A grid of half the cell size beside it, and one that lies over both.
TEST(CellsAround, BlocksBesideOtherGrids)
{
  const Medium smoke({scenes::UniformSmoke({0, 0, 0}, {4, 4, 4}, {4, 4, 4}, 1.0),
    scenes::UniformSmoke({4, 0, 0}, {8, 4, 4}, {8, 8, 8}, 1.0),
    scenes::UniformSmoke({3, 1, 1}, {5, 3, 3}, {16, 16, 16}, 1.0)});
  EXPECT_GT(CheckBlocks(smoke, 8), 0U);
}

} // namespace
