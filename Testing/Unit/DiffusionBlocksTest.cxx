// What light lacks that is scattered on and on, by the diffusion equation.
#include "DiffusionBlocks.h"
#include "SceneLibrary.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

constexpr int Layers = 64;
constexpr double Depth = 16.0;

/// Layers of conservative smoke.
SceneDescription Slab(double width)
{
  SceneDescription description;
  description.Albedo = 1.0;
  description.Grids = {
    scenes::UniformSmoke(Vec3(0.0), Vec3(width, width, Depth), {1, 1, Layers}, 1.0)};
  return description;
}

BatchState Empty(const DiffusionBlocks& blocks, std::size_t sides = 0)
{
  BatchState batch(Layers, sides);
  batch.Residual.assign(blocks.Residuals(), 0.0);
  batch.Lacking = batch.Residual;
  batch.Counted = 1;
  return batch;
}

// A source of 1 lm/m3 between black surroundings: by Fick's law and Marshak's condition the fluence
// is 3 x (L - x) / 2 + L, in the middles of blocks, a mean free path thick; what leaves the outer
// blocks is that of the fluence half a mean free path inside.
TEST(DiffusionBlocks, EvenSourceInASlab)
{
  const Scene scene(Slab(1e6));
  const DiffusionBlocks blocks(scene, 0, std::vector<float>(Layers, 1.0F));
  EXPECT_EQ(blocks.Count(), 16U);
  BatchState batch = Empty(blocks);
  for (std::size_t cell = 0; cell < Layers; ++cell)
  {
    blocks.AddResidual(cell, 1.0, batch.Residual);
  }
  blocks.CompleteSums(1.0, batch);
  const auto fluence = [](double x) { return 1.5 * x * (Depth - x) + Depth; };
  for (std::size_t block = 0; block < blocks.Count(); ++block)
  {
    const double expected = fluence(static_cast<double>(block) + 0.5);
    EXPECT_NEAR(batch.FluenceSum[block * Layers / blocks.Count()], expected,
      (block % 15 == 0 ? 0.03 : 0.01) * expected)
      << "block " << block;
  }
  EXPECT_EQ(batch.Residual, Empty(blocks).Residual);
}

// Half of what the source sends out comes to each of the two surfaces, and a wall in the middle
// parts a block: the fluence is that of two slabs of half the depth. A hundredth leaves through
// edges; the slab is no wider, since sides of surfaces are looked for at a distance from them that
// goes by the scene's size.
TEST(DiffusionBlocks, SurfacesAndAWall)
{
  constexpr double width = 3e3;
  SceneDescription description = Slab(width);
  for (const double z : {0.0, 7.5, Depth})
  {
    scenes::AddRectangle(description.Surfaces, {0, 0, z}, {width, 0, 0}, {0, width, 0}, 1, 1, 0.0);
  }
  const Scene scene(description);
  const DiffusionBlocks blocks(scene, 0, std::vector<float>(Layers, 1.0F));
  EXPECT_EQ(blocks.Count(), 17U);
  BatchState batch = Empty(blocks, 2 * scene.Patches());
  for (std::size_t cell = 0; cell < Layers; ++cell)
  {
    blocks.AddResidual(cell, 1.0, batch.Residual);
  }
  blocks.CompleteSums(1.0, batch);
  // Sides that face the smoke, up and down.
  EXPECT_NEAR(batch.IlluminanceSum[0], 0.5 * 7.5, 0.04 * 7.5);
  EXPECT_NEAR(batch.IlluminanceSum[3], 0.5 * 7.5, 0.04 * 7.5);
  EXPECT_NEAR(batch.IlluminanceSum[2], 0.5 * 8.5, 0.04 * 8.5);
  EXPECT_NEAR(batch.IlluminanceSum[5], 0.5 * 8.5, 0.04 * 8.5);
  EXPECT_EQ(batch.IlluminanceSum[1], 0.0F);
  EXPECT_NEAR(batch.FluenceSum[14], 1.5 * 3.5 * 4.0 + 7.5, 2.0);
}

