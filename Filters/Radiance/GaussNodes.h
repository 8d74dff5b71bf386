// Gauss-Legendre nodes and weights on (0, 1).
#pragma once

#include <array>

namespace smokevis
{

inline constexpr std::array<double, 2> Nodes2 = {0.21132486540518712, 0.78867513459481288};
inline constexpr std::array<double, 3> Nodes3 = {0.11270166537925831, 0.5, 0.88729833462074169};
inline constexpr std::array<double, 3> Weights3 = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
inline constexpr std::array<double, 4> Nodes4 = {
  0.06943184420297371, 0.33000947820757187, 0.66999052179242813, 0.93056815579702629};
inline constexpr std::array<double, 4> Weights4 = {
  0.17392742256872693, 0.32607257743127307, 0.32607257743127307, 0.17392742256872693};

/// Weights of the quadratic through the three nodes.
inline std::array<double, 3> QuadraticWeights(double t)
{
  const double a = t - Nodes3[0];
  const double b = t - Nodes3[1];
  const double c = t - Nodes3[2];
  constexpr double step = Nodes3[1] - Nodes3[0];
  return {b * c / (2.0 * step * step), -a * c / (step * step), a * b / (2.0 * step * step)};
}

/// By how much these weights change with t.
inline std::array<double, 3> QuadraticSlopes(double t)
{
  const double a = t - Nodes3[0];
  const double b = t - Nodes3[1];
  const double c = t - Nodes3[2];
  constexpr double step = Nodes3[1] - Nodes3[0];
  return {(b + c) / (2.0 * step * step), -(a + c) / (step * step), (a + b) / (2.0 * step * step)};
}

/// Factors of 1, t and t^2 in the quadratic with these values at the three nodes.
inline std::array<double, 3> QuadraticFactors(const std::array<double, 3>& values)
{
  constexpr double step = Nodes3[1] - Nodes3[0];
  const double slope = (values[2] - values[0]) / (2.0 * step);
  const double bend = (values[0] - 2.0 * values[1] + values[2]) / (2.0 * step * step);
  return {values[1] - 0.5 * slope + 0.25 * bend, slope - bend, bend};
}

} // namespace smokevis
