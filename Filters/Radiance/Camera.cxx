// Where the rays of a picture point to.
#include "Camera.h"

#include "Errors.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace smokevis
{
namespace
{

/// Sets the orthonormal frame; where up is parallel to the line of sight z, y or x takes its place.
void Aim(Camera& camera, const Vec3& forward, const Vec3& viewUp)
{
  camera.Forward = glm::normalize(forward);
  const double length = glm::length(viewUp);
  const Vec3 wanted = length > 0.0 && std::isfinite(length) ? viewUp / length : Vec3(0.0);
  Vec3 right(0.0);
  for (const Vec3& up : {wanted, Vec3(0.0, 0.0, 1.0), Vec3(0.0, 1.0, 0.0), Vec3(1.0, 0.0, 0.0)})
  {
    right = glm::cross(camera.Forward, up);
    if (glm::length(right) > 1e-9)
    {
      break;
    }
  }
  camera.Right = glm::normalize(right);
  camera.Up = glm::cross(camera.Right, camera.Forward);
}

void CheckSize(int width, int height)
{
  if (width < 1 || height < 1)
  {
    throw Error("camera", "the image has no pixels", "Give a width and a height from 1 pixel");
  }
}

} // namespace

//------------------------------------------------------------------------------
Camera Camera::LookAt(const Vec3& position, const Vec3& focalPoint, const Vec3& viewUp,
  double focalLength, double sensorWidth, double sensorHeight, int width, int height)
{
  CheckSize(width, height);
  const double distance = glm::distance(position, focalPoint);
  if (!(distance > 0.0) || !std::isfinite(distance))
  {
    throw Error(
      "camera", "its position and the point that it looks at coincide", "Move one of them apart");
  }
  if (!(focalLength > 0.0) || !(sensorWidth > 0.0) || !(sensorHeight > 0.0))
  {
    throw Error("camera", "its focal length or sensor size is not positive", "Give both in mm");
  }
  Camera camera;
  camera.Position = position;
  camera.Width = width;
  camera.Height = height;
  Aim(camera, focalPoint - position, viewUp);
  // Pixels are square: the picture is the largest middle part of the sensor with its proportions.
  const double pixel = std::min(sensorWidth / width, sensorHeight / height);
  camera.RightEdge = 0.5 * pixel * width / focalLength;
  camera.Top = 0.5 * pixel * height / focalLength;
  camera.Left = -camera.RightEdge;
  camera.Bottom = -camera.Top;
  return camera;
}

//------------------------------------------------------------------------------
Camera Camera::FramePlate(const Vec3& position, const std::array<Vec3, 4>& corners,
  const Vec3& viewUp, double margin, int width, int height)
{
  CheckSize(width, height);
  if (!(margin >= 0.0) || !std::isfinite(margin))
  {
    throw Error("camera", "the margin around the sign is negative", "Give a Margin from 0");
  }
  Camera camera;
  camera.Position = position;
  camera.Width = width;
  camera.Height = height;
  const Vec3 centre = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
  const Vec3 normal = glm::cross(corners[1] - corners[0], corners[3] - corners[0]);
  const double size = std::sqrt(glm::length(normal));
  const double distance = glm::distance(position, centre);
  if (!(distance > 1e-9 * size))
  {
    throw Error("camera", "its position lies on the sign", "Step back from the sign");
  }

  const auto nearest = [&]
  {
    double least = std::numeric_limits<double>::infinity();
    for (const Vec3& corner : corners)
    {
      least = std::min(least, glm::dot(corner - position, camera.Forward));
    }
    return least;
  };
  Aim(camera, centre - position, viewUp);
  if (nearest() < 1e-3 * distance)
  {
    // Close by and from the side a corner lies behind an eye that looks at the middle of the plate;
    // an eye that looks straight at the plane of the plate has all of it before it.
    Aim(camera, glm::dot(centre - position, normal) > 0.0 ? normal : -normal, viewUp);
    if (nearest() < 1e-6 * size)
    {
      throw Error("camera", "its position lies in the plane of the sign, next to it",
        "Step in front of the sign");
    }
  }

  double low[2] = {
    std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  double high[2] = {-low[0], -low[1]};
  for (const Vec3& corner : corners)
  {
    const Vec3 ray = corner - position;
    const double depth = glm::dot(ray, camera.Forward);
    const double tangent[2] = {
      glm::dot(ray, camera.Right) / depth, glm::dot(ray, camera.Up) / depth};
    for (int axis = 0; axis < 2; ++axis)
    {
      low[axis] = std::min(low[axis], tangent[axis]);
      high[axis] = std::max(high[axis], tangent[axis]);
    }
  }
  const double pixel =
    (1.0 + 2.0 * margin) * std::max((high[0] - low[0]) / width, (high[1] - low[1]) / height);
  const double middle[2] = {0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])};
  camera.Left = middle[0] - 0.5 * pixel * width;
  camera.RightEdge = middle[0] + 0.5 * pixel * width;
  camera.Bottom = middle[1] - 0.5 * pixel * height;
  camera.Top = middle[1] + 0.5 * pixel * height;
  return camera;
}

//------------------------------------------------------------------------------
Vec3 Camera::Direction(double x, double y) const
{
  const double u = this->Left + (this->RightEdge - this->Left) * x / this->Width;
  const double v = this->Bottom + (this->Top - this->Bottom) * y / this->Height;
  return glm::normalize(this->Forward + u * this->Right + v * this->Up);
}

//------------------------------------------------------------------------------
Camera Camera::ThroughLens(int point, int count) const
{
  // Equal areas a point, each turned by the golden angle from the one before (Vogel 1979).
  const double radius = 0.5 * this->Aperture * std::sqrt((point + 0.5) / count);
  const double angle = 2.399963229728653 * point;
  const double x = radius * std::cos(angle);
  const double y = radius * std::sin(angle);
  Camera camera = *this;
  camera.Aperture = 0.0;
  camera.Position += x * this->Right + y * this->Up;
  camera.Left -= x / this->FocusDistance;
  camera.RightEdge -= x / this->FocusDistance;
  camera.Bottom -= y / this->FocusDistance;
  camera.Top -= y / this->FocusDistance;
  return camera;
}

} // namespace smokevis
