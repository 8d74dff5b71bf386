// What refining thick smoke costs, and what it makes of the error.
#include "BenchmarkCases.h"

#include "Contrast.h"
#include "GridRefinement.h"

#include <algorithm>
#include <cmath>

namespace smokevis::benchmark
{

namespace
{

/// A scene on cells of any size, and where to look at its sign 0 from.
struct ThickScene
{
  std::string Name;
  double Extinction = 0.0;
  /// Edges of the cells that it comes in [m].
  double Edge = 0.0;
  std::function<SceneDescription(double)> Make;
  std::vector<Vec3> Eyes;
};

SmokeGrid Smoke(const Vec3& size, double edge, double extinction)
{
  std::array<int, 3> cells;
  for (int axis = 0; axis < 3; ++axis)
  {
    cells[axis] = static_cast<int>(std::lround(size[axis] / edge));
  }
  return scenes::UniformSmoke(Vec3(0.0), size, cells, extinction);
}

ThickScene Duct(double edge)
{
  constexpr double Extinction = 4.25;
  const auto make = [](double cell)
  {
    SceneDescription scene = scenes::Tunnel(Extinction, 0.99);
    scene.Grids = {Smoke({4, 1, 1}, cell, Extinction)};
    return scene;
  };
  return {"duct of white smoke and 17 mean free paths", Extinction, edge, make,
    {scenes::TunnelEye, {1.0, 0.5, 0.5}, {2.0, 0.5, 0.5}}};
}

ThickScene Room(const std::string& what, double extinction, double albedo)
{
  const auto make = [extinction, albedo](double cell)
  {
    const Vec3 size(10, 8, 3);
    SceneDescription scene;
    scene.Albedo = albedo;
    scene.Grids = {Smoke(size, cell, extinction)};
    scenes::AddRoom(scene.Surfaces, Vec3(0.0), size, 1.0, 0.5);
    scene.Emitters = scenes::Barcode({10, 4, 2}, {-1, 0, 0}, {0, 0, 1}, 0.6, 0.3, 5, 200.0, 0, 0.2);
    scene.Emitters.push_back(
      scenes::Plate({5.0, 4.0, 2.99}, {0, 0, -1}, {1, 0, 0}, 0.6, 0.6, 1000.0, 0.5));
    return scene;
  };
  return {
    "room of " + what, extinction, 0.5, make, {{9.3, 4.2, 1.7}, {8.8, 3.0, 1.7}, {8.2, 4.0, 1.7}}};
}

struct Looks
{
  std::vector<SignMeasurement> Signs;
  double Seconds = 0.0;
};

Looks Look(const SceneDescription& description, const std::vector<Vec3>& eyes, double tolerance,
  std::uint64_t seed, int threads)
{
  Looks looks;
  const StopWatch watch;
  const Solution solution = Solve(description, tolerance, seed, threads);
  for (const Vec3& eye : eyes)
  {
    looks.Signs.push_back(MeasureSign(*solution.TheView, 0, eye, Observer{0.0}));
  }
  looks.Seconds = watch.Processors();
  return looks;
}

} // namespace

void RunThick(const Settings& settings)
{
  /// Cells of the reference [mean free paths].
  constexpr double ReferenceDepth = 0.3;
  ResultTable table(settings.Out + "/thick.csv",
    {"scene", "mean_free_paths_a_cell", "tolerance", "refined", "seeds", "cells", "processor_s",
      "dark_bar_error", "contrast_error"});
  for (const ThickScene& scene : {Duct(1.0), Duct(0.5), Duct(0.25),
         Room("white smoke (albedo 0.9)", 3.0, 0.9), Room("soot (albedo 0.3)", 6.0, 0.3)})
  {
    const double fine = scene.Edge / std::ceil(scene.Edge * scene.Extinction / ReferenceDepth);
    const Looks reference = Look(scene.Make(fine), scene.Eyes, settings.ReferenceTolerance,
      settings.Seeds + 1, settings.Threads);
    for (const double tolerance : settings.Tolerances)
    {
      for (const bool refined : {false, true})
      {
        SceneDescription description = scene.Make(scene.Edge);
        if (refined)
        {
          Refine(description.Grids, FindThickSmoke(description, 500000, tolerance).Refinements);
        }
        double seconds = 0.0;
        double dark = 0.0;
        double contrast = 0.0;
        const int values = settings.Seeds * static_cast<int>(scene.Eyes.size());
        for (int seed = 1; seed <= settings.Seeds; ++seed)
        {
          const Looks looks = Look(
            description, scene.Eyes, tolerance, static_cast<std::uint64_t>(seed), settings.Threads);
          seconds += looks.Seconds / settings.Seeds;
          for (std::size_t eye = 0; eye < scene.Eyes.size(); ++eye)
          {
            const SignMeasurement& right = reference.Signs[eye];
            const SignMeasurement& sign = looks.Signs[eye];
            AddToRootMeanSquare(sign.UnlitLuminance / right.UnlitLuminance - 1.0, values, dark);
            AddToRootMeanSquare(sign.Contrast - right.Contrast, values, contrast);
          }
        }
        table.Row({scene.Name, Number(scene.Edge * scene.Extinction), Number(tolerance),
          refined ? "yes" : "no", Number(settings.Seeds),
          Number(static_cast<double>(description.Grids.front().Extinction.size())), Number(seconds),
          Number(dark), Number(contrast)});
      }
    }
  }
}

} // namespace smokevis::benchmark
