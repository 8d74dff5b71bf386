// How a field varies inside cells, by which neighbours, and the noise that this has of them.
#include "CellShape.h"
#include "Scene.h"
#include "ShapeNoise.h"
#include "SlopeWeights.h"
#include "View.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

/// Three cells in a row along x.
Scene Row(const std::vector<float>& extinction = {1.0F, 1.0F, 1.0F})
{
  SceneDescription description;
  SmokeGrid grid;
  grid.Name = "row";
  grid.Nodes = {{{0.0, 1.0, 2.0, 3.0}, {0.0, 1.0}, {0.0, 1.0}}};
  grid.Extinction = extinction;
  description.Albedo = 0.5;
  description.Grids = {grid};
  EmitterCell lamp;
  lamp.Vertices = {{1.4, 0.4, 0.9}, {1.4, 0.6, 0.9}, {1.6, 0.6, 0.9}, {1.6, 0.4, 0.9}};
  lamp.Luminance = {1.0, 1.0, 1.0};
  description.Emitters = {lamp};
  return Scene(description);
}

/// Slope in the middle cell of a row of the logarithm of a field that falls off by a and b K a
/// metre, in cells of an extinction coefficient K.
double SlopeOf(double a, double b, const std::vector<float>& extinction)
{
  const auto between = [&](int first)
  { return -a - b * 0.5 * (extinction[first] + extinction[first + 1]); };
  const auto factors = SlopeWeights(Row(extinction)).Of(1, 0, {0, 2});
  return factors[0] * between(0) + factors[1] * between(1);
}

// Whatever light falls off by, in even smoke both sides count alike, exactly.
TEST(SlopeWeights, EvenSmoke)
{
  for (const float extinction : {1e-6F, 0.3F, 1e4F})
  {
    const Scene scene = Row({extinction, extinction, extinction});
    const auto factors = SlopeWeights(scene).Of(1, 0, {0, 2});
    EXPECT_NEAR(factors[0], 0.5, 1e-12);
    EXPECT_NEAR(factors[1], 0.5, 1e-12);
    EXPECT_NEAR(SlopeWeights(scene).Of(1, 0, {0, -1})[0], 1.0, 1e-12);
    EXPECT_EQ(SlopeWeights(scene).Of(1, 0, {0, -1})[1], 0.0);
    EXPECT_EQ(SlopeWeights(scene).Of(1, 0, {-1, -1})[0], 0.0);
  }
}

// Clear air beside a layer, the layer beside clear air, and a layer of one cell: the mean of both
// sides would be off by up to half of the slope in the layer.
TEST(SlopeWeights, BesideALayer)
{
  constexpr double Layer = 3.0;
  EXPECT_NEAR(SlopeOf(0.2, 1.0, {0.02F, 0.02F, Layer}), -0.22, 0.02);
  EXPECT_NEAR(SlopeOf(0.2, 1.0, {0.02F, Layer, Layer}), -0.2 - Layer, 0.02 * Layer);
  EXPECT_NEAR(SlopeOf(0.2, 1.0, {0.02F, Layer, 0.02F}), -0.2 - Layer, 0.1 * Layer);
  EXPECT_NEAR(SlopeOf(0.2, 0.5, {0.5F, 1.0F, 2.0F}), -0.7, 0.02);
}

/// A value of a mean, a batch each, of a standard deviation that is given as a share.
Lanes Noisy(double mean, double deviation, int phase)
{
  Lanes lanes;
  for (int batch = 0; batch < Batches; ++batch)
  {
    // Sixteen cosines have the mean 0 and the mean square 1 / 2.
    lanes[batch] = static_cast<float>(
      mean * (1.0 + deviation * std::sqrt(2.0) *
                      std::cos(2.0 * std::numbers::pi * phase * batch / Batches)));
  }
  return lanes;
}

