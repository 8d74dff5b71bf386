// What a line of a sweep is worked out in.
#pragma once

#include "Geometry.h"
#include "Medium.h"

#include <array>
#include <cstdint>
#include <vector>

namespace smokevis
{

/// One a thread; emptied for each line.
struct LineBuffers
{
  std::vector<Crossing> Crossings;
  std::vector<Segment> Segments;
  /// Of each piece of the line: cell, length, tau = its optical depth, mean source luminance and
  /// its change from the piece's beginning to its end, exp(-tau), (1 - exp(-tau)) / tau, and the
  /// luminance that it adds: (1 - exp(-tau)) times the source, and what the change adds along the
  /// line and takes away against it.
  std::vector<std::int64_t> Cell;
  std::vector<float> Length, Depth, Source, Change, Transmittance, Escape, Added, Tilt;
  /// First piece behind each crossing, and the end.
  std::vector<std::size_t> First;
  /// By how much the radiances of both directions together, where they come in, exceed the source.
  std::vector<float> Excess;
  /// Radiance that comes to each crossing, along the line and against it; of watched surfaces only.
  std::array<std::vector<float>, 2> Arriving;
};

} // namespace smokevis
