// The light that is sent on for the first time, or out along random lines.
#pragma once

#include "Medium.h"

#include <cstdint>

namespace smokevis
{

class Scene;
struct Box;
struct LightField;

/// What smoke emits and scatters of direct light, and what surfaces reflect of it.
class FirstSource
{
public:
  /// @param field holds the direct light; it and the scene must outlive this
  FirstSource(const Scene& scene, const LightField& field, int band);
  /// The same without what smoke scatters.
  FirstSource WithoutScattering() const
  {
    FirstSource rest = *this;
    rest.Scatters_ = 0.0;
    return rest;
  }

  /// Of a smoke cell [lm/m3].
  double PerVolume(std::int64_t cell) const
  {
    return this->Smoke_.Extinction(cell) * (this->Scatters_ * this->DirectFluence_[cell] +
                                             this->Emits_ * this->Smoke_.EmittedLuminance(cell));
  }
  /// Of a smoke cell [lm].
  double OfCell(std::int64_t cell) const
  {
    const double perVolume = this->PerVolume(cell);
    return perVolume > 0.0 ? perVolume * this->Smoke_.OwnVolume(cell) : 0.0;
  }
  /// Of all smoke, and of all patches with what lines bring from large plates [lm].
  double OfSmoke() const;
  double OfPatches() const;
  /// Of all, with what lines bring from large plates and the sky [lm].
  /// @param outer box that lines from the sky come through
  double Whole(const Box& outer) const;

private:
  const Scene& Scene_;
  const LightField& Field_;
  int Band_;
  const Medium& Smoke_;
  const float* DirectFluence_;
  double Scatters_, Emits_;
};

} // namespace smokevis
