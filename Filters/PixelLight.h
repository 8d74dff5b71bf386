// What one band of a pixel of an image receives.
#pragma once

#include "View.h"

#include <array>

namespace smokevis
{

struct PixelLight
{
  /// From the surfaces, signs and lamps that end the rays, as it arrives [cd/m2].
  double Surface = 0.0;
  /// From the smoke [cd/m2].
  double Veil = 0.0;
  double OpticalDepth = 0.0;
  /// Batches of what of both is multiply scattered [cd/m2].
  Lanes Multiple;

  void AddVeil(const RayLight& light, double weight)
  {
    this->Veil += weight * light.Veil();
    this->OpticalDepth += weight * light.OpticalDepth;
    Add(this->Multiple, light.VeilMultiple, static_cast<float>(weight));
  }

  void Scale(double factor)
  {
    this->Surface *= factor;
    this->Veil *= factor;
    this->OpticalDepth *= factor;
    for (float& value : this->Multiple.Value)
    {
      value *= static_cast<float>(factor);
    }
  }
};

/// A value a band.
using PixelSpectrum = std::array<PixelLight, MaxBands>;

} // namespace smokevis
