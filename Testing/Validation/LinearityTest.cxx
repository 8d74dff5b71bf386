// Light is proportional to its sources, and that of several adds up.
#include "BatchState.h"
#include "Contrast.h"
#include "DirectField.h"
#include "LineSweep.h"
#include "NearLights.h"
#include "SceneLibrary.h"
#include "Solved.h"
#include "TestReport.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <vector>

namespace
{

using namespace smokevis;

/// Largest difference of values from what they should be, both by place, over what they should be.
/// @param least that this counts for; where it should be 0 and this is, too, the value has to be
template <class Value, class Expected>
double LargestDifference(
  std::size_t count, double least, const Value& value, const Expected& expected)
{
  double worst = 0.0;
  for (std::size_t i = 0; i < count; ++i)
  {
    const double difference = std::abs(value(i) - expected(i));
    EXPECT_TRUE(std::isfinite(difference)) << i;
    const double size = std::max(std::abs(expected(i)), least);
    if (size > 0.0)
    {
      worst = std::max(worst, difference / size);
    }
    else
    {
      EXPECT_EQ(value(i), 0.0);
    }
  }
  return worst;
}

// Lights that are so many times as bright make everything so many times as bright, whatever way the
// light took: the same lines are drawn, and but for twenty roundings to float, of a mean value
// or of what is brighter, nothing differs.
TEST(Linearity, Proportionality)
{
  constexpr double Times = 3.7e3;
  constexpr double Roundings = 20.0 * 6e-8;
  report::Head("Lights " + std::to_string(Times) + " times as bright, largest relative changes");
  const SceneDescription plain = scenes::FurnishedRoom(0.6, 0.5);
  SceneDescription bright = plain;
  for (EmitterCell& cell : bright.Emitters)
  {
    for (double& luminance : cell.Luminance)
    {
      luminance *= Times;
    }
  }
  const Solved one(plain, 0.03);
  const Solved many(bright, 0.03);
  const auto compare = [](const char* name, const auto& a, const auto& b, const auto& number)
  {
    double mean = 0.0;
    for (const auto& value : a)
    {
      mean += Times * number(value) / static_cast<double>(a.size());
    }
    report::Absolute(name, 0.0,
      LargestDifference(
        a.size(), mean, [&](std::size_t i) { return number(b[i]); },
        [&](std::size_t i) { return Times * number(a[i]); }),
      Roundings);
  };
  const auto itself = [](float value) { return static_cast<double>(value); };
  const auto mean = [](const Lanes& value) { return Mean(value); };
  const auto error = [](const Lanes& value) { return StandardError(value); };
  compare("direct fluence", one.Field->DirectFluence, many.Field->DirectFluence, itself);
  compare(
    "direct illuminance", one.Field->DirectIlluminance, many.Field->DirectIlluminance, itself);
  compare("multiple fluence", one.Field->MultipleFluence, many.Field->MultipleFluence, mean);
  compare("its errors", one.Field->MultipleFluence, many.Field->MultipleFluence, error);
  compare(
    "multiple illuminance", one.Field->MultipleIlluminance, many.Field->MultipleIlluminance, mean);
  const Vec3 eye(0.8, 1.4, 1.7);
  const SignMeasurement a = MeasureSign(*one.TheView, 0, eye, Observer{0.0});
  const SignMeasurement b = MeasureSign(*many.TheView, 0, eye, Observer{0.0});
  report::Relative("mean luminance", Times * a.MeanLuminance, b.MeanLuminance, Roundings);
  report::Relative("contrast", a.Contrast, b.Contrast, Roundings);
}

/// A room's sign and its lamp, both alight or one of them dark.
struct SignAndLamp
{
  explicit SignAndLamp(double extinction)
  {
    const SceneDescription both = scenes::FurnishedRoom(0.6, extinction);
    SceneDescription sign = both;
    sign.Emitters.back().Luminance = {};
    SceneDescription lamp = both;
    for (std::size_t cell = 0; cell + 1 < lamp.Emitters.size(); ++cell)
    {
      lamp.Emitters[cell].Luminance = {};
    }
    this->Both = std::make_unique<const Solved>(both);
    this->Sign = std::make_unique<const Solved>(sign);
    this->Lamp = std::make_unique<const Solved>(lamp);
  }

