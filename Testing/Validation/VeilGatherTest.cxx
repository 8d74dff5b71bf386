// A sign in the dark, where few random lines bring light to what the eye looks through.
#include "VeilGather.h"
#include "Contrast.h"
#include "FloorMap.h"
#include "SceneLibrary.h"
#include "Solved.h"
#include "TestReport.h"
#include "WorkCount.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <tbb/global_control.h>

namespace
{

using namespace smokevis;

const Vec3 HallEye(3.6, 4.1, 1.7);
const Vec3 SignCentre(15.9, 4.0, 2.5);

/// A hall full of soot of about one mean free path a metre. A sign and a lamp above it are twelve
/// of them away from the eye, and so is the light that makes the veil.
SceneDescription DarkHall(int cut)
{
  SceneDescription description;
  description.Albedo = 0.3;
  description.Grids = {
    scenes::UniformSmoke(Vec3(0.0), {16.0, 8.0, 4.0}, {32 * cut, 16 * cut, 8 * cut}, 1.0)};
  description.Emitters = scenes::Barcode(SignCentre, {-1, 0, 0}, {0, 0, 1}, 0.5, 0.25, 5, 4.0, 0);
  description.Emitters.push_back(
    scenes::Plate({15.9, 4.0, 3.5}, {-1, 0, 0}, {0, 0, 1}, 0.5, 0.25, 400.0));
  return description;
}

Estimate OfLanes(const Lanes& lanes)
{
  return {Mean(lanes), StandardError(lanes)};
}

Estimate Traced(const View& view)
{
  const Vec3 way = SignCentre - HallEye;
  return OfLanes(
    view.TraceVeil(HallEye, glm::normalize(way), 0.0, glm::length(way), 0).VeilMultiple);
}

Estimate Gathered(const View& view)
{
  const Vec3 way = SignCentre - HallEye;
  return OfLanes(view.GatherVeil(HallEye, {{glm::normalize(way), glm::length(way)}}, 0).Multiple);
}

struct Spread
{
  double Mean = 0.0;
  double Deviation = 0.0;
  /// Root mean square of the errors that were told.
  double Told = 0.0;
};

Spread SpreadOf(const std::vector<Estimate>& values)
{
  Spread spread;
  const auto count = static_cast<double>(values.size());
  for (const Estimate& value : values)
  {
    spread.Mean += value.Mean / count;
    spread.Told += value.StandardError * value.StandardError / count;
  }
  for (const Estimate& value : values)
  {
    spread.Deviation += std::pow(value.Mean - spread.Mean, 2) / (count - 1.0);
  }
  return {spread.Mean, std::sqrt(spread.Deviation), std::sqrt(spread.Told)};
}

// What is gathered in cells of half a mean free path, from light that is hardly known, against the
// light of cells half as large and many times the lines, not gathered. Where light is hardly known,
// so is its shape inside cells, and flat sources let too much through: 6 % through five mean free
// paths of such cells (Slab.CoarseLayers), as much again through as many more. What is gathered
// takes the last mean free paths anew.
TEST(VeilGather, DarkHall)
{
  constexpr int Seeds = 40;
  constexpr double FlatCells = 0.1;
  report::Head("Veil before a sign in the dark [cd/m2]");
  const Solved fine(DarkHall(2), 0.005, 99);
  const Estimate truth = Traced(*fine.TheView);
  const SignMeasurement trueSign = MeasureSign(*fine.TheView, 0, HallEye, Observer{0.0});
  std::vector<Estimate> traced, gathered, luminances, luminancesTraced, contrasts;
  for (int seed = 1; seed <= Seeds; ++seed)
  {
    const Solved rough(DarkHall(1), 0.1, static_cast<std::uint64_t>(seed));
    traced.push_back(Traced(*rough.TheView));
    gathered.push_back(Gathered(*rough.TheView));
    const SignMeasurement sign = MeasureSign(*rough.TheView, 0, HallEye, Observer{0.0});
    // One that is lost in the observer's own noise is not gathered for.
    const SignMeasurement lost = MeasureSign(*rough.TheView, 0, HallEye, Observer{1.0});
    EXPECT_EQ(lost.Rays, 0U);
    EXPECT_EQ(lost.LeftUncertain, sign.Rays > 0);
    EXPECT_FALSE(sign.LeftUncertain);
    if (sign.Rays > 0)
    {
      luminances.push_back({sign.MeanLuminance, sign.MeanLuminanceError});
      luminancesTraced.push_back({lost.MeanLuminance, lost.MeanLuminanceError});
      contrasts.push_back({sign.Contrast, sign.ContrastError});
    }
  }
  const Spread known = SpreadOf(traced);
  const Spread unused = SpreadOf(luminancesTraced);
  const Spread anew = SpreadOf(gathered);
  const Spread luminance = SpreadOf(luminances);
  const Spread contrast = SpreadOf(contrasts);
  // The allowance for noise is not to grow with the noise.
  EXPECT_LT(anew.Deviation / std::sqrt(Seeds), 0.035 * truth.Mean);
  const auto meanOf = [](const Spread& spread) { return spread.Deviation / std::sqrt(Seeds); };
  report::Relative("traced, mean of the seeds", truth.Mean, known.Mean, FlatCells,
    std::hypot(truth.StandardError, meanOf(known)));
  report::Relative("gathered, mean of the seeds", truth.Mean, anew.Mean, FlatCells,
    std::hypot(truth.StandardError, meanOf(anew)));
  // That much of the veil in all that the sign shows; contrast falls as the mean rises.
  const double share = FlatCells * truth.Mean / trueSign.MeanLuminance;
  report::Relative(
    "sign's mean luminance", trueSign.MeanLuminance, luminance.Mean, share, meanOf(luminance));
  report::Relative("sign's contrast", trueSign.Contrast, contrast.Mean, share, meanOf(contrast));
  EXPECT_GT(contrasts.size(), Seeds / 2);
  // Gathering is of use, and it is used: over many seeds these are about a half, and would be 1 if
  // nothing that is gathered were taken.
  report::Absolute(
    "spread gathered over traced, veil", 0.0, anew.Deviation / known.Deviation, 0.95);
  report::Absolute(
    "spread gathered over traced, luminance", 0.0, luminance.Deviation / unused.Deviation, 0.95);
  const auto compare = [](const char* what, const Spread& spread, std::size_t count)
  {
    report::Relative(std::string("errors told over spread, ") + what, 1.0,
      spread.Told / spread.Deviation, 0.0, 1.0 / std::sqrt(2.0 * (static_cast<double>(count) - 1)));
  };
  compare("gathered veil", anew, Seeds);
  compare("mean luminance of the sign", luminance, luminances.size());
  compare("contrast", contrast, contrasts.size());
}

// What is gathered depends neither on the unit of length nor on the place of the origin or the
// brightness of all lights: to 1e-5, or 1e-4 a million metres off.
TEST(VeilGather, UnitOfLengthPlaceAndBrightness)
{
  report::Head("Sign in the dark, scaled, moved and brighter");
  const SceneDescription plain = DarkHall(1);
  const auto compare = [&plain](const std::string& name, const SceneDescription& other,
                         double scale, const Vec3& offset, double times, double tolerance)
  {
    const Solved a(plain, 0.3);
    const Solved b(other, 0.3);
    const SignMeasurement one = MeasureSign(*a.TheView, 0, HallEye, Observer{0.0});
    const SignMeasurement two = MeasureSign(*b.TheView, 0, scale * HallEye + offset, Observer{0.0});
    EXPECT_GT(one.Rays, 0U);
    EXPECT_EQ(one.Rays, two.Rays);
    report::Relative(
      name + ": mean luminance", times * one.MeanLuminance, two.MeanLuminance, tolerance);
    report::Relative(name + ": contrast", one.Contrast, two.Contrast, tolerance);
  };
  for (const double scale : {1e-3, 1e3})
  {
    compare(
      "times " + std::to_string(scale), scenes::Scaled(plain, scale), scale, Vec3(0.0), 1.0, 1e-5);
  }
  const Vec3 offset(1e6, -1e6, 1e6);
  compare("moved", scenes::Moved(plain, offset), 1.0, offset, 1.0, 1e-4);
  SceneDescription bright = plain;
  for (EmitterCell& cell : bright.Emitters)
  {
    for (double& luminance : cell.Luminance)
    {
      luminance *= 3.7;
    }
  }
  compare("brighter", bright, 1.0, Vec3(0.0), 3.7, 1e-5);
}

// A map of some places that gather, whichever thread measures which; or do not, where the eye's own
// noise drowns the signs.
TEST(VeilGather, MapHasSameBitsForAllThreads)
{
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, 3);
  const Solved solved(DarkHall(1), 0.3);
  FloorMapOptions options;
  options.FirstPlace = HallEye;
  options.PlacesX = 4;
  options.PlacesY = 3;
  options.StepX = 0.4;
  options.StepY = 0.3;
  options.Eye.DarkLuminance = 0.0;
  Progress progress;
  options.Threads = 1;
  const FloorMap one = ComputeFloorMap(*solved.TheView, options, progress);
  const double gathered = WorkCount(one.Report, "views of signs gathered for");
  EXPECT_GT(gathered, 1.0);
  EXPECT_EQ(WorkCount(one.Report, "views of signs not gathered for"), 0.0);
  for (const int count : {2, 3})
  {
    options.Threads = count;
    const FloorMap other = ComputeFloorMap(*solved.TheView, options, progress);
    EXPECT_EQ(one.Contrast, other.Contrast);
    EXPECT_EQ(one.VisibilityError, other.VisibilityError);
  }
  options.Eye.DarkLuminance = 1.0;
  const FloorMap drowned = ComputeFloorMap(*solved.TheView, options, progress);
  EXPECT_EQ(WorkCount(drowned.Report, "views of signs gathered for"), 0.0);
  EXPECT_EQ(WorkCount(drowned.Report, "views of signs not gathered for"), gathered);
}

} // namespace
