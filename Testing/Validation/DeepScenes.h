// Signs so deep in smoke that their dark bars are down to a millionth of the lit ones' luminance.
#pragma once

#include "ReferenceIntegrator.h"
#include "SceneLibrary.h"

#include <string>
#include <vector>

namespace smokevis::scenes
{

/// The tunnel with other smoke.
struct DeepScene
{
  std::string Name;
  double Extinction;
  double Albedo;
};

inline const std::vector<DeepScene> DeepScenes = {{"soot 4", 1.0, 0.3}, {"soot 8", 2.0, 0.3},
  {"soot 12", 3.0, 0.3}, {"white 4", 1.0, 0.99}, {"white 8", 2.0, 0.99}, {"white 12", 3.0, 0.99},
  {"white 17", 4.25, 0.99}};

/// Rays from the eye to points drawn evenly over the four dark bars, or the five lit ones, of the
/// tunnel's sign.
inline Ray TunnelBarRay(bool lit, Pcg32& random)
{
  const int bar = lit ? 2 * static_cast<int>(5 * random.Uniform())
                      : 1 + 2 * static_cast<int>(4 * random.Uniform());
  const double y = 0.35 + 0.3 * (bar + random.Uniform()) / 9.0;
  const Vec3 point(4.0, y, 0.35 + 0.3 * random.Uniform());
  return {TunnelEye, glm::normalize(point - TunnelEye)};
}

} // namespace smokevis::scenes
