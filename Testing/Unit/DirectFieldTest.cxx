// Direct fluence near a light: lattices, cell means and pieces of rays, against plain sums over the
// plate.
#include "DirectField.h"
#include "LightField.h"
#include "NearField.h"
#include "SceneLibrary.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

constexpr double Extinction = 2.0;

/// A sign of five lit bars, 0.5 m x 0.25 m, at the end of a box of even smoke.
SceneDescription Barred(int bars)
{
  SceneDescription scene;
  scene.Albedo = 0.5;
  scene.Grids = {scenes::UniformSmoke(Vec3(0.0), Vec3(2.0), {12, 12, 12}, Extinction)};
  for (int bar = 0; bar < bars; bar += 2)
  {
    const double low = 0.75 + 0.5 * bar / bars;
    const double high = 0.75 + 0.5 * (bar + 1) / bars;
    EmitterCell cell;
    cell.Vertices = {{2, low, 0.9}, {2, low, 1.15}, {2, high, 1.15}, {2, high, 0.9}};
    cell.Luminance = {100, 100, 100};
    cell.SignId = 0;
    scene.Emitters.push_back(cell);
  }
  return scene;
}

/// Integral of luminance times transmittance over the solid angle, by the midpoint rule.
double SumOverPlate(const SceneDescription& scene, const Vec3& point)
{
  constexpr int Steps = 120;
  double sum = 0.0;
  for (const EmitterCell& cell : scene.Emitters)
  {
    const Vec3 u = cell.Vertices[1] - cell.Vertices[0];
    const Vec3 v = cell.Vertices[3] - cell.Vertices[0];
    const double area = glm::length(glm::cross(u, v)) / (Steps * Steps);
    for (int i = 0; i < Steps * Steps; ++i)
    {
      const Vec3 to =
        cell.Vertices[0] + (i % Steps + 0.5) / Steps * u + (i / Steps + 0.5) / Steps * v - point;
      const double distance = glm::length(to);
      sum += 100.0 * area * std::max(0.0, to.x / distance) / (distance * distance) *
             std::exp(-Extinction * distance);
    }
  }
  return sum;
}

class DirectFieldTest : public testing::Test
{
protected:
  DirectFieldTest() : Description(Barred(9)), TheScene(Description)
  {
    LightFieldOptions options;
    options.Tolerance = 0.5;
    Progress progress;
    this->Field = SolveLightField(this->TheScene, options, progress);
  }

  SceneDescription Description;
  Scene TheScene;
  LightField Field;
};

// Interpolation between the lattice's nodes: 0.5 %, a quarter of what the veil's promise allows.
TEST_F(DirectFieldTest, LatticeFollowsThePattern)
{
  const DirectLight direct(this->TheScene);
  const NearField near(this->TheScene, direct, 0, 1.0);
  for (const double height : {0.02, 0.05, 0.1, 0.2, 0.4, 0.8})
  {
    for (const double y : {0.78, 1.0, 1.13, 1.4})
    {
      const Vec3 point(2.0 - height, y, 1.05);
      const double expected = SumOverPlate(this->Description, point);
      EXPECT_NEAR(near.Fluence(point, 0) / expected, 1.0, 0.005) << height << ' ' << y;
    }
  }
  EXPECT_EQ(near.Fluence(Vec3(2.5, 1, 1), 0), 0.0);
}

// Cell means against 10 x 10 x 10 points a cell, whose own error is some 0.1 % beside the plate.
// What rays leave in cells that the plate touches is known to half a percent.
TEST_F(DirectFieldTest, CellMeans)
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
    EXPECT_NEAR(this->Field.DirectFluence[cell] / sum, 1.0, place[0] == 11 ? 0.005 : 0.003) << cell;
  }
}