  std::unique_ptr<const Solved> Both, Sign, Lamp;
};

/// Largest difference of a sum from its two parts.
/// @param least as for LargestDifference
double LargestChange(const std::vector<float>& sum, const std::vector<float>& a,
  const std::vector<float>& b, double least)
{
  return LargestDifference(
    sum.size(), least, [&](std::size_t i) { return static_cast<double>(sum[i]); },
    [&](std::size_t i) { return static_cast<double>(a[i]) + b[i]; });
}

// The direct parts of two lights add up to float rounding: each is computed on its own. What is
// sent on is drawn until its own error is small enough, and balanced by its own power: it adds up
// within that error.
TEST(Linearity, Superposition)
{
  report::Head("Superposition of a sign and a lamp");
  const SignAndLamp lights(0.5);
  // Three roundings to float, each of at most 6e-8.
  report::Absolute("direct fluence", 0.0,
    LargestChange(lights.Both->Field->DirectFluence, lights.Sign->Field->DirectFluence,
      lights.Lamp->Field->DirectFluence, 0.0),
    3e-7);
  report::Absolute("direct illuminance", 0.0,
    LargestChange(lights.Both->Field->DirectIlluminance, lights.Sign->Field->DirectIlluminance,
      lights.Lamp->Field->DirectIlluminance, 0.0),
    3e-7);
  std::vector<std::int64_t> cells(lights.Both->TheScene->Smoke().Cells());
  std::iota(cells.begin(), cells.end(), 0);
  const Estimate sum = lights.Both->Fluence(cells);
  const Estimate a = lights.Sign->Fluence(cells);
  const Estimate b = lights.Lamp->Fluence(cells);
  report::Relative("mean fluence", a.Mean + b.Mean, sum.Mean, 1e-3,
    std::hypot(std::hypot(a.StandardError, b.StandardError), sum.StandardError));
}

// So do the direct parts of eight lamps, in the cells around them as well, of which their own rays
// tell: none of so many draws fewer because there are others. A lamp that has less than a 20th of
// an eighth of the light somewhere is known there to some percent of itself, which for seven of
// them makes 0.3 % of all.
TEST(Linearity, SuperpositionOfEightLamps)
{
  report::Head("Superposition of eight lamps in smoke like noise");
  SceneDescription all = scenes::FurnishedRoom(0.6, 2.0);
  all.Emitters.clear();
  for (int lamp = 0; lamp < 8; ++lamp)
  {
    all.Emitters.push_back(scenes::Plate(
      {0.5 + lamp % 4, 0.5 + 1.5 * (lamp / 4), 2.0}, {0, 0, -1}, {1, 0, 0}, 0.2, 0.2, 100.0));
  }
  const Solved together(all, 0.1);
  const std::vector<float>& fluence = together.Field->DirectFluence;
  std::vector<double> sum(fluence.size());
  for (std::size_t lamp = 0; lamp < all.Emitters.size(); ++lamp)
  {
    SceneDescription one = all;
    for (std::size_t other = 0; other < all.Emitters.size(); ++other)
    {
      one.Emitters[other].Luminance[0] *= other == lamp ? 1.0 : 0.0;
    }
    const Solved alone(one, 0.1);
    std::transform(sum.begin(), sum.end(), alone.Field->DirectFluence.begin(), sum.begin(),
      [](double before, float own) { return before + own; });
  }
  std::vector<std::size_t> near;
  for (const NearLights::Cell& cell : together.TheScene->Near(0.1).Cells())
  {
    near.push_back(static_cast<std::size_t>(cell.Index));
  }
  const auto largest = [&](const std::vector<std::size_t>& cells)
  {
    return LargestDifference(
      cells.size(), 0.0, [&](std::size_t i) { return static_cast<double>(fluence[cells[i]]); },
      [&](std::size_t i) { return sum[cells[i]]; });
  };
  std::vector<std::size_t> cells(sum.size());
  std::iota(cells.begin(), cells.end(), std::size_t{0});
  report::Absolute("cells near to lamps", 0.0, largest(near), 5e-4);
  report::Absolute("all cells", 0.0, largest(cells), 3e-3);
}

/// What some sweeps along the same lines find, before sources follow what they found.
BatchState Swept(const Solved& solved, int sweeps)
{
  const LightField& field = *solved.Field;
  const DirectField direct(*solved.TheScene, field);
  RisingProgress progress;
  const LineSweep sweep(*solved.TheScene, field, direct, 0, 0.01, progress);
  EXPECT_FALSE(sweep.Blocks());
  BatchState state(field.Cells, 2 * field.Patches);
  LineTallies tallies;
  for (int i = 0; i < sweeps; ++i)
  {
    sweep.Run(state, tallies, static_cast<std::uint64_t>(i), sweep.Whole(), progress);
  }
  return state;
}

/// How far what sweeps along the same lines find of both lights is from the sum for each.
/// @param tolerance over the mean of all
void CheckSweeps(const std::string& name, double extinction, double tolerance)
{
  constexpr int Sweeps = 6;
  const SignAndLamp lights(extinction);
  const BatchState both = Swept(*lights.Both, Sweeps);
  const BatchState sign = Swept(*lights.Sign, Sweeps);
  const BatchState lamp = Swept(*lights.Lamp, Sweeps);
  const auto check = [&](const std::string& what, std::vector<float> BatchState::*sums)
  {
    const std::vector<float>& sum = both.*sums;
    const double mean =
      std::accumulate(sum.begin(), sum.end(), 0.0) / static_cast<double>(sum.size());
    EXPECT_GT(mean, 0.0);
    report::Absolute(
      name + ": " + what, 0.0, LargestChange(sum, sign.*sums, lamp.*sums, mean), tolerance);
  };
  if (extinction > 0.0)
  {
    check("fluence", &BatchState::FluenceSum);
  }
  check("illuminance", &BatchState::IlluminanceSum);
}

// Sweeps along the same lines add up, too, order of scattering by order: between walls to rounding
// (some ten lines meet a patch in a sweep, and what each adds is rounded to float twice). How light
// falls off inside a cell follows the light's own course, and the sum of two courses is no course
// of that kind: smoke scatters a little more or less of both lights than of each.
TEST(Linearity, SweepsAlongTheSameLines)
{
  report::Head("Superposition of sweeps with a sign and a lamp, largest changes over the mean");
  CheckSweeps("clear air", 0.0, 6.0 * 20.0 * 6e-8);
  CheckSweeps("smoke", 0.5, 1e-3);
}

} // namespace
