// Tables of luminous intensity against closed forms.
#include "EmissionLaw.h"
#include "Errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;
using std::numbers::pi;

std::vector<double> Angles(double last, int intervals)
{
  std::vector<double> angles;
  for (int i = 0; i <= intervals; ++i)
  {
    angles.push_back(last * i / intervals);
  }
  return angles;
}

template <class Function>
std::vector<double> Fill(
  const std::vector<double>& polar, const std::vector<double>& azimuth, Function&& intensity)
{
  std::vector<double> values;
  for (const double c : azimuth)
  {
    for (const double g : polar)
    {
      values.push_back(intensity(g * pi / 180.0, c * pi / 180.0));
    }
  }
  return values;
}

// An even intensity I sends 2 pi I into the half-sphere; one that falls linearly from I at the
// normal to 0 at its plane 2 pi I (1 - 2 / pi) (by parts); both are exact, as the interpolation is
// linear.
TEST(IntensityTable, FluxOfLinearIntensities)
{
  const std::vector<double> polar = {0, 20, 30, 90};
  EXPECT_NEAR(IntensityTable::Flux(polar, {0.0}, {3, 3, 3, 3}), 6.0 * pi, 1e-12);
  const auto falling = [](double g, double) { return 1.0 - g / (0.5 * pi); };
  const auto around = Angles(360, 3);
  EXPECT_NEAR(IntensityTable::Flux(polar, around, Fill(polar, around, falling)),
    2.0 * pi * (1.0 - 2.0 / pi), 1e-12);
  // Linear in the azimuth: the mean of both ends.
  const std::vector<double> uneven = {0, 90, 360};
  EXPECT_NEAR(IntensityTable::Flux({0, 90}, uneven, {0, 0, 1, 1, 0, 0}), pi, 1e-12);
}

// The scaled table of a Lambertian plate is the cosine; 1 degree apart, chords miss the arc by
// h^2 / 8 = 4e-5 at most.
TEST(IntensityTable, LambertianIsTheCosine)
{
  const auto polar = Angles(90, 90);
  const IntensityTable table(
    polar, {0.0}, Fill(polar, {0.0}, [](double g, double) { return 250.0 * std::cos(g); }));
  for (const double g : {0.0, 0.3, 1.0, 1.55})
  {
    EXPECT_NEAR(table.Value(std::sin(g), 0.0, std::cos(g)), std::cos(g), 1e-4);
  }
  EXPECT_NEAR(table.Sharpness(), 1.0, 1e-4);
  EXPECT_EQ(table.Value(std::sqrt(0.99), 0.0, -0.1), 0.0);
}

// Values between nodes follow the two angles linearly, also across azimuth 360.
TEST(IntensityTable, BilinearInBothAngles)
{
  const std::vector<double> polar = {0, 30, 90};
  const std::vector<double> azimuth = {0, 90, 180, 270, 360};
  const std::vector<double> values = {1, 2, 3, 1, 4, 5, 1, 6, 7, 1, 8, 9, 1, 2, 3};
  const IntensityTable table(polar, azimuth, values);
  const double scale = pi / IntensityTable::Flux(polar, azimuth, values);
  const auto at = [&](double g, double c)
  {
    g *= pi / 180.0;
    c *= pi / 180.0;
    return table.Value(std::sin(g) * std::cos(c), std::sin(g) * std::sin(c), std::cos(g)) / scale;
  };
  EXPECT_NEAR(at(30, 45), 3.0, 1e-9);
  EXPECT_NEAR(at(60, 90), 4.5, 1e-9);
  EXPECT_NEAR(at(30, 315), 5.0, 1e-9);
  EXPECT_NEAR(at(45, 200), 0.75 * (6 + 2.0 * 20 / 90) + 0.25 * (7 + 2.0 * 20 / 90), 1e-9);
}

TEST(IntensityTable, RefusesWhatIsNoDistribution)
{
  EXPECT_THROW(IntensityTable({0, 80}, {0}, {1, 1}), Error);
  EXPECT_THROW(IntensityTable({0, 90, 90}, {0}, {1, 1, 1}), Error);
  EXPECT_THROW(IntensityTable({0, 90}, {0, 180}, {1, 1, 1, 1}), Error);
  EXPECT_THROW(IntensityTable({0, 90}, {0}, {1, -1}), Error);
  EXPECT_THROW(IntensityTable({0, 90}, {0}, {0, 0}), Error);
  EXPECT_THROW(IntensityTable({0, 90}, {0}, {1, NAN}), Error);
  EXPECT_THROW(IntensityTable({0, 90}, {0}, {1}), Error);
}

// Whole exponents or not, to a rounding to double of each factor.
TEST(EmissionLaw, PowersOfTheCosine)
{
  for (const double exponent : {0.0, 0.5, 1.0, 2.0, 2.5, 5.0, 20.0, 127.0, 128.0, 129.0, 1e6})
  {
    for (const double cosine : {1e-3, 0.3, 0.99, 1.0})
    {
      const double expected = std::pow(cosine, exponent);
      EXPECT_NEAR(EmissionLaw(exponent).Relative(Vec3(0.0), cosine), expected,
        2e-16 * std::max(1.0, exponent) * expected)
        << exponent << " " << cosine;
    }
  }
}

TEST(EmissionLaw, CoarserOutsideItsBeam)
{
  const EmissionLaw sharp(20.0);
  // 0.79^20 is just below a hundredth, 0.39^20 below 1e-8.
  EXPECT_EQ(sharp.Coarseness(0.8, 1.0), 1.0);
  EXPECT_EQ(sharp.Coarseness(0.79, 1.0), 2.0);
  EXPECT_EQ(sharp.Coarseness(0.39, 1.0), std::numeric_limits<double>::infinity());
  EXPECT_EQ(sharp.Coarseness(-1.0, 1.0), std::numeric_limits<double>::infinity());
  // What may touch the light, or lie in its beam.
  EXPECT_EQ(sharp.Coarseness(0.5, -0.1), 1.0);
  EXPECT_EQ(sharp.Coarseness(2.0, 1.0), 1.0);
  EXPECT_EQ(EmissionLaw().Coarseness(1e-9, 1.0), 1.0);
}

// Luminance times cosine is the intensity; the azimuth grows counter-clockwise from above for a
// lamp that shines down (LM-63, type C).
TEST(EmissionLaw, TableInItsFrame)
{
  const std::vector<double> azimuth = {0, 90, 180, 270, 360};
  const std::vector<double> values = {1, 1, 1, 4, 1, 1, 1, 1, 1, 1};
  const IntensityTable table({0, 90}, azimuth, values);
  const double scale = pi / IntensityTable::Flux({0, 90}, azimuth, values);
  const EmissionLaw law(table, {1, 0, 0.2}, {0, 0, -1});
  const double part = std::sqrt(0.5);
  EXPECT_NEAR(law.Relative({0, part, -part}, part) * part, 2.5 * scale, 1e-9);
  EXPECT_NEAR(law.Relative({0, -part, -part}, part) * part, 1.0 * scale, 1e-9);
  EXPECT_NEAR(law.Relative({part, 0, -part}, part) * part, 1.0 * scale, 1e-9);
  EXPECT_EQ(law.Relative({1, 0, 0}, 0.0), 0.0);
  EXPECT_NEAR(law.UnitFlux(), pi, 1e-12);
  EXPECT_THROW(EmissionLaw(table, {0, 0, 2}, {0, 0, -1}), Error);
}

} // namespace
