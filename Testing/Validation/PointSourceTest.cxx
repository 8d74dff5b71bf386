// A point source in uniform smoke: airlight of single scattering, and the fluence with all orders.
#include "PolygonClip.h"
#include "SceneLibrary.h"
#include "Solved.h"
#include "TestReport.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

namespace
{

using namespace smokevis;
using std::numbers::pi;

/// A small icosahedron of Lambertian faces that stands for a point source. Its intensity in a
/// direction is luminance times projected area; by Cauchy's theorem the mean of that is a quarter
/// of the surface.
std::vector<EmitterCell> PointSource(const Vec3& centre, double radius, double intensity)
{
  std::vector<EmitterCell> cells = scenes::EmittingSphere(centre, radius, 0, false, 1.0, 0.0);
  double area = 0.0;
  for (const EmitterCell& cell : cells)
  {
    area += glm::length(AreaVector(cell.Vertices));
  }
  for (EmitterCell& cell : cells)
  {
    cell.Luminance.fill(4.0 * intensity / area);
  }
  return cells;
}

/// Intensity of the source in a direction, which differs from the mean by up to 5 %.
double Intensity(const std::vector<EmitterCell>& source, const Vec3& direction)
{
  double sum = 0.0;
  for (const EmitterCell& cell : source)
  {
    sum += cell.Luminance[0] * std::max(0.0, glm::dot(AreaVector(cell.Vertices), direction));
  }
  return sum;
}

/// Airlight of the icosahedron over that of an isotropic source of the same mean intensity 1, by
/// the midpoint rule over the angle at the source, in which the integrand is smooth.
double ShapeFactor(
  const std::vector<EmitterCell>& source, const Vec3& at, const Vec3& direction, double length)
{
  const double along = glm::dot(at, direction);
  const Vec3 foot = direction * along;
  const double height = glm::length(at - foot);
  const double first = std::atan2(-along, height);
  const double last = std::atan2(length - along, height);
  constexpr int Steps = 2000;
  double shaped = 0.0;
  double isotropic = 0.0;
  for (int step = 0; step < Steps; ++step)
  {
    const double angle = first + (last - first) * (step + 0.5) / Steps;
    const double x = along + height * std::tan(angle);
    const double distance = height / std::cos(angle);
    // dx / d^2 = d(angle) / height.
    const double weight = std::exp(-(x + distance));
    isotropic += weight;
    shaped += weight * Intensity(source, glm::normalize(x * direction - at));
  }
  return shaped / isotropic;
}

/// Airlight of a point source by single scattering in smoke of 1 mean free path a metre: the eye at
/// the origin, the source on the x axis, rays in the plane z = 0. No ray or way from the source to
/// it leaves the smoke.
class Airlight
{
public:
  /// Far from the source, light falls off beside a ray within less than a mean free path.
  explicit Airlight(double distance)
      : At_(distance, 0, 0), Source_(PointSource(At_, 0.0005, 1.0)),
        Solved_(Smoke(Source_, distance > 2.0 ? 3 : 1), 0.05)
  {
  }

  /// Compares with a reference for an albedo of 1, to the 1 % that is promised for luminance.
  void Check(const std::string& name, double angle, double length, double reference) const
  {
    // Beyond 15 mean free paths lies less than 1e-6 of the light.
    const double end = std::min(15.0, length);
    const Vec3 direction(std::cos(angle * pi / 180.0), std::sin(angle * pi / 180.0), 0.0);
    const RayLight light = this->Solved_.TheView->TraceVeil(Vec3(0.0), direction, 0.0, end, 0);
    report::Relative(name, reference * ShapeFactor(this->Source_, this->At_, direction, end),
      light.Veil() / Albedo, 0.01, StandardError(light.VeilMultiple) / Albedo);
  }

private:
  /// So low that light of the second order is next to nothing.
  static constexpr double Albedo = 1e-6;

  /// @param parts of a mean free path that cells are wide
  static SceneDescription Smoke(const std::vector<EmitterCell>& source, int parts)
  {
    SceneDescription description;
    description.Albedo = Albedo;
    description.Grids = {
      scenes::UniformSmoke({-20, -3, -3}, {20, 20, 3}, {40 * parts, 23 * parts, 6 * parts}, 1.0)};
    description.Emitters = source;
    return description;
  }

