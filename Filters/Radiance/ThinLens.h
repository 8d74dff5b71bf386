// Where a thin lens forms its image, how large, and how sharp.
#pragma once

#include <limits>

namespace smokevis
{

/// A thin lens and the plane that it is focused on (Zhang and Rubini, eq. 8): with the distance S
/// from that plane to the sensor, s + s' = S and 1/s + 1/s' = 1/f; the image is s'/s = D2/D1 times
/// as large as the thing. Lengths in m.
struct ThinLens
{
  double FocalLength = 0.05;
  /// From the plane in focus to the lens (s); infinity: focused on what is far away.
  double ObjectDistance = std::numeric_limits<double>::infinity();
  /// From the lens to the sensor (s').
  double ImageDistance = 0.05;

  /// A lens that is focused on infinity.
  static ThinLens FocusedAtInfinity(double focalLength);
  /// A lens that is focused on a plane at a distance from the sensor, as cameras mark it. Throws
  /// Error where that is nearer than four focal lengths, for then no image forms. Of the two
  /// solutions the one with the lens nearer to the sensor is taken, as cameras do.
  static ThinLens Focused(double focalLength, double planeToSensor);

  /// Size of the image over that of the thing, 0 at infinity.
  double Magnification() const;
  /// Diameter on the sensor of the disc that a point at a distance from the lens becomes.
  /// @param aperture diameter of the lens's opening
  double BlurDiameter(double aperture, double distance) const;
};

} // namespace smokevis
