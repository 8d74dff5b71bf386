// Floor maps: run time and memory against the error of contrast, beside the reference integrator.
#include "BenchmarkCases.h"

#include "ReferenceSign.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace smokevis::benchmark
{

namespace
{

struct MapError
{
  /// Of the plain contrast of signs whose mean luminance is at least 1e-3 cd/m2: root mean square
  /// and largest.
  double Contrast = 0.0;
  double LargestContrast = 0.0;
  /// Root mean square of the map itself, the largest perceived contrast of a place.
  double Visibility = 0.0;
  /// Over places whose best sign is the reference's, too, the mean of |error| / (reported error) of
  /// the map; 0.8 where error bars are true.
  double InErrorBars = 0.0;
};

/// What is fainter adds nothing to a map of perceived contrast with the default dark luminance,
/// 0.1 cd/m2.
constexpr double Faint = 1e-3;
constexpr double Nothing = std::numeric_limits<double>::quiet_NaN();

/// Views, as places in FloorMap's arrays of place and sign, whose contrast counts.
std::vector<std::size_t> CountedViews(const FloorMap& reference)
{
  std::vector<std::size_t> views;
  for (std::size_t i = 0; i < reference.Contrast.size(); ++i)
  {
    if (reference.SignLuminance[i] >= Faint)
    {
      views.push_back(i);
    }
  }
  return views;
}

/// Errors of contrasts alone.
/// @param contrast of all views
MapError CompareContrast(const FloorMap& reference, const std::vector<float>& contrast)
{
  MapError error;
  const std::vector<std::size_t> views = CountedViews(reference);
  for (const std::size_t view : views)
  {
    const double difference = std::abs(contrast[view] - reference.Contrast[view]);
    AddToRootMeanSquare(difference, static_cast<int>(views.size()), error.Contrast);
    error.LargestContrast = std::max(error.LargestContrast, difference);
  }
  return error;
}

MapError Compare(const FloorMap& reference, const FloorMap& map)
{
  MapError error = CompareContrast(reference, map.Contrast);
  double bars = 0.0;
  for (std::size_t i = 0; i < map.Visibility.size(); ++i)
  {
    const double difference = map.Visibility[i] - reference.Visibility[i];
    error.Visibility += difference * difference;
    if (map.VisibilityError[i] > 0.0F && map.BestSign[i] == reference.BestSign[i])
    {
      bars += 1.0;
      error.InErrorBars +=
        std::abs(difference) / std::hypot(map.VisibilityError[i], reference.VisibilityError[i]);
    }
  }
  error.Visibility = std::sqrt(error.Visibility / static_cast<double>(map.Visibility.size()));
  error.InErrorBars /= std::max(1.0, bars);
  return error;
}

/// Takes in the errors of one more of so many seeds.
void Add(const MapError& error, int seeds, MapError& all)
{
  AddToRootMeanSquare(error.Contrast, seeds, all.Contrast);
  AddToRootMeanSquare(error.Visibility, seeds, all.Visibility);
  all.LargestContrast = std::max(all.LargestContrast, error.LargestContrast);
  all.InErrorBars += error.InErrorBars / seeds;
}

/// Contrasts of the views that count by the reference integrator, 0 elsewhere.
std::vector<float> PathTrace(const Scene& scene, const FloorMapOptions& places,
  const FloorMap& reference, std::uint64_t samples, int threads)
{
  std::vector<float> contrast(reference.Contrast.size(), 0.0F);
  const std::vector<std::size_t> views = CountedViews(reference);
  ForAll(views.size(), threads,
    [&](std::size_t i)
    {
      const std::size_t view = views[i];
      contrast[view] = static_cast<float>(
        MeasureByPaths(scene, places.EyeAt(view / reference.Signs), samples, view % reference.Signs)
          .Contrast.Mean);
    });
  return contrast;
}

/// Rows of the reference integrator's maps.
void TraceMaps(const Settings& settings, const SceneDescription& description,
  const FloorMapOptions& places, const FloorMap& reference, ResultTable& table)
{
  const Scene scene(description);
  const ThreadLimit limit(settings.Threads);
  for (const double samples : settings.Samples)
  {
    const StopWatch watch;
    const std::vector<float> contrast =
      PathTrace(scene, places, reference, static_cast<std::uint64_t>(samples), settings.Threads);
    const double seconds = watch.Seconds();
    const double processors = watch.Processors();
    const MapError error = CompareContrast(reference, contrast);
    table.Row({"reference integrator", Number(samples), "1", Number(settings.Threads),
      Number(Nothing), Number(Nothing), Number(seconds), Number(seconds), Number(processors),
      Number(error.Contrast), Number(error.LargestContrast), Number(Nothing), Number(Nothing),
      Number(Nothing)});
  }
}

} // namespace

//--------------------------------------------------------------------------------------------------
void RunMap(const Settings& settings, const std::string& name, const SceneDescription& scene,
  const FloorMapOptions& places)
{
  ResultTable table(settings.Out + "/" + name + ".csv",
    {"method", "setting", "seeds", "threads", "setup_s", "field_s", "map_s", "total_s",
      "processor_s", "contrast_error", "largest_contrast_error", "visibility_error",
      "error_over_bar", "peak_MiB"});
  Progress progress;
  FloorMap reference;
  if (settings.ReferenceTolerance > 0.0)
  {
    const Solution limit = Solve(scene, settings.ReferenceTolerance, 99, settings.Threads);
    reference = ComputeFloorMap(*limit.TheView, places, progress);
  }
  for (const double tolerance : settings.Tolerances)
  {
    double setUp = 0.0;
    double field = 0.0;
    double look = 0.0;
    double processors = 0.0;
    MapError error;
    for (int seed = 1; seed <= settings.Seeds; ++seed)
    {
      const Solution solution =
        Solve(scene, tolerance, static_cast<std::uint64_t>(seed), settings.Threads);
      const StopWatch watch;
      const FloorMap map = ComputeFloorMap(*solution.TheView, places, progress);
      setUp += solution.SetUpSeconds / settings.Seeds;
      field += solution.FieldSeconds / settings.Seeds;
      look += watch.Seconds() / settings.Seeds;
      processors += (solution.FieldProcessors + watch.Processors()) / settings.Seeds;
      if (!reference.Visibility.empty())
      {
        Add(Compare(reference, map), settings.Seeds, error);
      }
    }
    std::vector<std::string> row = {"solver", Number(tolerance), Number(settings.Seeds),
      Number(settings.Threads), Number(setUp), Number(field), Number(look), Number(field + look),
      Number(processors)};
    if (reference.Visibility.empty())
    {
      row.insert(row.end(), 4, "");
    }
    else
    {
      row.insert(row.end(), {Number(error.Contrast), Number(error.LargestContrast),
                              Number(error.Visibility), Number(error.InErrorBars)});
    }
    row.push_back(Number(PeakMemory()));
    table.Row(row);
  }
  if (!reference.Visibility.empty())
  {
    TraceMaps(settings, scene, places, reference, table);
  }
}

} // namespace smokevis::benchmark
