// The reference integrator against closed forms, so that what it says of the solver can be trusted.
#include "ReferenceIntegrator.h"
#include "SceneLibrary.h"
#include "TestReport.h"

#include <cmath>
#include <numbers>

namespace
{

using namespace smokevis;
using std::numbers::pi;

// Closed box, walls emit Le and reflect rho, smoke scatters without loss: L = Le / (1 - rho)
// everywhere. 0.2 % beside three standard errors, which is the promise of the furnace tests.
TEST(ReferenceIntegrator, WhiteFurnace)
{
  report::Head("Reference integrator, white furnace");
  for (const double rho : {0.0, 0.5, 0.9})
  {
    SceneDescription description;
    description.Albedo = 1.0;
    description.Grids = {scenes::NoisySmoke(Vec3(0.0), Vec3(2, 1, 1), {8, 4, 4}, 0.1, 3.0, 5)};
    description.Emitters = scenes::EmittingRoom(Vec3(0.0), Vec3(2, 1, 1), 2, 1.0, rho);
    const Scene scene(description);
    const ReferenceIntegrator reference(scene);
    const Vec3 direction = glm::normalize(Vec3(1.0, 0.3, 0.2));
    const Estimate radiance = reference.Radiance({{0.3, 0.4, 0.5}, direction}, 20000, 1);
    const Estimate fluence = reference.Fluence({0.7, 0.4, 0.5}, 20000, 2);
    const Estimate illuminance = reference.Illuminance({0.5, 0.4, 0.0}, {0, 0, 1}, 20000, 3);
    const double exact = 1.0 / (1.0 - rho);
    const std::string name = "rho " + std::to_string(rho).substr(0, 3);
    report::Relative(name + " radiance", exact, radiance.Mean, 0.002, radiance.StandardError);
    report::Relative(
      name + " fluence", 4.0 * pi * exact, fluence.Mean, 0.002, fluence.StandardError);
    report::Relative(
      name + " illuminance", pi * exact, illuminance.Mean, 0.002, illuminance.StandardError);
  }
}

// Fluence and illuminance of a sign in absorbing smoke against quadrature. Nothing but noise
// differs.
TEST(ReferenceIntegrator, AreaLightUncollided)
{
  report::Head("Reference integrator, uncollided light of a 0.4 x 0.2 m sign, K = 1");
  const report::ReferenceTable table("area_light_uncollided.csv");
  SceneDescription description;
  description.Albedo = 0.0;
  description.Grids = {scenes::UniformSmoke({-1, -3, 0}, {4, 1, 11}, {5, 4, 11}, 1.0)};
  description.Emitters = {scenes::Plate(Vec3(0.0), {0, 0, 1}, {0, 1, 0}, 0.4, 0.2, 1.0)};
  const Scene scene(description);
  const ReferenceIntegrator reference(scene);
  for (std::size_t row = 0; row < table.Rows(); ++row)
  {
    if (table.Number(row, "K") != 1.0)
    {
      continue;
    }
    const Vec3 point(table.Number(row, "x"), table.Number(row, "y"), table.Number(row, "z"));
    const Estimate fluence = reference.Fluence(point, 20000, row);
    const Estimate facing = reference.Illuminance(point, {0, 0, -1}, 20000, row);
    const Estimate up = reference.Illuminance(point, {0, 1, 0}, 20000, row);
    const std::string name = "z = " + table.Text(row, "z");
    report::Relative(
      name + " G0", table.Number(row, "G0"), fluence.Mean, 1e-4, fluence.StandardError);
    report::Relative(
      name + " H facing", table.Number(row, "H_facing"), facing.Mean, 1e-4, facing.StandardError);
    report::Relative(name + " H up", table.Number(row, "H_up"), up.Mean, 1e-4, up.StandardError);
  }
}

// Slab lit by a diffuse wall: reflectance, transmittance and fluence in the middle. The open sides
// of the slab take less than 1e-3 (see MakeSlab).
TEST(ReferenceIntegrator, Slab)
{
  report::Head("Reference integrator, slab");
  const report::ReferenceTable table("slab_reflectance_transmittance.csv");
  for (std::size_t row = 0; row < table.Rows(); ++row)
  {
    const double depth = table.Number(row, "tau0");
    const double albedo = table.Number(row, "omega");
    if (table.Text(row, "incidence") != "diffuse" || depth != 1.0 ||
        (albedo != 0.5 && albedo != 0.9))
    {
      continue;
    }
    const scenes::Slab slab = scenes::MakeSlab(depth, albedo, 5);
    const Scene scene(slab.Description);
    const ReferenceIntegrator reference(scene);
    const Estimate middle = reference.Fluence({0, 0, 0.5}, 100000, 1);
    const Estimate through = reference.Illuminance({0, 0, 1}, {0, 0, -1}, 100000, 2);
    const Estimate back = reference.Illuminance({0, 0, 0}, {0, 0, 1}, 100000, 3);
    const std::string name = "albedo " + table.Text(row, "omega");
    report::Relative(
      name + " T", table.Number(row, "T"), through.Mean, 1e-3, through.StandardError);
    report::Relative(name + " R", table.Number(row, "R"), back.Mean, 1e-3, back.StandardError);
    report::Relative(
      name + " Gmid", table.Number(row, "Gmid"), middle.Mean, 1e-3, middle.StandardError);
  }
}

// Smoke that emits in a closed box of black walls at its own temperature: L = L_emit everywhere.
TEST(ReferenceIntegrator, EmittingSmoke)
{
  report::Head("Reference integrator, smoke and walls of one luminance");
  SceneDescription description;
  description.Albedo = 0.6;
  description.Grids = {scenes::NoisySmoke(Vec3(0.0), Vec3(1.0), {4, 4, 4}, 0.1, 3.0, 5)};
  description.Grids[0].EmittedLuminance.assign(64, 2.0F);
  description.Emitters = scenes::EmittingRoom(Vec3(0.0), Vec3(1.0), 1, 2.0, 0.0);
  const Scene scene(description);
  const ReferenceIntegrator reference(scene);
  const Estimate fluence = reference.Fluence({0.7, 0.4, 0.5}, 20000, 2);
  report::Relative("fluence", 8.0 * pi, fluence.Mean, 1e-6, fluence.StandardError);
}

} // namespace