// A wall below sends on what sweeps found more of: by Fick's law and Marshak's conditions at the
// wall and where light leaves above, the fluence falls from (2 + 3 L) J to 2 J, where J is the net
// flux, 2 s / (1 + rho) less (1 - rho) / (1 + rho) times half the fluence at the wall.
TEST(DiffusionBlocks, ReflectingWall)
{
  constexpr double width = 100.0;
  for (const double reflectance : {0.5, 1.0})
  {
    SceneDescription description = Slab(width);
    scenes::AddRectangle(
      description.Surfaces, Vec3(0.0), {width, 0, 0}, {0, width, 0}, 3, 3, reflectance);
    // All around white.
    const Vec3 up(0.0, 0.0, Depth);
    for (const auto& [corner, edge] :
      {std::pair(Vec3(0.0), Vec3(width, 0, 0)), std::pair(Vec3(0, width, 0), Vec3(width, 0, 0)),
        std::pair(Vec3(0.0), Vec3(0, width, 0)), std::pair(Vec3(width, 0, 0), Vec3(0, width, 0))})
    {
      scenes::AddRectangle(description.Surfaces, corner, edge, up, 1, 1, 1.0);
    }
    const Scene scene(description);
    const DiffusionBlocks blocks(scene, 0, std::vector<float>(Layers, 1.0F));
    BatchState batch = Empty(blocks, 2 * scene.Patches());
    for (std::size_t patch = 0; patch < 9; ++patch)
    {
      blocks.Sides().AddResidual(2 * patch, 1.0, batch.Residual);
    }
    blocks.CompleteSums(1.0, batch);
    const double back = (1.0 - reflectance) / (1.0 + reflectance);
    const double flux =
      2.0 * reflectance / (1.0 + reflectance) / (1.0 + 0.5 * back * (2.0 + 3.0 * Depth));
    for (const double x : {0.5, 7.5, 14.5})
    {
      const double expected = flux * (2.0 + 3.0 * (Depth - x));
      EXPECT_NEAR(batch.FluenceSum[static_cast<std::size_t>(x / Depth * Layers)], expected,
        0.03 * expected + 0.1 * flux)
        << "reflectance " << reflectance << ", depth " << x;
    }
    // A quarter of the fluence at the wall and, of the net flux from it, half less.
    const double illuminance = flux * (0.25 * (2.0 + 3.0 * Depth) - 0.5);
    EXPECT_NEAR(batch.IlluminanceSum[0], illuminance, 0.02 * illuminance);
  }
}

// Noise is not completed, and what all batches agree on is, by its mean.
TEST(DiffusionBlocks, OnlyWhatIsClear)
{
  const Scene scene(Slab(1e6));
  const DiffusionBlocks blocks(scene, 0, std::vector<float>(Layers, 1.0F));
  std::vector<BatchState> batches(Batches, Empty(blocks));
  for (int i = 0; i < Batches; ++i)
  {
    std::fill(batches[i].FluenceSum.begin(), batches[i].FluenceSum.end(), 2.0F);
  }
  // Of two sweeps, around means of two and a half and of three and a half standard errors.
  const double error = 1.0 / std::sqrt(Batches - 1.0);
  const auto lackOf = [&](double deviations)
  {
    for (int i = 0; i < Batches; ++i)
    {
      std::fill(batches[i].Lacking.begin(), batches[i].Lacking.end(),
        2.0 * (deviations * error + (i % 2 == 0 ? 1.0 : -1.0)));
    }
    return blocks.LackOf(2, batches);
  };
  EXPECT_FALSE(lackOf(2.5).IsClear());
  const DiffusionBlocks::Lack lack = lackOf(3.5);
  EXPECT_TRUE(lack.IsClear());
  // Over a fluence of 2.
  EXPECT_NEAR(lack.Size, 0.5 * 3.5 * error, 1e-6);
  EXPECT_NEAR(lack.Error, 0.5 * error, 1e-6);
  blocks.Complete(lack, batches);
  EXPECT_NEAR(batches[3].Fluence[7], 3.5 * error, 1e-6);
  EXPECT_EQ(batches[3].Lacking, Empty(blocks).Lacking);
}

} // namespace
