// Direct fluence near a sign, in cells and on pieces of rays, against many points of them.
#include "DirectField.h"
#include "LightField.h"
#include "NearLightScenes.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

/// To the largest tolerance at which lattices are fine, and to one at which they are coarse: twice
/// as much may be unknown then.
class DirectFieldTest : public testing::TestWithParam<double>
{
protected:
  DirectFieldTest() : TheScene(test::BarredSign(9))
  {
    LightFieldOptions options;
    options.Tolerance = GetParam();
    Progress progress;
    this->Field = SolveLightField(this->TheScene, options, progress);
  }

  Scene TheScene;
  LightField Field;
  const double Coarseness = GetParam() > DirectLight::FineTolerance ? 2.0 : 1.0;
};

INSTANTIATE_TEST_SUITE_P(Tolerances, DirectFieldTest, testing::Values(0.05, 0.5));

// Cell means against 10 x 10 x 10 points a cell, whose own error is some 0.1 % beside the plate.
// What rays leave in cells that the plate touches is known to half a percent.
TEST_P(DirectFieldTest, CellMeans)
{
  const DirectLight direct(this->TheScene);
  for (const std::array<int, 3> place :
    {std::array<int, 3>{11, 6, 6}, {10, 5, 6}, {8, 8, 4}, {4, 6, 6}, {0, 0, 0}})
  {
    const std::int64_t cell = place[0] + 12 * (place[1] + 12 * place[2]);
    const Vec3 centre = this->TheScene.Smoke().CellCentre(cell);
    const Vec3 size = this->TheScene.Smoke().CellSize(cell);
    double sum = 0.0;
    for (int i = 0; i < 1000; ++i)
    {
      const Vec3 share(i % 10 / 10.0 - 0.45, i / 10 % 10 / 10.0 - 0.45, i / 100 / 10.0 - 0.45);
      sum += direct.Fluence(0, centre + share * size, true)[0] / 1000.0;
    }
    EXPECT_NEAR(this->Field.DirectFluence[cell] / sum, 1.0,
      this->Coarseness * (place[0] == 11 ? 0.005 : 0.003))
      << cell;
  }
}

// What a piece of a ray into the plate scatters back, against 2000 points along it.
TEST_P(DirectFieldTest, VeilBeforeThePlate)
{
  const DirectField inside(this->TheScene, this->Field);
  const DirectLight direct(this->TheScene);
  const Vec3 origin(1.5, 1.02, 1.0);
  const Vec3 direction = glm::normalize(Vec3(1.0, 0.03, 0.05));
  std::vector<Segment> pieces;
  this->TheScene.Smoke().Walk(origin, direction, 0.0, 0.49, pieces);
  ASSERT_FALSE(pieces.empty());
  int varying = 0;
  for (const Segment& piece : pieces)
  {
    ASSERT_TRUE(inside.Near(piece.Cell));
    constexpr int Steps = 2000;
    const double step = (piece.End - piece.Begin) / Steps;
    double veil = 0.0;
    double mean = 0.0;
    for (int i = 0; i < Steps; ++i)
    {
      const double way = (i + 0.5) * step;
      const double fluence = direct.Fluence(0, origin + (piece.Begin + way) * direction, true)[0];
      veil += fluence * test::SignExtinction * std::exp(-test::SignExtinction * way) * step;
      mean += fluence / Steps;
    }
    veil *= 0.5 / (4.0 * 3.141592653589793);
    EXPECT_NEAR(inside.NearVeil(
                  piece.Cell, origin, direction, piece.Begin, piece.End, test::SignExtinction, 0) /
                  veil,
      1.0, 0.01 * this->Coarseness);
    if (!inside.Varies(piece.Cell, 0))
    {
      continue;
    }
    constexpr int Places = 64;
    double places = 0.0;
    for (int i = 0; i < Places; ++i)
    {
      const double place = (i + 0.5) / Places;
      places +=
        inside.NearFluence(piece.Cell, origin, direction, piece.Begin, piece.End, place, 0) /
        Places;
    }
    EXPECT_NEAR(places / mean, 1.0, 0.01 * this->Coarseness);
    ++varying;
  }
  EXPECT_GT(varying, 0);
}

// The only light is near: nothing is left for the smooth part, in any cell around it.
TEST_P(DirectFieldTest, NothingIsCountedTwice)
{
  const DirectField inside(this->TheScene, this->Field);
  for (std::int64_t cell = 0; cell < static_cast<std::int64_t>(this->Field.Cells); ++cell)
  {
    if (inside.Near(cell))
    {
      EXPECT_EQ(inside.Smooth(cell, this->TheScene.Smoke().CellCentre(cell), 0), 0.0);
    }
  }
}

} // namespace
