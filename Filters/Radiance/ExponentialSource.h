// What a source that changes exponentially along a piece of a ray sends out of it.
#pragma once

#include <cmath>

namespace smokevis
{

/// Of a source that is 1 in the middle of the piece, to some 1e-4: lines need many.
struct ExponentialSource
{
  /// @param depth optical depth of the piece
  /// @param transmittance exp(-depth)
  /// @param escape (1 - exp(-depth)) / depth
  /// @param rise of the source's logarithm from the piece's beginning to its end
  ExponentialSource(float depth, float transmittance, float escape, float rise)
  {
    const float high = std::exp(0.5F * rise);
    const float low = 1.0F / high;
    const float ahead = high * Mean(depth + rise, transmittance * low * low);
    const float back = low * Mean(depth - rise, transmittance * high * high);
    const float mean = high * Mean(rise, low * low);
    // Of next to nothing that is held back, all places hold as much.
    constexpr float Thin = 0.02F;
    this->Inside = depth < Thin ? mean : (mean - 0.5F * (ahead + back)) / (1.0F - escape);
    this->Ahead = depth * ahead;
    this->Back = depth * back;
  }

  /// Luminance that it adds at the end, looking along the ray, and at the beginning.
  float Ahead, Back;
  /// The even source of which as much stays inside, of both directions together.
  float Inside;

private:
  /// Mean of exp(-x t) over t in (0, 1), as MeanOfExponential, where exp(-x) is known already.
  /// @param last exp(-x)
  static float Mean(float x, float last)
  {
    return std::abs(x) < 0.1F
             ? 1.0F - x * (0.5F - x * (1.0F / 6.0F - x * (1.0F / 24.0F - x * (1.0F / 120.0F))))
             : (1.0F - last) / x;
  }
};

} // namespace smokevis