// What a piece of a ray into the plate scatters back, against 2000 points along it.
TEST_F(DirectFieldTest, VeilBeforeThePlate)
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
      veil += fluence * Extinction * std::exp(-Extinction * way) * step;
      mean += fluence / Steps;
    }
    veil *= 0.5 / (4.0 * 3.141592653589793);
    EXPECT_NEAR(
      inside.NearVeil(piece.Cell, origin, direction, piece.Begin, piece.End, Extinction, 0) / veil,
      1.0, 0.01);
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
    EXPECT_NEAR(places / mean, 1.0, 0.01);
    ++varying;
  }
  EXPECT_GT(varying, 0);
}

/// The only light in even smoke, with its direct light.
class LightAlone
{
public:
  explicit LightAlone(const SceneDescription& description)
      : TheScene_(description), Field_(Solve(TheScene_)), Inside_(TheScene_, Field_),
        Direct_(TheScene_), Extinction_(description.Grids[0].Extinction[0])
  {
  }

  /// What the smoke along a ray sends back of the light, over the same from 2000 places.
  double VeilOverSum(const Vec3& origin, const Vec3& direction, double length) const
  {
    std::vector<Segment> pieces;
    this->TheScene_.Smoke().Walk(origin, direction, 0.0, length, pieces);
    double veil = 0.0;
    for (const Segment& piece : pieces)
    {
      if (!this->Inside_.Near(piece.Cell))
      {
        ADD_FAILURE() << "the light is not near to cell " << piece.Cell;
        return 0.0;
      }
      veil += std::exp(-this->Extinction_ * piece.Begin) * this->Inside_.NearVeil(piece.Cell,
                                                             origin, direction, piece.Begin,
                                                             piece.End, this->Extinction_, 0);
    }
    constexpr int Steps = 2000;
    double expected = 0.0;
    for (int i = 0; i < Steps; ++i)
    {
      const double way = (i + 0.5) / Steps * length;
      expected +=
        this->Direct_.Fluence(0, origin + way * direction)[0] * std::exp(-this->Extinction_ * way);
    }
    return veil / (expected * this->Extinction_ * length / Steps * this->TheScene_.Albedo() /
                    (4.0 * 3.141592653589793));
  }

private:
  static LightField Solve(const Scene& scene)
  {
    LightFieldOptions options;
    options.Tolerance = 0.5;
    Progress progress;
    return SolveLightField(scene, options, progress);
  }

  Scene TheScene_;
  LightField Field_;
  DirectField Inside_;
  DirectLight Direct_;
  double Extinction_;
};

/// A plate in thin smoke, in so many cells along each 4 m.
SceneDescription ThinSmokeWith(const std::vector<Vec3>& plate, double exponent, int cells)
{
  SceneDescription description;
  description.Albedo = 0.5;
  description.Grids = {scenes::UniformSmoke(Vec3(0.0), Vec3(4.0), {cells, cells, cells}, 0.3)};
  EmitterCell lamp;
  lamp.Vertices = plate;
  lamp.Luminance.fill(1000.0);
  lamp.Exponent = exponent;
  description.Emitters = {lamp};
  return description;
}

// The veil before an unlit bar on the whole way from 0.55 m, the last cell in one piece: the
// lattice's own 0.5 %.
TEST(DirectField, VeilBeforeAWideUnlitBar)
{
  const Vec3 origin(1.45, 0.93, 1.03);
  const Vec3 way = Vec3(2.0, 0.9, 1.0) - origin;
  const LightAlone sign(Barred(5));
  EXPECT_NEAR(sign.VeilOverSum(origin, glm::normalize(way), glm::length(way)), 1.0, 0.005);
}

const std::vector<Vec3> Tube = {{1.4, 1.93, 2}, {1.4, 2.08, 2}, {2.6, 2.08, 2}, {2.6, 1.93, 2}};

