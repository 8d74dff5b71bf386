// Deep in the smoke, where a sign disappears, the veil decides: the dark bars' luminance down to a
// millionth of the sign's.
#include "Contrast.h"
#include "DeepScenes.h"
#include "Solved.h"
#include "TestReport.h"

#include <cmath>

namespace
{

using namespace smokevis;

// The promise is 2 % of the dark bars, to three standard errors of the reference; the solver's
// noise is to leave room for that. The lit bars and the contrast follow: with a dark luminance D
// and a lit one T + D, where T is the bars' own light, exact, C moves by less than the dark bars'
// relative error.
constexpr double Promise = 0.02;

void CheckDeep(const std::string& what, int cut, double tolerance)
{
  report::Head("Dark bars of the tunnel's sign, " + what + " [cd/m2]");
  const report::ReferenceTable table("deep_tunnel_own.csv");
  for (std::size_t row = 0; row < table.Rows(); ++row)
  {
    if (table.Text(row, "name").rfind(what, 0) != 0)
    {
      continue;
    }
    SceneDescription scene =
      scenes::Tunnel(table.Number(row, "extinction"), table.Number(row, "albedo"));
    // Cells of at most 0.3 mean free paths over the number of cuts.
    scene.Grids = {scenes::UniformSmoke(
      Vec3(0.0), {4, 1, 1}, {40 * cut, 10 * cut, 10 * cut}, table.Number(row, "extinction"))};
    const Solved solved(scene, tolerance);
    const SignMeasurement sign = MeasureSign(*solved.TheView, 0, scenes::TunnelEye, Observer{0.0});
    const double dark = table.Number(row, "dark");
    const double darkError = table.Number(row, "dark_error");
    report::Relative(table.Text(row, "name") + " mean free paths", dark, sign.UnlitLuminance,
      Promise, std::hypot(darkError, sign.MeanLuminanceError));
    EXPECT_NEAR(sign.UnlitLuminance, dark, Promise * dark + 3.0 * darkError);
  }
}

TEST(DeepRegime, Soot)
{
  CheckDeep("soot", 1, 0.01);
}

TEST(DeepRegime, WhiteSmoke)
{
  CheckDeep("white", 1, 0.006);
}

// Sources in such cells are exponential; linear ones that stay above 0 made the bars three and four
// times too bright.
TEST(DeepRegime, CellsOfFourMeanFreePaths)
{
  report::Head("Dark bars twelve mean free paths away, in cells of four, against cells of one");
  for (const double albedo : {0.6, 0.9})
  {
    const auto look = [albedo](int cut)
    {
      const Vec3 size(4.0, 2.0, 2.0);
      SceneDescription scene;
      scene.Albedo = albedo;
      scene.Grids = {scenes::UniformSmoke(Vec3(0.0), size, {8 * cut, 4 * cut, 4 * cut}, 8.0)};
      scenes::AddRoom(scene.Surfaces, Vec3(0.0), size, 0.5, 0.3);
      scene.Emitters =
        scenes::Barcode({4, 1, 1}, {-1, 0, 0}, {0, 0, 1}, 0.6, 0.3, 5, 100.0, 0, 0.2);
      scene.Emitters.push_back(
        scenes::Plate({1.0, 1.0, 1.99}, {0, 0, -1}, {1, 0, 0}, 0.6, 0.6, 100.0, 0.5));
      return MeasureSign(*Solved(scene, 0.1).TheView, 0, {2.5, 1.0, 1.0}, Observer{0.0});
    };
    const SignMeasurement coarse = look(1);
    const SignMeasurement fine = look(4);
    report::Relative("albedo " + std::to_string(albedo).substr(0, 3), fine.UnlitLuminance,
      coarse.UnlitLuminance, 0.35, std::hypot(fine.MeanLuminanceError, coarse.MeanLuminanceError));
  }
}

TEST(DeepRegime, FineCellsLong)
{
  CheckDeep("soot", 2, 0.003);
  CheckDeep("white", 2, 0.003);
}

} // namespace
