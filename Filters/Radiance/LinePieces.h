// How surfaces and smoke cells part a line.
#pragma once

#include "Geometry.h"
#include "Medium.h"

#include <cstddef>
#include <limits>
#include <vector>

namespace smokevis
{

/// Calls, in their order along a line, cross(i) for each crossing of a surface and
/// visit(cell, begin, end) for each piece in smoke; a surface inside a cell parts its piece in two.
template <class Cross, class Visit>
void ForEachPiece(const std::vector<Crossing>& crossings, const std::vector<Segment>& segments,
  Cross&& cross, Visit&& visit)
{
  std::size_t next = 0;
  const auto crossUntil = [&](double distance)
  {
    for (; next < crossings.size() && crossings[next].Arrive.Distance <= distance; ++next)
    {
      cross(next);
    }
  };
  for (const Segment& segment : segments)
  {
    double begin = segment.Begin;
    crossUntil(begin);
    while (next < crossings.size() && crossings[next].Arrive.Distance < segment.End)
    {
      const double middle = crossings[next].Arrive.Distance;
      visit(segment.Cell, begin, middle);
      begin = middle;
      crossUntil(middle);
    }
    visit(segment.Cell, begin, segment.End);
  }
  crossUntil(std::numeric_limits<double>::infinity());
}

} // namespace smokevis
