// Where rays through smoke are cut short: by a bound of what smoke sends out.
#include "View.h"
#include "ReferenceIntegrator.h"
#include "Sampler.h"
#include "SceneLibrary.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <tuple>
#include <utility>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

constexpr double Tolerance = 0.1;
const Vec3 Size(2.0);

struct Views
{
  explicit Views(SceneDescription description)
  {
    const auto scene = std::make_shared<const Scene>(std::move(description));
    LightFieldOptions options;
    options.Tolerance = Tolerance;
    Progress progress;
    const auto field =
      std::make_shared<const LightField>(SolveLightField(*scene, options, progress));
    this->Cut = std::make_unique<const View>(scene, field);
    this->Whole = std::make_unique<const View>(scene, field, ViewSkips{.HiddenSmoke = false});
  }

  std::unique_ptr<const View> Cut, Whole;
};

/// A cube of smoke between walls.
SceneDescription Cube(double extinction, double albedo, double reflectance)
{
  SceneDescription scene;
  scene.Albedo = albedo;
  scene.Grids = {scenes::UniformSmoke(Vec3(0.0), Size, {8, 8, 8}, extinction)};
  scenes::AddRoom(scene.Surfaces, Vec3(0.0), Size, 1.0, reflectance);
  return scene;
}

SceneDescription WithLamp(SceneDescription scene)
{
  scene.Emitters = {scenes::Plate({0.01, 1, 1}, {1, 0, 0}, {0, 0, 1}, 0.5, 0.5, 1000.0)};
  return scene;
}

/// Nothing but smoke, under a sky.
SceneDescription Cloud()
{
  SceneDescription scene = Cube(2.0, 0.99, 0.0);
  scene.Surfaces = {};
  scene.Sky = 1000.0;
  return scene;
}

SceneDescription Flame()
{
  SceneDescription scene = Cube(20.0, 0.0, 0.0);
  scene.Grids[0].EmittedLuminance.assign(512, 0.0F);
  scene.Grids[0].EmittedLuminance[36] = 1000.0F;
  return scene;
}

// No ray brings more, and some a good part of it: of smoke that hardly scatters right before a
// lamp, of smoke that a sky lights, of a flame, and of white smoke between white walls, whatever
// else of the bound is 0 there.
TEST(View, NothingIsBrighterThanTheBrightestSmoke)
{
  for (const auto& [name, scene] : {std::pair("lamp", WithLamp(Cube(20.0, 0.02, 0.0))),
         {"sky", Cloud()}, {"flame", Flame()}, {"white", WithLamp(Cube(5.0, 0.999, 0.9))}})
  {
    const Views views(scene);
    const double bound = views.Whole->BrightestSmoke(0);
    Pcg32 random(1, 1);
    double brightest = 0.0;
    for (int ray = 0; ray < 4000; ++ray)
    {
      const Vec3 share(random.Uniform(), random.Uniform(), random.Uniform());
      // Half of them right before the lamp, or through the flame.
      const Vec3 origin =
        ray % 2 == 0 ? share * Size : Vec3(0.0101, 0.75, 0.75) + share * Vec3(0.01, 0.5, 0.5);
      const Vec3 direction = SphereDirection(random.Uniform(), random.Uniform());
      const double end = views.Whole->FirstHit(origin, direction, 4.0).Distance;
      const RayLight light = views.Whole->TraceVeil(origin, direction, 0.0, std::min(end, 4.0), 0);
      brightest = std::max(brightest, light.Veil());
    }
    EXPECT_LT(brightest, bound) << name;
    EXPECT_GT(brightest, 0.1 * bound) << name;
  }
}

// What lies behind smoke counts as long as it may add a thousandth of the veil ahead, a hundredth
// of the tolerance. Its optical depth is told in any case.
TEST(View, CutsRaysWhereNothingIsLeft)
{
  const Views views(WithLamp(Cube(2.0, 0.8, 0.5)));
  const Vec3 origin(1.9, 1.0, 1.0);
  const Vec3 direction(-1.0, 0.0, 0.0);
  const auto trace = [&](const View& view, double ahead)
  { return view.TraceVeil(origin, direction, 1.5, 1.7, 0, ahead); };
  const RayLight whole = trace(*views.Whole, std::numeric_limits<double>::infinity());
  EXPECT_GT(whole.Veil(), 0.0);
  EXPECT_NEAR(whole.OpticalDepth, 3.4, 1e-9);
  EXPECT_EQ(views.Whole->RaysCutShort(), 0U);
  // The ray gets through by a factor of exp(-0.4) less at its end.
  const double most = std::exp(-3.0) * views.Cut->BrightestSmoke(0) / (0.01 * Tolerance);
  const RayLight kept = trace(*views.Cut, 0.6 * most);
  EXPECT_EQ(kept.Veil(), whole.Veil());
  EXPECT_EQ(views.Cut->RaysCutShort(), 0U);
  const RayLight cut = trace(*views.Cut, 1.01 * most);
  EXPECT_EQ(cut.Veil(), 0.0);
  EXPECT_EQ(cut.OpticalDepth, whole.OpticalDepth);
  EXPECT_EQ(views.Cut->RaysCutShort(), 1U);
}

} // namespace
