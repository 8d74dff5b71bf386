// How the sources of sweeps vary inside cells.
#include "SourceShape.h"
#include "BatchState.h"
#include "DirectField.h"
#include "LightField.h"
#include "Scene.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

struct Shape
{
  bool Steep;
  /// Along x [1/m].
  float Change;
  float Middle;
};

/// Of the source in the middle one of three cells of 1 m in a row, from what sweeps say of their
/// fluence.
/// @param width of the row [m]
Shape ShapeOf(const std::vector<float>& fluence, float extinction = 1.0F, double width = 1.0)
{
  SceneDescription description;
  SmokeGrid grid;
  grid.Name = "row";
  grid.Nodes = {{{0.0, 1.0, 2.0, 3.0}, {0.0, width}, {0.0, width}}};
  grid.Extinction.assign(3, extinction);
  description.Albedo = 0.9;
  description.Grids = {grid};
  const Scene scene(description);
  LightField field;
  field.Cells = fluence.size();
  field.DirectFluence.assign(field.Cells, 0.0F);
  const DirectField direct(scene, field);
  SourceShape shape(scene, field, direct, 0, grid.Extinction);
  std::vector<BatchState> batches(Batches, BatchState(field.Cells, 0));
  for (BatchState& batch : batches)
  {
    batch.FluenceSum = fluence;
    batch.Counted = 1;
  }
  shape.Follow(batches);
  const SourceShape::Shaped& own = shape.Cells().at(1);
  return {shape.Steep(1), own.Change[0], own.Middle};
}

// The logarithm falls by what the neighbours say, both sides counting alike in even smoke.
TEST(SourceShape, FallsAsTheNeighboursSay)
{
  EXPECT_NEAR(ShapeOf({1.2F, 1.0F, 0.8F}).Change, 0.5 * std::log(0.8 / 1.2), 1e-6);
  EXPECT_NEAR(ShapeOf({0.8F, 1.0F, 1.2F}).Change, 0.5 * std::log(1.2 / 0.8), 1e-6);
  EXPECT_FALSE(ShapeOf({0.8F, 1.0F, 1.2F}).Steep);
  EXPECT_EQ(ShapeOf({1.0F, 1.0F, 0.0F}).Change, 0.0F);
}

/// Most that the logarithm falls by over a depth, sinh(k (depth + 0.7104)) / sinh(0.7104 k) with
/// the k of an albedo of 0.9.
double MostOf(double depth)
{
  const double decay = std::sqrt(0.3) * 0.96;
  return std::log(std::sinh(decay * (depth + 0.7104)) / std::sinh(decay * 0.7104));
}

// By 25 over two cells: exp(-1.6 x) has a mean of sinh(0.8) / 0.8 over 1 m around 0. It falls by no
// more than light does that diffuses to an end.
TEST(SourceShape, IsExponentialWhereItIsSteep)
{
  const Shape steep = ShapeOf({5.0F, 1.0F, 0.2F}, 3.0F);
  EXPECT_TRUE(steep.Steep);
  EXPECT_NEAR(steep.Change, -std::log(5.0), 1e-6);
  const double half = 0.5 * std::log(5.0);
  EXPECT_NEAR(steep.Middle, -std::log(std::sinh(half) / half), 1e-6);
  EXPECT_NEAR(ShapeOf({100.0F, 1.0F, 0.01F}, 3.0F).Change, -MostOf(3.0), 1e-6);
}

// In smoke too thin to dim light so, and across cells that are much longer than light gets, the
// source is linear, but above 0 in all of the cell.
TEST(SourceShape, IsLinearInThinSmokeAndLongCells)
{
  for (const Shape& shape :
    {ShapeOf({100.0F, 1.0F, 0.01F}, 0.3F), ShapeOf({100.0F, 1.0F, 0.01F}, 6.5F, 0.5)})
  {
    EXPECT_FALSE(shape.Steep);
    EXPECT_FLOAT_EQ(shape.Change, -2.0F);
  }
}

// Far out in dense smoke light may be close to the smallest number of single precision, while it is
// bright beside: such a quotient is not a number of single precision.
TEST(SourceShape, HoldsBesideNextToNothing)
{
  EXPECT_NEAR(ShapeOf({1e-35F, 1e5F, 1e5F}).Change, MostOf(1.0), 1e-6);
  EXPECT_NEAR(ShapeOf({1e5F, 1e5F, 1e-35F}).Change, -MostOf(1.0), 1e-6);
  EXPECT_NEAR(ShapeOf({1e5F, 1e-35F, 1e-35F}).Change, -MostOf(1.0), 1e-6);
  EXPECT_TRUE(std::isfinite(ShapeOf({1e-35F, 1e30F, 1e-35F}).Change));
}

} // namespace
