// Lamps with a measured spread of light: candela over distance squared, and no light lost.
#include "SceneLibrary.h"
#include "Solved.h"
#include "TestReport.h"

#include <cmath>
#include <numbers>

namespace
{

using namespace smokevis;
using std::numbers::pi;

/// A wide beam, brightest off the normal and cut off at 75 degrees, stronger to both sides.
double Candela(double polar, double azimuth)
{
  const double sine = std::sin(polar);
  return polar > 5.0 * pi / 12.0 ? 0.0
                                 : 400.0 * std::cos(polar) * (0.5 + 1.5 * sine * sine) *
                                     (1.0 + 0.5 * sine * sine * std::cos(2.0 * azimuth));
}

constexpr double LampSide = 0.1;

/// A down-light at a place, and its flux.
EmitterCell DownLight(const Vec3& centre, double& flux)
{
  std::vector<double> polar, azimuth, candela;
  for (int g = 0; g <= 90; ++g)
  {
    polar.push_back(g);
  }
  for (int c = 0; c <= 360; c += 5)
  {
    azimuth.push_back(c);
    for (const double g : polar)
    {
      candela.push_back(Candela(g * pi / 180.0, c * pi / 180.0));
    }
  }
  flux = IntensityTable::Flux(polar, azimuth, candela);
  EmitterCell lamp = scenes::Plate(
    centre, {0, 0, -1}, {0, 1, 0}, LampSide, LampSide, flux / (pi * LampSide * LampSide));
  lamp.Table = std::make_shared<IntensityTable>(polar, azimuth, candela);
  lamp.TableAxis = {1, 0, 0};
  return lamp;
}

// Far from a lamp of 0.1 m, at 3 m: I(gamma, C) cos / r^2. The lamp's size changes that by
// (0.05 / 3)^2, the patch's (0.1 m) by about as much.
TEST(Photometry, CandelaOverDistanceSquared)
{
  report::Head("Illuminance under a down-light against I cos / r^2 [lx]");
  SceneDescription scene;
  double flux = 0.0;
  scene.Emitters = {DownLight({0, 0, 3}, flux)};
  std::vector<Vec3> places;
  for (const auto& [x, y] : {std::pair(0.0, 0.0), std::pair(1.5, 0.0), std::pair(0.0, 1.5),
         std::pair(-1.2, 2.0), std::pair(2.0, -2.5), std::pair(3.5, 3.0)})
  {
    places.emplace_back(x, y, 0.0);
    scenes::AddRectangle(
      scene.Surfaces, {x - 0.05, y - 0.05, 0}, {0.1, 0, 0}, {0, 0.1, 0}, 1, 1, 0.0);
  }
  const Solved solved(std::move(scene));
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    const Vec3 way = places[i] - Vec3(0, 0, 3);
    const double distance = glm::length(way);
    const double polar = std::acos(-way.z / distance);
    const double expected =
      Candela(polar, std::atan2(way.y, way.x)) * std::cos(polar) / (distance * distance);
    report::Absolute("at " + std::to_string(way.x) + ", " + std::to_string(way.y), expected,
      solved.Illuminance({i}, 0).Mean, 0.002 * expected + 0.01);
  }
}

// Directly lit surfaces take in the table's flux, and so do all in a room that reflects.
TEST(Photometry, NoLightIsLost)
{
  report::Head("Flux of a down-light in a closed room [lm]");
  for (const double reflectance : {0.0, 0.5})
  {
    SceneDescription scene;
    double flux = 0.0;
    scene.Albedo = reflectance;
    scene.Emitters = {DownLight({2.1, 1.4, 2.7}, flux)};
    scene.Grids = {scenes::UniformSmoke(Vec3(0.0), {4, 3, 3}, {16, 12, 12}, 0.3)};
    scenes::AddRoom(scene.Surfaces, Vec3(0.0), {4, 3, 3}, 0.25, reflectance);
    const Solved solved(std::move(scene));
    const Estimate smoke = solved.AbsorbedInSmoke();
    const Estimate surfaces = solved.AbsorbedOnSurfaces();
    // Some patches of 0.25 m are cut by the beam's edge, which the quadrature does not see.
    report::Relative("reflectance " + std::to_string(reflectance), flux,
      solved.PowerBeforeBalance(), 0.005, std::hypot(smoke.StandardError, surfaces.StandardError));
  }
}

// In a room where boxes of smoke are far from the lamp as it counts, beams end within them and all
// that is beyond gets nothing: light is neither lost nor not a number.
TEST(Photometry, SharpBeams)
{
  report::Head("Flux of lamps with sharp beams in a closed room with smoke [lm]");
  const auto check = [](const std::string& name, const EmitterCell& lamp)
  {
    SceneDescription scene;
    scene.Albedo = 0.5;
    scene.Emitters = {lamp};
    scene.Grids = {scenes::UniformSmoke(Vec3(0.0), {8, 6, 3}, {40, 30, 15}, 0.5)};
    scenes::AddRoom(scene.Surfaces, Vec3(0.0), {8, 6, 3}, 0.25, 0.5);
    const Solved solved(std::move(scene), 0.1);
    const Estimate smoke = solved.AbsorbedInSmoke();
    const Estimate surfaces = solved.AbsorbedOnSurfaces();
    report::Relative(name, solved.TheScene->Lights().Flux(0), solved.PowerBeforeBalance(), 0.005,
      std::hypot(smoke.StandardError, surfaces.StandardError));
    EXPECT_GT(smoke.StandardError, 0.0);
  };
  EmitterCell lamp =
    scenes::Plate({4.1, 3.1, 2.98}, {0, 0, -1}, {1, 0, 0}, LampSide, LampSide, 5000.0);
  lamp.Table = std::make_shared<IntensityTable>(std::vector<double>{0, 30, 60, 65, 90},
    std::vector<double>{0}, std::vector<double>{100, 100, 80, 0, 0});
  lamp.TableAxis = {1, 0, 0};
  check("cut off at 65 degrees", lamp);
  lamp.Table = nullptr;
  lamp.Exponent = 300.0;
  check("exponent 300", lamp);
}

// What an eye sees of the lamp is candela over its projected area.
TEST(Photometry, LuminanceThatAnEyeSees)
{
  SceneDescription scene;
  double flux = 0.0;
  scene.Emitters = {DownLight({0, 0, 3}, flux)};
  scenes::AddRectangle(scene.Surfaces, {-5, -5, 0}, {10, 0, 0}, {0, 10, 0}, 1, 1, 0.0);
  const Solved solved(std::move(scene));
  const Vec3 eye(0.0, 1.0, 1.7);
  const Vec3 way = Vec3(0, 0, 3) - eye;
  const double polar = std::atan2(1.0, 1.3);
  report::Relative("luminance", Candela(polar, pi / 2.0) / (LampSide * LampSide * std::cos(polar)),
    solved.Luminance({eye, glm::normalize(way)}).Mean, 1e-3);
}

} // namespace
