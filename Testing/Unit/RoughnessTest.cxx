// How rough values over a plate are.
#include "Roughness.h"

#include <vector>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

constexpr int Columns = 12;
constexpr int Rows = 10;

std::vector<SeenPlace> Places()
{
  std::vector<SeenPlace> places;
  for (int i = 0; i < Columns * Rows; ++i)
  {
    SeenPlace& place = places.emplace_back();
    place.OnPlate = {(i % Columns + 0.5) / Columns, (i / Columns + 0.5) / Rows};
    place.Weight = 1e-4 * (1.0 + 0.1 * place.OnPlate.x);
  }
  return places;
}

std::vector<double> Quadratic(const std::vector<SeenPlace>& places)
{
  std::vector<double> values;
  for (const SeenPlace& place : places)
  {
    const double u = place.OnPlate.x;
    const double v = place.OnPlate.y;
    values.push_back(20.0 + 3.0 * u - 5.0 * v + 2.0 * u * u - 4.0 * u * v + 7.0 * v * v);
  }
  return values;
}

TEST(Roughness, NoneOfAQuadratic)
{
  const std::vector<SeenPlace> places = Places();
  EXPECT_NEAR(Roughness(places, Quadratic(places)), 0.0, 1e-10);
}

// What changes sign from place to place has next to nothing in common with any quadratic.
TEST(Roughness, OfAChequerboard)
{
  const std::vector<SeenPlace> places = Places();
  std::vector<double> values = Quadratic(places);
  for (int i = 0; i < Columns * Rows; ++i)
  {
    values[i] += (i % Columns + i / Columns) % 2 == 0 ? 0.1 : -0.1;
  }
  EXPECT_NEAR(Roughness(places, values), 0.1, 0.002);
}

// Of a step halfway across, the closest line takes three quarters of the variance: half of half
// the step's height is left. Twelve places across and their weights change that by 1.5 %.
TEST(Roughness, OfAStep)
{
  const std::vector<SeenPlace> places = Places();
  std::vector<double> values;
  for (const SeenPlace& place : places)
  {
    values.push_back(place.OnPlate.x < 0.5 ? 0.0 : 0.2);
  }
  EXPECT_NEAR(Roughness(places, values), 0.05, 0.001);
}

TEST(Roughness, FewPlacesTellNone)
{
  std::vector<SeenPlace> places = Places();
  places.resize(3);
  EXPECT_NEAR(Roughness(places, {1.0, 5.0, 2.0}), 0.0, 1e-10);
  EXPECT_EQ(Roughness({}, {}), 0.0);
}

} // namespace
