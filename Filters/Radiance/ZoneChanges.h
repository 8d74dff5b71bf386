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
  /// Standard error of the value in the middle of each zone as the mean over it, by how uneven the
  /// values around it are; 0 along an edge where two neighbours in a row are not seen. It holds
  /// where each zone differs from the next by chance; where values bend or have kinks, as behind
  /// cells of smoke that are larger than the zones, middles are off by a fifth of it.
  std::vector<double> Unevenness(const std::vector<double>& values) const;

private:
  /// Changes of values over a zone as those before and behind tell it.
  struct Steps
  {
    double Before = 0.0;
    double Behind = 0.0;
  };
  /// Three zones in a row, one of which is told of, and how far apart their middles are, over the
  /// size of that one.
  struct Row
  {
    std::array<std::size_t, 3> Zones;
    std::array<double, 2> Apart;

    Steps Of(const std::vector<double>& values) const
    {
      return {(values[this->Zones[1]] - values[this->Zones[0]]) / this->Apart[0],
        (values[this->Zones[2]] - values[this->Zones[1]]) / this->Apart[1]};
    }
  };

  bool Resolved_;
  /// Of each zone, along both edges.
  std::vector<std::array<std::optional<Row>, 2>> Rows_;
};

} // namespace smokevis
