// By what batches are scaled so that as much light is lost as is sent out.
#include "PowerBalance.h"
#include "Errors.h"
#include "LightField.h"
#include "Scene.h"
#include "SceneLibrary.h"

#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

/// Light of a smoky room with grey walls, as sixteen batches could have found it in a sweep.
class PowerBalanceTest : public testing::Test
{
protected:
  PowerBalanceTest() : PowerBalanceTest(0.0) {}
  explicit PowerBalanceTest(double sky) : TheScene(Room(sky))
  {
    this->Field.Cells = this->TheScene.Smoke().Cells();
    this->Field.Patches = this->TheScene.Patches();
    this->Field.DirectFluence.assign(this->Field.Cells, 1.0F);
    this->Field.DirectIlluminance.assign(2 * this->Field.Patches, 0.0F);
  }

  static SceneDescription Room(double sky)
  {
    SceneDescription description;
    description.Albedo = 0.5;
    description.Sky = sky;
    description.Grids = {scenes::UniformSmoke(Vec3(0.0), {4, 4, 3}, {4, 4, 3}, 0.5)};
    scenes::AddRoom(description.Surfaces, Vec3(0.0), {4, 4, 3}, 4.0, 0.5);
    return description;
  }

  PowerBalance Balance()
  {
    return {this->TheScene, this->Field, 0, Box{Vec3(0.0), {4, 4, 3}}, this->Arena};
  }

  /// @param light of each batch, in its smoke and on its walls, from within
  /// @param escaped from each batch [lm]
  std::vector<BatchState> Drawn(
    const std::function<double(int)>& light, const std::function<double(int)>& escaped) const
  {
    std::vector<BatchState> batches;
    for (int batch = 0; batch < Batches; ++batch)
    {
      BatchState& state = batches.emplace_back(this->Field.Cells, 2 * this->Field.Patches);
      const auto own = static_cast<float>(light(batch));
      state.Fluence.assign(this->Field.Cells, own);
      state.FluenceSum = state.Fluence;
      for (std::size_t patch = 0; patch < this->Field.Patches; ++patch)
      {
        state.Illuminance[2 * patch] = own;
      }
      state.IlluminanceSum = state.Illuminance;
      state.EscapedSum = escaped(batch);
      state.Counted = 1;
    }
    return batches;
  }

  /// By how much ScaleLatest() scaled each batch, in its smoke and on its walls.
  std::vector<double> ScalesOf(std::vector<BatchState> batches)
  {
    const PowerBalance balance = this->Balance();
    const std::vector<BatchState> before = batches;
    balance.ScaleLatest(balance.Of(batches), batches);
    std::vector<double> scales;
    for (int batch = 0; batch < Batches; ++batch)
    {
      scales.push_back(batches[batch].Fluence.front() / before[batch].Fluence.front());
      EXPECT_NEAR(batches[batch].Illuminance.front() / before[batch].Illuminance.front(),
        scales.back(), 1e-6);
      // What was summed up is not touched.
      EXPECT_EQ(batches[batch].FluenceSum, before[batch].FluenceSum);
    }
    return scales;
  }

  Scene TheScene;
  LightField Field;
  tbb::task_arena Arena;
};

class PowerBalanceWithSkyTest : public PowerBalanceTest
{
protected:
  PowerBalanceWithSkyTest() : PowerBalanceTest(1.0) {}
};

/// Numbers around 0, of both signs, whose sum is 0.
double Off(int batch)
{
  return batch - 0.5 * (Batches - 1);
}

double None(int)
{
  return 0.0;
}

// Smoke takes up half of 0.5 per metre of its fluence over 48 m3, walls half of what comes to
// 80 m2 of them.
TEST_F(PowerBalanceTest, Powers)
{
  const PowerBalance balance = this->Balance();
  EXPECT_NEAR(balance.Source(), 0.5 * 0.5 * 48.0, 1e-4);
  for (const PowerBalance::Powers& own :
    balance.Of(this->Drawn([](int) { return 2.0; }, [](int) { return 3.0; })))
  {
    EXPECT_NEAR(own.Lost, 2.0 * (0.25 * 48.0 + 0.5 * 80.0) + 3.0, 1e-4);
    EXPECT_NEAR(own.SentAgain, 2.0 * (0.25 * 48.0 + 0.5 * 80.0), 1e-4);
    EXPECT_NEAR(own.Reflected, 2.0 * 0.5 * 80.0, 1e-4);
    EXPECT_EQ(own.Escaped, 3.0);
  }
}

