// How what is seen before a sign changes over its zones.
#pragma once

#include "SignSight.h"

#include <array>
#include <optional>
#include <vector>

namespace smokevis
{

/// Tells by how much values change over the zones of a part of a sign, from one side to the other
/// along both edges of the plate, by those of their neighbours.
class ZoneChanges
{
public:
  ZoneChanges(const SignSight& sight, const SignSight::Part& part);

  /// Change over each zone; 0 where pixels average it, where two neighbours in a row are not seen,
  /// and where values do not go on from one to the next.
  /// @param values of the zones' middles
  std::vector<glm::dvec2> Of(const std::vector<double>& values) const;

private:
  /// Three zones in a row, one of which is told of, and how far apart their middles are, over the
  /// size of that one.
  struct Row
  {
    std::array<std::size_t, 3> Zones;
    std::array<double, 2> Apart;
  };

  /// Of each zone, along both edges.
  std::vector<std::array<std::optional<Row>, 2>> Rows_;
};

} // namespace smokevis
