// Scattering that is left out must not be missed: where there is none, and where a bound shows that
// what is scattered more than once adds next to nothing.
#include "Sampler.h"
#include "ScatterBound.h"
#include "SceneLibrary.h"
#include "SkipOutcome.h"
#include "TestReport.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

/// What is not direct of the fluence, in the cell where it comes nearest to its bound, as a share
/// of that; the noise is left out.
double LargestShareOfBound(const Outcome& all)
{
  const auto bound = ScatterBound::Of(*all.TheScene, 0);
  EXPECT_TRUE(bound.has_value());
  double largest = 0.0;
  for (std::size_t cell = 0; cell < all.Field->Cells && bound; ++cell)
  {
    const Lanes& lanes = all.Field->MultipleFluence[cell];
    largest = std::max(largest,
      (Mean(lanes) - 4.0 * StandardError(lanes)) / bound->Fluence(static_cast<std::int64_t>(cell)));
  }
  return largest;
}

/// Largest share, over lines of sight from anywhere to anywhere, of the light that is not direct in
/// the light that is, or in a tenth of its mean where there is less.
double LargestLater(const Outcome& all)
{
  const Scene& scene = *all.TheScene;
  const View view(all.TheScene, all.Field);
  const EvenPoints points(3);
  std::vector<double> direct;
  std::vector<double> later;
  double mean = 0.0;
  constexpr int Lines = 200;
  for (int line = 0; line < Lines; ++line)
  {
    const auto at = points.Point(line);
    const Vec3 eye = scene.Lower() + Vec3(at[0], at[1], at[2]) * (scene.Upper() - scene.Lower());
    const double angle = 6.2831853 * at[3];
    const Vec3 direction =
      glm::normalize(Vec3(std::cos(angle), std::sin(angle), 0.7 * std::sin(5.0 * angle)));
    const double end = view.FirstHit(eye, direction).Distance;
    const RayLight light = view.TraceVeil(eye, direction, 0.0, end, 0);
    direct.push_back(light.VeilDirect);
    later.push_back(Mean(light.VeilMultiple));
    mean += light.VeilDirect / Lines;
  }
  double largest = 0.0;
  for (std::size_t line = 0; line < direct.size(); ++line)
  {
    largest = std::max(largest, later[line] / std::max(direct[line], 0.1 * mean));
  }
  return largest;
}

// Multiple scattering is left out in thin smoke between black walls, and only there: whenever it
// is, what it would have added lies below the tolerance, and it never exceeds its bound.
TEST(Skip, MultipleScatteringOverOpticalDepth)
{
  report::Head(
    "Corridor of 60 m with black walls: light scattered more than once over direct light");
  int skipped = 0;
  int computed = 0;
  for (const double extinction : {1e-5, 1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 0.1, 1.0})
  {
    SceneDescription scene = scenes::Corridor(extinction);
    const Outcome skipping = Solve(scene, true);
    const Outcome all = Solve(scene, false);
    const double later = LargestLater(all);
    const bool left = skipping.Count("multiple scattering skipped") > 0.0;
    std::printf("| extinction %-8g | adds at most %.5f | of the bound %.3f | %s |\n", extinction,
      later, LargestShareOfBound(all), left ? "left out" : "computed");
    EXPECT_EQ(all.Count("multiple scattering skipped"), 0.0);
    EXPECT_LT(LargestShareOfBound(all), 1.0) << extinction;
    (left ? skipped : computed) += 1;
    if (left)
    {
      EXPECT_LT(later, 0.1) << extinction;
      EXPECT_EQ(Mean(skipping.Field->MultipleFluence[1000]), 0.0);
    }
  }
  EXPECT_GT(skipped, 1);
  EXPECT_GT(computed, 2);
}

// Thin smoke in which all is well lit, but for what only comes by a detour: round a wall from a
// lamp much stronger than the others, from a far one, by a slot, or from a surface.
TEST(Skip, MultipleScatteringByDetours)
{
  constexpr double extinction = 1e-4;
  const auto expectComputed = [](const char* name, const SceneDescription& scene)
  {
    const Outcome run = Solve(scene, true);
    EXPECT_EQ(run.Count("multiple scattering skipped"), 0.0) << name;
    EXPECT_LT(LargestShareOfBound(run), 1.0) << name;
  };
  const SceneDescription plain = scenes::Corridor(extinction);
  EXPECT_GT(Solve(plain, true).Count("multiple scattering skipped"), 0.0);

  SceneDescription behind = plain;
  behind.Emitters[3].Luminance.fill(1e10);
  scenes::AddBlock(behind.Surfaces, {11.5, 0.5, 0.0}, {12.0, 3.5, 4.0}, 1.0, 0.0);
  expectComputed("a strong lamp behind a block", behind);

  SceneDescription far = plain;
  far.Emitters.back().Luminance.fill(1e11);
  scenes::AddBlock(far.Surfaces, {50.0, 0.0, 0.0}, {50.5, 4.0, 3.8}, 1.0, 0.0);
  expectComputed("a strong lamp far off behind a wall that leaves a gap", far);

  SceneDescription slot = plain;
  for (std::size_t cell = 0; cell < slot.Grids[0].Extinction.size(); ++cell)
  {
    const std::size_t x = cell % 120;
    slot.Grids[0].Extinction[cell] = x >= 50 && x < 60 && cell / 120 % 8 != 4 ? 20.0F : 1e-4F;
  }
  expectComputed("a slot in thick smoke", slot);

  SceneDescription reflected = plain;
  reflected.Surfaces = {};
  scenes::AddRoom(reflected.Surfaces, Vec3(0.0), {60, 4, 4}, 2.0, 0.1);
  expectComputed("walls that reflect a little", reflected);

  SceneDescription mirror = plain;
  scenes::AddRectangle(mirror.Surfaces, {1, 1, 0.1}, {1, 0, 0}, {0, 1, 0}, 1, 1, 0.5);
  expectComputed("a plate that reflects", mirror);
}

// Black smoke between black walls scatters nothing; smoke that scatters next to nothing, with all
// of it followed, comes to the same.
TEST(Skip, NoScattering)
{
  SceneDescription scene = scenes::Corridor(0.25);
  scene.Albedo = 0.0;
  const Outcome black = Solve(scene, true);
  EXPECT_GT(black.Count("multiple scattering skipped"), 0.0);
  scene.Albedo = 1e-9;
  const Outcome followed = Solve(scene, false);
  EXPECT_EQ(followed.Count("multiple scattering skipped"), 0.0);
  EXPECT_LT(LargestChange(black, followed), 0.004);
  for (std::size_t cell = 0; cell < black.Field->Cells; ++cell)
  {
    EXPECT_EQ(Mean(black.Field->MultipleFluence[cell]), 0.0F);
    EXPECT_LT(Mean(followed.Field->MultipleFluence[cell]), 1e-6);
  }
}

} // namespace
