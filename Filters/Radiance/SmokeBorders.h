// Where borders of smoke cross the plates of lights.
#pragma once

#include "Emitters.h"

#include <vector>

namespace smokevis
{

class Medium;

/// Divides lights so that smoke is much the same before all of each: from afar one way stands for
/// all ways to a light.
class SmokeBorders
{
public:
  /// @param smoke must outlive this
  /// @param scale largest extinction of a band over that at 633 nm
  SmokeBorders(const Medium& smoke, double scale) : Smoke_(smoke), Scale_(scale) {}

  /// Leaves of one plane, in groups on either side of the borders that cross them.
  std::vector<std::vector<LightGroup>> Divide(std::vector<LightGroup> leaves) const;

private:
  /// A plane between cells.
  struct Border
  {
    int Axis = 0;
    double Place = 0.0;
    /// Step of the extinction across it, times how far the leaves reach on the shorter side, twice:
    /// for a border in their middle the step of the optical depth along them.
    double Step = 0.0;
  };

  /// The border of the largest step.
  Border Largest(const std::vector<LightGroup>& leaves) const;
  double StepAt(const Border& border, const std::array<Vec3, 4>& plate, const Vec3& normal) const;

  const Medium& Smoke_;
  double Scale_;
};

} // namespace smokevis
