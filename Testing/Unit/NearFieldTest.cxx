// Lattices of direct light near a plate, against sums over it and light taken at each point.
#include "NearField.h"
#include "DirectLight.h"
#include "NearLightScenes.h"
#include "NearLights.h"
#include "ReferenceIntegrator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

/// Integral of luminance times transmittance over the solid angle, by the midpoint rule.
double SumOverPlate(const SceneDescription& scene, const Vec3& point)
{
  constexpr int Steps = 120;
  double sum = 0.0;
  for (const EmitterCell& cell : scene.Emitters)
  {
    const Vec3 u = cell.Vertices[1] - cell.Vertices[0];
    const Vec3 v = cell.Vertices[3] - cell.Vertices[0];
    const double area = glm::length(glm::cross(u, v)) / (Steps * Steps);
    for (int i = 0; i < Steps * Steps; ++i)
    {
      const Vec3 to =
        cell.Vertices[0] + (i % Steps + 0.5) / Steps * u + (i / Steps + 0.5) / Steps * v - point;
      const double distance = glm::length(to);
      sum += 100.0 * area * std::max(0.0, to.x / distance) / (distance * distance) *
             std::exp(-test::SignExtinction * distance);
    }
  }
  return sum;
}

// Interpolation between the lattice's nodes: 0.5 %, a quarter of what the veil's promise allows,
// and 1.2 % where tolerances above 5 % let lattices be coarse.
TEST(NearField, FollowsThePattern)
{
  const SceneDescription description = test::BarredSign(9);
  const Scene scene(description);
  const DirectLight direct(scene);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const NearField near(scene, direct, 0, 1.0, infinity, false);
  const NearField coarse(scene, direct, 0, 1.0, infinity, true);
  for (const double height : {0.02, 0.05, 0.1, 0.2, 0.4, 0.8})
  {
    for (const double y : {0.78, 1.0, 1.13, 1.4})
    {
      const Vec3 point(2.0 - height, y, 1.05);
      const double expected = SumOverPlate(description, point);
      EXPECT_NEAR(near.Fluence(point, 0) / expected, 1.0, 0.005) << height << ' ' << y;
      EXPECT_NEAR(coarse.Fluence(point, 0) / expected, 1.0, 0.012) << height << ' ' << y;
    }
  }
  EXPECT_EQ(near.Fluence(Vec3(2.5, 1, 1), 0), 0.0);
}

// In smoke that differs from cell to cell like noise: steps of the lattice are as fine as that
// asks for. Steps that the plate alone asks for leave 2.5 % in the mean square.
TEST(NearField, SmokeLikeNoise)
{
  SceneDescription description = test::BarredSign(1);
  Pcg32 random(1, 1);
  for (float& extinction : description.Grids[0].Extinction)
  {
    extinction = static_cast<float>(0.2 + 1.6 * random.Uniform());
  }
  const Scene scene(description);
  const DirectLight direct(scene);
  const NearField& near = *scene.Near(0.01).Field(0);
  double squares = 0.0;
  constexpr int Points = 200;
  for (int i = 0; i < Points; ++i)
  {
    const Vec3 share(random.Uniform(), random.Uniform(), random.Uniform());
    const Vec3 point = Vec3(1.4, 0.6, 0.7) + share * Vec3(0.55, 0.8, 0.7);
    const double off = near.Fluence(point, 0) / direct.Fluence(0, point, true)[0] - 1.0;
    squares += off * off;
  }
  EXPECT_LT(std::sqrt(squares / Points), 0.01);
}

// Before a plate in smoke of hundreds of mean free paths a cell, a corner of which is free,
// lattices that are made for even smoke would tell of light many orders brighter than the plate.
TEST(NearField, ThickSmokeThatEnds)
{
  SceneDescription description = test::BarredSign(1);
  std::vector<float>& extinction = description.Grids[0].Extinction;
  for (std::size_t cell = 0; cell < extinction.size(); ++cell)
  {
    extinction[cell] = cell % 12 == 11 && cell % 144 / 12 < 7 ? 1500.0F : 0.01F;
  }
  const Scene scene(description);
  const DirectLight direct(scene);
  const NearField field(scene, direct, 0, 2.0);
  for (const double x : {0.3, 1.0, 1.4, 1.7, 1.82})
  {
    for (const double y : {0.2, 0.8, 1.0, 1.3, 1.9})
    {
      const Vec3 point(x, y, 1.05);
      const double expected = direct.Fluence(0, point, true)[0];
      EXPECT_NEAR(field.Fluence(point, 0), expected, 1e-6 * expected) << x << ' ' << y;
    }
  }
}

// Before lit bars, in smoke so dense that steps of the lattice are one to two mean free paths long;
// in the denser one numbers would overflow at the plate's ends if the lattice kept them without
// that smoke. Light falls by up to half over steps that are interpolated linearly, which leaves up
// to x^2 / 8 of it: an eighth, with what it differs by from the closed form.
TEST(NearField, DenseSmokeBeforeAPattern)
{
  for (const auto& [bars, dense] : {std::tuple(9, 120.0F), std::tuple(15, 340.0F)})
  {
    SceneDescription description = test::BarredSign(bars);
    std::vector<float>& extinction = description.Grids[0].Extinction;
    std::fill(extinction.begin(), extinction.end(), dense);
    const Scene scene(description);
    const DirectLight direct(scene);
    const NearField field(scene, direct, 0, 2.0);
    for (const double before : {0.003, 0.011, 0.025})
    {
      for (int bar = 0; bar < bars; bar += 4)
      {
        const Vec3 point(2.0 - before, 0.75 + 0.5 * (bar + 0.5) / bars, 1.13);
        const double expected = direct.Fluence(0, point, true)[0];
        EXPECT_NEAR(field.Fluence(point, 0), expected, 0.13 * expected)
          << dense << ' ' << before << ' ' << bar;
      }
    }
  }
}

// In smoke a plate's light falls off most steeply right before it: the lattice follows to 5 %
// where the plate is more than two mean free paths wide, to 2 % where it is one.
TEST(NearField, ThickSmokeBeforeALamp)
{
  for (const auto& [extinction, exponent, tolerance] :
    {std::tuple{4.0, 0.0, 0.055}, {1.0, 0.0, 0.015}, {4.0, 1.0, 0.055}, {1.0, 3.0, 0.02}})
  {
    const Scene scene(test::CeilingLamp(exponent, extinction));
    const DirectLight direct(scene);
    const NearField near(scene, direct, 0, 1.0);
    for (const double height : {0.005, 0.01, 0.025, 0.05, 0.1, 0.15})
    {
      const Vec3 point(2.03, 1.9, 3 - height);
      EXPECT_NEAR(near.Fluence(point, 0) / direct.Fluence(0, point)[0], 1.0, tolerance)
        << extinction << ' ' << exponent << ' ' << height;
    }
  }
}

} // namespace