// Rays that pass or meet a slender lamp, a triangle or a wide one anywhere, from afar and from 1 cm
// before it, through cells shorter and longer than the lamp is wide.
TEST(DirectField, VeilBesideLampsOfAnyShape)
{
  for (const int cells : {6, 16})
  {
    for (const auto& plate : {Tube, {{1.5, 1.6, 2}, {1.62, 2.6, 2}, {1.88, 2.6, 2}},
           {{1.6, 1.6, 2}, {1.6, 2.4, 2}, {2.4, 2.4, 2}, {2.4, 1.6, 2}}})
    {
      const LightAlone lamp(ThinSmokeWith(plate, 0.0, cells));
      for (const auto& [height, slope] : {std::pair{0.01, 0.0}, {0.04, 0.0}, {0.1, 0.0}, {0.4, 0.0},
             {0.02, 0.05}, {0.1, 0.3}, {0.2, 0.6}})
      {
        for (const double turn : {0.05, 0.8, 2.6})
        {
          const Vec3 direction = glm::normalize(Vec3(std::cos(turn), std::sin(turn), slope));
          const Vec3 origin = Vec3(1.75, 2.03, 2.0 - height) - 0.4 * direction;
          EXPECT_NEAR(lamp.VeilOverSum(origin, direction, 0.8), 1.0, 0.02)
            << cells << ' ' << plate[1].y << ' ' << height << ' ' << slope << ' ' << turn;
        }
      }
    }
  }
}

// Rays across a tube that come to its plane right before it, under it or behind it: all of its
// light may lie in the last centimetres.
TEST(DirectField, VeilOfRaysThatGrazeATube)
{
  for (const int cells : {8, 16})
  {
    const LightAlone lamp(ThinSmokeWith(Tube, 0.0, cells));
    for (const double slope : {0.02, 0.1, 0.3})
    {
      for (const double place : {1.88, 1.95, 2.03, 2.1, 2.14})
      {
        const Vec3 direction = glm::normalize(Vec3(0.2, 1.0, slope));
        const Vec3 origin = Vec3(1.8, place, 2.0) - 0.6 * direction;
        EXPECT_NEAR(lamp.VeilOverSum(origin, direction, 0.6), 1.0, 0.03)
          << cells << ' ' << slope << ' ' << place;
      }
    }
  }
}

// Rays that pass a tube beyond its end.
TEST(DirectField, VeilBeyondATubesEnd)
{
  const LightAlone lamp(ThinSmokeWith(Tube, 0.0, 6));
  for (const double height : {0.02, 0.05, 0.1})
  {
    for (const double beyond : {0.05, 0.15, 0.31})
    {
      const Vec3 direction = glm::normalize(Vec3(0.1, 1.0, 0.0));
      const Vec3 origin = Vec3(2.6 + beyond, 2.0, 2.0 - height) - 0.7 * direction;
      EXPECT_NEAR(lamp.VeilOverSum(origin, direction, 1.4), 1.0, 0.02) << height << ' ' << beyond;
    }
  }
}

// Rays along a wide panel of bars, across which the light varies within the pieces of a ray: 2 %
// from a bar's width on, 10 % closer to it.
TEST(DirectField, VeilAlongAPanelOfBars)
{
  for (const int cells : {4, 8, 16})
  {
    SceneDescription description = ThinSmokeWith(Tube, 0.0, cells);
    description.Emitters.clear();
    for (int bar = 0; bar < 20; bar += 2)
    {
      EmitterCell cell;
      const double low = 1.0 + 0.1 * bar;
      cell.Vertices = {{low, 1.5, 2}, {low, 2.5, 2}, {low + 0.1, 2.5, 2}, {low + 0.1, 1.5, 2}};
      cell.Luminance.fill(1000.0);
      cell.SignId = 0;
      description.Emitters.push_back(cell);
    }
    const LightAlone panel(description);
    for (const double height : {0.02, 0.05, 0.1, 0.2})
    {
      for (const double turn : {0.05, 0.4, 0.8})
      {
        const Vec3 direction(std::cos(turn), std::sin(turn), 0.0);
        const Vec3 origin = Vec3(2.03, 2.01, 2.0 - height) - 0.55 * direction;
        EXPECT_NEAR(panel.VeilOverSum(origin, direction, 1.1), 1.0, height < 0.1 ? 0.1 : 0.02)
          << cells << ' ' << height << ' ' << turn;
      }
    }
  }
}

