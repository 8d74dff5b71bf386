// What steep sources send out of a piece of a ray, held against quadrature.
#include "ExponentialSource.h"

#include <cmath>
#include <functional>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

double Integral(const std::function<double(double)>& function)
{
  return boost::math::quadrature::gauss_kronrod<double, 31>::integrate(
    function, 0.0, 1.0, 12, 1e-12);
}

// A source exp(r (t - 1/2)) at the share t of a piece of depth d adds d exp(-d (1 - t)) of itself
// at the end and d exp(-d t) at the beginning. What is left of 2 stays inside, which of an even
// source is 2 - 2 (1 - exp(-d)) / d. Single precision leaves 1e-4 of small differences.
TEST(ExponentialSource, IsItsIntegral)
{
  for (const double depth : {1e-4, 0.019, 0.021, 0.1, 0.7, 3.0, 40.0})
  {
    for (const double rise : {0.0, 1e-3, 0.09, 0.11, 0.7, -2.0, 3.0, -4.0, 12.0})
    {
      const auto part = [=](double share) { return std::exp(rise * (share - 0.5)); };
      const double ahead =
        depth * Integral([&](double t) { return part(t) * std::exp(-depth * (1.0 - t)); });
      const double back =
        depth * Integral([&](double t) { return part(t) * std::exp(-depth * t); });
      const double kept = 2.0 * Integral(part) - (ahead + back) / depth;
      const double escape = -std::expm1(-depth) / depth;
      const ExponentialSource source(static_cast<float>(depth),
        static_cast<float>(std::exp(-depth)), static_cast<float>(escape), static_cast<float>(rise));
      SCOPED_TRACE(testing::Message() << "depth " << depth << ", rise " << rise);
      EXPECT_NEAR(source.Ahead / ahead, 1.0, 1e-5);
      EXPECT_NEAR(source.Back / back, 1.0, 1e-5);
      // Of what hardly anything is held back, all places hold as much, to a hundredth.
      EXPECT_NEAR(source.Inside * (2.0 - 2.0 * escape) / kept, 1.0, depth < 0.02 ? 0.02 : 5e-4);
    }
  }
}

} // namespace
