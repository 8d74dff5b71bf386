// Random numbers that test scenes are made of.
#pragma once

#include "ReferenceIntegrator.h"

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <numbers>

namespace smokevis
{

/// Draws what a scene is made of.
class Dice
{
public:
  Dice(std::uint64_t seed, std::uint64_t stream) : Random_(seed, stream) {}

  double Between(double low, double high) { return low + (high - low) * this->Random_.Uniform(); }
  /// Even on a logarithmic scale.
  double Magnitude(double low, double high)
  {
    return std::exp(this->Between(std::log(low), std::log(high)));
  }
  int Count(int least, int most)
  {
    return least + static_cast<int>((most - least + 1) * this->Random_.Uniform());
  }
  bool Chance(double probability) { return this->Random_.Uniform() < probability; }
  double OneOf(std::initializer_list<double> values)
  {
    return values.begin()[this->Count(0, static_cast<int>(values.size()) - 1)];
  }
  Vec3 Inside(const Vec3& lower, const Vec3& upper)
  {
    const double x = this->Between(lower.x, upper.x);
    const double y = this->Between(lower.y, upper.y);
    return {x, y, this->Between(lower.z, upper.z)};
  }
  Vec3 Direction()
  {
    const double z = this->Between(-1.0, 1.0);
    const double azimuth = this->Between(0.0, 2.0 * std::numbers::pi);
    const double r = std::sqrt(1.0 - z * z);
    return {r * std::cos(azimuth), r * std::sin(azimuth), z};
  }

private:
  Pcg32 Random_;
};

} // namespace smokevis
