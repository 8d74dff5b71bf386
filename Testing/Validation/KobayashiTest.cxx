// Kobayashi's problem 1: a source cube in a void cube in a shield, eight octants of it (OECD/NEA
// 2000).
#include "SceneLibrary.h"
#include "Solved.h"
#include "TestReport.h"

#include <cmath>
#include <numbers>

namespace
{

using namespace smokevis;
constexpr double Pi = std::numbers::pi;

/// The report's centimetres are taken as metres here. Its mirror planes become the whole cube.
SceneDescription Problem1(double albedo)
{
  SceneDescription scene;
  scene.Albedo = albedo;
  // Cells of 10 / 3 m: the points of the table, at odd multiples of 5 m, are centres of cells.
  constexpr int Cells = 60;
  SmokeGrid grid = scenes::UniformSmoke(Vec3(-100.0), Vec3(100.0), {Cells, Cells, Cells}, 0.0);
  grid.EmittedLuminance.assign(grid.Extinction.size(), 0.0F);
  std::size_t cell = 0;
  for (int k = 0; k < Cells; ++k)
  {
    for (int j = 0; j < Cells; ++j)
    {
      for (int i = 0; i < Cells; ++i, ++cell)
      {
        const int out = std::max(
          {std::abs(2 * i + 1 - Cells), std::abs(2 * j + 1 - Cells), std::abs(2 * k + 1 - Cells)});
        const bool source = out < 6;
        const bool isVoid = !source && out < 30;
        grid.Extinction[cell] = isVoid ? 1e-4F : 0.1F;
        if (source)
        {
          // k_a L_emit = 1 / (4 pi): one particle a cubic centimetre and second.
          grid.EmittedLuminance[cell] = static_cast<float>(0.25 / Pi / (0.1 * (1.0 - albedo)));
        }
      }
    }
  }
  scene.Grids = {grid};
  return scene;
}

/// Fluence at a point: the luminance from all directions, on a Fibonacci lattice.
Estimate FluenceByViews(const Solved& solved, const Vec3& point, int directions)
{
  DoubleLanes total{};
  const double golden = Pi * (3.0 - std::sqrt(5.0));
  for (int i = 0; i < directions; ++i)
  {
    const double z = 1.0 - (2.0 * i + 1.0) / directions;
    const double r = std::sqrt(1.0 - z * z);
    const Vec3 direction(r * std::cos(golden * i), r * std::sin(golden * i), z);
    const Lanes light = solved.TheView->TraceVeil(point, direction, 0.0, 400.0, 0).TotalLanes();
    for (int batch = 0; batch < Batches; ++batch)
    {
      total[batch] += 4.0 * Pi * light[batch] / directions;
    }
  }
  return {Mean(total), StandardError(total)};
}

// Pure absorber: only the view's line integrals count, which are exact; the lattice of 400000
// directions resolves the source cube, 0.02 sr at the farthest point, to 0.3 %.
TEST(Kobayashi, PureAbsorberLong)
{
  report::Head("Kobayashi problem 1, pure absorber");
  const Solved solved(Problem1(0.0));
  const report::ReferenceTable table("kobayashi_problem1.csv");
  for (std::size_t row = 0; row < table.Rows(); ++row)
  {
    const Vec3 point(table.Number(row, "x"), table.Number(row, "y"), table.Number(row, "z"));
    const Estimate fluence = FluenceByViews(solved, point, 400000);
    report::Relative(table.Text(row, "line") + " " + table.Text(row, "x") + " " +
                       table.Text(row, "y") + " " + table.Text(row, "z"),
      table.Number(row, "phi_i_ref"), fluence.Mean, 0.005, fluence.StandardError);
  }
}

// Half scattering. Cells of a third of a mean free path: 2 % deep in the shield, where the fluence
// falls by 28 % from cell to cell.
TEST(Kobayashi, HalfScatteringLong)
{
  report::Head("Kobayashi problem 1, half scattering");
  const Solved solved(Problem1(0.5));
  const report::ReferenceTable table("kobayashi_problem1.csv");
  for (std::size_t row = 0; row < table.Rows(); ++row)
  {
    const Vec3 point(table.Number(row, "x"), table.Number(row, "y"), table.Number(row, "z"));
    const Estimate fluence = FluenceByViews(solved, point, 100000);
    const double reference = table.Number(row, "phi_ii_ref");
    report::Relative(table.Text(row, "line") + " " + table.Text(row, "x") + " " +
                       table.Text(row, "y") + " " + table.Text(row, "z"),
      reference, fluence.Mean, 0.02,
      std::hypot(fluence.StandardError, reference * table.Number(row, "relsd_ii_ref")));
  }
}

} // namespace
