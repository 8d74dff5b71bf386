// Gauss-Legendre nodes and weights on (0, 1).
#pragma once

#include <array>

namespace smokevis
{

inline constexpr std::array<double, 2> Nodes2 = {0.21132486540518712, 0.78867513459481288};
inline constexpr std::array<double, 3> Nodes3 = {0.11270166537925831, 0.5, 0.88729833462074169};
inline constexpr std::array<double, 3> Weights3 = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};

} // namespace smokevis
