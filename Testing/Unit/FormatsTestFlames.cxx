// The light of flames: black bodies against the old definition of the candela, lumens that add up,
// and where a run keeps its heat release rate.
#include "BlackBody.h"
#include "FlameLight.h"
#include "FlameSource.h"
#include "FormatsTestRun.h"
#include "SmvFile.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

using testing::Each;
using testing::ElementsAre;
using testing::FloatEq;
using testing::FloatNear;
using testing::HasSubstr;

namespace smokevis
{

namespace
{

// Lumens that a mesh's cells send out, 4 pi k_a L V each.
double LumensOf(const SmvMesh& mesh, const std::vector<float>& extinction,
  const std::vector<float>& luminance, double albedo)
{
  double lumens = 0.0;
  for (int i = 0; i < mesh.Cells(0); ++i)
  {
    const double volume = mesh.Nodes[0][i + 1] - mesh.Nodes[0][i];
    lumens += 4.0 * std::numbers::pi * extinction[i] * (1.0 - albedo) * luminance[i] * volume;
  }
  return lumens;
}

// A row of three cells, 1, 2 and 1 m long and 1 m2 across.
SmvMesh Row()
{
  SmvMesh mesh;
  mesh.Nodes = {{{0.0, 1.0, 3.0, 4.0}, {0.0, 1.0}, {0.0, 1.0}}};
  return mesh;
}

} // namespace

TEST(BlackBody, MeetsTheOldCandela)
{
  // From 1948 to 1979 the candela was defined by a black body at the freezing point of platinum,
  // 2041.4 K, of 60 cd/cm2; the values agree within the rounding of that definition (0.6 %).
  EXPECT_NEAR(BlackBodyLuminance(2041.4 - 273.15) / 6e5, 1.0, 0.006);
}

TEST(BlackBody, FallsByWiensLaw)
{
  // Close to 555 nm, L goes as exp(-h c / (k T 0.57 um)) at flame temperatures: a ratio of 1400 K
  // to 1200 K of about 17.5 (1/T differs by 1.19e-4, times 24 000 K).
  const double ratio = BlackBodyLuminance(1400 - 273.15) / BlackBodyLuminance(1200 - 273.15);
  EXPECT_NEAR(std::log(ratio), 1.4388e-2 / 0.595e-6 * (1.0 / 1200 - 1.0 / 1400), 0.05);
  EXPECT_EQ(BlackBodyLuminance(499.0), 0.0);
  EXPECT_EQ(BlackBodyLuminance(std::nan("")), 0.0);
  EXPECT_GT(BlackBodyLuminance(501.0), 0.0);
  EXPECT_TRUE(std::isfinite(BlackBodyLuminance(1e9)));
}

TEST(FlameLight, AddsUpToTheEfficacyTimesTheHeat)
{
  const SmvMesh mesh = Row();
  const std::vector<float> heat{100.0F, 50.0F, 0.0F}; // kW/m3: 100 kW and 100 kW
  const std::vector<float> extinction{2.0F, 0.5F, 1.0F};
  std::vector<float> luminance(3);
  const FlameLight light = SpreadFlameLight(mesh, heat, extinction, 0.3, 0.05, luminance);
  EXPECT_NEAR(light.HeatRelease, 2e5, 1e-6);
  EXPECT_NEAR(light.LumensAsked, 1e4, 1e-6);
  EXPECT_EQ(light.LumensPlaced, light.LumensAsked);
  EXPECT_NEAR(LumensOf(mesh, extinction, luminance, 0.3), 1e4, 1e-2);
  // 5000 lm each: per volume twice as much in the first, at four times the absorption.
  EXPECT_NEAR(luminance[0] / luminance[1], 2.0 / 4.0, 1e-6);
  EXPECT_EQ(luminance[2], 0.0F);
}

TEST(FlameLight, LightOfClearBurningCellsGoesToSmokyOnes)
{
  const SmvMesh mesh = Row();
  const std::vector<float> heat{100.0F, 50.0F, 300.0F};
  std::vector<float> luminance(3);
  const std::vector<float> extinction{2.0F, 0.0F, 1e-5F};
  const FlameLight light = SpreadFlameLight(mesh, heat, extinction, 0.0, 0.05, luminance);
  EXPECT_EQ(light.LumensPlaced, light.LumensAsked);
  EXPECT_NEAR(LumensOf(mesh, extinction, luminance, 0.0), 0.05 * 5e5, 1e-1);
  EXPECT_EQ(luminance[1], 0.0F);
  EXPECT_EQ(luminance[2], 0.0F);
}

TEST(FlameLight, WithoutAnySmokeNothingIsPlacedAndThatIsSaid)
{
  std::vector<float> luminance(3);
  const FlameLight light = SpreadFlameLight(
    Row(), std::vector<float>{1, 1, 1}, std::vector<float>(3), 0.3, 0.05, luminance);
  EXPECT_GT(light.LumensAsked, 0.0);
  EXPECT_EQ(light.LumensPlaced, 0.0);
  EXPECT_THAT(luminance, Each(0.0F));
  // Smoke that only scatters cannot emit.
  EXPECT_EQ(SpreadFlameLight(
              Row(), std::vector<float>{1, 1, 1}, std::vector<float>(3, 5.0F), 1.0, 0.05, luminance)
              .LumensPlaced,
    0.0);
}

TEST(FlameLight, SmokeGlowsAtItsTemperature)
{
  std::vector<float> luminance(3);
  const std::vector<float> extinction{1.0F, 2.0F, 3.0F};
  const FlameLight light =
    GlowOfSmoke(Row(), std::vector<float>{20, 1100, 1300}, extinction, 0.3, luminance);
  EXPECT_THAT(luminance, ElementsAre(0.0F, FloatEq(static_cast<float>(BlackBodyLuminance(1100))),
                           FloatEq(static_cast<float>(BlackBodyLuminance(1300)))));
  EXPECT_NEAR(light.LumensPlaced / LumensOf(Row(), extinction, luminance, 0.3), 1.0, 1e-6);
}

TEST(FlameSource, TakesSlicesBeforeBytesAndTellsWhatIsMissing)
{
  test::Folder folder("flames");
  test::Index index;
  index.Mesh("m", {2, 1, 1}, {0, 0, 0}, {2, 1, 1});
  index.Text("SMOKF3D     1      0.000\n h.s3d\n HRRPUV\n hrrpuv\n kW/m3\n");
  const auto read = [&](float efficacyTime)
  {
    const SmvFile run(folder.Write("test.smv", index.Bytes()));
    FlameSource source(run, FlameModel::LuminousEfficacy);
    std::vector<float> values(2, -1.0F);
    source.Read(0, efficacyTime, TimeInterpolation::Linear, {}, values);
    return std::make_pair(values, source.Warnings());
  };
  const auto [nothing, warnings] = read(0.0F);
  EXPECT_THAT(nothing, Each(0.0F));
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_THAT(
    warnings[0], HasSubstr("h.s3d: the 8-bit file of HRRPUV of mesh 'm' cannot be opened"));

  // 8-bit: 12 nodes of byte 127, from 0 to 1200 kW/m3 and rounded down.
  test::Records bytes;
  bytes.Add(std::vector<int>{1, 1, 0, 2, 0, 1, 0, 1}).Add(std::vector<float>{0.0F});
  bytes.Add(std::vector<int>{12, 3}).Add(std::vector<unsigned char>{255, 127, 12});
  folder.Write("h.s3d", bytes.Bytes());
  const float expected = 127.5F / 254.0F * 1200.0F;
  EXPECT_THAT(read(0.0F).first, Each(FloatNear(expected, 1e-3F)));
  EXPECT_THAT(read(0.0F).second, testing::IsEmpty());

  std::vector<float> later(12, 40.0F);
  folder.Write("h.sf", test::SliceBytes("HRRPUV", {0, 2, 0, 1, 0, 1},
                         {{0.0F, std::vector<float>(12, 20.0F)}, {10.0F, later}}));
  index.Slice(true, 1, {0, 2, 0, 1, 0, 1}, "h.sf", "HRRPUV");
  EXPECT_THAT(read(0.0F).first, Each(20.0F));
  EXPECT_THAT(read(2.5F).first, Each(25.0F));
  EXPECT_THAT(read(99.0F).first, Each(40.0F));
}

} // namespace smokevis
