#include "OwnGlow.h"

#include "Scene.h"

#include <glm/gtc/constants.hpp>

namespace smokevis
{

double OwnGlow::Fluence(std::int64_t cell) const
{
  const Medium& smoke = this->Scene_.Smoke();
  const double luminance = smoke.EmittedLuminance(cell);
  if (luminance == 0.0)
  {
    return 0.0;
  }
  const double depth =
    this->Scene_.ExtinctionScale(this->Band_) * smoke.Extinction(cell) * smoke.MeanChord(cell);
  const double absorbed = (1.0 - this->Scene_.Albedo()) * depth;
  return 4.0 * glm::pi<double>() * luminance * absorbed / (1.0 + absorbed) * depth / (1.0 + depth);
}

} // namespace smokevis
