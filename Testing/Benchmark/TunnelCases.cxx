// The image of the tunnel's sign: the solver and the reference integrator in one run.
#include "BenchmarkCases.h"

#include "Camera.h"
#include "ReferenceIntegrator.h"

#include <cmath>
#include <limits>

namespace smokevis::benchmark
{

namespace
{

constexpr int Pixels = 64;
constexpr double Nothing = std::numeric_limits<double>::quiet_NaN();

/// The pixels' central rays, and which of them end on a dark bar.
struct Picture
{
  std::vector<Ray> Rays;
  std::vector<bool> Dark;
};

Picture Frame(const Scene& scene)
{
  const Camera camera = Camera::FramePlate(
    scenes::TunnelEye, scene.Lights().Signs()[0].Corners, {0, 0, 1}, 0.05, Pixels, Pixels);
  Picture picture;
  for (int y = 0; y < Pixels; ++y)
  {
    for (int x = 0; x < Pixels; ++x)
    {
      const Ray ray{camera.Position, camera.Direction(x + 0.5, y + 0.5)};
      const Hit hit = scene.Shapes().Intersect(ray.Origin, ray.Direction, 0.0, 100.0);
      picture.Rays.push_back(ray);
      picture.Dark.push_back(
        hit.Emitter && scene.Lights().Cells()[scene.Shapes().Cell(hit)].Luminance[0] == 0.0);
    }
  }
  return picture;
}

struct PictureError
{
  /// Root mean square over all pixels of their relative errors.
  double Pixel = 0.0;
  /// Root mean square over dark pixels of their errors, over their mean.
  double Veil = 0.0;
  /// Error of the dark pixels' mean, relative.
  double VeilMean = 0.0;
};

PictureError Compare(
  const Picture& picture, const std::vector<double>& reference, const std::vector<double>& values)
{
  PictureError error;
  double dark = 0.0;
  double darkReference = 0.0;
  double darkSquare = 0.0;
  int darkPixels = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const double difference = values[i] - reference[i];
    error.Pixel += std::pow(difference / reference[i], 2);
    if (picture.Dark[i])
    {
      ++darkPixels;
      dark += values[i];
      darkReference += reference[i];
      darkSquare += difference * difference;
    }
  }
  error.Pixel = std::sqrt(error.Pixel / static_cast<double>(values.size()));
  error.Veil = std::sqrt(darkSquare * darkPixels) / darkReference;
  error.VeilMean = dark / darkReference - 1.0;
  return error;
}

/// Takes in the errors of one more of so many seeds.
void Add(const PictureError& error, int seeds, PictureError& all)
{
  AddToRootMeanSquare(error.Pixel, seeds, all.Pixel);
  AddToRootMeanSquare(error.Veil, seeds, all.Veil);
  all.VeilMean += error.VeilMean / seeds;
}

std::vector<double> Render(const Solution& solution, const Picture& picture, int threads)
{
  std::vector<double> values(picture.Rays.size());
  ForAll(values.size(), threads,
    [&](std::size_t i)
    {
      const Ray& ray = picture.Rays[i];
      const Hit hit = solution.TheView->FirstHit(ray.Origin, ray.Direction);
      values[i] = solution.TheView->Trace(ray.Origin, ray.Direction, hit, 0).Total();
    });
  return values;
}

std::vector<double> PathTrace(
  const Scene& scene, const Picture& picture, std::uint64_t samples, int threads)
{
  const ReferenceIntegrator integrator(scene);
  std::vector<double> values(picture.Rays.size());
  ForAll(values.size(), threads,
    [&](std::size_t i)
    { values[i] = integrator.Radiance(picture.Rays[i], samples, 1000 + i).Mean; });
  return values;
}

/// The dark pixels' mean by the reference integrator, one sample a pixel and round.
Estimate DarkMean(const Scene& scene, const Picture& picture, std::uint64_t samples)
{
  std::vector<Ray> dark;
  for (std::size_t i = 0; i < picture.Rays.size(); ++i)
  {
    if (picture.Dark[i])
    {
      dark.push_back(picture.Rays[i]);
    }
  }
  return ReferenceIntegrator(scene).MeanRadiance([&dark](Pcg32& random)
    { return dark[static_cast<std::size_t>(random.Uniform() * static_cast<double>(dark.size()))]; },
    samples, 1);
}

} // namespace

