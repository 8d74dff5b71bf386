// A plate's light in strips, for smoke that dims one part of it more than another.
#pragma once

#include "Types.h"

#include <array>
#include <span>

namespace smokevis
{

struct LightGroup;

/// How much of a light comes from each of the strips that the rectangle around it is cut into,
/// along either edge.
class PlateStrips
{
public:
  static constexpr std::size_t Count = 16;

  struct Strip
  {
    /// Two places that stand for its length.
    std::array<Vec3, 2> Places{Vec3(0.0), Vec3(0.0)};
    /// Share of the light in each band.
    Spectrum Share{};
  };

  /// @param corners of the rectangle
  /// @param leaves that the light consists of
  PlateStrips(const std::array<Vec3, 4>& corners, std::span<const LightGroup> leaves, int bands);

  /// One behind another from the first corner to the second (0), or to the last (1).
  const std::array<Strip, Count>& Along(int edge) const { return this->Strips_[edge]; }

private:
  std::array<std::array<Strip, Count>, 2> Strips_;
};

} // namespace smokevis
