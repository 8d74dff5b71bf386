// Light straight from a sign through absorbing smoke, against quadrature to ten digits.
#include "SceneLibrary.h"
#include "Solved.h"
#include "TestReport.h"

#include <algorithm>

namespace
{

using namespace smokevis;

/// Nodes that put a cell of the given size around each coordinate.
std::vector<double> NodesAround(std::vector<double> centres, double size, double first, double last)
{
  std::vector<double> nodes = {first, last};
  std::sort(centres.begin(), centres.end());
  centres.erase(std::unique(centres.begin(), centres.end()), centres.end());
  for (const double centre : centres)
  {
    nodes.push_back(centre - 0.5 * size);
    nodes.push_back(centre + 0.5 * size);
  }
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

EmitterCell TableSign()
{
  return scenes::Plate(Vec3(0.0), {0, 0, 1}, {0, 1, 0}, 0.4, 0.2, 1.0, 0.0, 0);
}

/// K = 0 is posed as an extinction too small to matter, so that there is smoke to hold a fluence.
double Extinction(double tabulated)
{
  return tabulated > 0.0 ? tabulated : 1e-6;
}

// Cells of 1 cm hold the points: the mean over a cell differs from its centre's value by
// h^2 / 24 times the Laplacian, which for 1 / r^2 at 0.5 m is 2 h^2 / (24 r^2) = 3e-5.
TEST(AreaLight, DirectFluence)
{
  report::Head("Uncollided fluence of a 0.4 x 0.2 m sign");
  const report::ReferenceTable table("area_light_uncollided.csv");
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> z;
  for (std::size_t row = 0; row < table.Rows(); ++row)
  {
    x.push_back(table.Number(row, "x"));
    y.push_back(table.Number(row, "y"));
    z.push_back(table.Number(row, "z"));
  }
  for (const double extinction : {0.0, 0.5, 1.0, 2.0})
  {
    SceneDescription description;
    description.Albedo = 0.01;
    SmokeGrid grid;
    grid.Name = "smoke";
    grid.Nodes = {NodesAround(x, 0.01, -1.0, 4.0), NodesAround(y, 0.01, -3.0, 1.0),
      NodesAround(z, 0.01, 0.0, 11.0)};
    grid.Extinction.assign(
      (grid.Nodes[0].size() - 1) * (grid.Nodes[1].size() - 1) * (grid.Nodes[2].size() - 1),
      static_cast<float>(Extinction(extinction)));
    description.Grids = {grid};
    description.Emitters = {TableSign()};
    // Only the direct part is read: what is scattered need not converge.
    const Solved solved(description, 1.0);
    for (std::size_t row = 0; row < table.Rows(); ++row)
    {
      if (table.Number(row, "K") != extinction)
      {
        continue;
      }
      const Vec3 point(table.Number(row, "x"), table.Number(row, "y"), table.Number(row, "z"));
      const std::int64_t cell = solved.TheScene->Smoke().Locate(point);
      ASSERT_GE(cell, 0);
      report::Relative("K " + table.Text(row, "K") + " at " + table.Text(row, "x") + " " +
                         table.Text(row, "y") + " " + table.Text(row, "z"),
        table.Number(row, "G0"), solved.Field->DirectFluence[static_cast<std::size_t>(cell)], 1e-3);
    }
  }
}

// Patches of 1 cm; by symmetry of the square the error is again second order, 1e-4 at most.
TEST(AreaLight, DirectIlluminance)
{
  report::Head("Uncollided illuminance of a 0.4 x 0.2 m sign");
  const report::ReferenceTable table("area_light_uncollided.csv");
  for (std::size_t row = 0; row < table.Rows(); ++row)
  {
    const Vec3 point(table.Number(row, "x"), table.Number(row, "y"), table.Number(row, "z"));
    for (const bool facing : {true, false})
    {
      SceneDescription description;
      description.Albedo = 0.0;
      description.Grids = {scenes::UniformSmoke(
        {-1, -3, 0}, {4, 1, 11}, {1, 1, 1}, Extinction(table.Number(row, "K")))};
      description.Emitters = {TableSign()};
      const Vec3 u = facing ? Vec3(0, 0.01, 0) : Vec3(0, 0, 0.01);
      const Vec3 v = Vec3(0.01, 0, 0);
      scenes::AddRectangle(description.Surfaces, point - 0.5 * (u + v), u, v, 1, 1, 0.0);
      const Solved solved(description);
      report::Relative(std::string(facing ? "facing" : "up") + " K " + table.Text(row, "K") +
                         " at " + table.Text(row, "x") + " " + table.Text(row, "y") + " " +
                         table.Text(row, "z"),
        table.Number(row, facing ? "H_facing" : "H_up"), solved.Field->DirectIlluminance[0], 1e-3);
    }
  }
}

} // namespace
