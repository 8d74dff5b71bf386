#include "BenchmarkCases.h"

#include "ExtinctionSource.h"
#include "FlameLight.h"
#include "FlameSource.h"
#include "Places.h"
#include "SolidCells.h"
#include "SrgbColor.h"
#include "WallBuilder.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace smokevis::benchmark
{

namespace
{

const std::string HallFolder = std::string(SMOKEVIS_DATA_DIR) + "/Hall";
/// Largest patch of the hall's walls [m].
constexpr double HallPatch = 2.0;
/// Of the fire, as the reader has it where nothing else is asked for [lm/W].
constexpr double FlamesEfficacy = 0.05;

Vec3 ToVec3(const std::array<double, 3>& point)
{
  return {point[0], point[1], point[2]};
}

void AddWalls(const SmvFile& index, double time, SurfaceMesh& mesh)
{
  WallBuilder builder(index, time, 0.5);
  for (const WallQuad& quad : builder.Build())
  {
    const auto corners = quad.Corners();
    const Vec3 corner = ToVec3(corners[0]);
    const Vec3 u = ToVec3(corners[1]) - corner;
    const Vec3 v = ToVec3(corners[3]) - corner;
    const std::size_t first = scenes::AddRectangle(mesh, corner, u, v,
      std::max(1, static_cast<int>(std::ceil(glm::length(u) / HallPatch))),
      std::max(1, static_cast<int>(std::ceil(glm::length(v) / HallPatch))), 0.0);
    Spectrum reflectance;
    std::transform(builder.Materials()[quad.Material].Color.begin(),
      builder.Materials()[quad.Material].Color.end(), reflectance.begin(), LinearFromSrgb);
    std::fill(mesh.CellReflectance.begin() + static_cast<std::ptrdiff_t>(first),
      mesh.CellReflectance.end(), Spectrum{Luminance(reflectance, 3), 0.0, 0.0});
  }
}

/// Signs of the hall's table: id, name, centre, normal, width, height, pattern, bars, luminance.
void AddSigns(std::vector<EmitterCell>& emitters)
{
  const std::string path = HallFolder + "/signs.csv";
  std::ifstream file(path);
  std::string line;
  while (std::getline(file, line))
  {
    if (line.empty() || line[0] == '#' || line.rfind("id,", 0) == 0)
    {
      continue;
    }
    std::vector<std::string> cells;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');)
    {
      cells.push_back(cell);
    }
    const auto number = [&cells](std::size_t column) { return std::stod(cells.at(column)); };
    const auto sign = scenes::Barcode({number(2), number(3), number(4)},
      {number(5), number(6), number(7)}, {0, 0, 1}, number(8), number(9),
      static_cast<int>(number(11)), number(12), static_cast<int>(number(0)));
    emitters.insert(emitters.end(), sign.begin(), sign.end());
  }
  if (emitters.empty())
  {
    throw std::runtime_error("no signs in " + path);
  }
}

} // namespace

//--------------------------------------------------------------------------------------------------
SceneDescription Hall(double time)
{
  const SmvFile index(HallFolder + "/fds/hall.smv");
  ExtinctionSource source(index, SmokeOptions{});
  SceneDescription scene;
  scene.Albedo = index.Albedo.value_or(0.3);
  for (std::size_t mesh = 0; mesh < index.Meshes.size(); ++mesh)
  {
    SmokeGrid grid;
    grid.Name = index.Meshes[mesh].Name;
    grid.Nodes = index.Meshes[mesh].Nodes;
    std::size_t cells = 1;
    for (int axis = 0; axis < 3; ++axis)
    {
      cells *= static_cast<std::size_t>(index.Meshes[mesh].Cells(axis));
    }
    grid.Extinction.resize(cells);
    const int number = static_cast<int>(mesh);
    const auto solid =
      SolidCells(index.Meshes[mesh], PresentObstructions(index, number, time, 0.0));
    source.Read(number, time, TimeInterpolation::Nearest, solid, grid.Extinction);
    scene.Grids.push_back(std::move(grid));
  }
  AddWalls(index, time, scene.Surfaces);
  AddSigns(scene.Emitters);
  return scene;
}

//--------------------------------------------------------------------------------------------------
SceneDescription BurningHall(double time)
{
  SceneDescription scene = Hall(time);
  const SmvFile index(HallFolder + "/fds/hall.smv");
  FlameSource flames(index, FlameModel::LuminousEfficacy);
  for (std::size_t mesh = 0; mesh < index.Meshes.size(); ++mesh)
  {
    SmokeGrid& grid = scene.Grids[mesh];
    const int number = static_cast<int>(mesh);
    const auto solid =
      SolidCells(index.Meshes[mesh], PresentObstructions(index, number, time, 0.0));
    std::vector<float> heatRelease(grid.Extinction.size());
    flames.Read(number, time, TimeInterpolation::Nearest, solid, heatRelease);
    grid.EmittedLuminance.resize(grid.Extinction.size());
    SpreadFlameLight(index.Meshes[mesh], heatRelease, grid.Extinction, scene.Albedo, FlamesEfficacy,
      grid.EmittedLuminance);
  }
  return scene;
}

//--------------------------------------------------------------------------------------------------
SceneDescription FineHall(double time)
{
  SceneDescription scene = Hall(time);
  const Medium coarse(scene.Grids);
  // 10.02 million cells of 0.098 x 0.098 x 0.1 m inside the hall, each with the smoke at its
  // centre.
  SmokeGrid fine = scenes::UniformSmoke(Vec3(0.0), {55, 35, 5}, {560, 358, 50}, 0.0);
  tbb::parallel_for(0, 50,
    [&](int k)
    {
      std::size_t cell = static_cast<std::size_t>(k) * 560 * 358;
      for (int j = 0; j < 358; ++j)
      {
        for (int i = 0; i < 560; ++i, ++cell)
        {
          const Vec3 centre(55.0 * (i + 0.5) / 560, 35.0 * (j + 0.5) / 358, 0.1 * (k + 0.5));
          const std::int64_t there = coarse.Locate(centre);
          fine.Extinction[cell] = there < 0 ? 0.0F : coarse.Extinction(there);
        }
      }
    });
  scene.Grids = {std::move(fine)};
  return scene;
}

//--------------------------------------------------------------------------------------------------
FloorMapOptions HallPlaces(int across, int along, int threads)
{
  FloorMapOptions options;
  options.PlacesX = across;
  options.PlacesY = along;
  options.StepX = 55.0 / across;
  options.StepY = 35.0 / along;
  options.FirstPlace = {0.5 * options.StepX, 0.5 * options.StepY, 1.7};
  // The reference integrator resolves all detail, too.
  options.Eye.Acuity = 0.0;
  options.Threads = threads;
  return options;
}

//--------------------------------------------------------------------------------------------------
SceneDescription Office()
{
  SceneDescription scene;
  scene.Albedo = 0.6;
  const Vec3 size(5.0, 4.0, 3.0);
  SmokeGrid smoke = scenes::UniformSmoke(Vec3(0.0), size, {50, 40, 30}, 0.0);
  std::size_t cell = 0;
  ForEachPlace({50, 40, 30},
    [&](const std::array<int, 3>& place)
    {
      const Vec3 at = 0.1 * (Vec3(place[0], place[1], place[2]) + 0.5);
      const double layer = 1.6 + 0.1 * std::sin(2.0 * at.x) * std::cos(1.7 * at.y);
      const double share = 1.0 / (1.0 + std::exp((layer - at.z) / 0.15));
      const double swirls = 1.0 + 0.15 * std::sin(3.0 * at.x + 1.0) * std::sin(2.3 * at.y + at.z);
      smoke.Extinction[cell++] = static_cast<float>(0.05 + 0.8 * share * swirls);
    });
  scene.Grids.push_back(std::move(smoke));
  scenes::AddRoom(scene.Surfaces, Vec3(0.0), size, 0.5, 0.5);
  // A table, two cupboards and a beam.
  scenes::AddBlock(scene.Surfaces, {1.0, 1.0, 0.0}, {2.2, 1.8, 0.8}, 0.4, 0.4);
  scenes::AddBlock(scene.Surfaces, {3.0, 2.5, 0.0}, {3.6, 3.6, 1.9}, 0.4, 0.4);
  scenes::AddBlock(scene.Surfaces, {0.0, 3.2, 0.0}, {1.0, 4.0, 2.0}, 0.4, 0.4);
  scenes::AddBlock(scene.Surfaces, {2.0, 0.0, 2.5}, {2.3, 4.0, 3.0}, 0.4, 0.4);
  for (const double x : {1.2, 3.8})
  {
    for (const double y : {1.2, 2.8})
    {
      scene.Emitters.push_back(
        scenes::Plate({x, y, 2.9}, {0, 0, -1}, {1, 0, 0}, 0.6, 0.6, 2000.0, 0.5));
    }
  }
  const auto sign = [&scene](const Vec3& centre, const Vec3& normal, int number)
  {
    const auto bars = scenes::Barcode(centre, normal, {0, 0, 1}, 0.4, 0.2, 9, 50.0, number, 0.1);
    scene.Emitters.insert(scene.Emitters.end(), bars.begin(), bars.end());
  };
  sign({2.5, 3.99, 2.2}, {0, -1, 0}, 0);
  sign({4.99, 2.0, 2.2}, {-1, 0, 0}, 1);
  return scene;
}

//--------------------------------------------------------------------------------------------------
FloorMapOptions OfficePlaces(int threads)
{
  FloorMapOptions options = HallPlaces(10, 8, threads);
  options.StepX = 0.5;
  options.StepY = 0.5;
  options.FirstPlace = {0.25, 0.25, 1.5};
  return options;
}

//--------------------------------------------------------------------------------------------------
Solution Solve(
  const SceneDescription& description, double tolerance, std::uint64_t seed, int threads)
{
  Solution solution;
  const StopWatch setUp;
  solution.TheScene = std::make_shared<const Scene>(description);
  solution.SetUpSeconds = setUp.Seconds();
  solution.SetUpProcessors = setUp.Processors();
  LightFieldOptions options;
  options.Tolerance = tolerance;
  options.Seed = seed;
  options.Threads = threads;
  Progress progress;
  const StopWatch watch;
  solution.Field =
    std::make_shared<const LightField>(SolveLightField(*solution.TheScene, options, progress));
  solution.TheView = std::make_unique<const View>(solution.TheScene, solution.Field);
  solution.FieldSeconds = watch.Seconds();
  solution.FieldProcessors = watch.Processors();
  return solution;
}

//--------------------------------------------------------------------------------------------------
ThreadLimit::ThreadLimit(int threads)
    : Limit_(tbb::global_control::max_allowed_parallelism,
        threads > 0
          ? static_cast<std::size_t>(threads)
          : tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism))
{
}

//--------------------------------------------------------------------------------------------------
void ForAll(std::size_t count, int threads, const std::function<void(std::size_t)>& body)
{
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  arena.execute([&] { tbb::parallel_for(std::size_t{0}, count, body); });
}

} // namespace smokevis::benchmark
