// A sign in the dark, where few random lines bring light to what the eye looks through.
#include "VeilGather.h"
#include "Contrast.h"
#include "SceneLibrary.h"
#include "Solved.h"
#include "TestReport.h"

#include <cmath>
#include <vector>

namespace
{

using namespace smokevis;

const Vec3 Eye(3.6, 4.1, 1.7);
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
  const Vec3 way = SignCentre - Eye;
  return OfLanes(view.TraceVeil(Eye, glm::normalize(way), 0.0, glm::length(way), 0).VeilMultiple);
}

Estimate Gathered(const View& view)
{
  const Vec3 way = SignCentre - Eye;
  return OfLanes(view.GatherVeil(Eye, {{glm::normalize(way), glm::length(way)}}, 0).Multiple);
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
// so is its shape inside cells: flat sources let a tenth too much through (a fifth, not gathered).
TEST(VeilGather, DarkHall)
{
  constexpr int Seeds = 32;
  constexpr double FlatCells = 0.1;
  report::Head("Veil before a sign in the dark [cd/m2]");
  const Estimate truth = Traced(*Solved(DarkHall(2), 0.005, 99).TheView);
  std::vector<Estimate> traced, gathered, luminances, contrasts;
  for (int seed = 1; seed <= Seeds; ++seed)
  {
    const Solved rough(DarkHall(1), 0.1, static_cast<std::uint64_t>(seed));
    traced.push_back(Traced(*rough.TheView));
    gathered.push_back(Gathered(*rough.TheView));
    const SignMeasurement sign = MeasureSign(*rough.TheView, 0, Eye, Observer{0.0});
    if (sign.Rays > 0)
    {
      luminances.push_back({sign.MeanLuminance, sign.MeanLuminanceError});
      contrasts.push_back({sign.Contrast, sign.ContrastError});
    }
    // A sign that is lost in the observer's own noise is not gathered for.
    EXPECT_EQ(MeasureSign(*rough.TheView, 0, Eye, Observer{1.0}).Rays, 0U);
  }
  const Spread known = SpreadOf(traced);
  const Spread anew = SpreadOf(gathered);
  report::Relative("gathered, mean of the seeds", truth.Mean, anew.Mean, FlatCells,
    std::hypot(truth.StandardError, anew.Deviation / std::sqrt(Seeds)));
  // Their spreads are known to an eighth.
  EXPECT_LT(anew.Deviation, 0.8 * known.Deviation);
  EXPECT_GT(contrasts.size(), Seeds / 2);
  const auto compare = [](const char* what, const std::vector<Estimate>& values)
  {
    const Spread spread = SpreadOf(values);
    report::Relative(std::string("errors told over spread, ") + what, 1.0,
      spread.Told / spread.Deviation, 0.0,
      1.0 / std::sqrt(2.0 * (static_cast<double>(values.size()) - 1.0)));
  };
  compare("gathered veil", gathered);
  compare("mean luminance of the sign", luminances);
  compare("contrast", contrasts);
}

// Whatever thread asks first.
TEST(VeilGather, SameBitsForAllThreads)
{
  const SignMeasurement one =
    MeasureSign(*Solved(DarkHall(1), 0.1, 1, 1).TheView, 0, Eye, Observer{0.0});
  const SignMeasurement three =
    MeasureSign(*Solved(DarkHall(1), 0.1, 1, 3).TheView, 0, Eye, Observer{0.0});
  EXPECT_GT(one.Rays, 0U);
  EXPECT_EQ(one.Contrast, three.Contrast);
  EXPECT_EQ(one.ContrastError, three.ContrastError);
}

} // namespace
