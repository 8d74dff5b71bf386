// The few places that stand for a pattern's light.
#include "Emitters.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

EmitterCell Polygon(std::vector<Vec3> vertices, double luminance)
{
  EmitterCell cell;
  cell.Vertices = std::move(vertices);
  cell.Luminance = {luminance, 2.0 * luminance, 3.0 * luminance};
  cell.SignId = 0;
  return cell;
}

/// Bars of different width and luminance, and a triangle, in the plane x = 1.
std::vector<EmitterCell> Pattern()
{
  const auto bar = [](double from, double to, double luminance) {
    return Polygon({{1, from, 0}, {1, to, 0}, {1, to, 0.4}, {1, from, 0.4}}, luminance);
  };
  return {bar(0.0, 0.1, 50), bar(0.15, 0.2, 400), bar(0.5, 0.7, 20),
    Polygon({{1, 0.8, 0}, {1, 1.0, 0.1}, {1, 0.9, 0.4}}, 100)};
}

// A polynomial of degree n - 1 in each coordinate is summed exactly; its integral over the leaves
// is known from their exact quadrature.
TEST(PlateStencil, SumsPolynomialsExactly)
{
  EmitterSet lights(Pattern(), 3);
  lights.FormLights(1e9);
  ASSERT_EQ(lights.Lights().size(), 1U);
  const LightGroup& root = lights.Groups()[lights.Lights()[0]];
  ASSERT_NE(root.Stencil, nullptr);
  const auto polynomial = [](const Vec3& place, int degree)
  { return std::pow(1.3 - place.y, degree) * std::pow(0.2 + place.z, degree); };
  int seen = 0;
  for (const double distance : {1.5, 3.0, 30.0})
  {
    const auto places = root.Stencil->PlacesFor({1.0 + distance, 0.5, 0.2}, 1.0);
    const int across = static_cast<int>(std::lround(std::sqrt(places.size())));
    ASSERT_EQ(places.size(), static_cast<std::size_t>(across * across));
    seen += across;
    for (int degree = 0; degree < across; ++degree)
    {
      for (int band = 0; band < 3; ++band)
      {
        double exact = 0.0;
        // A fine midpoint rule over each leaf, whose error falls with the square of its step.
        constexpr int steps = 200;
        for (const LightGroup& leaf : lights.Groups())
        {
          for (int i = 0; leaf.FirstChild < 0 && i < steps * steps; ++i)
          {
            const double u = (i % steps + 0.5) / steps;
            const double v = (i / steps + 0.5) / steps;
            exact += leaf.Intensity[band] / leaf.Area * leaf.AreaAt(u, v) / (steps * steps) *
                     polynomial(leaf.At(u, v), degree);
          }
        }
        double sum = 0.0;
        for (const PlateStencil::Place& place : places)
        {
          sum += place.Intensity[band] * polynomial(place.Point, degree);
        }
        EXPECT_NEAR(sum, exact, 2e-5 * exact) << across << " across, degree " << degree;
      }
    }
  }
  EXPECT_EQ(seen, 5 + 4 + 3);
}

TEST(PlateStencil, ServesNoReceiverThatIsClose)
{
  EmitterSet lights(Pattern(), 1);
  lights.FormLights(1e9);
  const LightGroup& root = lights.Groups()[lights.Lights()[0]];
  EXPECT_TRUE(root.Stencil->PlacesFor({1.5, 0.5, 0.2}, 1.0).empty());
  // Light that changes quickly with the angle needs more distance.
  EXPECT_FALSE(root.Stencil->PlacesFor({3.0, 0.5, 0.2}, 1.0).empty());
  EXPECT_TRUE(root.Stencil->PlacesFor({3.0, 0.5, 0.2}, 4.0).empty());
}

} // namespace