// Batches that hold too much or too little light as a whole agree when each gets what it misses.
TEST_F(PowerBalanceTest, EachGetsWhatItMisses)
{
  const auto light = [](int batch) { return 0.3 + 0.01 * Off(batch); };
  const std::vector<double> scales = this->ScalesOf(this->Drawn(light, None));
  for (int batch = 0; batch < Batches; ++batch)
  {
    EXPECT_NEAR(scales[batch] * light(batch) * 52.0 / 12.0, 1.0, 1e-5) << batch;
  }
}

// What is far from where most light is lost knows nothing of that: in the mean it is scaled as all
// are, whatever batches hold elsewhere, and so are the sums; and each batch is in balance.
TEST_F(PowerBalanceTest, MeansHaveNoBias)
{
  const auto light = [](int batch) { return 0.3 + 0.03 * Off(batch); };
  std::vector<BatchState> batches = this->Drawn(light, None);
  constexpr float dark = 1e-3F;
  for (BatchState& batch : batches)
  {
    batch.Fluence[0] = dark;
    batch.FluenceSum[0] = dark;
  }
  const PowerBalance balance = this->Balance();
  const double common = 12.0 / (0.3 * (52.0 - 0.25) + dark * 0.25);
  balance.ScaleLatest(balance.Of(batches), batches);
  balance.ScaleSums(balance.Of(batches), batches);
  double latest = 0.0;
  double sum = 0.0;
  for (const BatchState& batch : batches)
  {
    latest += batch.Fluence[0] / Batches;
    sum += batch.FluenceSum[0] / Batches;
  }
  EXPECT_NEAR(latest, common * dark, 1e-5 * dark);
  EXPECT_NEAR(sum, common * dark, 1e-5 * dark);
  for (const PowerBalance::Powers& own : balance.Of(batches))
  {
    EXPECT_NEAR(own.Lost, 12.0, 1e-4);
  }
}

// Where what escapes is noise that says nothing of what the batches hold, all are scaled as one in
// the mean, and each by what it changes of that: leaving out one batch changes the common scale by
// as much as that batch is off, over fifteen, so that the spread is the common scale's error.
TEST_F(PowerBalanceTest, EachByWhatItChangesOfTheWhole)
{
  const auto escaped = [](int batch) { return 5.0 + 0.2 * Off(batch); };
  const auto light = [](int) { return 0.3; };
  const double taken = 0.3 * 52.0;
  const double common = 12.0 / (taken + 5.0);
  const std::vector<double> scales = this->ScalesOf(this->Drawn(light, escaped));
  double mean = 0.0;
  for (int batch = 0; batch < Batches; ++batch)
  {
    mean += scales[batch] / Batches;
    const double without = 12.0 / (taken + 5.0 - 0.2 * Off(batch) / (Batches - 1));
    EXPECT_NEAR((scales[batch] - common) / (Batches - 1), common - without, 0.001 * common)
      << batch;
  }
  EXPECT_NEAR(mean, common, 1e-6);
}

// What is known to no better than a half does not tell what a batch changes of it.
TEST_F(PowerBalanceTest, AllAlikeWhereTheLossIsBadlyKnown)
{
  const auto escaped = [](int batch) { return 5.0 + 4.0 * Off(batch); };
  const std::vector<double> scales = this->ScalesOf(this->Drawn([](int) { return 0.1; }, escaped));
  for (const double scale : scales)
  {
    EXPECT_NEAR(scale, 12.0 / (5.2 + 5.0), 1e-5);
  }
}

TEST_F(PowerBalanceWithSkyTest, NothingIsScaled)
{
  for (const double scale : this->ScalesOf(
         this->Drawn([](int batch) { return 0.3 + 0.01 * Off(batch); }, [](int) { return 5.0; })))
  {
    EXPECT_EQ(scale, 1.0);
  }
}

TEST_F(PowerBalanceTest, LightThatDidNotSettle)
{
  const PowerBalance balance = this->Balance();
  EXPECT_NO_THROW(balance.ExpectBalance(balance.Of(this->Drawn([](int) { return 100.0; }, None))));
  for (const double light : {1e5, std::numeric_limits<double>::quiet_NaN()})
  {
    EXPECT_THROW(
      balance.ExpectBalance(balance.Of(this->Drawn([light](int) { return light; }, None))), Error)
      << light;
  }
}

} // namespace
