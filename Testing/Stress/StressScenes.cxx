#include "StressScenes.h"

#include "Dice.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace smokevis::stress
{

namespace
{

/// Uneven nodes between two bounds.
std::vector<double> DrawNodes(Dice& dice, double first, double last, int cells)
{
  std::vector<double> nodes{first};
  std::vector<double> widths;
  double sum = 0.0;
  const bool even = dice.Chance(0.5);
  for (int i = 0; i < cells; ++i)
  {
    widths.push_back(even ? 1.0 : dice.Magnitude(0.1, 1.0));
    sum += widths.back();
  }
  for (int i = 0; i + 1 < cells; ++i)
  {
    nodes.push_back(nodes.back() + (last - first) * widths[static_cast<std::size_t>(i)] / sum);
  }
  nodes.push_back(last);
  return nodes;
}

SmokeGrid DrawGrid(Dice& dice, const Vec3& lower, const Vec3& upper, double extinction)
{
  SmokeGrid grid;
  grid.Name = "drawn smoke";
  std::array<std::size_t, 3> size{};
  for (int axis = 0; axis < 3; ++axis)
  {
    const int cells = dice.Count(1, 7);
    grid.Nodes[axis] = DrawNodes(dice, lower[axis], upper[axis], cells);
    size[axis] = static_cast<std::size_t>(cells);
  }
  const int kind = dice.Count(0, 3);
  const double contrast = dice.OneOf({0.0, 0.5, 1.0});
  for (std::size_t k = 0; k < size[2]; ++k)
  {
    const double layer = kind == 1 && 2 * k < size[2] ? 0.0 : extinction;
    for (std::size_t cell = 0; cell < size[0] * size[1]; ++cell)
    {
      const double noise = kind == 2 ? 1.0 + contrast * dice.Between(-1.0, 1.0) : 1.0;
      const double hole = kind == 3 && dice.Chance(0.3) ? 0.0 : 1.0;
      grid.Extinction.push_back(static_cast<float>(layer * noise * hole));
    }
  }
  if (dice.Chance(0.1))
  {
    for (std::size_t cell = 0; cell < grid.Extinction.size(); ++cell)
    {
      grid.EmittedLuminance.push_back(
        dice.Chance(0.2) ? static_cast<float>(dice.Magnitude(0.1, 100.0)) : 0.0F);
    }
  }
  return grid;
}

void DrawSmoke(Dice& dice, const Vec3& upper, double extinction, StressScene& scene)
{
  std::vector<SmokeGrid>& grids = scene.Description.Grids;
  const double kind = dice.Between(0.0, 1.0);
  if (kind < 0.1)
  {
    scene.Name += ", no smoke";
    return;
  }
  if (kind < 0.2)
  {
    scene.Name += ", two meshes";
    const double cut = upper.x * dice.Between(0.3, 0.7);
    // In one face, or with a gap that is lost in rounding, or with a real one.
    const double gap = dice.OneOf({0.0, 1e-9, 0.1}) * upper.x;
    grids.push_back(DrawGrid(dice, Vec3(0.0), {cut, upper.y, upper.z}, extinction));
    grids.push_back(DrawGrid(dice, {cut + gap, 0.0, 0.0}, upper, extinction));
    return;
  }
  grids.push_back(DrawGrid(dice, Vec3(0.0), upper, extinction));
  if (kind < 0.3)
  {
    scene.Name += ", nested meshes";
    const Vec3 corner = dice.Inside(Vec3(0.0), 0.5 * upper);
    grids.push_back(DrawGrid(dice, corner, corner + 0.4 * upper, extinction));
  }
}

void DrawShapes(Dice& dice, const Vec3& upper, bool closed, StressScene& scene)
{
  SurfaceMesh& mesh = scene.Description.Surfaces;
  const double reflectance = closed ? dice.OneOf({0.0, 0.2, 0.5, 0.8, 0.95}) : 0.5;
  if (closed)
  {
    scene.Name += ", closed";
    scenes::AddRoom(mesh, Vec3(0.0), upper, glm::length(upper) / dice.Count(1, 4), reflectance);
  }
  const int blocks = dice.Count(0, 3);
  for (int block = 0; block < blocks; ++block)
  {
    const Vec3 lower = dice.Inside(Vec3(0.0), 0.8 * upper);
    const Vec3 size = dice.Inside(0.02 * upper, 0.3 * upper);
    const double shade = dice.Between(0.0, 1.0);
    if (dice.Chance(0.8))
    {
      scenes::AddBlock(mesh, lower, lower + size, 0.3 * glm::length(upper), shade);
    }
    else
    {
      // Inside out: its fronts face inwards.
      scenes::AddRoom(mesh, lower, lower + size, 0.3 * glm::length(upper), shade);
    }
  }
  if (mesh.Triangles.empty() || !dice.Chance(0.3))
  {
    return;
  }
  scene.Name += ", broken triangles";
  const std::size_t count = mesh.Triangles.size();
  for (int i = 0; i < 5; ++i)
  {
    const auto which = static_cast<std::size_t>(dice.Count(0, static_cast<int>(count) - 1));
    auto triangle = mesh.Triangles[which];
    const int kind = dice.Count(0, 2);
    if (kind == 1)
    {
      std::swap(triangle[0], triangle[1]);
    }
    else if (kind == 2)
    {
      triangle[2] = triangle[0];
    }
    mesh.Triangles.push_back(triangle);
    mesh.TriangleCell.push_back(mesh.TriangleCell[which]);
  }
}

void DrawEmitters(Dice& dice, const Vec3& upper, bool closed, StressScene& scene)
{
  std::vector<EmitterCell>& emitters = scene.Description.Emitters;
  const int signs = dice.Count(0, 3);
  for (int sign = 0; sign < signs; ++sign)
  {
    // On the wall x = upper.x, in it by a hair, half inside it, or anywhere.
    const bool onWall = closed && dice.Chance(0.7);
    const double hair = dice.OneOf({0.0, 0.0, 1e-9, -1e-9, 0.05}) * upper.x;
    const Vec3 centre = onWall ? Vec3(upper.x - hair, upper.y * dice.Between(0.2, 0.8),
                                   upper.z * dice.Between(0.0, 1.0))
                               : dice.Inside(0.1 * upper, 0.9 * upper);
    const Vec3 normal = onWall ? Vec3(-1, 0, 0) : dice.Direction();
    const Vec3 up = std::abs(normal.z) < 0.9 ? Vec3(0, 0, 1) : Vec3(1, 0, 0);
    const double size = std::min({upper.x, upper.y, upper.z});
    const auto cells = scenes::Barcode(centre, normal, up, size * dice.Magnitude(0.02, 0.4),
      size * dice.Magnitude(0.02, 0.3), 2 * dice.Count(0, 2) + 1, dice.Magnitude(1.0, 1e3),
      3 * sign, dice.OneOf({0.0, 0.1, 0.9}));
    emitters.insert(emitters.end(), cells.begin(), cells.end());
  }
  const int lamps = dice.Count(signs == 0 ? 1 : 0, 7);
  for (int lamp = 0; lamp < lamps; ++lamp)
  {
    const double size = upper.z * dice.Magnitude(1e-3, 0.3);
    emitters.push_back(scenes::Plate(dice.Inside(Vec3(0.0), upper), {0, 0, -1}, {1, 0, 0}, size,
      size, dice.Magnitude(0.1, 1e4), dice.OneOf({0.0, 0.5, 1.0})));
    emitters.back().Exponent = dice.OneOf({0.0, 0.0, 0.0, 1.0, 20.0});
  }
}

} // namespace

//--------------------------------------------------------------------------------------------------
StressScene DrawScene(std::uint64_t seed)
{
  Dice dice(seed, 11);
  StressScene scene;
  scene.Name = "seed " + std::to_string(seed);
  const Vec3 upper = dice.Inside(Vec3(2.0, 1.5, 1.5), Vec3(6.0, 4.0, 3.0));
  const bool closed = dice.Chance(0.7);
  scene.Description.Albedo = dice.OneOf({0.0, 0.3, 0.6, 0.9, 0.99, 1.0});
  // Of the whole scene; cells are a third of it on average.
  const double depth = dice.Chance(0.1) ? dice.Magnitude(20.0, 1e6) : dice.Magnitude(1e-3, 20.0);
  scene.Name += ", albedo " + std::to_string(scene.Description.Albedo).substr(0, 4) + ", depth " +
                std::to_string(depth);
  if (dice.Chance(0.1))
  {
    scene.Description.Bands = 3;
    scene.Description.ExtinctionScale = {1.0, 1.2, dice.OneOf({1.0, 1.4})};
  }
  DrawSmoke(dice, upper, depth / glm::length(upper), scene);
  DrawShapes(dice, upper, closed, scene);
  DrawEmitters(dice, upper, closed, scene);
  scene.Eye = dice.Inside(0.02 * upper, 0.98 * upper);
  scene.Tolerance = dice.OneOf({0.1, 0.03});
  if (dice.Chance(0.1))
  {
    const double factor = dice.Magnitude(1e-3, 1e3);
    scene.Name += ", scaled by " + std::to_string(factor);
    scene.Description = scenes::Scaled(std::move(scene.Description), factor);
    scene.Eye *= factor;
  }
  else if (dice.Chance(0.1))
  {
    const Vec3 offset = 1e5 * dice.Direction();
    scene.Name += ", far off";
    scene.Description = scenes::Moved(std::move(scene.Description), offset);
    scene.Eye += offset;
  }
  return scene;
}

//--------------------------------------------------------------------------------------------------
void ExpectSaneField(const Solved& solved)
{
  const auto direct = [](const std::vector<float>& values, const char* name)
  {
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      ASSERT_TRUE(std::isfinite(values[i]) && values[i] >= 0.0F)
        << "direct " << name << " " << i << ": " << values[i];
    }
  };
  direct(solved.Field->DirectFluence, "fluence");
  direct(solved.Field->DirectIlluminance, "illuminance");
  // Lines bring what differs from an expected value: the sum may fall below zero by its noise, and
  // by a rounding of the largest value.
  constexpr double Rounding = 1e-6;
  const auto multiple =
    [](const std::vector<Lanes>& values, const std::vector<float>& base, const char* name)
  {
    double largest = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      for (const float value : values[i].Value)
      {
        ASSERT_TRUE(std::isfinite(value)) << "multiple " << name << " " << i << ": " << value;
      }
      largest = std::max(largest, base[i] + Mean(values[i]));
    }
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      ASSERT_GE(base[i] + Mean(values[i]), -5.0 * StandardError(values[i]) - Rounding * largest)
        << name << " " << i << " of at most " << largest;
    }
  };
  multiple(solved.Field->MultipleFluence, solved.Field->DirectFluence, "fluence");
  multiple(solved.Field->MultipleIlluminance, solved.Field->DirectIlluminance, "illuminance");
}

//--------------------------------------------------------------------------------------------------
void ExpectSaneSign(const SignMeasurement& sign)
{
  for (const double value : {sign.Contrast, sign.ContrastError, sign.ContrastDivisionError,
         sign.PerceivedContrast, sign.PerceivedContrastError, sign.PerceivedContrastDivisionError,
         sign.MeanLuminance, sign.MeanLuminanceError, sign.LitLuminance, sign.UnlitLuminance,
         sign.OpticalDepth, sign.VisibleFraction})
  {
    EXPECT_TRUE(std::isfinite(value) && value >= 0.0) << value;
  }
  EXPECT_TRUE(std::isfinite(sign.WebberContrast)) << sign.WebberContrast;
  EXPECT_TRUE(std::isfinite(sign.UL924Contrast)) << sign.UL924Contrast;
  EXPECT_LE(sign.VisibleFraction, 1.0 + 1e-6);
}

} // namespace smokevis::stress
