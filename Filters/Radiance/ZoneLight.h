// What lights the zones of a sign that reflect.
#pragma once

#include "SignSight.h"
#include "View.h"
#include "ZoneChanges.h"

#include <array>
#include <vector>

namespace smokevis
{

/// Illuminance of the zones of a part of a sign, and how it changes over each.
class ZoneLight
{
public:
  struct Illuminance
  {
    /// In the middle of a zone, straight from lights and the rest of it [lx]. Where noise makes
    /// that so negative that both were, direct light is as much more.
    double Direct = 0.0;
    Lanes Multiple;
    /// Change of both over the zone, over their value (ZoneChanges).
    glm::dvec2 Change{0.0};
  };

  ZoneLight(const View& view, const SignSight& sight, const SignSight::Part& part,
    const ZoneChanges& changes);

  /// Of a zone that reflects.
  const Illuminance& At(std::size_t zone, int band) const { return this->Bands_[band][zone]; }

private:
  /// None where no zone of the part reflects.
  std::array<std::vector<Illuminance>, MaxBands> Bands_;
};

} // namespace smokevis