  Vec3 At_;
  std::vector<EmitterCell> Source_;
  Solved Solved_;
};

// L = omega I0 beta^2 Lhat (Sun et al. 2005).
TEST(PointSource, AirlightOfSingleScattering)
{
  report::Head("Airlight of a point source, single scattering");
  const report::ReferenceTable table("airlight_single_scatter_point.csv");
  std::map<double, std::unique_ptr<Airlight>> airlights;
  for (std::size_t row = 0; row < table.Rows(); ++row)
  {
    const double distance = table.Number(row, "T_sv");
    std::unique_ptr<Airlight>& airlight = airlights[distance];
    if (!airlight)
    {
      airlight = std::make_unique<Airlight>(distance);
    }
    airlight->Check("distance " + table.Text(row, "T_sv") + " angle " +
                      table.Text(row, "gamma_deg") + " depth " + table.Text(row, "T_vp"),
      table.Number(row, "gamma_deg"), table.Number(row, "T_vp"), table.Number(row, "Lhat_direct"));
  }
}

// The same by the function F(u, v) of Sun et al.: a ray at gamma = 2 v1 from the way to a source at
// T = u / sin(gamma) mean free paths passes it at u. As far as where the source sees it at 2 v2 -
// 90 degrees beyond the foot of the perpendicular, it gathers exp(-T cos(gamma)) / (2 pi u) (F(u,
// v2) - F(u, v1)).
TEST(PointSource, AirlightByTheFunctionF)
{
  report::Head("Airlight of a point source by F(u, v)");
  const report::ReferenceTable table("airlight_F_function.csv");
  constexpr double Degree = pi / 180.0;
  int rows = 0;
  for (std::size_t from = 0; from < table.Rows(); ++from)
  {
    const double u = table.Number(from, "u");
    const double angle = 2.0 * table.Number(from, "v_deg");
    const double distance = u / std::sin(angle * Degree);
    if (u == 0.0 || angle >= 150.0 || distance > 2.0)
    {
      continue;
    }
    const Airlight airlight(distance);
    const double along = distance * std::cos(angle * Degree);
    for (std::size_t to = from + 1; to < table.Rows() && table.Number(to, "u") == u; ++to, ++rows)
    {
      const double end = 2.0 * table.Number(to, "v_deg") - 90.0;
      airlight.Check("u " + table.Text(from, "u") + " v " + table.Text(from, "v_deg") + " to " +
                       table.Text(to, "v_deg"),
        angle, end < 90.0 ? along + u * std::tan(end * Degree) : INFINITY,
        std::exp(-along) / (2.0 * pi * u) * (table.Number(to, "F") - table.Number(from, "F")));
    }
  }
  EXPECT_EQ(rows, 72);
}

// Fluence of 1 lm in an infinite medium (Case, de Hoffmann and Placzek 1953), read on the axes at
// 1 to 10 mean free paths; walls of the volume are 14 mean free paths away, from beyond which less
// than exp(-8) of the fluence at 10 comes back. The source's own neighbourhood is steep: cells grow
// from 0.1 mean free paths to 0.6. A flat source in cells of h mean free paths errs by h^2 / 12 of
// the local fall, 2 to 3 % in the coarsest. Far off, where few lines pass, cells beside the axes
// count, too: their centres are farther away by at most 0.0025 mean free paths, or 0.3 %.
TEST(PointSource, InfiniteMediumLong)
{
  report::Head("Fluence of a point source in an infinite medium");
  const report::ReferenceTable table("infinite_medium_point_source.csv");
  std::vector<double> nodes;
  for (const double at : {0.05, 0.15, 0.25, 0.35, 0.5, 0.65, 0.8, 0.95, 1.05, 1.3, 1.6, 1.95, 2.05,
         2.35, 2.65, 2.95, 3.05, 3.5, 3.95, 4.4, 4.9, 5.1, 5.6, 6.1, 6.7, 7.3, 7.85, 8.15, 8.7, 9.3,
         9.85, 10.15, 11.0, 12.0, 14.0})
  {
    nodes.push_back(at);
    nodes.push_back(-at);
  }
  std::sort(nodes.begin(), nodes.end());
  for (const double albedo : {0.5, 0.9})
  {
    SceneDescription description;
    description.Albedo = albedo;
    SmokeGrid grid;
    grid.Name = "smoke";
    grid.Nodes = {nodes, nodes, nodes};
    const std::size_t size = nodes.size() - 1;
    grid.Extinction.assign(size * size * size, 1.0F);
    description.Grids = {grid};
    description.Emitters = PointSource(Vec3(0.0), 0.01, 0.25 / pi);
    const Solved solved(description);
    for (std::size_t row = 0; row < table.Rows(); ++row)
    {
      const double r = table.Number(row, "r");
      if (table.Number(row, "omega") != albedo || r < 1.0 || r > 10.0)
      {
        continue;
      }
      const bool far = r > 3.0;
      const std::vector<double> beside =
        far ? std::vector<double>{-0.1, 0.0, 0.1} : std::vector<double>{0.0};
      std::vector<std::int64_t> cells;
      for (int axis = 0; axis < 3; ++axis)
      {
        for (const double along : {-r, r})
        {
          for (const double across : beside)
          {
            for (const double up : beside)
            {
              Vec3 point;
              point[axis] = along;
              point[(axis + 1) % 3] = across;
              point[(axis + 2) % 3] = up;
              cells.push_back(solved.TheScene->Smoke().Locate(point));
            }
          }
        }
      }
      const Estimate fluence = solved.Fluence(cells);
      report::Relative("albedo " + table.Text(row, "omega") + " r " + table.Text(row, "r"),
        table.Number(row, "G"), fluence.Mean, far ? 0.03 : 0.02, fluence.StandardError);
    }
  }
}

} // namespace
