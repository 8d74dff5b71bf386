// Cells at the corners of blocks, and what they tell of those between them.
#include "BlockCorners.h"

#include <array>
#include <set>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

const Medium::Block Long{0, {3, 5, 7}, {8, 4, 1}};

double Linear(const std::array<int, 3>& place)
{
  return 2.0 + 0.5 * place[0] - 0.25 * place[1] + 3.0 * place[2];
}

std::array<double, 8> LinearAtCorners(const Medium::Block& block)
{
  std::array<double, 8> values;
  for (int corner = 0; corner < 8; ++corner)
  {
    values[corner] = Linear(CornerOf(block, corner));
  }
  return values;
}

} // namespace

TEST(BlockCorners, CornersRunFirstAxisFirst)
{
  EXPECT_EQ(CornerOf(Long, 0), (std::array<int, 3>{0, 0, 0}));
  EXPECT_EQ(CornerOf(Long, 1), (std::array<int, 3>{7, 0, 0}));
  EXPECT_EQ(CornerOf(Long, 2), (std::array<int, 3>{0, 3, 0}));
  // A block of one layer has the same corners twice.
  EXPECT_EQ(CornerOf(Long, 7), CornerOf(Long, 3));
}

TEST(BlockCorners, WhatIsLinearIsToldExactly)
{
  for (const Medium::Block& block : {Long, Medium::Block{0, {0, 0, 0}, {4, 4, 4}}})
  {
    const std::array<double, 8> corners = LinearAtCorners(block);
    block.ForEachCell([&](const std::array<int, 3>& place)
      { EXPECT_NEAR(BetweenCorners(corners, block, place), Linear(place), 1e-12); });
  }
}

TEST(BlockCorners, AProductAlongTwoAxesIsToldToo)
{
  const Medium::Block block{0, {0, 0, 0}, {5, 3, 1}};
  std::array<double, 8> corners{};
  // 1 at the far ends of both axes alone.
  corners[3] = corners[7] = 1.0;
  EXPECT_DOUBLE_EQ(BetweenCorners(corners, block, {4, 2, 0}), 1.0);
  EXPECT_DOUBLE_EQ(BetweenCorners(corners, block, {2, 1, 0}), 0.25);
  EXPECT_DOUBLE_EQ(BetweenCorners(corners, block, {4, 1, 0}), 0.5);
  EXPECT_DOUBLE_EQ(BetweenCorners(corners, block, {0, 2, 0}), 0.0);
}

/// Whatever lies in one layer of cells is met, and each diagonal goes its own way.
TEST(BlockCorners, DiagonalsPassThroughAllLayers)
{
  const Medium::Block cube{0, {0, 0, 0}, {8, 8, 8}};
  std::set<std::array<int, 3>> met;
  for (int diagonal = 0; diagonal < 4; ++diagonal)
  {
    for (const Medium::Block& block : {Long, cube})
    {
      std::array<std::set<int>, 3> layers;
      for (int step = 0; step < block.LongestEdge(); ++step)
      {
        const std::array<int, 3> place = PlaceOnDiagonal(block, step, diagonal);
        for (int axis = 0; axis < 3; ++axis)
        {
          ASSERT_GE(place[axis], 0);
          ASSERT_LT(place[axis], block.Size[axis]);
          layers[axis].insert(place[axis]);
        }
        if (block.Size == cube.Size)
        {
          met.insert(place);
        }
      }
      for (int axis = 0; axis < 3; ++axis)
      {
        EXPECT_EQ(layers[axis].size(), static_cast<std::size_t>(block.Size[axis])) << diagonal;
      }
    }
  }
  EXPECT_GE(met.size(), 28U);
}
