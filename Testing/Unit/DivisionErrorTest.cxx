// What uneven smoke before a sign leaves unknown of its contrast, against a sum over fine steps.
#include "Contrast.h"
#include "PlateColumns.h"
#include "PlatePattern.h"
#include "SceneLibrary.h"
#include "SignByRays.h"
#include "View.h"

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

/// A sign of bars behind smoke, the only light but for what the smoke emits.
std::unique_ptr<View> SignBehind(SmokeGrid smoke, int bars, double albedo = 0.0)
{
  SceneDescription scene;
  scene.Albedo = albedo;
  scene.Grids = {std::move(smoke)};
  scene.Emitters = scenes::Barcode({4, 1, 1}, {-1, 0, 0}, {0, 0, 1}, 0.8, 0.4, bars, 100.0, 0);
  const auto built = std::make_shared<const Scene>(std::move(scene));
  LightFieldOptions options;
  options.Tolerance = 0.05;
  Progress progress;
  return std::make_unique<View>(
    built, std::make_shared<const LightField>(SolveLightField(*built, options, progress)));
}

/// Extinction anew in each cell, in cells a quarter of the sign's width.
SmokeGrid Noise(double low, double high, std::uint64_t seed)
{
  return scenes::NoisySmoke(Vec3(0.0), {4, 2, 2}, {20, 10, 10}, low, high, seed);
}

const Vec3 Eye{0.3, 0.8, 1.1};
const Observer Plain{0.0};

/// Contrast over points of equal steps on the plate.
double ContrastOfSteps(const View& view)
{
  return MeasureByRays(view, Eye, {120, 120}).Contrast;
}

// Over twenty draws of the smoke, none is off by more than three of its error bars or 0.005. Bars
// are up to five times what contrasts are off by: second differences overstate kinks.
TEST(DivisionError, HoldsInUnevenSmoke)
{
  for (const int bars : {1, 5})
  {
    constexpr int Draws = 20;
    double squares = 0.0;
    int divided = 0;
    for (int seed = 1; seed <= Draws; ++seed)
    {
      const auto view = SignBehind(Noise(0.1, 1.5, seed), bars);
      const SignMeasurement sign = MeasureSign(*view, 0, Eye, Plain);
      const double off = sign.Contrast - ContrastOfSteps(*view);
      EXPECT_LT(std::abs(off), 3.0 * sign.ContrastDivisionError) << bars << " bars, seed " << seed;
      EXPECT_LT(std::abs(off), 0.005) << bars << " bars, seed " << seed;
      squares += off * off / (sign.ContrastDivisionError * sign.ContrastDivisionError) / Draws;
      divided += sign.Uneven ? 1 : 0;
    }
    EXPECT_GT(std::sqrt(squares), 0.2) << bars << " bars";
    EXPECT_LT(std::sqrt(squares), 1.0) << bars << " bars";
    EXPECT_GT(divided, Draws / 2) << bars << " bars";
  }
}

// A twentieth of the smoke's unevenness is known as well with the usual blocks.
TEST(DivisionError, IsSmallInNearlyEvenSmoke)
{
  const auto view = SignBehind(Noise(0.78, 0.82, 1), 5);
  const SignMeasurement sign = MeasureSign(*view, 0, Eye, Plain);
  EXPECT_FALSE(sign.Uneven);
  EXPECT_LT(sign.ContrastDivisionError, 0.0005);
  EXPECT_NEAR(sign.Contrast, ContrastOfSteps(*view), 0.0005);
}

// In even smoke it is what depths bend over the plate, also over one that is evenly bright.
TEST(DivisionError, IsSmallInEvenSmoke)
{
  for (const int bars : {1, 5})
  {
    const auto view =
      SignBehind(scenes::UniformSmoke(Vec3(0.0), {4, 2, 2}, {20, 10, 10}, 0.8), bars);
    const SignMeasurement sign = MeasureSign(*view, 0, Eye, Plain);
    EXPECT_FALSE(sign.Uneven);
    EXPECT_LT(sign.ContrastDivisionError, 3e-4) << bars;
    EXPECT_NEAR(sign.Contrast, ContrastOfSteps(*view), 1e-4) << bars;
  }
}

/// Off by less than three of both errors, and than the promise of a contrast.
void ExpectKnown(const View& view, const std::string& what)
{
  const SignMeasurement sign = MeasureSign(view, 0, Eye, Plain);
  const double off = std::abs(sign.Contrast - ContrastOfSteps(view));
  EXPECT_LT(off, 0.005) << what;
  EXPECT_LT(off, 3.0 * std::hypot(sign.ContrastError, sign.ContrastDivisionError)) << what;
}

// So it is where the veil is as uneven as what comes through.
TEST(DivisionError, HoldsWhereUnevenSmokeScatters)
{
  for (int seed = 1; seed <= 4; ++seed)
  {
    for (const int bars : {1, 9})
    {
      ExpectKnown(*SignBehind(Noise(0.1, 1.5, seed), bars, 0.8),
        std::to_string(bars) + " bars, seed " + std::to_string(seed));
    }
  }
}

