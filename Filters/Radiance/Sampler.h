// Random numbers that depend on counters alone, and the point sequence that lines are drawn from.
#pragma once

#include "Types.h"

#include <array>
#include <cmath>
#include <cstdint>

#include <glm/gtc/constants.hpp>

namespace smokevis
{

/// A well-mixed 64-bit word from a counter (SplitMix64, Steele, Lea and Flood 2014).
constexpr std::uint64_t Mix(std::uint64_t counter)
{
  counter += 0x9E3779B97F4A7C15ULL;
  counter = (counter ^ (counter >> 30)) * 0xBF58476D1CE4E5B9ULL;
  counter = (counter ^ (counter >> 27)) * 0x94D049BB133111EBULL;
  return counter ^ (counter >> 31);
}

/// A number in [0, 1) from a word.
constexpr double ToUnit(std::uint64_t word)
{
  return static_cast<double>(word >> 11) * 0x1.0p-53;
}

/// Points that fill the unit cube of 4 or 5 dimensions evenly: the additive recurrence with the
/// powers of the root of x^(n + 1) = x + 1 (Roberts 2018), moved by a random shift. Any one point
/// is uniform, so that means over the sequence have no bias; many together lie more evenly than
/// independent ones.
template <int Dimensions = 4> class EvenPoints
{
public:
  /// Different keys give independent shifts.
  explicit EvenPoints(std::uint64_t key)
  {
    for (int axis = 0; axis < Dimensions; ++axis)
    {
      this->Shift_[axis] = ToUnit(Mix(key + 0x632BE59BD9B4E019ULL * (axis + 1)));
    }
  }

  std::array<double, Dimensions> Point(std::uint64_t index) const
  {
    static_assert(Dimensions >= 4 && Dimensions <= 6);
    constexpr double root = Dimensions == 4   ? 1.1673039782614187
                            : Dimensions == 5 ? 1.1347241384015195
                                              : 1.1127756842787055;
    constexpr std::array<double, 6> step = {1.0 / root, 1.0 / (root * root),
      1.0 / (root * root * root), 1.0 / (root * root * root * root),
      1.0 / (root * root * root * root * root), 1.0 / (root * root * root * root * root * root)};
    std::array<double, Dimensions> point;
    for (int axis = 0; axis < Dimensions; ++axis)
    {
      const double value = this->Shift_[axis] + static_cast<double>(index) * step[axis];
      point[axis] = value - static_cast<double>(static_cast<std::int64_t>(value));
    }
    return point;
  }

private:
  std::array<double, Dimensions> Shift_;
};

/// A unit direction, all alike likely, from two numbers of 0 to 1.
inline Vec3 SphereDirection(double first, double second)
{
  const double z = 2.0 * first - 1.0;
  const double sine = std::sqrt(std::max(0.0, 1.0 - z * z));
  const double angle = glm::two_pi<double>() * second;
  return {sine * std::cos(angle), sine * std::sin(angle), z};
}

/// A unit direction as a Lambertian plane sends or gathers light: as often as its cosine with the
/// normal.
/// @param tangent unit vector in the plane
/// @param square of the sine of the angle to the normal, 0 to 1
/// @param turn share of the full circle from the tangent, 0 to 1
inline Vec3 LambertianDirection(const Vec3& normal, const Vec3& tangent, double square, double turn)
{
  const double sine = std::sqrt(square);
  const double angle = glm::two_pi<double>() * turn;
  return sine * std::cos(angle) * tangent + sine * std::sin(angle) * glm::cross(normal, tangent) +
         std::sqrt(1.0 - square) * normal;
}

} // namespace smokevis
