// How much light may be scattered or reflected more than once: a bound, not an estimate.
#pragma once

#include "Scene.h"

#include <optional>

namespace smokevis
{

/// Bound of what comes to any point of a scene by more than one scattering or reflection. With
/// sigma the largest scattering coefficient, it is the sum of three parts.
///
/// Light of a plate that was scattered once. A point s of the plate of luminance L sends at most
/// L cos(theta) dA / r^2 to a point at a distance r, which sends sigma / (4 pi) of it to a point at
/// a distance D of s. Over all places of the first scattering the integral along a direction at an
/// angle g to that of D is (pi - g) / (D sin g), and that over all directions at most
/// 2 pi (pi / 2 + 1) / D, what it is where both the plate's normal and the point lie on one axis
/// (Hardy and Littlewood's inequality, both factors decrease with the angle). So it is
/// sigma (pi / 2 + 1) / 2 times the integral of L dA / D over the plate, and that is at most I / D
/// for the nearest D and 2 sqrt(pi I L) everywhere (it is largest where what shines is a disc
/// around the nearest point).
///
/// Light of surfaces that reflect direct light: at most 4 pi times their highest luminance.
///
/// Light of all orders behind: no radiance is higher than (1 - exp(-tau)) times the highest
/// luminance that smoke sends on plus the highest one that surfaces do, with tau that of the
/// longest line through the smoke at its thickest, and each order sends on at most a share q =
/// albedo (1 - exp(-tau)) + reflectance of that.
class ScatterBound
{
public:
  /// None where smoke emits, random lines carry light, the sky shines, a light is measured by a
  /// table, or q is not below 1.
  static std::optional<ScatterBound> Of(const Scene& scene, int band);

  /// Of the fluence in a cell [lx].
  double Fluence(std::int64_t cell) const;
  /// Of the illuminance on any surface [lx].
  double Illuminance() const { return this->Illuminance_; }

private:
  ScatterBound(const Scene& scene, int band);
  /// Integral of L dA / D over all lights from points within a distance of a place [cd/m].
  double Closeness(const Vec3& place, double within) const;
  /// Highest luminance of surfaces that reflect direct light [cd/m2].
  double ReflectedOnce() const;

  const Scene& Scene_;
  int Band_;
  /// Highest luminance of any plate [cd/m2].
  double Brightest_ = 0.0;
  /// Fluence of light scattered once over Closeness.
  double Scattered_ = 0.0;
  /// The part of the fluence that does not depend on the place [lx].
  double Everywhere_ = 0.0;
  double Illuminance_ = 0.0;
  bool Holds_ = false;
};

} // namespace smokevis
