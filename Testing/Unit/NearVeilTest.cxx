// The veil of a light nearby, ray by ray, against 2000 places along each.
#include "DirectField.h"
#include "LightField.h"
#include "NearLightScenes.h"

#include <cmath>
#include <numbers>
#include <utility>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

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
                    (4.0 * std::numbers::pi));
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
TEST(NearVeil, BeforeAWideUnlitBar)
{
  const Vec3 origin(1.45, 0.93, 1.03);
  const Vec3 way = Vec3(2.0, 0.9, 1.0) - origin;
  const LightAlone sign(test::BarredSign(5));
  EXPECT_NEAR(sign.VeilOverSum(origin, glm::normalize(way), glm::length(way)), 1.0, 0.005);
}

const std::vector<Vec3> Tube = {{1.4, 1.93, 2}, {1.4, 2.08, 2}, {2.6, 2.08, 2}, {2.6, 1.93, 2}};

// Rays that pass or meet a slender lamp, a triangle or a wide one anywhere, from afar and from 1 cm
// before it, through cells shorter and longer than the lamp is wide.
TEST(NearVeil, BesideLampsOfAnyShape)
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
TEST(NearVeil, OfRaysThatGrazeATube)
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
TEST(NearVeil, BeyondATubesEnd)
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
TEST(NearVeil, AlongAPanelOfBars)
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

// Rays in cells that a panel's plane goes through, along it, up to it, and out from behind its
// plane beside it: with nothing before it light is looked up; where a rod or a screen stands close
// before it, some or half of it is hidden.
TEST(NearVeil, InCellsThatThePlaneGoesThrough)
{
  const std::vector<Vec3> plate = {{1.5, 1.5, 2}, {1.5, 2.5, 2}, {2.5, 2.5, 2}, {2.5, 1.5, 2}};
  for (const double hidden : {0.0, 0.034, 0.6})
  {
    for (const int cells : {5, 7, 15})
    {
      SceneDescription description = ThinSmokeWith(plate, 0.0, cells);
      if (hidden > 0.0)
      {
        scenes::AddRectangle(
          description.Surfaces, {2.0, 1.4, 1.97}, {hidden, 0.0, 0.0}, {0.0, 1.2, 0.0}, 1, 1, 0.0);
      }
      const LightAlone lamp(description);
      for (const double height : {0.02, 0.05, 0.2})
      {
        for (const double slope : {0.0, 0.1, -0.6})
        {
          const Vec3 direction = glm::normalize(Vec3(0.7, 0.4, slope));
          const Vec3 origin = Vec3(1.63, 2.03, 2.0 - height) - 0.5 * direction;
          EXPECT_NEAR(lamp.VeilOverSum(origin, direction, 0.6), 1.0, 0.02)
            << hidden << ' ' << cells << ' ' << height << ' ' << slope;
        }
      }
    }
  }
}

// Lamps with beams, close to them and below.
TEST(NearVeil, UnderBeams)
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

} // namespace