// Lamps with beams, close to them and below.
TEST(DirectField, VeilUnderBeams)
{
  for (const double exponent : {1.0, 3.0, 8.0, 30.0})
  {
    const LightAlone lamp(
      ThinSmokeWith({{2, 2, 3.3}, {2, 2.1, 3.3}, {2.1, 2.1, 3.3}, {2.1, 2, 3.3}}, exponent, 8));
    for (const double height : {0.05, 0.2, 0.5, 0.9})
    {
      const Vec3 direction = glm::normalize(Vec3(1.0, 0.3, 0.1));
      const Vec3 origin = Vec3(2.06, 2.04, 3.3 - height) - 0.7 * direction;
      EXPECT_NEAR(lamp.VeilOverSum(origin, direction, 1.2), 1.0, 0.02) << exponent << ' ' << height;
    }
  }
}

// The only light is near: nothing is left for the smooth part, in any cell around it.
TEST_F(DirectFieldTest, NothingIsCountedTwice)
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

TEST(Blocks, HoldEveryCellOnce)
{
  SmokeGrid grid;
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int node = 0; node <= 9 + axis; ++node)
    {
      grid.Nodes[axis].push_back(node);
    }
  }
  grid.Extinction.assign(9 * 10 * 11, 1.0F);
  const Medium medium({grid});
  std::vector<int> met(medium.Cells(), 0);
  for (const Medium::Block& block : medium.Blocks(8))
  {
    std::size_t number = 0;
    block.ForEachCell(
      [&](const std::array<int, 3>& place)
      {
        ++met[medium.Cell(block, place)];
        EXPECT_EQ(block.Number(place), number++);
      });
    EXPECT_EQ(block.Cells(), number);
  }
  EXPECT_EQ(std::count(met.begin(), met.end(), 1), static_cast<std::ptrdiff_t>(met.size()));
}

// Before a plate in smoke of hundreds of mean free paths a cell, a corner of which is free,
// lattices that are made for even smoke would tell of light many orders brighter than the plate.
TEST(NearField, ThickSmokeThatEnds)
{
  SceneDescription description = Barred(1);
  std::vector<float>& extinction = description.Grids[0].Extinction;
  for (std::size_t cell = 0; cell < extinction.size(); ++cell)
  {
    extinction[cell] = cell % 12 == 11 && cell % 144 / 12 < 7 ? 1500.0F : 0.01F;
  }
  const Scene scene(description);
  const DirectLight direct(scene);
  const NearField field(scene, direct, 0, 2.0);
  for (const double x : {0.3, 1.0, 1.4, 1.7, 1.82})
  {
    for (const double y : {0.2, 0.8, 1.0, 1.3, 1.9})
    {
      const Vec3 point(x, y, 1.05);
      const double expected = direct.Fluence(0, point, true)[0];
      EXPECT_NEAR(field.Fluence(point, 0), expected, 1e-6 * expected) << x << ' ' << y;
    }
  }
}

// Before lit bars, in smoke so dense that steps of the lattice are one to two mean free paths long;
// in the denser one numbers would overflow at the plate's ends if the lattice kept them without
// that smoke. Light falls by up to half over steps that are interpolated linearly, which leaves up
// to x^2 / 8 of it: an eighth, with what it differs by from the closed form.
TEST(NearField, DenseSmokeBeforeAPattern)
{
  for (const auto& [bars, dense] : {std::tuple(9, 120.0F), std::tuple(15, 340.0F)})
  {
    SceneDescription description = Barred(bars);
    std::vector<float>& extinction = description.Grids[0].Extinction;
    std::fill(extinction.begin(), extinction.end(), dense);
    const Scene scene(description);
    const DirectLight direct(scene);
    const NearField field(scene, direct, 0, 2.0);
    for (const double before : {0.003, 0.011, 0.025})
    {
      for (int bar = 0; bar < bars; bar += 4)
      {
        const Vec3 point(2.0 - before, 0.75 + 0.5 * (bar + 0.5) / bars, 1.13);
        const double expected = direct.Fluence(0, point, true)[0];
        EXPECT_NEAR(field.Fluence(point, 0), expected, 0.13 * expected)
          << dense << ' ' << before << ' ' << bar;
      }
    }
  }
}

