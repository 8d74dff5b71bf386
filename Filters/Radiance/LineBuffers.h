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
  /// Of the line, in one cell or a part of it.
  struct Piece
  {
    std::int64_t Cell;
    /// [m]
    float Length;
    /// Mean luminance of what it sends on and emits [cd/m2].
    float Source;
    /// exp(-tau) of its optical depth tau, and (1 - exp(-tau)) / tau.
    float Transmittance, Escape;
    /// Luminance that it adds, (1 - exp(-tau)) times the source, and what the source's change from
    /// its beginning to its end adds along the line and takes away against it [cd/m2].
    float Added, Tilt;
    /// By how much the radiances of both directions together, where they come in, exceed the
    /// source.
    float Excess;

    /// Integral of the radiance of both directions together over the length, less what is expected
    /// of that radiance [cd/m].
    float Brought(float expected) const
    {
      return this->Length * (this->Excess * this->Escape + (2.0F * this->Source - expected));
    }
  };

  std::vector<Crossing> Crossings;
  std::vector<Segment> Segments;
  std::vector<Piece> Pieces;
  /// First piece behind each crossing, and the end.
  std::vector<std::size_t> First;
  /// Radiance that comes to each crossing, along the line and against it; where places are watched.
  std::array<std::vector<float>, 2> Arriving;
};

} // namespace smokevis