//--------------------------------------------------------------------------------------------------
void RunTunnel(const Settings& settings)
{
  ResultTable table(settings.Out + "/tunnel.csv",
    {"method", "setting", "seeds", "threads", "field_s", "view_s", "total_s", "processor_s",
      "pixel_error", "veil_error", "veil_mean_error"});
  const SceneDescription tunnel = scenes::Tunnel(1.0, 0.9);
  // The reference is the solver's own limit: half the cell size, a small tolerance, another seed.
  // The reference integrator says in the first row how far that is off in the mean.
  SceneDescription fine = tunnel;
  fine.Grids = {scenes::UniformSmoke(Vec3(0.0), {4, 1, 1}, {80, 20, 20}, 1.0)};
  const Solution limit = Solve(fine, settings.ReferenceTolerance, 99, settings.Threads);
  const Picture picture = Frame(*limit.TheScene);
  const std::vector<double> reference = Render(limit, picture, settings.Threads);
  double limitDark = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < reference.size(); ++i)
  {
    limitDark += picture.Dark[i] ? reference[i] : 0.0;
    count += picture.Dark[i] ? 1.0 : 0.0;
  }
  // One sample of it errs by 13 times the mean: five times the tolerance is asked of them all.
  const auto samples =
    static_cast<std::uint64_t>(std::pow(13.0 / (5.0 * settings.ReferenceTolerance), 2));
  const Estimate check = DarkMean(*limit.TheScene, picture, samples);
  table.Row({"reference against integrator (standard error " +
               Number(check.StandardError / check.Mean) + ")",
    Number(settings.ReferenceTolerance), "1", Number(settings.Threads), Number(limit.FieldSeconds),
    Number(Nothing), Number(Nothing), Number(Nothing), Number(Nothing), Number(Nothing),
    Number(limitDark / count / check.Mean - 1.0)});

  for (const double tolerance : settings.Tolerances)
  {
    double field = 0.0;
    double look = 0.0;
    double processors = 0.0;
    PictureError error;
    for (int seed = 1; seed <= settings.Seeds; ++seed)
    {
      const Solution solution =
        Solve(tunnel, tolerance, static_cast<std::uint64_t>(seed), settings.Threads);
      const StopWatch watch;
      const std::vector<double> values = Render(solution, picture, settings.Threads);
      look += watch.Seconds() / settings.Seeds;
      processors +=
        (solution.SetUpProcessors + solution.FieldProcessors + watch.Processors()) / settings.Seeds;
      field += (solution.SetUpSeconds + solution.FieldSeconds) / settings.Seeds;
      Add(Compare(picture, reference, values), settings.Seeds, error);
    }
    table.Row({"solver", Number(tolerance), Number(settings.Seeds), Number(settings.Threads),
      Number(field), Number(look), Number(field + look), Number(processors), Number(error.Pixel),
      Number(error.Veil), Number(error.VeilMean)});
  }
  const ThreadLimit limitThreads(settings.Threads);
  for (const double perPixel : settings.Samples)
  {
    const StopWatch watch;
    const std::vector<double> values =
      PathTrace(*limit.TheScene, picture, static_cast<std::uint64_t>(perPixel), settings.Threads);
    const double seconds = watch.Seconds();
    const double processors = watch.Processors();
    const PictureError error = Compare(picture, reference, values);
    table.Row({"reference integrator", Number(perPixel), "1", Number(settings.Threads), Number(0.0),
      Number(seconds), Number(seconds), Number(processors), Number(error.Pixel), Number(error.Veil),
      Number(error.VeilMean)});
  }
}

} // namespace smokevis::benchmark
