// The straight line from an eye to a sign, and what today's practice concludes from it.
#pragma once

#include "Scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace smokevis
{

/// From an eye to the centre of a sign's plate.
struct SightLine
{
  /// Whether the eye is before the sign's front and nothing opaque lies between. Nothing else is
  /// known where it is not.
  bool InView = false;
  /// Length [m].
  double Distance = 0.0;
  /// Integral of the extinction coefficient at 633 nm along the line.
  double OpticalDepth = 0.0;

  /// Arithmetic mean of the extinction along the line [1/m], by which light is weakened as by even
  /// smoke of the same depth (Bouguer). C over it is the harmonic mean of the local visibilities.
  double MeanExtinction() const
  {
    return this->Distance > 0.0 ? this->OpticalDepth / this->Distance : 0.0;
  }
  /// Jin's law V = C/K for that mean [m]; infinite in clear air.
  double JinVisibility(double factor) const
  {
    const double extinction = this->MeanExtinction();
    return extinction > 0.0 ? factor / extinction : std::numeric_limits<double>::infinity();
  }
  /// Whether the line is no longer than that: a distance up to C/K is an optical depth up to C.
  bool SeenAfterJin(double factor) const { return this->InView && this->OpticalDepth <= factor; }
};

/// The line from an eye to a sign of a scene.
inline SightLine LookAtSign(const Scene& scene, const Sign& sign, const Vec3& eye)
{
  SightLine line;
  if (glm::dot(eye - sign.Centre, sign.Normal) <= 0.0 || !scene.Shapes().Visible(eye, sign.Centre))
  {
    return line;
  }
  line.InView = true;
  line.Distance = glm::length(sign.Centre - eye);
  if (line.Distance > 0.0)
  {
    line.OpticalDepth =
      scene.Smoke().OpticalDepth(eye, (sign.Centre - eye) / line.Distance, 0.0, line.Distance);
  }
  return line;
}

} // namespace smokevis