Lanes ValueAt(const Scene& scene, const std::vector<Lanes>& field, const Vec3& point)
{
  std::vector<float> means;
  for (const Lanes& lanes : field)
  {
    means.push_back(static_cast<float>(Mean(lanes)));
  }
  const CellShape shape(scene, [&](std::int64_t, std::int64_t cell) { return means[cell]; });
  const double weight = shape.Value(1, point);
  Lanes value;
  for (int batch = 0; batch < Batches; ++batch)
  {
    value[batch] = static_cast<float>(weight * field[1][batch]);
  }
  ShapeNoise(scene, 0, field.data(), means, shape).Add(1, point, weight, value);
  return value;
}

// What batches say of a place between the centres of two cells is what fields made of each batch
// alone have there, where the noise is small enough for the logarithm to be straight.
TEST(ShapeNoise, IsThatOfFieldsOfEachBatch)
{
  const std::vector<Lanes> field = {
    Noisy(5.0, 0.003, 1), Noisy(2.0, 0.0005, 2), Noisy(0.5, 0.002, 3)};
  // In even smoke, and where the neighbours do not count alike.
  for (const std::vector<float>& extinction : {{1.0F, 1.0F, 1.0F}, std::vector{0.2F, 1.0F, 3.0F}})
  {
    const Scene scene = Row(extinction);
    for (const double x : {1.0, 1.3, 1.5, 1.9})
    {
      const Vec3 point(x, 0.5, 0.5);
      const Lanes value = ValueAt(scene, field, point);
      for (int batch = 0; batch < Batches; ++batch)
      {
        const CellShape own(
          scene, [&](std::int64_t, std::int64_t cell) { return field[cell][batch]; });
        const double expected = field[1][batch] * own.Value(1, point);
        // The second order is about the square of the largest deviation.
        EXPECT_NEAR(value[batch] / expected, 1.0, 3e-5) << "x = " << x << ", batch " << batch;
      }
    }
  }
}

// A neighbour that one batch alone brings light to says nothing of a slope: without it, a ray has
// the noise of its own cell, as in the same light without that neighbour's.
TEST(ShapeNoise, LeavesOutCellsThatAreMostlyNoise)
{
  const std::shared_ptr<const Scene> scene(new Scene(Row()));
  Lanes spike;
  spike[0] = 16.0F;
  const auto veil = [&](const Lanes& beside)
  {
    auto field = std::make_shared<LightField>();
    field->Cells = 3;
    field->Patches = scene->Patches();
    field->DirectFluence.assign(3, 0.0F);
    field->MultipleFluence = {Noisy(2.0, 0.01, 1), Noisy(2.0, 0.01, 2), beside};
    field->DirectIlluminance.assign(2 * field->Patches, 0.0F);
    field->MultipleIlluminance.assign(2 * field->Patches, Lanes());
    return View(scene, field).TraceVeil({1.9, 0.1, 0.1}, {0, 1, 0}, 0.0, 0.5, 0).VeilMultiple;
  };
  const Lanes noise = veil(spike);
  const Lanes dark = veil(Lanes());
  EXPECT_GT(Mean(dark), 0.0);
  EXPECT_LT(StandardError(dark) / Mean(dark), 0.01);
  for (int batch = 0; batch < Batches; ++batch)
  {
    EXPECT_FLOAT_EQ(noise[batch], dark[batch]);
  }
}

// Beside a cell without light, and one so bright that the slope is cut off, no noise is added,
// which would be of no measure.
TEST(ShapeNoise, LeavesCutOffSlopes)
{
  const Scene scene = Row();
  for (const double beside : {0.0, 1e-19, 1e15})
  {
    const std::vector<Lanes> field = {
      Noisy(beside, 0.5, 1), Noisy(2.0, 0.003, 2), Noisy(beside * beside, 0.5, 3)};
    const Lanes value = ValueAt(scene, field, {1.9, 0.5, 0.5});
    EXPECT_NEAR(StandardError(value) / Mean(value), FewBatches * 0.003 / std::sqrt(15.0), 1e-6);
  }
}

} // namespace
