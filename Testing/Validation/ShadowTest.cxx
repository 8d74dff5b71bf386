// Shadows in smoke: what a beam, slats and a door's frame leave of a lamp's light.
#include "SceneLibrary.h"
#include "Solved.h"
#include "TestReport.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace
{

using namespace smokevis;

/// A room of 6 x 3 x 3 m between black walls, with a lamp of 0.6 x 0.6 m below its ceiling.
SceneDescription LampRoom(double albedo, int cellsAMetre)
{
  SceneDescription scene;
  const Vec3 size(6, 3, 3);
  scene.Albedo = albedo;
  scene.Grids = {scenes::UniformSmoke(
    Vec3(0.0), size, {6 * cellsAMetre, 3 * cellsAMetre, 3 * cellsAMetre}, 0.4)};
  scenes::AddRoom(scene.Surfaces, Vec3(0.0), size, 0.5, 0.0);
  scene.Emitters = {scenes::Plate({3, 1.5, 2.95}, {0, 0, -1}, {0, 1, 0}, 0.6, 0.6, 1000.0)};
  return scene;
}

/// A beam of 0.2 x 0.2 m right below the lamp.
SceneDescription BeamRoom(double albedo, int cellsAMetre)
{
  SceneDescription scene = LampRoom(albedo, cellsAMetre);
  scenes::AddBlock(scene.Surfaces, {2.9, 0, 2.5}, {3.1, 3, 2.7}, 0.2, 0.0);
  return scene;
}

/// Slats, upright and crosswise, below the lamp.
SceneDescription SlatRoom(int cellsAMetre)
{
  SceneDescription scene = LampRoom(0.0, cellsAMetre);
  constexpr int slats = 24;
  for (int slat = 0; slat < slats; ++slat)
  {
    const double x = 1.8 + 2.4 * (slat + 0.5) / slats;
    scenes::AddRectangle(scene.Surfaces, {x, 0.3, 2.2}, {0, 2.4, 0}, {0, 0, 0.25}, 1, 1, 0.0);
  }
  return scene;
}

/// A wall with a door between the lamp and the other half of the room.
SceneDescription DoorRoom(int cellsAMetre)
{
  SceneDescription scene = LampRoom(0.0, cellsAMetre);
  scenes::AddRectangle(scene.Surfaces, {4.05, 0, 0}, {0, 1, 0}, {0, 0, 3}, 2, 6, 0.0);
  scenes::AddRectangle(scene.Surfaces, {4.05, 2, 0}, {0, 1, 0}, {0, 0, 3}, 2, 6, 0.0);
  scenes::AddRectangle(scene.Surfaces, {4.05, 1, 2}, {0, 1, 0}, {0, 0, 1}, 2, 2, 0.0);
  return scene;
}

/// What is amiss of the light of a row of cells along x, as a share of what all of them get.
double AmissInRow(const Solved& solved, double y, double z, double from, double to)
{
  const ReferenceIntegrator reference(*solved.TheScene);
  const Medium& smoke = solved.TheScene->Smoke();
  const double width = smoke.CellSize(0).x;
  double all = 0.0;
  double amiss = 0.0;
  for (double x = from + 0.5 * width; x < to; x += width)
  {
    const std::int64_t cell = smoke.Locate({x, y, z});
    const Box box = smoke.BoxOf(cell);
    const double expected =
      reference.MeanFluence([&box](Pcg32& random) { return PlaceIn(box, random); }, 40000, 1).Mean;
    all += expected;
    amiss += std::abs(solved.Fluence(Vec3(x, y, z)).Mean - expected);
  }
  return amiss / all;
}

// Cells that the edge of a shadow crosses are measured at 64 places: to some 2 % of an unhidden
// cell's light each, more where several edges do. Edges on patches are followed to a 16th of their
// triangles.
TEST(Shadows, CellsBehindBeamSlatsAndDoor)
{
  report::Head("Direct light of a row of cells in half shadows: what is amiss of all; power");
  for (const int cells : {4, 8})
  {
    const std::string size = ", cells of 1/" + std::to_string(cells) + " m";
    const Solved beam(BeamRoom(0.0, cells), 0.1);
    report::Absolute("below a beam" + size, 0.0, AmissInRow(beam, 1.6, 2.3, 1.0, 5.0), 0.04);
    report::Absolute("far below it" + size, 0.0, AmissInRow(beam, 1.6, 0.9, 1.0, 5.0), 0.03);
    report::Relative(
      "power" + size, beam.TheScene->Lights().Flux(0), beam.PowerBeforeBalance(), 0.002);
    const Solved slats(SlatRoom(cells), 0.1);
    report::Absolute("below slats" + size, 0.0, AmissInRow(slats, 1.6, 1.6, 1.0, 5.0), 0.08);
    report::Relative(
      "power" + size, slats.TheScene->Lights().Flux(0), slats.PowerBeforeBalance(), 0.005);
    const Solved door(DoorRoom(cells), 0.1);
    report::Absolute("behind a door" + size, 0.0, AmissInRow(door, 1.1, 0.9, 4.25, 6.0), 0.05);
    report::Relative(
      "power" + size, door.TheScene->Lights().Flux(0), door.PowerBeforeBalance(), 0.004);
  }
}

// Light that is not even over the plate, or that smoke dims unlike from place to place: a sign
// whose bright half stands behind a pillar, and a layer of smoke below a beam and a lamp in clear
// air.
TEST(Shadows, PowerBehindPillarAndInALayer)
{
  report::Head("Power taken up in black rooms with half shadows");
  SceneDescription pillar;
  pillar.Albedo = 0.0;
  pillar.Grids = {scenes::UniformSmoke(Vec3(0.0), {3, 2, 2}, {24, 16, 16}, 0.4)};
  scenes::AddRoom(pillar.Surfaces, Vec3(0.0), {3, 2, 2}, 0.5, 0.0);
  scenes::AddBlock(pillar.Surfaces, {0.25, 0.5, 0}, {0.35, 0.9, 2}, 0.2, 0.0);
  for (const auto& [y, luminance] : {std::pair(0.7, 1000.0), {1.1, 20.0}})
  {
    pillar.Emitters.push_back(
      scenes::Plate({0.05, y, 1}, {1, 0, 0}, {0, 0, 1}, 0.4, 0.3, luminance, 0.0, 0));
  }
  const Solved behind(std::move(pillar), 0.1);
  report::Relative(
    "sign behind a pillar", behind.TheScene->Lights().Flux(0), behind.PowerBeforeBalance(), 0.002);
  for (const double extinction : {0.5, 4.0, 40.0})
  {
    SceneDescription layer = BeamRoom(0.0, 8);
    const auto above = layer.Grids[0].Extinction.size() / 2;
    std::fill(layer.Grids[0].Extinction.begin(), layer.Grids[0].Extinction.begin() + above,
      static_cast<float>(extinction));
    std::fill(layer.Grids[0].Extinction.begin() + above, layer.Grids[0].Extinction.end(), 0.0F);
    const Solved solved(std::move(layer), 0.1);
    report::Relative("layer of " + std::to_string(extinction).substr(0, 4) + " per m",
      solved.TheScene->Lights().Flux(0), solved.PowerBeforeBalance(), 0.004);
  }
}

// A block so close to a lamp that it hides a strip of it and none of its centre and corners.
TEST(Shadows, StripOfALampHidden)
{
  report::Head("Power taken up where a thin block hides a strip of a lamp");
  SceneDescription scene = LampRoom(0.0, 8);
  scenes::AddBlock(scene.Surfaces, {3.08, 0.8, 2.74}, {3.16, 2.2, 2.83}, 0.2, 0.0);
  const Solved solved(std::move(scene), 0.1);
  report::Relative("power", solved.TheScene->Lights().Flux(0), solved.PowerBeforeBalance(), 0.002);
}

// What the solver's README says: of a pole thinner than a cell, and of a luminous plate of tens of
// metres before patches that are as large.
TEST(Shadows, PoleAndHugePlate)
{
  report::Head("Power taken up: a pole of 4 cm in cells of 0.25 m; a plate of 36 m");
  for (const double lamp : {0.1, 0.6})
  {
    SceneDescription scene;
    scene.Albedo = 0.0;
    scene.Grids = {scenes::UniformSmoke(Vec3(0.0), {4, 3, 3}, {16, 12, 12}, 0.4)};
    scenes::AddRoom(scene.Surfaces, Vec3(0.0), {4, 3, 3}, 0.5, 0.0);
    scenes::AddBlock(scene.Surfaces, {2.27, 1.52, 0}, {2.31, 1.56, 3}, 0.2, 0.0);
    scene.Emitters = {scenes::Plate({0.4, 1.5, 1.5}, {1, 0, 0}, {0, 0, 1}, lamp, lamp, 1000.0)};
    const Solved solved(std::move(scene), 0.1);
    report::Relative("pole, lamp of " + std::to_string(lamp).substr(0, 3) + " m",
      solved.TheScene->Lights().Flux(0), solved.PowerBeforeBalance(), 0.003);
  }
  SceneDescription hall;
  hall.Albedo = 0.0;
  scenes::AddRoom(hall.Surfaces, Vec3(-100, -100, -100), Vec3(100, 100, 3), 50.0, 0.0);
  hall.Grids = {scenes::UniformSmoke(Vec3(0.0), Vec3(0.8), {16, 16, 16}, 1.0)};
  hall.Emitters = {scenes::Plate({0.4, 0.4, 0.95}, {0, 0, -1}, {0, 1, 0}, 36.0, 36.0, 1000.0)};
  const Solved solved(std::move(hall), 0.1);
  report::Relative(
    "plate of 36 m", solved.TheScene->Lights().Flux(0), solved.PowerBeforeBalance(), 0.08);
}

/// A room of cells as wide as itself, with a lamp and, where it is wanted, a block before the
/// middle of theirs.
SceneDescription WideCells(bool block)
{
  SceneDescription scene;
  scene.Albedo = 0.0;
  const Vec3 size(2.6, 1.8, 2.5);
  scene.Grids = {scenes::UniformSmoke(Vec3(0.0), size, {1, 5, 2}, 0.003)};
  scenes::AddRoom(scene.Surfaces, Vec3(0.0), size, 1.3, 0.0);
  scene.Emitters = {scenes::Plate({0.95, 0.06, 2.3}, {0, 0, -1}, {1, 0, 0}, 0.1, 0.1, 100.0)};
  if (block)
  {
    scenes::AddBlock(scene.Surfaces, {0.75, 0.35, 1.65}, {1.35, 0.85, 1.95}, 0.6, 0.0);
  }
  return scene;
}

// A block that hides nearly half of a lamp's light from a cell, though neither from its corners nor
// from its centre.
TEST(Shadows, BlockNarrowerThanACell)
{
  report::Head("Fluence in cells behind a block narrower than they are [lx]");
  const Solved hidden(WideCells(true), 0.01);
  const Solved clear(WideCells(false), 0.01);
  const ReferenceIntegrator reference(*hidden.TheScene);
  for (const double y : {1.25, 1.6})
  {
    const Vec3 place(1.3, y, 1.9);
    const Box box = hidden.TheScene->Smoke().BoxOf(hidden.TheScene->Smoke().Locate(place));
    const Estimate truth =
      reference.MeanFluence([&box](Pcg32& random) { return PlaceIn(box, random); }, 40000, 1);
    // As the cells that the edge of a shadow crosses.
    report::Absolute("at y = " + std::to_string(y).substr(0, 4), truth.Mean,
      hidden.Fluence(place).Mean, 0.02 * clear.Fluence(place).Mean, truth.StandardError);
  }
}

// In the cleft right below a beam cells are too coarse for what is seen of the lamp at either side.
TEST(Shadows, CleftBelowABeam)
{
  report::Head("Veil right below a beam, along a border between cells, against the path tracer");
  for (const int cells : {4, 8})
  {
    const Solved solved(BeamRoom(0.7, cells), 0.03);
    const Ray ray{{3.0, 0.01, 2.2}, {0, 1, 0}};
    const RayLight light = solved.Trace(ray);
    const Estimate expected = ReferenceIntegrator(*solved.TheScene).Veil(ray, 100000, 1);
    report::Relative("cells of 1/" + std::to_string(cells) + " m", expected.Mean, light.Veil(), 0.3,
      std::hypot(expected.StandardError, StandardError(light.VeilMultiple)));
  }
}

// The veil of rays along a beam, below the lamp that it hides a part of.
TEST(Shadows, VeilAlongABeam)
{
  report::Head("Veil along a beam below a lamp, against the path tracer");
  for (const int cells : {4, 8})
  {
    const Solved solved(BeamRoom(0.7, cells), 0.03);
    const ReferenceIntegrator reference(*solved.TheScene);
    for (const double z : {2.2, 1.2})
    {
      for (const double x : {2.8, 2.6, 2.4})
      {
        const Ray ray{{x, 0.01, z}, {0, 1, 0}};
        const RayLight light = solved.Trace(ray);
        const Estimate expected = reference.Veil(ray, 100000, 1);
        report::Relative("cells of 1/" + std::to_string(cells) + " m, " +
                           std::to_string(3.0 - x).substr(0, 3) + " m aside, z " +
                           std::to_string(z).substr(0, 3),
          expected.Mean, light.Veil(), 0.04,
          std::hypot(expected.StandardError, StandardError(light.VeilMultiple)));
      }
    }
  }
}

} // namespace
