// Where the rays of a picture point to.
#include "Camera.h"
#include "Errors.h"

#include <gtest/gtest.h>

namespace smokevis
{
namespace
{

/// Place on the plane at a depth along the camera's axis that the middle of a pixel edge shows.
Vec3 At(const Camera& camera, double x, double y, const Vec3& plane, const Vec3& normal)
{
  const Vec3 direction = camera.Direction(x, y);
  return camera.Position +
         glm::dot(plane - camera.Position, normal) / glm::dot(direction, normal) * direction;
}

void ExpectNear(const Vec3& value, const Vec3& expected, double tolerance = 1e-12)
{
  EXPECT_LE(glm::distance(value, expected), tolerance)
    << value.x << " " << value.y << " " << value.z;
}

const std::array<Vec3, 4> Plate = {
  Vec3(4.0, 0.65, 0.35), Vec3(4.0, 0.35, 0.35), Vec3(4.0, 0.35, 0.65), Vec3(4.0, 0.65, 0.65)};

} // namespace

TEST(Camera, LooksAtAPoint)
{
  const Camera camera =
    Camera::LookAt({1.0, 2.0, 3.0}, {1.0, 7.0, 3.0}, {0.0, 0.0, 1.0}, 50.0, 36.0, 24.0, 90, 60);
  ExpectNear(camera.Forward, {0.0, 1.0, 0.0});
  ExpectNear(camera.Right, {1.0, 0.0, 0.0});
  ExpectNear(camera.Up, {0.0, 0.0, 1.0});
  ExpectNear(camera.Direction(45.0, 30.0), camera.Forward);
  // Half of a 36 mm sensor behind a 50 mm lens.
  ExpectNear(camera.Direction(90.0, 30.0), glm::normalize(Vec3(18.0, 50.0, 0.0)));
  ExpectNear(camera.Direction(45.0, 60.0), glm::normalize(Vec3(0.0, 50.0, 12.0)));
}

TEST(Camera, KeepsPixelsSquareByCroppingTheSensor)
{
  const Camera camera =
    Camera::LookAt(Vec3(0.0), {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, 50.0, 36.0, 24.0, 256, 128);
  EXPECT_DOUBLE_EQ(camera.RightEdge - camera.Left, 36.0 / 50.0);
  EXPECT_DOUBLE_EQ(camera.Top - camera.Bottom, 18.0 / 50.0);
}

TEST(Camera, TakesAnotherUpWhereItLooksAlongIt)
{
  const Camera camera =
    Camera::LookAt(Vec3(0.0), {0.0, 0.0, -1.0}, {0.0, 0.0, 1.0}, 50.0, 36.0, 24.0, 9, 6);
  ExpectNear(camera.Up, {0.0, 1.0, 0.0});
  ExpectNear(camera.Right, {1.0, 0.0, 0.0});
}

TEST(Camera, RefusesWhatCannotBeAimed)
{
  const Vec3 up(0.0, 0.0, 1.0);
  EXPECT_THROW(Camera::LookAt(Vec3(1.0), Vec3(1.0), up, 50.0, 36.0, 24.0, 9, 6), Error);
  EXPECT_THROW(Camera::LookAt(Vec3(0.0), Vec3(1.0), up, 0.0, 36.0, 24.0, 9, 6), Error);
  EXPECT_THROW(Camera::LookAt(Vec3(0.0), Vec3(1.0), up, 50.0, 36.0, 24.0, 0, 6), Error);
  EXPECT_THROW(Camera::FramePlate({4.0, 0.5, 0.5}, Plate, up, 0.0, 8, 8), Error);
  EXPECT_THROW(Camera::FramePlate({0.0, 0.5, 0.5}, Plate, up, -1.0, 8, 8), Error);
}

TEST(Camera, FramesAPlate)
{
  const Vec3 normal(-1.0, 0.0, 0.0);
  const Camera camera = Camera::FramePlate({0.0, 0.5, 0.5}, Plate, {0.0, 0.0, 1.0}, 0.0, 64, 64);
  // Seen from the front, left is where y is largest.
  ExpectNear(At(camera, 0.0, 0.0, Plate[0], normal), Plate[0]);
  ExpectNear(At(camera, 64.0, 0.0, Plate[0], normal), Plate[1]);
  ExpectNear(At(camera, 64.0, 64.0, Plate[0], normal), Plate[2]);
}

TEST(Camera, LeavesAMarginAndFillsTheNarrowerDirection)
{
  const Vec3 normal(-1.0, 0.0, 0.0);
  const Camera camera = Camera::FramePlate({0.0, 0.5, 0.5}, Plate, {0.0, 0.0, 1.0}, 0.25, 60, 30);
  // 0.3 m and twice a quarter of it fill the height of 30 pixels, 0.015 m each.
  ExpectNear(At(camera, 0.0, 0.0, Plate[0], normal), {4.0, 0.95, 0.275});
  ExpectNear(At(camera, 60.0, 30.0, Plate[0], normal), {4.0, 0.05, 0.725});
}

TEST(Camera, KeepsAllCornersOfAnObliquePlateInThePicture)
{
  const Vec3 normal(-1.0, 0.0, 0.0);
  for (const Vec3& eye :
    {Vec3(3.5, -3.0, 0.2), Vec3(3.9, 0.69, 0.5), Vec3(3.999, 0.4, 0.4), Vec3(0.0, 3.0, 5.0)})
  {
    const Camera camera = Camera::FramePlate(eye, Plate, {0.0, 0.0, 1.0}, 0.0, 40, 30);
    double least = 1.0;
    for (const Vec3& corner : Plate)
    {
      const Vec3 ray = corner - eye;
      const double depth = glm::dot(ray, camera.Forward);
      ASSERT_GT(depth, 0.0);
      const double x =
        (glm::dot(ray, camera.Right) / depth - camera.Left) / (camera.RightEdge - camera.Left);
      const double y =
        (glm::dot(ray, camera.Up) / depth - camera.Bottom) / (camera.Top - camera.Bottom);
      EXPECT_GE(std::min({x, y, 1.0 - x, 1.0 - y}), -1e-9);
      least = std::min({least, x, y, 1.0 - x, 1.0 - y});
      ExpectNear(At(camera, 40.0 * x, 30.0 * y, Plate[0], normal), corner, 1e-9);
    }
    // The plate touches the border of the picture.
    EXPECT_NEAR(least, 0.0, 1e-9);
    EXPECT_NEAR(
      (camera.RightEdge - camera.Left) / 40.0, (camera.Top - camera.Bottom) / 30.0, 1e-12);
  }
}

} // namespace smokevis
