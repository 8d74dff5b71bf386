// A dense cloud in much clear air, against the reference integrator.
#include "ReferenceIntegrator.h"
#include "SceneLibrary.h"
#include "Solved.h"
#include "TestReport.h"
#include "WorkCount.h"

#include <algorithm>
#include <cmath>

namespace
{

using namespace smokevis;

/// Checks the fluence in layers of a cloud below a lamp in clear air. The smoke as a whole scatters
/// little, but inside the cloud light is scattered hundreds of times: diffusion completes it.
/// @param cells along an edge of all smoke, of which the cloud has half
void CheckCloud(int cells, double tolerance)
{
  constexpr double edge = 4.0;
  const double cell = edge / cells;
  SceneDescription scene;
  scene.Albedo = 0.99;
  SmokeGrid grid = scenes::UniformSmoke(Vec3(0.0), Vec3(edge), {cells, cells, cells}, 8.0);
  for (int i = 0; i < cells * cells * cells; ++i)
  {
    if (std::max({i % cells, i / cells % cells, i / (cells * cells)}) >= cells / 2)
    {
      grid.Extinction[i] = 0.01F;
    }
  }
  scene.Grids = {grid};
  scenes::AddRoom(scene.Surfaces, Vec3(0.0), Vec3(edge), 1.0, 0.0);
  scene.Emitters = {scenes::Plate({1, 1, 2.4}, {0, 0, -1}, {1, 0, 0}, 0.5, 0.5, 100.0)};
  const Solved solved(scene, 0.03);
  EXPECT_GT(WorkCount(solved.Field->Report, "blocks of diffusion"), 0.0);
  const ReferenceIntegrator reference(*solved.TheScene);
  report::Head("Fluence in a dense cloud below a lamp, in cells of " +
               std::to_string(8.0 * cell).substr(0, 3) + " mean free paths [lx]");
  const int quarter = cells / 8;
  for (const int layer : {3 * quarter, 2 * quarter, quarter, quarter / 4})
  {
    std::vector<std::int64_t> inside;
    for (int i = quarter; i < 3 * quarter; ++i)
    {
      for (int j = quarter; j < 3 * quarter; ++j)
      {
        inside.push_back((static_cast<std::int64_t>(layer) * cells + j) * cells + i);
      }
    }
    const Estimate expected = reference.MeanFluence(
      [&](Pcg32& random)
      {
        const Vec3 share(random.Uniform(), random.Uniform(), random.Uniform());
        return cell * (Vec3(quarter, quarter, layer) + share * Vec3(2 * quarter, 2 * quarter, 1));
      },
      100000, 1);
    const Estimate found = solved.Fluence(inside);
    report::Relative("at " + std::to_string(cell * (layer + 0.5)).substr(0, 5) + " m",
      expected.Mean, found.Mean, tolerance,
      std::hypot(expected.StandardError, found.StandardError));
  }
}

// In cells of one mean free path linear sources are right to about 3 % sixteen of them deep.
TEST(Cloud, InMuchClearAirLong)
{
  CheckCloud(32, 0.03);
}

// In cells of two the light before the lamp comes out up to a tenth too bright, as the solver's
// README says.
TEST(Cloud, InCoarseCells)
{
  CheckCloud(16, 0.1);
}

} // namespace
