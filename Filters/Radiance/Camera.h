// The camera, or eye, that an image is formed in: a pinhole, or a lens with depth of field.
#pragma once

#include "Types.h"

#include <limits>

namespace smokevis
{

/// Orthonormal frame of a view and the part of its image plane that the picture covers.
struct Camera
{
  Vec3 Position{0.0};
  /// Unit vectors.
  Vec3 Forward{1.0, 0.0, 0.0};
  Vec3 Right{0.0, -1.0, 0.0};
  Vec3 Up{0.0, 0.0, 1.0};
  /// Tangents of the angles from the forward direction to the edges of the picture.
  double Left = -1.0, RightEdge = 1.0, Bottom = -1.0, Top = 1.0;
  /// Pixels.
  int Width = 64, Height = 64;
  /// Diameter of the lens's opening [m]; 0: a pinhole, sharp everywhere.
  double Aperture = 0.0;
  /// From the lens to the plane in focus, along the forward direction [m].
  double FocusDistance = std::numeric_limits<double>::infinity();

  /// A camera that looks from a position at a point. Throws Error where the two coincide.
  /// @param sensorWidth,sensorHeight in the same unit as the focal length (mm by custom)
  static Camera LookAt(const Vec3& position, const Vec3& focalPoint, const Vec3& viewUp,
    double focalLength, double sensorWidth, double sensorHeight, int width, int height);

  /// A camera that looks at a plane plate of a sign so that the plate fills the picture but for a
  /// margin. Pixels stay square: the plate fills the narrower of the two directions.
  /// @param corners the plate's corners
  /// @param margin  free border, as a fraction of the plate's size on each side
  static Camera FramePlate(const Vec3& position, const std::array<Vec3, 4>& corners,
    const Vec3& viewUp, double margin, int width, int height);

  /// Direction (unit) through the point (x, y) of the picture, in pixels from its lower left
  /// corner.
  Vec3 Direction(double x, double y) const;

  /// The pinhole camera at one of `count` points that lie evenly over the lens's opening. Their
  /// images agree in the plane in focus; their mean is the lens's image.
  Camera ThroughLens(int point, int count) const;
};

} // namespace smokevis
