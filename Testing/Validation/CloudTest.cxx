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

// The smoke as a whole scatters little, but inside the cloud light is scattered hundreds of times:
// diffusion completes it. Cells are one mean free path wide: linear sources in them are right to
// about 3 % sixteen mean free paths deep.
TEST(Cloud, InMuchClearAir)
{
  constexpr int cells = 32;
  constexpr double edge = 4.0;
  constexpr double cell = edge / cells;
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
  report::Head("Fluence in layers of a dense cloud below a lamp [lx]");
  for (const int layer : {12, 8, 4, 1})
  {
    std::vector<std::int64_t> inside;
    for (int i = 4; i < 12; ++i)
    {
      for (int j = 4; j < 12; ++j)
      {
        inside.push_back((static_cast<std::int64_t>(layer) * cells + j) * cells + i);
      }
    }
    const Estimate expected = reference.MeanFluence(
      [&](Pcg32& random)
      {
        const Vec3 share(random.Uniform(), random.Uniform(), random.Uniform());
        return cell * (Vec3(4, 4, layer) + share * Vec3(8, 8, 1));
      },
      100000, 1);
    const Estimate found = solved.Fluence(inside);
    report::Relative("at " + std::to_string(cell * (layer + 0.5)).substr(0, 5) + " m",
      expected.Mean, found.Mean, 0.03, std::hypot(expected.StandardError, found.StandardError));
  }
}

} // namespace
