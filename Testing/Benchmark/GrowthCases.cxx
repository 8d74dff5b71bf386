// How time grows with the size of a scene, and what a step along a ray costs.
#include "BenchmarkCases.h"

#include "ReferenceIntegrator.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace smokevis::benchmark
{

namespace
{

constexpr double GrowthTolerance = 0.03;
const Vec3 RoomSize(8.0, 4.0, 3.0);

/// What a growth curve varies.
struct Room
{
  double Cells = 1e4;
  int Lamps = 1;
  double Triangles = 1e3;
  /// Over the room's length.
  double OpticalDepth = 4.0;
  double Albedo = 0.8;
};

/// A closed room of 8 x 4 x 3 m with a sign on its end wall and lamps under its ceiling.
SceneDescription Describe(const Room& room)
{
  SceneDescription scene;
  scene.Albedo = room.Albedo;
  const double edge = std::cbrt(RoomSize.x * RoomSize.y * RoomSize.z / room.Cells);
  std::array<int, 3> cells{};
  for (int axis = 0; axis < 3; ++axis)
  {
    cells[axis] = std::max(1, static_cast<int>(std::lround(RoomSize[axis] / edge)));
  }
  const double extinction = room.OpticalDepth / RoomSize.x;
  scene.Grids = {
    scenes::NoisySmoke(Vec3(0.0), RoomSize, cells, 0.5 * extinction, 1.5 * extinction, 1)};
  const double area =
    2.0 * (RoomSize.x * RoomSize.y + RoomSize.y * RoomSize.z + RoomSize.z * RoomSize.x);
  scenes::AddRoom(scene.Surfaces, Vec3(0.0), RoomSize, std::sqrt(2.0 * area / room.Triangles), 0.4);
  scene.Emitters = scenes::Barcode({8.0, 2.0, 2.0}, {-1, 0, 0}, {0, 0, 1}, 0.6, 0.3, 9, 300.0, 0);
  const int rows = std::max(1, static_cast<int>(std::sqrt(0.5 * room.Lamps)));
  for (int lamp = 0; lamp < room.Lamps; ++lamp)
  {
    const int columns = (room.Lamps + rows - 1) / rows;
    const Vec3 centre(RoomSize.x * (lamp / rows + 0.5) / columns,
      RoomSize.y * (lamp % rows + 0.5) / rows, RoomSize.z - 0.02);
    const double size = std::min(0.2, 0.5 * RoomSize.y / rows);
    scene.Emitters.push_back(
      scenes::Plate(centre, {0, 0, -1}, {1, 0, 0}, size, size, 100.0 / room.Lamps));
  }
  return scene;
}

/// Mean time of a measurement of the sign from places all over the room [s].
double ViewSeconds(const Solution& solution, int views, int threads)
{
  const StopWatch watch;
  ForAll(static_cast<std::size_t>(views), threads,
    [&](std::size_t view)
    {
      Pcg32 random(view, 1);
      const double x = 0.1 + 0.7 * random.Uniform();
      const double y = 0.1 + 0.8 * random.Uniform();
      MeasureSign(
        *solution.TheView, 0, RoomSize * Vec3(x, y, 0.2 + 0.6 * random.Uniform()), Observer{});
    });
  return watch.Seconds() / views;
}

} // namespace

//--------------------------------------------------------------------------------------------------
void RunGrowth(const Settings& settings)
{
  ResultTable table(settings.Out + "/growth.csv",
    {"curve", "value", "setup_s", "field_s", "field_processor_s", "view_s", "peak_MiB"});
  const auto curve = [&](const std::string& name, const std::vector<double>& values,
                       const std::function<void(Room&, double)>& set)
  {
    for (const double value : values)
    {
      Room room;
      set(room, value);
      const Solution solution = Solve(Describe(room), GrowthTolerance, 1, settings.Threads);
      table.Row({name, Number(value), Number(solution.SetUpSeconds), Number(solution.FieldSeconds),
        Number(solution.FieldProcessors), Number(ViewSeconds(solution, 20, settings.Threads)),
        Number(PeakMemory())});
      if (solution.SetUpProcessors + solution.FieldProcessors > settings.Limit)
      {
        break;
      }
    }
  };
  curve(
    "smoke cells", {1e3, 1e4, 1e5, 1e6, 1e7}, [](Room& room, double value) { room.Cells = value; });
  curve("emitters", {1, 10, 100, 1000},
    [](Room& room, double value) { room.Lamps = static_cast<int>(value); });
  curve("triangles", {1e2, 1e3, 1e4, 1e5, 1e6},
    [](Room& room, double value) { room.Triangles = value; });
  curve("optical depth", {0.1, 0.3, 1, 3, 10, 30, 100},
    [](Room& room, double value) { room.OpticalDepth = value; });
  curve("albedo", {0.0, 0.3, 0.6, 0.9, 0.99, 1.0},
    [](Room& room, double value) { room.Albedo = value; });
  const Solution solution = Solve(Describe(Room()), GrowthTolerance, 1, settings.Threads);
  for (const int views : {1, 10, 100, 1000})
  {
    const double seconds = views * ViewSeconds(solution, views, settings.Threads);
    table.Row({"views", Number(views), Number(solution.SetUpSeconds), Number(solution.FieldSeconds),
      Number(solution.FieldProcessors), Number(seconds), Number(PeakMemory())});
    if (seconds > settings.Limit)
    {
      break;
    }
  }
}

//--------------------------------------------------------------------------------------------------
void RunThreads(const Settings& settings)
{
  ResultTable table(
    settings.Out + "/threads.csv", {"part", "one_thread_s", "two_threads_s", "ratio"});
  const SceneDescription scene = Hall(settings.Time);
  constexpr double Infinity = std::numeric_limits<double>::infinity();
  std::array<double, 2> field{Infinity, Infinity};
  std::array<double, 2> map{Infinity, Infinity};
  // By turns; the shortest of each counts.
  constexpr int Turns = 3;
  for (int turn = 0; turn < Turns; ++turn)
  {
    for (const int threads : {1, 2})
    {
      const auto which = static_cast<std::size_t>(threads - 1);
      const Solution solution = Solve(scene, 0.01, 1, threads);
      field[which] = std::min(field[which], solution.FieldSeconds);
      Progress progress;
      const StopWatch watch;
      ComputeFloorMap(*solution.TheView, HallPlaces(12, 8, threads), progress);
      map[which] = std::min(map[which], watch.Seconds());
    }
  }
  table.Row({"hall light field", Number(field[0]), Number(field[1]), Number(field[0] / field[1])});
  table.Row({"hall map 12 x 8", Number(map[0]), Number(map[1]), Number(map[0] / map[1])});
}

//--------------------------------------------------------------------------------------------------
void RunSteps(const Settings& settings)
{
  ResultTable table(
    settings.Out + "/steps.csv", {"what", "rays", "cells_a_ray", "ns_a_ray", "ns_a_cell"});
  const Solution solution = Solve(Hall(settings.Time), 0.1, 1, settings.Threads);
  const Medium& smoke = solution.TheScene->Smoke();
  constexpr int Rays = 20000;
  constexpr double Far = std::numeric_limits<double>::infinity();
  // From all over the hall towards its signs, as maps do.
  std::vector<Ray> rays;
  std::vector<double> ends;
  Pcg32 random(1, 1);
  const auto& signs = solution.TheScene->Lights().Signs();
  for (int i = 0; i < Rays; ++i)
  {
    const double x = 55.0 * random.Uniform();
    const Vec3 eye(x, 35.0 * random.Uniform(), 1.7);
    const Vec3 towards = signs[static_cast<std::size_t>(i) % signs.size()].Centre - eye;
    rays.push_back({eye, glm::normalize(towards)});
    ends.push_back(std::min(
      solution.TheView->FirstHit(eye, rays.back().Direction).Distance, glm::length(towards)));
  }
  double sum = 0.0;
  const auto crossed = [&](const Medium& medium)
  {
    double cells = 0.0;
    std::vector<Segment> pieces;
    for (int i = 0; i < Rays; ++i)
    {
      medium.Walk(rays[i].Origin, rays[i].Direction, 0.0, ends[i], pieces);
      cells += static_cast<double>(pieces.size());
    }
    return cells;
  };
  const auto measure = [&](const std::string& name, double cells, const auto& work)
  {
    const StopWatch watch;
    for (int i = 0; i < Rays; ++i)
    {
      sum += work(rays[i], ends[i]);
    }
    const double nanoseconds = 1e9 * watch.Processors();
    table.Row({name, Number(Rays), Number(cells / Rays), Number(nanoseconds / Rays),
      Number(nanoseconds / cells)});
  };
  const double cells = crossed(smoke);
  measure("optical depth", cells,
    [&](const Ray& ray, double end)
    { return smoke.OpticalDepth(ray.Origin, ray.Direction, 0.0, end); });
  // The same rays through cells of a fifth of the length: what memory makes of a step.
  const Medium fine(FineHall(settings.Time).Grids);
  measure("optical depth in ten million cells", crossed(fine),
    [&](const Ray& ray, double end)
    { return fine.OpticalDepth(ray.Origin, ray.Direction, 0.0, end); });
  measure("first hit", cells,
    [&](const Ray& ray, double)
    { return solution.TheView->FirstHit(ray.Origin, ray.Direction, Far).Distance; });
  // The first rays fill the lattices around the signs.
  for (const char* name : {"luminance of a ray on one thread", "the same with full lattices"})
  {
    measure(name, cells,
      [&](const Ray& ray, double end)
      { return solution.TheView->TraceVeil(ray.Origin, ray.Direction, 0.0, end, 0).Veil(); });
  }
  if (!std::isfinite(sum))
  {
    std::fprintf(stderr, "a ray gave no finite number\n");
  }
}

} // namespace smokevis::benchmark
