// Conservation of energy and reciprocity.
#include "RandomScenes.h"
#include "ReferenceIntegrator.h"
#include "Sampler.h"
#include "SceneLibrary.h"
#include "Solved.h"
#include "TestReport.h"
#include "WorkCount.h"

#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

namespace
{

using namespace smokevis;

/// What is emitted is absorbed, to the promised 0.1 %, since both direct light and the rest are
/// scaled for that.
/// @param amiss what quadratures of direct light may miss, as a share
void CheckBalance(const std::string& name, const Solved& solved, double amiss)
{
  const double emitted = solved.TheScene->Lights().Flux(0);
  report::Relative(
    name, emitted, solved.AbsorbedInSmoke().Mean + solved.AbsorbedOnSurfaces().Mean, 1e-3);
  report::Relative("  before it was made up for", emitted, solved.PowerBeforeBalance(), amiss);
}

void CheckRoom(const std::string& name, double albedo, double extinction)
{
  CheckBalance(name, Solved(scenes::FurnishedRoom(albedo, extinction)), 1e-3);
}

// Nothing leaves a closed room.
TEST(Balance, ClosedRoom)
{
  report::Head("Energy balance of a closed room [lm]");
  CheckRoom("no smoke", 0.0, 0.0);
  CheckRoom("extinction 0.5, albedo 0", 0.0, 0.5);
  CheckRoom("extinction 0.5, albedo 0.6", 0.6, 0.5);
  CheckRoom("extinction 2, albedo 0.9", 0.9, 2.0);
  CheckRoom("extinction 2, albedo 1", 1.0, 2.0);
}

/// A random room whose cells are so many times as thick, and up to e times more or less than that.
SceneDescription ThickNoise(int room, double factor)
{
  SceneDescription scene = scenes::MakeRandomRoom(room).Description;
  Pcg32 random(room, 4);
  for (float& extinction : scene.Grids.front().Extinction)
  {
    extinction *= static_cast<float>(factor * std::exp(2.0 * random.Uniform() - 1.0));
  }
  return scene;
}

// Rooms whose smoke differs from cell to cell by up to the mean, and by much more: quadratures of
// direct light over cells miss up to 0.7 % of it. Lights tell themselves what they leave around
// them where it is so uneven, and are held to their power.
TEST(Balance, SmokeLikeNoise)
{
  report::Head("Energy balance of closed rooms of smoke like noise [lm]");
  for (const int room : {13, 16, 18})
  {
    const std::string name = "random room " + std::to_string(room);
    CheckBalance(name, Solved(scenes::MakeRandomRoom(room).Description, 0.1), 0.01);
    for (const double factor : {4.0, 16.0})
    {
      CheckBalance(name + ", thicker by " + std::to_string(static_cast<int>(factor)),
        Solved(ThickNoise(room, factor), 0.1), 0.01);
    }
  }
}

/// A cloud in the open around a block and a lamp.
SceneDescription OpenCloud()
{
  SceneDescription scene;
  scene.Albedo = 0.8;
  const Vec3 upper(3, 2, 2);
  scene.Grids = {scenes::NoisySmoke(Vec3(0.0), upper, {15, 10, 10}, 0.3, 1.5, 6)};
  scenes::AddBlock(scene.Surfaces, {1.4, 0.8, 0.2}, {1.8, 1.4, 1.1}, 0.2, 0.4);
  scene.Emitters = {scenes::Plate({0.7, 1, 1.6}, {0, 0, -1}, {1, 0, 0}, 0.5, 0.5, 20.0, 0.3)};
  return scene;
}

// What the open takes is what a black box far around takes in: with it, what is emitted is absorbed
// in the smoke and on surfaces or escapes, to the promised 0.1 % and three errors of at most so
// much.
TEST(Balance, OpenCloud)
{
  report::Head("Energy balance of a cloud in the open [lm]");
  const Solved open(OpenCloud(), 0.005);
  SceneDescription boxed = OpenCloud();
  const std::size_t own = boxed.Surfaces.CellReflectance.size();
  scenes::AddRoom(boxed.Surfaces, Vec3(-7, -7, -7), Vec3(9, 9, 9), 1.0, 0.0);
  const Solved box(boxed, 0.005);
  std::vector<std::size_t> walls;
  for (std::size_t patch = own; patch < box.TheScene->SurfacePatches(); ++patch)
  {
    walls.push_back(patch);
  }
  const double area = static_cast<double>(walls.size()) * box.TheScene->PatchArea(walls.front());
  const Estimate onWalls = box.Illuminance(walls, 0);
  const Estimate smoke = open.AbsorbedInSmoke();
  const Estimate surfaces = open.AbsorbedOnSurfaces();
  const double error = std::hypot(
    smoke.StandardError, std::hypot(surfaces.StandardError, area * onWalls.StandardError));
  const double emitted = open.TheScene->Lights().Flux(0);
  EXPECT_LT(error, 1e-3 * emitted);
  EXPECT_GT(area * onWalls.Mean, 0.3 * emitted);
  report::Relative("cloud", emitted, smoke.Mean + surfaces.Mean + area * onWalls.Mean, 1e-3, error);
}

/// A room of bright walls in few patches, and a sign that leans over its floor.
/// @param height of the sign's centre [m]
SceneDescription LeaningSign(double height)
{
  SceneDescription scene;
  scene.Albedo = 0.6;
  const Vec3 upper(4.5, 3.6, 2.0);
  scene.Grids = {scenes::UniformSmoke(Vec3(0.0), upper, {9, 6, 5}, 0.01)};
  scenes::AddRoom(scene.Surfaces, Vec3(0.0), upper, 1.2, 0.95);
  scene.Emitters = scenes::Barcode(
    {1.6, 0.8, height}, {-0.67, -0.67, -0.32}, {-0.2, -0.2, 0.96}, 0.3, 0.5, 3, 6.0, 0, 0.1);
  return scene;
}

// What is gathered for a plate is the light of places right before it, where lines have the mean of
// a patch. It is taken off what lines carry elsewhere, also where a room has a leak: that below the
// sign's foot lets a twelfth of its light out. Where on a patch of 1.2 m the light is that it sends
// on, nothing tells: hence 1.5 %.
TEST(Balance, SignThatLeansOverALargePatch)
{
  report::Head("Mean fluence in a room with a sign that leans over its floor [lx]");
  for (const auto& [name, height] :
    {std::pair{"above the floor", 0.26}, std::pair{"its foot in the floor", 0.2}})
  {
    const Solved solved(LeaningSign(height));
    const Medium& smoke = solved.TheScene->Smoke();
    // Without those that the plate cuts, which have a value for each part.
    std::vector<std::int64_t> cells;
    for (std::size_t i = 0; i < smoke.Cells(); ++i)
    {
      if (const auto cell = static_cast<std::int64_t>(i); !smoke.Parts().Find(cell))
      {
        cells.push_back(cell);
      }
    }
    EXPECT_LT(cells.size(), smoke.Cells());
    const Estimate fluence = solved.Fluence(cells);
    const Estimate truth =
      ReferenceIntegrator(*solved.TheScene)
        .MeanFluence(
          [&](Pcg32& random)
          {
            const double number = random.Uniform() * static_cast<double>(cells.size());
            return PlaceIn(smoke.BoxOf(cells[static_cast<std::size_t>(number)]), random);
          },
          100000, 3);
    report::Relative(name, truth.Mean, fluence.Mean, 0.015,
      std::hypot(truth.StandardError, fluence.StandardError));
  }
}

/// Two squares in a room with smoke and a block half between them; one emits.
SceneDescription TwoSquares(bool firstEmits)
{
  SceneDescription scene;
  scene.Albedo = 0.7;
  const Vec3 upper(3, 2, 2);
  scene.Grids = {scenes::NoisySmoke(Vec3(0.0), upper, {15, 10, 10}, 0.3, 1.0, 4)};
  scenes::AddRoom(scene.Surfaces, Vec3(0.0), upper, 0.5, 0.4);
  scenes::AddBlock(scene.Surfaces, {1.4, 0.8, 0}, {1.6, 1.4, 1.1}, 0.5, 0.4);
  scene.Emitters = {
    scenes::Plate({0.5, 1, 1}, {1, 0, 0}, {0, 0, 1}, 0.6, 0.4, firstEmits ? 1.0 : 0.0, 0.0),
    scenes::Plate({2.5, 0.7, 1.2}, glm::normalize(Vec3(-1, 0.2, 0)), {0, 0, 1}, 0.3, 0.5,
      firstEmits ? 0.0 : 1.0, 0.0)};
  return scene;
}

// A lamp in a bubble of clear air, in white smoke up to black walls ten mean free paths away: light
// crosses the bubble many times before it is absorbed, and diffusion completes that. The light as a
// whole is scaled where its power is clearly not what is emitted, so that fluences are held to the
// path tracer, too: what they still lack is within the tolerance.
TEST(Balance, BubbleInWhiteSmoke)
{
  constexpr double tolerance = 0.03;
  constexpr int cells = 40;
  SceneDescription scene;
  scene.Albedo = 1.0;
  SmokeGrid grid = scenes::UniformSmoke(Vec3(-1.0), Vec3(1.0), {cells, cells, cells}, 14.0);
  const auto isInside = [](int i) { return std::abs(2 * i + 1 - cells) < 0.3 * cells; };
  for (int i = 0; i < cells * cells * cells; ++i)
  {
    if (isInside(i % cells) && isInside(i / cells % cells) && isInside(i / (cells * cells)))
    {
      grid.Extinction[i] = 0.0F;
    }
  }
  scene.Grids = {grid};
  scenes::AddRoom(scene.Surfaces, Vec3(-1.0), Vec3(1.0), 0.5, 0.0);
  scene.Emitters = {scenes::Plate({0, 0, 0.02}, {0, 0, -1}, {1, 0, 0}, 0.1, 0.1, 100.0)};
  const Solved solved(scene, tolerance);
  EXPECT_GT(WorkCount(solved.Field->Report, "blocks of diffusion"), 0.0);
  report::Head("Energy balance of a lamp in a bubble [lm]");
  const Estimate absorbed = solved.AbsorbedOnSurfaces();
  report::Relative("absorbed by walls", solved.TheScene->Lights().Flux(0), absorbed.Mean, tolerance,
    absorbed.StandardError);
  const ReferenceIntegrator reference(*solved.TheScene);
  report::Head("Fluence in layers below the bubble [lx]");
  for (const int layer : {10, 5})
  {
    std::vector<std::int64_t> inside;
    for (int i = cells / 4; i < 3 * cells / 4; ++i)
    {
      for (int j = cells / 4; j < 3 * cells / 4; ++j)
      {
        inside.push_back((static_cast<std::int64_t>(layer) * cells + j) * cells + i);
      }
    }
    const Estimate expected = reference.MeanFluence(
      [&](Pcg32& random)
      {
        const Vec3 share(random.Uniform(), random.Uniform(), random.Uniform());
        return Vec3(-0.5, -0.5, -1.0 + 2.0 * layer / cells) + share * Vec3(1, 1, 2.0 / cells);
      },
      20000, 1);
    const Estimate found = solved.Fluence(inside);
    report::Relative("layer " + std::to_string(layer), expected.Mean, found.Mean, tolerance,
      std::hypot(expected.StandardError, found.StandardError));
  }
}

// Black smoke in thick cells, below clear air and a lamp: ways into the topmost cells differ by the
// smoke beside those, not by their lengths alone. What is left are differences within the cells
// that Gauss points miss, and patches of a metre that the smoke's light falls off on.
TEST(Balance, ThickCellsBehindClearAir)
{
  report::Head("Energy balance of a lamp above a layer of thick cells [lm]");
  for (const double depth : {0.5, 1.0, 2.0, 3.0})
  {
    for (const double place : {2.0, 0.6})
    {
      SceneDescription scene;
      scene.Albedo = 0.0;
      SmokeGrid grid = scenes::UniformSmoke(Vec3(0.0), Vec3(4.0), {8, 8, 8}, 2.0 * depth);
      std::fill(grid.Extinction.begin() + grid.Extinction.size() / 2, grid.Extinction.end(), 0.0F);
      scene.Grids = {grid};
      scenes::AddRoom(scene.Surfaces, Vec3(0.0), Vec3(4.0), 1.0, 0.0);
      scene.Emitters = {scenes::Plate({place, 2, 3.99}, {0, 0, -1}, {1, 0, 0}, 0.3, 0.3, 100.0)};
      CheckBalance("depth of a cell " + std::to_string(depth).substr(0, 3) + ", lamp at " +
                     std::to_string(place).substr(0, 3),
        Solved(scene), 0.002 + 0.003 * depth);
    }
  }
}

// A lamp right before a wall whose patches are many times as wide as it is far lights little of
// them, and all of its light arrives. Triangles that repeat others of a patch change nothing.
TEST(Balance, LampRightBeforeALargePatch)
{
  report::Head("Direct light of lamps in a black room of few triangles [lm]");
  for (const double distance : {0.1, 0.01})
  {
    for (const double exponent : {0.0, 20.0})
    {
      for (const bool repeated : {false, true})
      {
        SceneDescription scene;
        scenes::AddRoom(scene.Surfaces, Vec3(0.0), Vec3(4, 3, 2.5), 4.0, 0.0);
        if (repeated)
        {
          const std::size_t floor = 8;
          scene.Surfaces.Triangles.push_back(scene.Surfaces.Triangles[floor]);
          scene.Surfaces.TriangleCell.push_back(scene.Surfaces.TriangleCell[floor]);
        }
        scene.Emitters = {
          scenes::Plate({1.3, 1.1, distance}, {0, 0, -1}, {1, 0, 0}, 0.1, 0.1, 100.0)};
        scene.Emitters[0].Exponent = exponent;
        CheckBalance(std::to_string(distance).substr(0, 4) + " m, cos^" +
                       std::to_string(static_cast<int>(exponent)) +
                       (repeated ? ", a triangle twice" : ""),
          Solved(scene), 0.01);
      }
    }
  }
}

/// Power that smoke takes up of a square lamp's light [lm]: the integral over the lamp and all
/// directions of 1 - exp(-depth), of the optical depth of all smoke on the way.
template <class Depth> double TakenOf(const EmitterCell& lamp, int directions, const Depth& depth)
{
  constexpr int Places = 6;
  const Vec3 along = lamp.Vertices[1] - lamp.Vertices[0];
  const Vec3 up = lamp.Vertices[3] - lamp.Vertices[0];
  const Vec3 first = glm::normalize(along);
  const Vec3 second = glm::normalize(up);
  const Vec3 normal = glm::cross(first, second);
  double sum = 0.0;
  for (int place = 0; place < Places * Places; ++place)
  {
    const Vec3 origin = lamp.Vertices[0] + (place % Places + 0.5) / Places * along +
                        (place / Places + 0.5) / Places * up;
    for (int i = 0; i < directions; ++i)
    {
      // Rings of equal power.
      const double sine = std::sqrt((i + 0.5) / directions);
      for (int j = 0; j < directions; ++j)
      {
        const double angle = 2.0 * std::numbers::pi * (j + 0.5) / directions;
        const Vec3 direction = sine * (std::cos(angle) * first + std::sin(angle) * second) +
                               std::sqrt(1.0 - sine * sine) * normal;
        sum -= std::expm1(-depth(origin, direction));
      }
    }
  }
  const double power = std::numbers::pi * lamp.Luminance[0] * glm::length(along) * glm::length(up);
  return power * sum / (Places * Places * directions * directions);
}

/// The same of a uniform cube of smoke.
double TakenByCube(const EmitterCell& lamp, double extinction, const Box& cube)
{
  return TakenOf(lamp, 240,
    [&](const Vec3& origin, const Vec3& direction)
    {
      double begin = 0.0;
      double end = 1e3;
      return cube.Clip(origin, 1.0 / direction, begin, end) ? extinction * (end - begin) : 0.0;
    });
}

/// A cube of uniform smoke of 16 cells an edge in clear air.
/// @param depth optical depth of a cell
SceneDescription CloudInClearAir(double depth)
{
  constexpr int Cells = 16;
  constexpr double Edge = 1.0 / Cells;
  SceneDescription scene;
  scene.Albedo = 0.0;
  SmokeGrid grid = scenes::UniformSmoke(
    Vec3(-Edge), Vec3(1.0 + Edge), {Cells + 2, Cells + 2, Cells + 2}, depth / Edge);
  for (std::size_t i = 0; i < grid.Extinction.size(); ++i)
  {
    const auto inside = [](std::size_t place) { return place > 0 && place <= Cells; };
    constexpr std::size_t row = Cells + 2;
    grid.Extinction[i] *=
      inside(i % row) && inside(i / row % row) && inside(i / (row * row)) ? 1.0F : 0.0F;
  }
  scene.Grids = {grid};
  return scene;
}

/// Power that the smoke takes up of the direct light in one band, were its albedo 0 [lm].
double TakenDirectly(const Solved& solved, int band)
{
  const Medium& smoke = solved.TheScene->Smoke();
  double taken = 0.0;
  for (std::size_t i = 0; i < smoke.Cells(); ++i)
  {
    const auto cell = static_cast<std::int64_t>(i);
    taken += smoke.Extinction(cell) * solved.TheScene->ExtinctionScale(band) *
             smoke.CellVolume(cell) *
             solved.Field->DirectFluence[solved.Field->CellIndex(band, cell)];
  }
  return taken;
}

constexpr Box UnitCube{Vec3(0.0), Vec3(1.0)};

// Light that comes into smoke aslant gets dark faster behind its border than the cells are deep, in
// bands of more and of less extinction, too, and where it hardly gets into the first cell.
TEST(Balance, LampAsideOfACloud)
{
  report::Head("Direct light of a lamp aside of a cloud in clear air, taken up there [lm]");
  for (const auto& [name, centre, normal] :
    {std::tuple{"above", Vec3(0.5, 0.5, 2.0), Vec3(0, 0, -1)},
      {"aside", Vec3(-0.15, 0.5, 1.15), Vec3(0, 0, -1)},
      {"grazing", Vec3(-0.5, 0.5, 1.06), Vec3(1, 0, 0)},
      {"askew", Vec3(-1.0, -0.7, 1.6), Vec3(0.6, 0.4, -0.69)}})
  {
    for (const double depth : {0.0625, 0.25, 0.625, 20.0})
    {
      SceneDescription scene = CloudInClearAir(depth);
      scene.Bands = 3;
      scene.ExtinctionScale = {1.0, 3.0, 0.3};
      scene.Emitters = {scenes::Plate(centre, glm::normalize(normal), {0, 1, 0}, 0.1, 0.1, 100.0)};
      const Solved solved(scene);
      for (int band = 0; band < scene.Bands; ++band)
      {
        const double scale = scene.ExtinctionScale[band];
        report::Relative(
          std::string(name) + ", depth of a cell " + std::to_string(depth * scale).substr(0, 5),
          TakenByCube(scene.Emitters[0], 16.0 * depth * scale, UnitCube),
          TakenDirectly(solved, band), 0.01);
      }
    }
  }
}

// Cells of a tenth to nearly twice the mean extinction: what ways to neighbours tell of a cell is
// rough there, and each cell takes what is beside it for smoother than it is.
TEST(Balance, LampAsideOfANoisyCloud)
{
  report::Head("The same of a cloud whose cells differ by their own extinction [lm]");
  for (const double depth : {0.25, 1.0, 2.0})
  {
    SceneDescription scene = CloudInClearAir(depth);
    Pcg32 random(3, 1);
    for (float& extinction : scene.Grids[0].Extinction)
    {
      extinction *= static_cast<float>(0.1 + 1.8 * random.Uniform());
    }
    scene.Emitters = {scenes::Plate({-0.15, 0.5, 1.15}, {0, 0, -1}, {0, 1, 0}, 0.1, 0.1, 100.0)};
    const Solved solved(scene);
    report::Relative("mean depth of a cell " + std::to_string(depth).substr(0, 4),
      TakenOf(scene.Emitters[0], 120,
        [&](const Vec3& origin, const Vec3& direction)
        { return solved.TheScene->Smoke().OpticalDepth(origin, direction, 0.0, 10.0); }),
      TakenDirectly(solved, 0), 0.03);
  }
}

// The border of the smoke crosses the plate: from one of its halves light has to get out of the
// smoke first, and ways from its middle tell of neither.
TEST(Balance, LampHalfInACloud)
{
  report::Head("Direct light of a lamp that the border of a cloud crosses, taken up there [lm]");
  for (const auto& [name, centre, normal] :
    {std::tuple{"along the border", Vec3(0.4, 0.5, 1.0), Vec3(1, 0, 0)},
      {"a quarter outside", Vec3(0.4, 0.5, 0.9), Vec3(1, 0, 0)},
      {"askew", Vec3(0.5, 0.5, 1.0), Vec3(0.6, 0.5, -0.3)}})
  {
    for (const double depth : {0.0625, 0.25, 1.0, 4.0})
    {
      SceneDescription scene = CloudInClearAir(depth);
      scene.Emitters = {scenes::Plate(centre, glm::normalize(normal), {0, 0, 1}, 0.3, 0.3, 100.0)};
      const Solved solved(scene);
      report::Relative(
        std::string(name) + ", depth of a cell " + std::to_string(depth).substr(0, 5),
        TakenByCube(scene.Emitters[0], 16.0 * depth, UnitCube), TakenDirectly(solved, 0), 0.02);
    }
  }
}

// Light exchanged by two patches is the same either way: area times illuminance for one luminance.
TEST(Balance, ReciprocityOfTwoPatches)
{
  report::Head("Reciprocity of two plates through smoke and reflections");
  const auto exchange = [](const Solved& solved, std::size_t patch)
  {
    return solved.TheScene->PatchArea(patch) *
           solved.Field->DirectIlluminance[solved.Field->PatchIndex(0, patch, 0)];
  };
  const Solved there(TwoSquares(true));
  const Solved back(TwoSquares(false));
  const std::size_t first = there.TheScene->SurfacePatches();
  const std::size_t second = first + 1;
  const double areaOfFirst = there.TheScene->PatchArea(first);
  const double areaOfSecond = there.TheScene->PatchArea(second);
  // Both sides are quadratures over partly hidden plates, refined to a few permille.
  SceneDescription clearThere = TwoSquares(true);
  SceneDescription clearBack = TwoSquares(false);
  clearThere.Grids.clear();
  clearBack.Grids.clear();
  report::Relative("direct, without smoke", exchange(Solved(clearBack), first),
    exchange(Solved(clearThere), second), 0.01);
  // Cells of smoke differ by their own value: for what is seen of a partly hidden light stands the
  // way to its middle.
  report::Relative("direct", exchange(back, first), exchange(there, second), 0.02);
  const Estimate forth = there.Illuminance({second}, 0);
  const Estimate home = back.Illuminance({first}, 0);
  report::Relative("in all", areaOfFirst * home.Mean, areaOfSecond * forth.Mean, 0.01,
    std::hypot(areaOfFirst * home.StandardError, areaOfSecond * forth.StandardError));
}

} // namespace
