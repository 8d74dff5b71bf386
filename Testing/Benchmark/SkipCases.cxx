// What each thing that a scene does not need saves by being left out, and what that changes.
#include "BenchmarkCases.h"
#include "SkipComparison.h"

#include "Sampler.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace smokevis::benchmark
{

namespace
{

constexpr double SkipTolerance = 0.1;
/// Contrasts below this count as so large: nobody sees them.
constexpr double LeastContrast = 0.01;

LightField SolveWith(const Scene& scene, bool skips)
{
  LightFieldOptions options;
  options.Tolerance = SkipTolerance;
  options.Skips = skips;
  Progress progress;
  return SolveLightField(scene, options, progress);
}

/// Direct fluence of cells that hold smoke, which tells what was left out without noise.
Values Direct(const Scene& scene, const LightField& field)
{
  Values values;
  for (std::size_t i = 0; i < field.DirectFluence.size(); ++i)
  {
    const auto cell = static_cast<std::int64_t>(i % field.Cells);
    values.push_back(scene.Smoke().Extinction(cell) > 0.0F ? field.DirectFluence[i] : 0.0);
  }
  return values;
}

/// Sum of the multiply scattered fluence of a band.
Values Multiple(const LightField& field, int band)
{
  double sum = 0.0;
  for (std::size_t cell = 0; cell < field.Cells; ++cell)
  {
    sum += Mean(field.MultipleFluence[field.CellIndex(band, static_cast<std::int64_t>(cell))]);
  }
  return {sum};
}

/// A corridor with smoke that is thinnest on the floor, where it has half of the given extinction,
/// and thickest under the ceiling.
SceneDescription Corridor(double extinction, int lamps, double albedo, double reflectance)
{
  SceneDescription scene = scenes::Corridor(extinction, lamps, albedo, reflectance);
  std::vector<float>& values = scene.Grids[0].Extinction;
  for (std::size_t cell = 0; cell < values.size(); ++cell)
  {
    const std::size_t layer = cell / (120 * 8);
    values[cell] *= static_cast<float>(0.5 + static_cast<double>(layer) / 7.0);
  }
  return scene;
}

void SkipLight(ResultTable& table)
{
  const auto field = [&table](const std::string& skip, const std::string& name,
                       const SceneDescription& description, auto result)
  {
    const Scene scene(description);
    Compare(table, skip, name, [&](bool skips) { return result(scene, SolveWith(scene, skips)); });
  };
  // There is no switch for it: the same with an albedo that makes no difference but is followed,
  // both without the other skips.
  const Scene black(Corridor(0.3, 4, 0.0, 0.0));
  const Scene nearlyBlack(Corridor(0.3, 4, 1e-9, 0.0));
  Compare(table, "no scattering", "corridor of 60 m with black walls and soot of albedo 0",
    [&](bool skips)
    {
      const Scene& scene = skips ? black : nearlyBlack;
      return Direct(scene, SolveWith(scene, false));
    });
  field("ways told", "corridor of 60 m with one lamp", Corridor(0.1, 1, 0.0, 0.0), Direct);
  SceneDescription lamps = Corridor(1.0, 15, 0.0, 0.0);
  field("ways told and negligible lights", "corridor of 60 m with 15 lamps", lamps, Direct);
  std::fill(lamps.Grids[0].Extinction.begin(), lamps.Grids[0].Extinction.end(), 1.0F);
  field("ways told and negligible lights", "the same with even smoke", lamps, Direct);
  // Of multiply scattered light only the sum of all fluence is compared.
  SceneDescription thin = Corridor(1e-4, 15, 0.5, 0.0);
  field("multiple scattering below a bound", "corridor of 60 m with black walls and thin smoke",
    thin,
    [](const Scene&, const LightField& solved)
    {
      const Values direct(solved.DirectFluence.begin(), solved.DirectFluence.end());
      return Values{
        std::accumulate(direct.begin(), direct.end(), 0.0) + Multiple(solved, 0).front()};
    });
  SceneDescription grey = Corridor(0.3, 4, 0.5, 0.5);
  grey.Bands = 3;
  for (EmitterCell& cell : grey.Emitters)
  {
    cell.Luminance.fill(1000.0);
  }
  // Bands that are solved for themselves differ by their noise.
  field("equal bands", "corridor of 60 m with grey walls and three bands", grey,
    [](const Scene&, const LightField& solved) { return Multiple(solved, 2); });
}

/// Optical depths from eyes all over a scene to its lights, or the luminances of such rays.
Values Rays(const View& view, bool luminance)
{
  constexpr int Count = 4000;
  const Scene& scene = view.TheScene();
  const EvenPoints points(5);
  Values values;
  for (int ray = 0; ray < Count; ++ray)
  {
    const auto at = points.Point(ray);
    const Vec3 eye =
      scene.Lower() + Vec3(at[0], at[1], 0.4 * at[2]) * (scene.Upper() - scene.Lower());
    const EmitterSet& lights = scene.Lights();
    const Vec3 way = lights.CellCentre(ray % lights.Cells().size()) - eye;
    const double length = glm::length(way);
    values.push_back(luminance ? view.TraceVeil(eye, way / length, 0.0, length, 0).Veil()
                               : scene.Smoke().OpticalDepth(eye, way / length, 0.0, length));
  }
  return values;
}

void SkipClearAir(ResultTable& table, const Settings& settings)
{
  // Smoke under the ceiling, on cells of 0.3 m, and a fire that has just begun.
  SceneDescription layer = Corridor(0.3, 4, 0.5, 0.5);
  layer.Surfaces = {};
  scenes::AddRoom(layer.Surfaces, Vec3(0.0), {60, 20, 6}, 2.0, 0.5);
  layer.Grids = {scenes::UniformSmoke(Vec3(0.0), {60, 20, 6}, {200, 66, 24}, 0.3)};
  std::fill_n(layer.Grids[0].Extinction.begin(), 200 * 66 * 16, 0.0F);
  const auto compare = [&](const std::string& name, SceneDescription description)
  {
    std::array<std::unique_ptr<const Scene>, 2> scenes;
    std::array<std::unique_ptr<const View>, 2> views;
    for (const bool leaps : {true, false})
    {
      description.LeapsClearAir = leaps;
      scenes[leaps ? 0 : 1] = std::make_unique<const Scene>(description);
      auto solved = Solve(description, SkipTolerance, 1, settings.Threads);
      views[leaps ? 0 : 1] = std::move(solved.TheView);
    }
    const auto cells = static_cast<double>(scenes[0]->Smoke().Cells());
    const std::string where =
      name + " (" + Number(scenes[0]->Smoke().LeaptCells() / cells) + " of the cells)";
    Compare(table, "clear air leapt over", where + ": light field",
      [&](bool skips)
      {
        const Scene& scene = *scenes[skips ? 0 : 1];
        return Direct(scene, SolveWith(scene, true));
      });
    Compare(table, "clear air leapt over", where + ": optical depths of 4000 rays",
      [&](bool skips) { return Rays(*views[skips ? 0 : 1], false); });
    Compare(table, "clear air leapt over", where + ": luminances of 4000 rays",
      [&](bool skips) { return Rays(*views[skips ? 0 : 1], true); });
  };
  compare("layer of smoke", layer);
  compare("hall at 60 s", Hall(60.0));
}

void SkipSteps(ResultTable& table)
{
  CompareSteps(table);
  SceneDescription description = Corridor(0.3, 4, 0.5, 0.5);
  description.Surfaces = {};
  scenes::AddRoom(description.Surfaces, Vec3(0.0), {60, 4, 4}, 0.1, 0.5);
  const Scene fine(description);
  Compare(table, "kept search structures", "corridor of 60 m with 200 000 triangles",
    [&](bool skips)
    {
      const Scene next(description, skips ? &fine : nullptr);
      return Values{next.PatchArea(0), next.ExposedArea(0, 0), next.Shapes().Tolerance()};
    });
}

void SkipSigns(ResultTable& table, const Settings& settings)
{
  const Solution hall = Solve(Hall(settings.Time), SkipTolerance, 1, settings.Threads);
  FloorMapOptions places = HallPlaces(12, 8, settings.Threads);
  Progress progress;
  Compare(table, "signs below the cut-off of 0.2", "hall at 600 s: map of 12 x 8 places",
    [&](bool skips)
    {
      places.CutOff = skips ? places.ContrastThreshold : 0.0;
      const FloorMap map = ComputeFloorMap(*hall.TheView, places, progress);
      Values values;
      for (const float visibility : map.Visibility)
      {
        // Places below the cut-off need not keep their value, but must stay below.
        values.push_back(std::max<double>(visibility, places.ContrastThreshold));
      }
      return values;
    });
  places.CutOff = 0.0;
  const auto compare = [&](const std::string& skip, const ViewSkips& others)
  {
    const View without(hall.TheScene, hall.Field, others);
    Compare(table, skip, "the same",
      [&](bool skips)
      {
        const FloorMap map = ComputeFloorMap(skips ? *hall.TheView : without, places, progress);
        Values values;
        for (const float contrast : map.Contrast)
        {
          values.push_back(std::max<double>(contrast, LeastContrast));
        }
        return values;
      });
  };
  compare("veil behind smoke that hides it", {.HiddenSmoke = false});
  compare("looks at parts of signs that nothing hides", {.Looks = false});
}

/// A corridor with pairs of signs back to back, 10 m apart.
SceneDescription CorridorOfSigns()
{
  SceneDescription scene = Corridor(0.3, 4, 0.5, 0.5);
  constexpr int Pairs = 5;
  constexpr double Apart = 10.0;
  for (int sign = 0; sign < 2 * Pairs; ++sign)
  {
    const double side = sign % 2 == 0 ? -1.0 : 1.0;
    const Vec3 centre(Apart * (sign / 2 + 1) + 0.05 * side, 2.0, 2.5);
    const auto cells =
      scenes::Barcode(centre, {side, 0, 0}, {0, 0, 1}, 0.6, 0.3, 5, 200.0, sign, 0.1);
    scene.Emitters.insert(scene.Emitters.end(), cells.begin(), cells.end());
  }
  return scene;
}

void SkipSignsOutOfView(ResultTable& table, const Settings& settings)
{
  FloorMapOptions places;
  places.FirstPlace = {0.5, 0.5, 1.7};
  places.StepX = 3.0;
  places.PlacesX = 20;
  places.PlacesY = 4;
  places.Threads = settings.Threads;
  Progress progress;
  const auto visibility = [&](const View& view)
  {
    const FloorMap map = ComputeFloorMap(view, places, progress);
    return Values(map.Visibility.begin(), map.Visibility.end());
  };
  SceneDescription scene = CorridorOfSigns();
  const Solution open = Solve(scene, SkipTolerance, 1, settings.Threads);
  Compare(table, "signs that face away", "corridor with ten signs back to back: map of 20 x 4",
    [&](bool skips)
    {
      places.SkipsAway = skips;
      return visibility(*open.TheView);
    });
  places.SkipsAway = true;
  for (int wall = 0; wall < 6; ++wall)
  {
    // A door of 1 m at one side or the other.
    scenes::AddRectangle(scene.Surfaces, {5.0 + 10.0 * wall, wall % 2 == 0 ? 0.0 : 1.0, 0.0},
      {0, 3, 0}, {0, 0, 4}, 6, 8, 0.5);
  }
  const Solution rooms = Solve(scene, SkipTolerance, 1, settings.Threads);
  const View looked(rooms.TheScene, rooms.Field, {.HiddenSigns = false});
  Compare(table, "signs that surfaces hide", "the same in rooms of 10 m with doors between them",
    [&](bool skips) { return visibility(skips ? *rooms.TheView : looked); });
}

} // namespace

//--------------------------------------------------------------------------------------------------
void RunSkips(const Settings& settings)
{
  ResultTable table(settings.Out + "/skips.csv",
    {"skip", "scene", "with_s", "without_s", "ratio", "largest_relative_difference"});
  SkipLight(table);
  SkipClearAir(table, settings);
  SkipSteps(table);
  SkipSigns(table, settings);
  SkipSignsOutOfView(table, settings);
}

} // namespace smokevis::benchmark
