// The same bits from one, two and three threads and from run to run, in all stages.
#include "FloorMap.h"
#include "StressScenes.h"

#include <cstring>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace
{

using namespace smokevis;

template <class T> bool SameBits(const std::vector<T>& a, const std::vector<T>& b)
{
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

FloorMap MapOf(const Solved& solved, int threads)
{
  const Vec3 lower = solved.TheScene->Lower();
  const Vec3 size = solved.TheScene->Upper() - lower;
  FloorMapOptions options;
  options.PlacesX = 2;
  options.PlacesY = 2;
  options.StepX = size.x / 2.0;
  options.StepY = size.y / 2.0;
  options.FirstPlace = lower + Vec3(0.5 * options.StepX, 0.5 * options.StepY, 0.6 * size.z);
  options.Threads = threads;
  Progress progress;
  return ComputeFloorMap(*solved.TheView, options, progress);
}

void ExpectSame(const Solved& a, const FloorMap& mapA, const Solved& b, const FloorMap& mapB)
{
  EXPECT_TRUE(SameBits(a.Field->DirectFluence, b.Field->DirectFluence));
  EXPECT_TRUE(SameBits(a.Field->MultipleFluence, b.Field->MultipleFluence));
  EXPECT_TRUE(SameBits(a.Field->DirectIlluminance, b.Field->DirectIlluminance));
  EXPECT_TRUE(SameBits(a.Field->MultipleIlluminance, b.Field->MultipleIlluminance));
  EXPECT_TRUE(SameBits(mapA.Status, mapB.Status));
  EXPECT_TRUE(SameBits(mapA.BestSign, mapB.BestSign));
  EXPECT_TRUE(SameBits(mapA.Visibility, mapB.Visibility));
  EXPECT_TRUE(SameBits(mapA.VisibilityError, mapB.VisibilityError));
  EXPECT_TRUE(SameBits(mapA.VisibilityDivisionError, mapB.VisibilityDivisionError));
  EXPECT_TRUE(SameBits(mapA.Contrast, mapB.Contrast));
  EXPECT_TRUE(SameBits(mapA.SignLuminance, mapB.SignLuminance));
  EXPECT_TRUE(SameBits(mapA.VisibleFraction, mapB.VisibleFraction));
  EXPECT_TRUE(SameBits(mapA.OpticalDepth, mapB.OpticalDepth));
}

// Scenes with a sign, drawn at random; each is solved with 1, 2, 3 threads, and with 3 once more.
// Three threads run also where there are fewer cores.
TEST(SameBits, OneTwoThreeThreadsAndAgain)
{
  const tbb::global_control threeThreads(tbb::global_control::max_allowed_parallelism, 3);
  int scenes = 0;
  for (std::uint64_t seed = 500; scenes < 2; ++seed)
  {
    const stress::StressScene scene = stress::DrawScene(seed);
    if (Scene(scene.Description).Lights().Signs().empty())
    {
      continue;
    }
    ++scenes;
    SCOPED_TRACE(scene.Name);
    const Solved one(scene.Description, scene.Tolerance, 1, 1);
    const FloorMap mapOfOne = MapOf(one, 1);
    for (const int threads : {2, 3, 3})
    {
      const Solved other(scene.Description, scene.Tolerance, 1, threads);
      ExpectSame(one, mapOfOne, other, MapOf(other, threads));
    }
  }
}

} // namespace
