#include "FloorMap.h"

#include "Errors.h"
#include "ReportedLoop.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>

namespace smokevis
{

namespace
{

/// Jin's law for signs that reflect light: visibility times extinction (Jin 1978; FDS's default).
constexpr double JinConstant = 3.0;
/// FDS reports no visibility beyond this [m].
constexpr double FarthestVisibility = 30.0;

double JinVisibility(double extinction)
{
  return extinction * FarthestVisibility > JinConstant ? JinConstant / extinction
                                                       : FarthestVisibility;
}

/// Counts of what was left out, and of what was gathered along rays.
struct Counts
{
  std::atomic<std::size_t> Solid{0};
  std::atomic<std::size_t> Away{0};
  std::atomic<std::size_t> CutOff{0};
  std::atomic<std::size_t> Hidden{0};
  std::atomic<std::size_t> InShadow{0};
  std::atomic<std::size_t> Clear{0};
  std::atomic<std::size_t> Gathered{0};
  std::atomic<std::size_t> Uncertain{0};
  std::atomic<std::size_t> Uneven{0};
  std::atomic<std::size_t> Rays{0};
};

bool FacesAway(const EmitterSet& lights, const Sign& sign, const Vec3& eye)
{
  return std::all_of(sign.Cells.begin(), sign.Cells.end(),
    [&](std::size_t cell)
    { return glm::dot(eye - lights.CellCentre(cell), lights.CellNormal(cell)) <= 0.0; });
}

void MeasurePlace(const View& view, const FloorMapOptions& options, std::size_t place,
  FloorMap& map, Counts& counts)
{
  const EmitterSet& lights = view.TheScene().Lights();
  const Medium& smoke = view.TheScene().Smoke();
  const Vec3 eye = options.EyeAt(place);
  const std::int64_t cell = smoke.Locate(eye);
  map.JinVisibility[place] =
    static_cast<float>(JinVisibility(cell < 0 ? 0.0 : smoke.Extinction(cell)));
  if (view.InsideSolid(eye))
  {
    map.Status[place] = PlaceStatus::InsideSolid;
    ++counts.Solid;
    return;
  }
  std::optional<GlareSources> glare;
  if (options.State.Glare)
  {
    glare.emplace(view, eye);
  }
  bool cut = false;
  for (std::size_t sign = 0; sign < map.Signs; ++sign)
  {
    if (options.SkipsAway && FacesAway(lights, lights.Signs()[sign], eye))
    {
      ++counts.Away;
      continue;
    }
    const Observer observer =
      LookingAt(options.Eye, options.State, glare ? &*glare : nullptr, lights.Signs()[sign]);
    const SignMeasurement measured = MeasureSign(view, sign, eye, observer, options.CutOff);
    if (!measured.InView || measured.BelowCutOff)
    {
      ++(measured.BelowCutOff ? counts.CutOff : counts.Hidden);
      counts.InShadow += measured.InShadow ? 1 : 0;
      cut = cut || measured.BelowCutOff;
      continue;
    }
    counts.Clear += measured.Clear ? 1 : 0;
    counts.Gathered += measured.Rays > 0 ? 1 : 0;
    counts.Rays += measured.Rays;
    counts.Uncertain += measured.LeftUncertain ? 1 : 0;
    counts.Uneven += measured.Uneven ? 1 : 0;
    const std::size_t index = place * map.Signs + sign;
    map.Contrast[index] = static_cast<float>(measured.Contrast);
    map.PerceivedContrast[index] = static_cast<float>(measured.PerceivedContrast);
    map.SignLuminance[index] = static_cast<float>(measured.LitLuminance);
    map.VisibleFraction[index] = static_cast<float>(measured.VisibleFraction);
    if (map.BestSign[place] < 0 || measured.PerceivedContrast > map.Visibility[place])
    {
      const double distance = glm::length(lights.Signs()[sign].Centre - eye);
      map.BestSign[place] = lights.Signs()[sign].Id;
      map.Visibility[place] = static_cast<float>(measured.PerceivedContrast);
      map.VisibilityError[place] = static_cast<float>(measured.PerceivedContrastError);
      map.VisibilityDivisionError[place] =
        static_cast<float>(measured.PerceivedContrastDivisionError);
      map.VisibleProbability[place] = static_cast<float>(VisibleProbability(
        measured.PerceivedContrast, options.ContrastThreshold, options.ThresholdSpread));
      map.EyeLuminance[place] = static_cast<float>(observer.DarkLuminance);
      map.OpticalDepth[place] = static_cast<float>(measured.OpticalDepth);
      map.JinVisibility[place] =
        static_cast<float>(JinVisibility(measured.OpticalDepth / distance));
    }
  }
  if (map.BestSign[place] >= 0 || cut)
  {
    map.Status[place] = map.Visibility[place] < options.ContrastThreshold
                          ? PlaceStatus::BelowThreshold
                          : PlaceStatus::Seen;
  }
}

} // namespace

FloorMap ComputeFloorMap(const View& view, const FloorMapOptions& options, Progress& progress)
{
  FloorMap map;
  map.Signs = view.TheScene().Lights().Signs().size();
  if (map.Signs == 0)
  {
    throw Error("floor map", "there is no sign", "Give emitters with a SignId of 0 or more");
  }
  if (options.PlacesX < 1 || options.PlacesY < 1)
  {
    throw Error("floor map", "there are no places", "Give a resolution of at least 1 x 1");
  }
  const auto places = static_cast<std::size_t>(options.PlacesX) * options.PlacesY;
  map.Status.assign(places, PlaceStatus::NoSignInView);
  map.BestSign.assign(places, -1);
  for (std::vector<float>* values :
    {&map.Visibility, &map.VisibilityError, &map.VisibilityDivisionError, &map.OpticalDepth,
      &map.JinVisibility, &map.VisibleProbability, &map.EyeLuminance})
  {
    values->assign(places, 0.0F);
  }
  for (std::vector<float>* values :
    {&map.Contrast, &map.PerceivedContrast, &map.SignLuminance, &map.VisibleFraction})
  {
    values->assign(places * map.Signs, 0.0F);
  }
  Counts counts;
  tbb::task_arena arena(options.Threads > 0 ? options.Threads : tbb::task_arena::automatic);
  const std::size_t cutBefore = view.RaysCutShort();
  const std::size_t last = std::min(places, options.End);
  const std::size_t own = last - std::min(last, options.First);
  ReportedLoop(
    arena, own, 1, progress, [&progress](double done) { progress.Report(done); },
    [&](std::size_t i) { MeasurePlace(view, options, options.First + i, map, counts); });
  progress.ThrowIfStopped("floor map");
  const auto say = [&map](const char* what, std::size_t count, const char* why) {
    map.Report.push_back({what, static_cast<double>(count), why});
  };
  const std::size_t views = own * map.Signs;
  const std::size_t left = counts.Solid * map.Signs + counts.Away + counts.CutOff;
  say("views of signs computed", views - left - counts.Hidden, "the sign is in view");
  say("views of signs not looked at in parts", counts.Clear,
    "nothing reaches between the eye and the sign");
  say(
    "views of signs gathered for", counts.Gathered, "the light field left the contrast uncertain");
  say("views of signs not gathered for", counts.Uncertain,
    "as uncertain, but lost in the eye's own noise, or no smoke scatters on the way");
  say("rays gathered by views of signs", counts.Rays, "they tell the veil in the dark");
  say("views of signs divided finely", counts.Uneven, "the smoke before the sign is uneven");
  say("rays cut short", view.RaysCutShort() - cutBefore,
    "so much smoke lies ahead that the rest adds next to nothing");
  say("places skipped", counts.Solid, "inside a solid");
  say("views of signs skipped", counts.Away, "the sign faces away");
  say("views of signs skipped", counts.Hidden, "the sign is hidden");
  say("hidden signs not looked at in parts", counts.InShadow, "surfaces stand before all of it");
  say("views of signs skipped", counts.CutOff,
    "without the smoke's light, its contrast is below the cut-off");
  return map;
}

} // namespace smokevis
