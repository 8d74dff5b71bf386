// A plate's light as a few points that stand for its whole pattern.
#pragma once

#include "Types.h"

#include <array>
#include <span>
#include <vector>

namespace smokevis
{

struct LightGroup;

/// Places on the rectangle around a group of leaves, and the intensity that each gets so that sums
/// over them are exact wherever the light's way to a receiver changes like a polynomial of degree
/// n - 1 across the plate, whatever the pattern. Intensities may be negative: they interpolate.
class PlateStencil
{
public:
  struct Place
  {
    Vec3 Point{0.0};
    /// [cd]
    Spectrum Intensity{};
  };

  /// @param corners of the rectangle
  PlateStencil(const std::array<Vec3, 4>& corners, std::span<const LightGroup> leaves, int bands);

  /// The fewest places that serve a receiver, or none where it is too close. They are off by some
  /// 3e-4: Chebyshev interpolation of a function that is singular at a distance d from the middle
  /// of an interval of half-length a errs by about 2 (a / 2d)^n (Trefethen 2013, chapter 8).
  /// @param sharpness how fast the light changes with the angle [1/rad]
  std::span<const Place> PlacesFor(const Vec3& receiver, double sharpness) const;

private:
  static constexpr int FewestAcross = 3;
  static constexpr int MostAcross = 5;

  Vec3 Centre_;
  /// Half of the longer side [m].
  double Half_;
  std::array<std::vector<Place>, MostAcross - FewestAcross + 1> Places_;
};

} // namespace smokevis
