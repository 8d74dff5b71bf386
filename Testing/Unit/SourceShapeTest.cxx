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

/// Of the source in the middle one of three cells of 1 m, from what sweeps say of their fluence.
Shape ShapeOf(const std::vector<float>& fluence, float extinction = 1.0F)
{
  SceneDescription description;
  SmokeGrid grid;
  grid.Name = "row";
  grid.Nodes = {{{0.0, 1.0, 2.0, 3.0}, {0.0, 1.0}, {0.0, 1.0}}};
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

// By a hundred over two cells: exp(-2.3 x) has a mean of sinh(1.15) / 1.15 over 1 m around 0. It
// falls by exp(4) at most. In smoke too thin to dim light so, the source is linear, but above 0 in
// all of the cell.
TEST(SourceShape, IsExponentialWhereItIsSteep)
{
  const Shape steep = ShapeOf({10.0F, 1.0F, 0.1F});
  EXPECT_TRUE(steep.Steep);
  EXPECT_NEAR(steep.Change, -std::log(10.0), 1e-6);
  const double half = 0.5 * std::log(10.0);
  EXPECT_NEAR(steep.Middle, -std::log(std::sinh(half) / half), 1e-6);
  EXPECT_FLOAT_EQ(ShapeOf({100.0F, 1.0F, 0.01F}).Change, -4.0F);
  const Shape thin = ShapeOf({100.0F, 1.0F, 0.01F}, 0.3F);
  EXPECT_FALSE(thin.Steep);
  EXPECT_FLOAT_EQ(thin.Change, -2.0F);
}

// Far out in dense smoke light may be close to the smallest number of single precision, while it is
// bright beside: such a quotient is not a number of single precision.
TEST(SourceShape, HoldsBesideNextToNothing)
{
  EXPECT_FLOAT_EQ(ShapeOf({1e-35F, 1e5F, 1e5F}).Change, 4.0F);
  EXPECT_FLOAT_EQ(ShapeOf({1e5F, 1e5F, 1e-35F}).Change, -4.0F);
  EXPECT_FLOAT_EQ(ShapeOf({1e5F, 1e-35F, 1e-35F}).Change, -4.0F);
  EXPECT_TRUE(std::isfinite(ShapeOf({1e-35F, 1e30F, 1e-35F}).Change));
}

} // namespace
