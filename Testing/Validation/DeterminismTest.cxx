// The same numbers, bit for bit, whatever the number of threads and however often.
#include "Contrast.h"
#include "SceneLibrary.h"
#include "Solved.h"
#include "WorkCount.h"

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

void ExpectSame(const Solved& a, const Solved& b)
{
  EXPECT_TRUE(SameBits(a.Field->DirectFluence, b.Field->DirectFluence));
  EXPECT_TRUE(SameBits(a.Field->MultipleFluence, b.Field->MultipleFluence));
  EXPECT_TRUE(SameBits(a.Field->DirectIlluminance, b.Field->DirectIlluminance));
  EXPECT_TRUE(SameBits(a.Field->MultipleIlluminance, b.Field->MultipleIlluminance));
  const SignMeasurement signA = MeasureSign(*a.TheView, 0, scenes::TunnelEye, {});
  const SignMeasurement signB = MeasureSign(*b.TheView, 0, scenes::TunnelEye, {});
  EXPECT_EQ(signA.Contrast, signB.Contrast);
  EXPECT_EQ(signA.ContrastError, signB.ContrastError);
  EXPECT_EQ(signA.PerceivedContrast, signB.PerceivedContrast);
  EXPECT_EQ(signA.MeanLuminance, signB.MeanLuminance);
  EXPECT_EQ(signA.VisibleFraction, signB.VisibleFraction);
}

SceneDescription TunnelWithLamp()
{
  SceneDescription scene = scenes::Tunnel(1.0, 0.9);
  scene.Emitters.push_back(scenes::TunnelLamp(0.5));
  return scene;
}

TEST(Determinism, OneAndTwoThreads)
{
  ExpectSame(Solved(TunnelWithLamp(), 0.01, 1, 1), Solved(TunnelWithLamp(), 0.01, 1, 2));
}

TEST(Determinism, TwiceInARow)
{
  ExpectSame(Solved(TunnelWithLamp(), 0.01, 1), Solved(TunnelWithLamp(), 0.01, 1));
}

// Deep smoke that scatters often, where diffusion completes the sweeps.
TEST(Determinism, SmokeThatIsCompleted)
{
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, 3);
  const auto solve = [](int most)
  { return Solved(scenes::MakeSlab(8.0, 0.95, 16).Description, 0.05, 1, most); };
  const Solved one = solve(1);
  EXPECT_GT(WorkCount(one.Field->Report, "blocks of diffusion"), 0.0);
  for (const int most : {2, 3})
  {
    const Solved more = solve(most);
    EXPECT_TRUE(SameBits(one.Field->MultipleFluence, more.Field->MultipleFluence));
    EXPECT_TRUE(SameBits(one.Field->MultipleIlluminance, more.Field->MultipleIlluminance));
  }
}

// The seed matters, and only to what is estimated.
TEST(Determinism, AnotherSeed)
{
  const Solved a(TunnelWithLamp(), 0.01, 1);
  const Solved b(TunnelWithLamp(), 0.01, 2);
  EXPECT_TRUE(SameBits(a.Field->DirectFluence, b.Field->DirectFluence));
  EXPECT_FALSE(SameBits(a.Field->MultipleFluence, b.Field->MultipleFluence));
}

} // namespace