// A row of glowing cells before a sign, which rays far apart would miss.
TEST(DivisionError, HoldsBehindAFlame)
{
  for (const float luminance : {5.0F, 50.0F})
  {
    SmokeGrid smoke = scenes::UniformSmoke(Vec3(0.0), {4, 2, 2}, {40, 20, 40}, 0.2);
    smoke.EmittedLuminance.assign(smoke.Extinction.size(), 0.0F);
    for (std::size_t j = 8; j < 12; ++j)
    {
      const std::size_t cell = 30 + 40 * (j + 20 * 19);
      smoke.Extinction[cell] = 2.0F;
      smoke.EmittedLuminance[cell] = luminance;
    }
    for (const int bars : {1, 5})
    {
      ExpectKnown(*SignBehind(smoke, bars, 0.3),
        std::to_string(bars) + " bars, " + std::to_string(luminance) + " cd/m2");
    }
  }
}

/// Contrast over equal pixels of a plate of bars behind absorbing smoke, by equal steps in each.
double ContrastOfPixels(const View& view, int bars, int across, int up)
{
  // Bars are cut by pixels' edges.
  constexpr int Steps = 256;
  constexpr int Rows = 8;
  const Sign& sign = view.TheScene().Lights().Signs()[0];
  double all = 0.0;
  double first = 0.0;
  double second = 0.0;
  for (int pixel = 0; pixel < across * up; ++pixel)
  {
    double weight = 0.0;
    double light = 0.0;
    for (int step = 0; step < Steps * Rows; ++step)
    {
      const double u = (pixel % across + (step % Steps + 0.5) / Steps) / across;
      const double v = (pixel / across + (step / Steps + 0.5) / Rows) / up;
      const Vec3 way = OnPlate(sign, u, v) - Eye;
      const double distance = glm::length(way);
      const double seen = std::abs(way.x) / std::pow(distance, 3.0);
      weight += seen;
      if (static_cast<int>(u * bars) % 2 == 0)
      {
        light += seen * std::exp(-view.TheScene().Smoke().OpticalDepth(
                          Eye, way / distance, 0.0, distance));
      }
    }
    all += weight;
    first += light;
    second += light * light / weight;
  }
  const double mean = first / all;
  return std::sqrt(second / all - mean * mean) / mean;
}

// Where pixels average bars, blocks are cut anew; the smoke before them is as uneven.
TEST(DivisionError, HoldsWherePixelsAverage)
{
  // Pixels hardly larger than the bars, with whole blocks to each pixel, or, of many bars, whole
  // pixels to each block.
  for (const auto& [bars, acuity] : {std::pair{9, 0.0252}, std::pair{45, 0.006}})
  {
    const auto view = SignBehind(Noise(0.1, 1.5, 1), bars);
    const SignMeasurement sign = MeasureSign(*view, 0, Eye, Observer{0.0, acuity});
    const Sign& plate = view->TheScene().Lights().Signs()[0];
    const auto pixels = [&, least = acuity](const glm::dvec2& from, const glm::dvec2& to)
    {
      const Vec3 a = glm::normalize(OnPlate(plate, from.x, from.y) - Eye);
      const Vec3 b = glm::normalize(OnPlate(plate, to.x, to.y) - Eye);
      return static_cast<int>(std::acos(glm::dot(a, b)) / least);
    };
    const double contrast =
      ContrastOfPixels(*view, bars, pixels({0.0, 0.5}, {1.0, 0.5}), pixels({0.5, 0.0}, {0.5, 1.0}));
    EXPECT_GT(sign.ContrastDivisionError, 1e-4) << bars;
    EXPECT_NEAR(sign.Contrast, contrast, 3.0 * sign.ContrastDivisionError) << bars;
    EXPECT_NEAR(sign.Contrast, contrast, 0.005) << bars;
  }
}

// Blocks narrower than a pixel, in which none lies, keep their place among the others.
TEST(DivisionError, HoldsWhereBlocksHaveNoPixel)
{
  const PatternAxis axis({0.0, 0.001, 0.4, 0.999, 1.0}, 20);
  ASSERT_EQ(axis.Borders().size(), axis.Blocks + 1);
  EXPECT_EQ(axis.Borders()[1], 0.0);
  EXPECT_NEAR(axis.Borders()[2], 0.4, 1e-12);
  // A dark frame of a four hundredth of the plate around two lit halves.
  SceneDescription scene;
  scene.Albedo = 0.0;
  scene.Grids = {scenes::UniformSmoke(Vec3(0.0), {4, 2, 2}, {4, 2, 2}, 0.05)};
  const std::array<double, 6> across = {0.8, 0.801, 0.95, 1.05, 1.199, 1.2};
  const std::array<double, 4> up = {0.8, 0.801, 1.199, 1.2};
  for (std::size_t i = 0; i + 1 < across.size(); ++i)
  {
    for (std::size_t j = 0; j + 1 < up.size(); ++j)
    {
      EmitterCell cell;
      cell.Vertices = {{4, across[i + 1], up[j]}, {4, across[i], up[j]}, {4, across[i], up[j + 1]},
        {4, across[i + 1], up[j + 1]}};
      cell.Luminance.fill(j == 1 && (i == 1 || i == 3) ? 100.0 : 0.0);
      cell.SignId = 0;
      scene.Emitters.push_back(cell);
    }
  }
  const auto built = std::make_shared<const Scene>(std::move(scene));
  Progress progress;
  const View view(built,
    std::make_shared<const LightField>(SolveLightField(*built, LightFieldOptions(), progress)));
  const Observer observer{0.0, 3.0 * Observer().Acuity};
  EXPECT_LT(MeasureSign(view, 0, Eye, observer).ContrastDivisionError, 1e-4);
}

} // namespace
