// Means of exponentials, held against their closed forms in more digits and against their series.
#include "ExponentialMean.h"

#include <cmath>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

// On both sides of where the fraction gives way to the closed form. Extended precision has 19
// digits, of which the difference of nearly equal terms leaves 16 at 0.05.
TEST(Langevin, IsItsClosedForm)
{
  for (const double h : {0.05, 0.3, 1.0, 1.7, 1.999, 2.0, 2.001, 3.0, 10.0, 700.0})
  {
    const long double x = h;
    const auto exact = static_cast<double>(1.0L / std::tanh(x) - 1.0L / x);
    EXPECT_NEAR(Langevin(h) / exact, 1.0, 5e-12) << "h = " << h;
    EXPECT_EQ(Langevin(-h), -Langevin(h));
  }
}

// coth h = 1 / h + h / 3 - h^3 / 45 + ... (Abramowitz and Stegun 4.5.67).
TEST(Langevin, IsItsSeriesNearZero)
{
  EXPECT_EQ(Langevin(0.0), 0.0);
  for (const double h : {1e-300, 1e-12, 1e-5, 1e-3})
  {
    EXPECT_NEAR(Langevin(h) / (h / 3.0 * (1.0 - h * h / 15.0)), 1.0, 1e-13) << "h = " << h;
  }
}

TEST(Langevin, HasAnInverse)
{
  for (const double h : {-2.0, -1.3, -1e-3, 0.0, 1e-6, 0.2, 0.9, 1.6, 1.99})
  {
    EXPECT_NEAR(InverseLangevin(Langevin(h)), h, 1e-5) << "h = " << h;
  }
  EXPECT_EQ(InverseLangevin(0.7), 2.0);
  EXPECT_EQ(InverseLangevin(-1.5), -2.0);
}

TEST(LogarithmOfMean, IsItsClosedForm)
{
  for (const double h : {1e-3, 0.03, 0.5, 2.0, 20.0, 700.0})
  {
    const long double x = h;
    const auto exact = static_cast<double>(std::log(std::sinh(x) / x));
    // Near zero the logarithm is of a number near 1, which has 16 digits.
    EXPECT_NEAR(LogarithmOfMean(h), exact, 1e-15 + 1e-14 * exact) << "h = " << h;
    EXPECT_EQ(LogarithmOfMean(-h), LogarithmOfMean(h));
  }
  EXPECT_EQ(LogarithmOfMean(0.0), 0.0);
  // Where the series' first term stands for it, h^4 / 180 is left out.
  EXPECT_NEAR(LogarithmOfMean(9.9e-4), 9.9e-4 * 9.9e-4 / 6.0, 1e-14);
  // Beyond what sinh can hold.
  EXPECT_NEAR(LogarithmOfMean(1e4), 1e4 - std::log(2e4), 1e-10);
}

} // namespace
