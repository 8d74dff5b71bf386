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

/// Relative change along x [1/m] of the source in the middle one of three cells of 1 m, from what
/// sweeps say of their fluence.
float ChangeOf(const std::vector<float>& fluence)
{
  SceneDescription description;
  SmokeGrid grid;
  grid.Name = "row";
  grid.Nodes = {{{0.0, 1.0, 2.0, 3.0}, {0.0, 1.0}, {0.0, 1.0}}};
  grid.Extinction = {1.0F, 1.0F, 1.0F};
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
  return shape.Cells().at(1).Change[0];
}

// The logarithm falls by what the neighbours say, both sides counting alike in even smoke, but the
// source stays above 0 in all of the cell.
TEST(SourceShape, FallsAsTheNeighboursSay)
{
  EXPECT_NEAR(ChangeOf({1.2F, 1.0F, 0.8F}), 0.5 * std::log(0.8 / 1.2), 1e-6);
  EXPECT_NEAR(ChangeOf({0.8F, 1.0F, 1.2F}), 0.5 * std::log(1.2 / 0.8), 1e-6);
  EXPECT_EQ(ChangeOf({1.0F, 1.0F, 0.0F}), 0.0F);
  EXPECT_FLOAT_EQ(ChangeOf({100.0F, 1.0F, 0.01F}), -2.0F);
}

// Far out in dense smoke light may be close to the smallest number of single precision, while it is
// bright beside: such a quotient is not a number of single precision.
TEST(SourceShape, HoldsBesideNextToNothing)
{
  EXPECT_FLOAT_EQ(ChangeOf({1e-35F, 1e5F, 1e5F}), 2.0F);
  EXPECT_FLOAT_EQ(ChangeOf({1e5F, 1e5F, 1e-35F}), -2.0F);
  EXPECT_FLOAT_EQ(ChangeOf({1e5F, 1e-35F, 1e-35F}), -2.0F);
  EXPECT_TRUE(std::isfinite(ChangeOf({1e-35F, 1e30F, 1e-35F})));
}

} // namespace
