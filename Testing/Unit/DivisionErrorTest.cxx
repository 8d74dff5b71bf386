// What uneven smoke before a sign leaves unknown of its contrast, against a sum over fine steps.
#include "Contrast.h"
#include "SceneLibrary.h"
#include "View.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

/// A sign of bars that light its absorbing smoke alone: its veil is 0 and its contrast a matter of
/// optical depths.
std::unique_ptr<View> SignBehind(SmokeGrid smoke, int bars)
{
  SceneDescription scene;
  scene.Albedo = 0.0;
  scene.Grids = {std::move(smoke)};
  scene.Emitters = scenes::Barcode({4, 1, 1}, {-1, 0, 0}, {0, 0, 1}, 0.8, 0.4, bars, 100.0, 0);
  const auto built = std::make_shared<const Scene>(std::move(scene));
  Progress progress;
  return std::make_unique<View>(built,
    std::make_shared<const LightField>(SolveLightField(*built, LightFieldOptions(), progress)));
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
  constexpr int Steps = 120;
  const EmitterSet& lights = view.TheScene().Lights();
  double weight = 0.0;
  double first = 0.0;
  double second = 0.0;
  for (const std::size_t index : lights.Signs()[0].Cells)
  {
    const EmitterCell& cell = lights.Cells()[index];
    const Vec3 along = cell.Vertices[1] - cell.Vertices[0];
    const Vec3 up = cell.Vertices[3] - cell.Vertices[0];
    for (int step = 0; step < Steps * Steps; ++step)
    {
      const Vec3 way = cell.Vertices[0] + (step % Steps + 0.5) / Steps * along +
                       (step / Steps + 0.5) / Steps * up - Eye;
      const double distance = glm::length(way);
      const double seen = std::abs(glm::dot(glm::cross(along, up), way)) / std::pow(distance, 3.0);
      const double light = cell.Luminance[0] * std::exp(-view.TheScene().Smoke().OpticalDepth(
                                                 Eye, way / distance, 0.0, distance));
      weight += seen;
      first += seen * light;
      second += seen * light * light;
    }
  }
  const double mean = first / weight;
  return std::sqrt(second / weight - mean * mean) / mean;
}

// Over forty draws of the smoke, none is off by more than three of its error bars or 0.005. Bars
// are up to five times what contrasts are off by: second differences overstate kinks.
TEST(DivisionError, HoldsInUnevenSmoke)
{
  for (const int bars : {1, 5})
  {
    constexpr int Draws = 40;
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

// In even smoke nothing is unknown, also of a plate that is evenly bright.
TEST(DivisionError, IsNoneInEvenSmoke)
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

// Where pixels average bars, blocks are cut anew; the smoke before them is as uneven, and what is
// averaged has no more contrast than its places.
TEST(DivisionError, HoldsWherePixelsAverage)
{
  // Pixels hardly larger than the bars, with whole blocks to each pixel, or, of many bars, whole
  // pixels to each block.
  for (const auto& [bars, acuity] : {std::pair{9, 0.0252}, std::pair{45, 0.006}})
  {
    const auto view = SignBehind(Noise(0.1, 1.5, 1), bars);
    const SignMeasurement sign = MeasureSign(*view, 0, Eye, Observer{0.0, acuity});
    EXPECT_GT(sign.ContrastDivisionError, 1e-4) << bars;
    EXPECT_LT(sign.ContrastDivisionError, 0.05) << bars;
    EXPECT_LT(sign.Contrast, ContrastOfSteps(*view) + 3.0 * sign.ContrastDivisionError) << bars;
  }
}

} // namespace