/// A lamp of 0.6 m x 1.2 m under z = 3 in even smoke.
SceneDescription Lamp(double exponent, double extinction)
{
  SceneDescription scene;
  scene.Albedo = 0.9;
  scene.Grids = {scenes::UniformSmoke(Vec3(0.0), {4, 4, 3}, {16, 16, 16}, extinction)};
  EmitterCell cell;
  cell.Vertices = {{1.7, 1.4, 3}, {1.7, 2.6, 3}, {2.3, 2.6, 3}, {2.3, 1.4, 3}};
  cell.Luminance.fill(1000.0);
  cell.Exponent = exponent;
  scene.Emitters = {cell};
  return scene;
}

// Right before the middle of a plate its fluence is 2 pi L / (n + 1), farther off what a sum over
// 400 x 400 places of the plate gives; beams far sharper than the plate is wide among them.
TEST(DirectLight, SteepLawsCloseToThePlate)
{
  for (const double exponent : {0.0, 1.0, 3.0, 8.0, 16.0, 50.0})
  {
    const Scene scene(Lamp(exponent, 0.0));
    const DirectLight direct(scene);
    for (const double height : {1e-6, 1e-5, 1e-4, 1e-3})
    {
      const double closed = 2000.0 * std::acos(-1.0) / (exponent + 1.0);
      EXPECT_NEAR(direct.Fluence(0, {2, 2, 3 - height})[0] / closed, 1.0, 0.006)
        << exponent << ' ' << height;
    }
    for (const double height : {0.05, 0.15, 0.45, 0.6, 0.9, 1.5})
    {
      const Vec3 point(2.1, 1.8, 3 - height);
      constexpr int Steps = 400;
      double sum = 0.0;
      for (int i = 0; i < Steps * Steps; ++i)
      {
        const Vec3 to =
          Vec3(1.7 + 0.6 * (i % Steps + 0.5) / Steps, 1.4 + 1.2 * (i / Steps + 0.5) / Steps, 3.0) -
          point;
        const double distance = glm::length(to);
        sum += 1000.0 * 0.72 / (Steps * Steps) * std::pow(to.z / distance, exponent + 1.0) /
               (distance * distance);
      }
      EXPECT_NEAR(direct.Fluence(0, point)[0] / sum, 1.0, 0.006) << exponent << ' ' << height;
    }
  }
}

// In smoke a plate's light falls off most steeply right before it: the lattice follows to 5 %
// where the plate is more than two mean free paths wide, to 2 % where it is one.
TEST(DirectField, ThickSmokeBeforeALamp)
{
  for (const auto& [extinction, exponent, tolerance] :
    {std::tuple{4.0, 0.0, 0.055}, {1.0, 0.0, 0.015}, {4.0, 1.0, 0.055}, {1.0, 3.0, 0.02}})
  {
    const Scene scene(Lamp(exponent, extinction));
    const DirectLight direct(scene);
    const NearField near(scene, direct, 0, 1.0);
    for (const double height : {0.005, 0.01, 0.025, 0.05, 0.1, 0.15})
    {
      const Vec3 point(2.03, 1.9, 3 - height);
      EXPECT_NEAR(near.Fluence(point, 0) / direct.Fluence(0, point)[0], 1.0, tolerance)
        << extinction << ' ' << exponent << ' ' << height;
    }
  }
}

} // namespace
