// The cases of the benchmark and what they share.
#pragma once

#include "FloorMap.h"
#include "ResultTable.h"
#include "SceneLibrary.h"
#include "View.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <tbb/global_control.h>

namespace smokevis::benchmark
{

/// What the command line asks for.
struct Settings
{
  /// Folder for the CSV files.
  std::string Out = ".";
  std::vector<std::string> Cases = {};
  std::vector<double> Tolerances = {0.1, 0.03, 0.01, 0.003};
  /// Samples a pixel, or a point of a sign's raster, of the reference integrator; none: without it.
  std::vector<double> Samples = {1, 4, 16, 64};
  /// Threads of the solver; 0: all.
  int Threads = 0;
  /// Tolerance of the solutions that others are measured against.
  double ReferenceTolerance = 0.002;
  /// Solutions that each tolerance is tried with, of the seeds 1, 2, ..., at least one: times are
  /// their mean, errors their root mean square. What one of them happens to hit says little.
  int Seeds = 4;
  /// A growth curve ends after the first point that takes longer [processor seconds].
  double Limit = 60.0;
  /// Instant of the hall's fire [s].
  double Time = 600.0;
};

/// A light field with what it took.
struct Solution
{
  std::shared_ptr<const Scene> TheScene;
  std::shared_ptr<const LightField> Field;
  std::unique_ptr<const View> TheView;
  /// Search structures, and the light field [s].
  double SetUpSeconds = 0.0;
  double FieldSeconds = 0.0;
  /// The same of all processors.
  double SetUpProcessors = 0.0;
  double FieldProcessors = 0.0;
};
/// A scene keeps what it found of its lights: each solution has one of its own.
Solution Solve(
  const SceneDescription& description, double tolerance, std::uint64_t seed, int threads);

/// While it lives, no more threads than these (0: all) work. The integrator's own tasks obey the
/// process's limit, not an arena's.
class ThreadLimit
{
public:
  explicit ThreadLimit(int threads);

private:
  tbb::global_control Limit_;
};

/// Runs body(i) for all i below count on so many threads (0: all).
void ForAll(std::size_t count, int threads, const std::function<void(std::size_t)>& body);

/// The hall of Data/Hall with its FDS smoke, its walls in patches of at most 2 m and eight signs.
SceneDescription Hall(double time);
/// The same with the light of the fire in its middle, some 50 000 lm.
SceneDescription BurningHall(double time);
/// The dark hall with its smoke on cells of about 0.1 m, ten million of them.
SceneDescription FineHall(double time);

/// The places of a map of the hall at eye level, 1.7 m.
FloorMapOptions HallPlaces(int across, int along, int threads);

/// A furnished office of 5 x 4 x 3 m in cells of 0.1 m, with smoke that is thick above some 1.6 m,
/// four lamps of 0.6 m under its ceiling, each wider than many cells, and two signs.
SceneDescription Office();
/// Places of the office, half a metre apart, at 1.5 m.
FloorMapOptions OfficePlaces(int threads);

/// tunnel: 64 x 64 pixels, error of pixels and of the veil before dark bars, beside the reference
/// integrator.
void RunTunnel(const Settings& settings);
/// hall12, hall110, hall10m, fire12, office: a floor map, beside the reference integrator.
void RunMap(const Settings& settings, const std::string& name, const SceneDescription& scene,
  const FloorMapOptions& places);
/// growth: time over cells, views, emitters, triangles, optical depth and albedo.
void RunGrowth(const Settings& settings);
/// threads: one thread against two.
void RunThreads(const Settings& settings);
/// skips: what each thing that is left out saves, and what it changes.
void RunSkips(const Settings& settings);
/// thick: smoke in cells of more than a mean free path, as it comes and refined.
void RunThick(const Settings& settings);
/// steps: nanoseconds a step of a ray from cell to cell.
void RunSteps(const Settings& settings);

} // namespace smokevis::benchmark
