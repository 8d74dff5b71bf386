// Scenes drawn at random, the odder the better: finite numbers, none negative, no hang, and error
// bars that hold from one seed to another.
#include "Errors.h"
#include "StressScenes.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <map>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

/// Of all processors, which does not depend on what else the machine does.
double ProcessorSeconds()
{
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// What went by in a run over many scenes.
struct Tally
{
  int Scenes = 0;
  int Refused = 0;
  /// Scenes by the message that they were refused with, and those that failed a check.
  std::map<std::string, std::vector<std::uint64_t>> Refusals;
  std::vector<std::uint64_t> Failed;
  int Compared = 0;
  int Violations = 0;
  /// Scenes compared, and those that any of these are in. Even light makes all values of a scene
  /// one.
  int Twice = 0;
  int Violating = 0;
  /// Scenes that took more than the second of processor time that one of them may take.
  int Slow = 0;
  double Seconds = 0.0;
  double Slowest = 0.0;
  std::string SlowestName;
};

/// Share of the brightest emitter below which no luminance is asked for, as the solver's probes
/// have it.
constexpr double FaintestShare = 1e-7;

/// Two estimates of one number differ by more than three joint standard errors in 0.5 % of all
/// cases (Student's t with 30 degrees of freedom).
/// @param faintest below which they do not count
void Compare(const Estimate& a, const Estimate& b, double faintest, Tally& tally)
{
  const double error = std::hypot(a.StandardError, b.StandardError);
  if (error <= 0.0 || std::max(a.Mean, b.Mean) < faintest)
  {
    return;
  }
  ++tally.Compared;
  tally.Violations += std::abs(a.Mean - b.Mean) > 3.0 * error ? 1 : 0;
}

Ray DrawRay(const Vec3& eye, Pcg32& random)
{
  const double x = random.Uniform() - 0.5;
  const double y = random.Uniform() - 0.5;
  return {eye, glm::normalize(Vec3(x, y, random.Uniform() - 0.5))};
}

/// Compares fluences of cells and luminances of rays of two solutions from different seeds.
void CompareSeeds(const Solved& a, const Solved& b, const stress::StressScene& scene,
  std::uint64_t seed, Tally& tally)
{
  double brightest = a.TheScene->Sky();
  for (const EmitterCell& cell : a.TheScene->Lights().Cells())
  {
    brightest = std::max(brightest, cell.Luminance[0]);
  }
  const double faintest = FaintestShare * brightest;
  const int before = tally.Violations;
  Pcg32 random(seed, 2);
  for (int i = 0; i < 3; ++i)
  {
    const Ray ray = DrawRay(scene.Eye, random);
    Compare(a.Luminance(ray), b.Luminance(ray), faintest, tally);
    if (const std::size_t cells = a.TheScene->Smoke().Cells(); cells > 0)
    {
      const std::vector<std::int64_t> cell = {
        static_cast<std::int64_t>(random.Uniform() * static_cast<double>(cells))};
      // From all directions.
      Compare(a.Fluence(cell), b.Fluence(cell), 4.0 * std::numbers::pi * faintest, tally);
    }
  }
  ++tally.Twice;
  tally.Violating += tally.Violations > before ? 1 : 0;
}

/// What no luminance exceeds, by the maximum principle: smoke and surfaces send on means of what
/// comes to them, and a plate adds its own to its share of that. Infinite where white plates shine.
double LargestLuminance(const Scene& scene)
{
  const Medium& smoke = scene.Smoke();
  double most = scene.Sky();
  for (std::size_t cell = 0; cell < smoke.Cells(); ++cell)
  {
    most = std::max<double>(most, smoke.EmittedLuminance(static_cast<std::int64_t>(cell)));
  }
  for (const EmitterCell& cell : scene.Lights().Cells())
  {
    for (int band = 0; band < scene.Bands(); ++band)
    {
      const double own = cell.Luminance[band];
      most = std::max(most, own > 0.0 ? own / (1.0 - cell.Reflectance[band]) : 0.0);
    }
  }
  return most;
}

/// Above the largest luminance by what quadratures may be off by.
constexpr double Margin = 1.02;

/// Expects that no light exceeds what a largest luminance from everywhere comes to, but for four
/// standard errors.
void ExpectNoMore(
  const std::vector<float>& direct, const std::vector<Lanes>& multiple, double largest)
{
  for (std::size_t i = 0; i < direct.size(); ++i)
  {
    EXPECT_LE(direct[i] + Mean(multiple[i]), Margin * largest + 4.0 * StandardError(multiple[i]));
  }
}

/// All that is to be said about one solution: the light field, each sign, a few rays. A luminance
/// tells no error of its own here, but what noise is to the largest is far below the margin.
void ExpectSane(const Solved& solved, const stress::StressScene& scene, std::uint64_t seed)
{
  stress::ExpectSaneField(solved);
  const double largest = LargestLuminance(*solved.TheScene);
  const LightField& field = *solved.Field;
  ExpectNoMore(field.DirectFluence, field.MultipleFluence, 4.0 * std::numbers::pi * largest);
  ExpectNoMore(field.DirectIlluminance, field.MultipleIlluminance, std::numbers::pi * largest);
  const auto& signs = solved.TheScene->Lights().Signs();
  for (std::size_t sign = 0; sign < signs.size(); ++sign)
  {
    stress::ExpectSaneSign(MeasureSign(*solved.TheView, sign, scene.Eye, Observer{0.0}));
  }
  Pcg32 random(seed, 1);
  for (int i = 0; i < 5; ++i)
  {
    const Ray ray = i == 0 ? Ray{scene.Eye, Vec3(1, 0, 0)} : DrawRay(scene.Eye, random);
    const Hit hit = solved.TheView->FirstHit(ray.Origin, ray.Direction);
    for (int band = 0; band < solved.TheScene->Bands(); ++band)
    {
      const double light = solved.TheView->Trace(ray.Origin, ray.Direction, hit, band).Total();
      EXPECT_TRUE(std::isfinite(light) && light >= 0.0) << light;
      EXPECT_LE(light, Margin * largest);
    }
  }
}

/// Power that lights and smoke send out, and that a sky brings through the box around all [lm].
double PowerOfSources(const SceneDescription& description, const Scene& made)
{
  const Medium& smoke = made.Smoke();
  Box all{smoke.Lower(), smoke.Upper()};
  all.Add(Box::Around(description.Surfaces.Points));
  for (const EmitterCell& cell : description.Emitters)
  {
    all.Add(Box::Around(cell.Vertices));
  }
  double power = made.Lights().Flux(0) + std::numbers::pi * made.Sky() * all.Surface();
  for (std::size_t i = 0; i < smoke.Cells(); ++i)
  {
    const auto cell = static_cast<std::int64_t>(i);
    power += 4.0 * std::numbers::pi * (1.0 - made.Albedo()) * made.ExtinctionScale(0) *
             smoke.Extinction(cell) * smoke.OwnVolume(cell) * smoke.EmittedLuminance(cell);
  }
  return power;
}

/// Expects that no more power is taken up than is sent out, and none is given back: to the
/// tolerance, and to four standard errors.
void ExpectNoMorePower(const Solved& solved, const stress::StressScene& scene)
{
  const double emitted = PowerOfSources(scene.Description, *solved.TheScene);
  const Estimate smoke = solved.AbsorbedInSmoke();
  const Estimate surfaces = solved.AbsorbedOnSurfaces();
  const double error =
    2.0 * scene.Tolerance * emitted + 4.0 * std::hypot(smoke.StandardError, surfaces.StandardError);
  EXPECT_LE(smoke.Mean + surfaces.Mean, emitted + error);
  EXPECT_GE(smoke.Mean, -error);
  EXPECT_GE(surfaces.Mean, -error);
  EXPECT_LE(error, 10.0 * emitted);
}

/// Checks of the running test that failed so far.
int FailedParts()
{
  return testing::UnitTest::GetInstance()->current_test_info()->result()->total_part_count();
}

void RunScene(std::uint64_t seed, bool twice, Tally& tally)
{
  const stress::StressScene scene = stress::DrawScene(seed);
  SCOPED_TRACE(scene.Name);
  ++tally.Scenes;
  const int failures = FailedParts();
  const double start = ProcessorSeconds();
  try
  {
    const Solved solved(scene.Description, scene.Tolerance, seed);
    ExpectSane(solved, scene, seed);
    ExpectNoMorePower(solved, scene);
    const double seconds = ProcessorSeconds() - start;
    tally.Seconds += seconds;
    if (seconds > 1.0)
    {
      ++tally.Slow;
      std::printf("%.1f s: %s\n", seconds, scene.Name.c_str());
      std::fflush(stdout);
    }
    if (seconds > tally.Slowest)
    {
      tally.Slowest = seconds;
      tally.SlowestName = scene.Name;
    }
    if (twice)
    {
      const Solved other(scene.Description, scene.Tolerance, seed + 1000000);
      CompareSeeds(solved, other, scene, seed, tally);
    }
  }
  catch (const Error& error)
  {
    ++tally.Refused;
    tally.Refusals[error.what()].push_back(seed);
    ADD_FAILURE() << error.what();
  }
  if (FailedParts() > failures)
  {
    tally.Failed.push_back(seed);
  }
}

void PrintSeeds(const std::vector<std::uint64_t>& seeds)
{
  for (const std::uint64_t seed : seeds)
  {
    std::printf(" %llu", static_cast<unsigned long long>(seed));
  }
  std::printf("\n");
}

/// @param every of how many scenes one is solved a second time, for its error bars
void RunScenes(std::uint64_t first, std::uint64_t count, std::uint64_t every)
{
  Tally tally;
  for (std::uint64_t seed = first; seed < first + count; ++seed)
  {
    RunScene(seed, seed % every == 0, tally);
  }
  std::printf("%d scenes in %.0f processor seconds, %d refused, %d of more than a processor "
              "second, slowest %.2f s (%s)\n"
              "%d values from two seeds, %d of them, in %d scenes, more than three standard errors "
              "apart\n",
    tally.Scenes, tally.Seconds, tally.Refused, tally.Slow, tally.Slowest,
    tally.SlowestName.c_str(), tally.Compared, tally.Violations, tally.Violating);
  for (const auto& [message, seeds] : tally.Refusals)
  {
    std::printf("refused (%s):", message.c_str());
    PrintSeeds(seeds);
  }
  if (!tally.Failed.empty())
  {
    std::printf("failed:");
    PrintSeeds(tally.Failed);
  }
  // Half a percent of some five values of each is expected; batches that share rare events have
  // longer tails than a normal law.
  EXPECT_LE(tally.Violating, 2 + tally.Twice / 20);
}

TEST(RandomScenes, Forty)
{
  RunScenes(1, 40, 2);
}

// Hardly any light comes to one of the signs: that it is not known there is no reason to refuse the
// scene.
TEST(RandomScenes, DarkSign)
{
  RunScenes(1327, 1, 1);
}

// Light of a thousand times the power that lamps send out, more or less than nothing, came of
// closed white solids in broken triangles, of thick cells that lines hardly meet, and of parts of
// cells that diffusion does not describe. A little that comes into a closed white box in thin white
// smoke grows for a thousand sweeps.
TEST(RandomScenes, LightThatDidNotSettle)
{
  for (const std::uint64_t seed : {1260U, 5064U, 7676U, 8389U, 9446U})
  {
    RunScenes(seed, 1, 2 * seed);
  }
}

// Where next to no light comes, diffusion takes away more than there is.
TEST(RandomScenes, LightBelowNone)
{
  for (const std::uint64_t seed : {8034U, 10319U})
  {
    RunScenes(seed, 1, 2 * seed);
  }
}

// An eye in an opaque cell sees its glow, whatever is dark beyond.
TEST(RandomScenes, EyeInGlowingCell)
{
  RunScenes(7006, 1, 2 * 7006);
}

TEST(RandomScenes, HundredLong)
{
  RunScenes(41, 100, 2);
}

/// A hundred hundreds, so that they can be shared between processes (GTEST_TOTAL_SHARDS) or run in
/// part.
class TenThousandLong : public testing::TestWithParam<int>
{
};

TEST_P(TenThousandLong, Hundred)
{
  RunScenes(1001 + 100 * static_cast<std::uint64_t>(this->GetParam()), 100, 10);
}

INSTANTIATE_TEST_SUITE_P(RandomScenes, TenThousandLong, testing::Range(0, 100));

} // namespace
