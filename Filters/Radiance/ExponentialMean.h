// Means of what rises or falls exponentially over a stretch.
#pragma once

#include <algorithm>
#include <cmath>

namespace smokevis
{

/// Mean of exp(-depth t) over t in (0, 1), (1 - exp(-depth)) / depth.
inline double MeanOfExponential(double depth)
{
  return depth == 0.0 ? 1.0 : -std::expm1(-depth) / depth;
}

/// Logarithm of the mean of exp(2 h t) over t in (-1/2, 1/2), log(sinh(h) / h); no h is too large.
inline double LogarithmOfMean(double h)
{
  const double size = std::abs(h);
  return size < 1e-3 ? size * size / 6.0 : size + std::log(MeanOfExponential(2.0 * size));
}

/// Langevin's function coth h - 1 / h, the derivative of LogarithmOfMean: twice the place t that
/// is the mean where exp(2 h t) is the weight.
inline double Langevin(double h)
{
  if (std::abs(h) > 2.0)
  {
    return 1.0 / std::tanh(h) - 1.0 / h;
  }
  // The continued fraction h / (3 + h^2 / (5 + h^2 / (7 + ...))) (Abramowitz and Stegun 4.5.70),
  // cut off behind 17, is off by 4e-12 of itself at most, and costs as much as one division.
  const double square = h * h;
  return h * (11486475.0 + square * (810810.0 + square * (12870.0 + square * 44.0))) /
         (34459425.0 + square * (4729725.0 + square * (135135.0 + square * (990.0 + square))));
}

/// Derivative of Langevin's function: four times the variance of the place t there.
inline double LangevinSlope(double h)
{
  const double size = std::abs(h);
  if (size < 0.1)
  {
    return 1.0 / 3.0 - size * size / 15.0;
  }
  const double sinh = std::sinh(std::min(size, 300.0));
  return 1.0 / (size * size) - 1.0 / (sinh * sinh);
}

/// Inverse of Langevin's function; of what it takes more than 2 for, or less than -2, that.
inline double InverseLangevin(double value)
{
  constexpr double Most = 2.0;
  const double square = value * value;
  // Cohen's approximation (Rheologica Acta 30, 1991) is off by a twentieth at most; twice Newton.
  double h = square < 1.0 ? std::clamp(value * (3.0 - square) / (1.0 - square), -Most, Most)
                          : std::copysign(Most, value);
  for (int step = 0; step < 2; ++step)
  {
    h = std::clamp(h - (Langevin(h) - value) / LangevinSlope(h), -Most, Most);
  }
  return h;
}

} // namespace smokevis
