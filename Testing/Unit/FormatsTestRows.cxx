// The loops over rows of values: rows of any length give the plain formula, bit for bit.
#include "RowLoops.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace smokevis
{
namespace
{

// A layer of nodes, and another above, for rows of some number of cells.
struct Nodes
{
  explicit Nodes(std::size_t cells, std::size_t rows = 6) : Values(2 * (cells + 1) * (rows + 1) + 1)
  {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(0.0F, 3.0F);
    for (float& value : Values)
    {
      value = uniform(random);
    }
    // One value before the first that counts, so that no row is aligned.
    Rows = {Values.data() + 1, cells + 1, (cells + 1) * (rows + 1), cells, rows};
  }

  float Mean(std::size_t i, std::size_t j) const
  {
    const float* const corner = Rows.First + j * Rows.Stride + i;
    const auto four = [this](const float* at)
    { return (at[0] + at[Rows.Layer]) + (at[1] + at[Rows.Layer + 1]); };
    return 0.125F * (four(corner) + four(corner + Rows.Stride));
  }

  std::vector<float> Values;
  StoredRows Rows;
};

constexpr std::size_t LongestRow = 37;
constexpr float Untouched = -7.0F;

TEST(RowLoops, MeansOfNodesInRowsOfAnyLength)
{
  for (std::size_t cells = 1; cells <= LongestRow; ++cells)
  {
    const Nodes nodes(cells);
    const std::size_t stride = cells + 2;
    std::vector<float> target(stride * nodes.Rows.Rows, Untouched);
    ASSERT_TRUE(CopyExtinctionOfNodes(nodes.Rows, target.data(), stride));
    std::vector<float> means(cells);
    for (std::size_t j = 0; j < nodes.Rows.Rows; ++j)
    {
      MeansOfNodes(
        nodes.Rows.First + j * nodes.Rows.Stride, nodes.Rows.Stride, nodes.Rows.Layer, means);
      for (std::size_t i = 0; i < cells; ++i)
      {
        ASSERT_EQ(target[j * stride + i], nodes.Mean(i, j)) << cells << " cells, cell " << i;
        ASSERT_EQ(means[i], nodes.Mean(i, j)) << cells << " cells, cell " << i;
      }
      ASSERT_EQ(target[j * stride + cells], Untouched) << "beyond a row of " << cells;
      ASSERT_EQ(target[j * stride + cells + 1], Untouched) << "beyond a row of " << cells;
    }
  }
}

TEST(RowLoops, WhatIsNoExtinctionIsFoundWhereverItIs)
{
  constexpr float infinity = std::numeric_limits<float>::infinity();
  for (const float bad : {std::nanf(""), infinity, -infinity, -1.0F})
  {
    for (std::size_t cells = 1; cells <= LongestRow; ++cells)
    {
      Nodes nodes(cells);
      std::vector<float> target(cells * nodes.Rows.Rows);
      for (std::size_t place = 0; place < cells * nodes.Rows.Rows; ++place)
      {
        const std::size_t i = place % cells;
        const std::size_t j = place / cells;
        float* const at = nodes.Values.data() + 1 + j * nodes.Rows.Stride + i;
        const float before = std::exchange(*at, 1e3F * bad);
        EXPECT_FALSE(CopyExtinction(nodes.Rows, target.data(), cells)) << bad << " at " << place;
        EXPECT_FALSE(CopyExtinctionOfNodes(nodes.Rows, target.data(), cells))
          << bad << " at " << place;
        EXPECT_FALSE(AddExtinction({at - i, cells}, 0.5F, target.data())) << bad << " at " << place;
        *at = before;
      }
      EXPECT_TRUE(CopyExtinction(nodes.Rows, target.data(), cells));
    }
  }
}

TEST(RowLoops, RoundingBelowZeroIsNoSmoke)
{
  std::vector<float> values(LongestRow, 0.5F * MostNegativeExtinction);
  std::vector<float> target(LongestRow, Untouched);
  EXPECT_TRUE(CopyExtinction(values, target.data()));
  EXPECT_EQ(target, std::vector<float>(LongestRow, 0.0F));
  EXPECT_TRUE(AddExtinction(values, 1.0F, target.data()));
  EXPECT_EQ(target, std::vector<float>(LongestRow, 0.0F));
}

} // namespace
} // namespace smokevis
