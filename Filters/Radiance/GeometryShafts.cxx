// Geometry's part for shafts: whether all lines between a plate and a box are clear at once.
#include "Geometry.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace smokevis
{

namespace
{

/// Triangles near to a shaft that are looked at: where there are more, lines cost less.
constexpr int MostLooks = 512;

/// Balls that hold a shaft, at most.
constexpr double MostBalls = 64.0;

struct Ball
{
  Vec3 Centre;
  double Radius;
};

/// Balls in a row that together hold all of a shaft, none much wider than that: one around a long
/// shaft would hold much that is nowhere near.
std::vector<Ball> BallsAlong(const Shaft& shaft)
{
  const Box plate = Box::Around(shaft.Plate);
  const Vec3 start = shaft.Before.Centre();
  const Vec3 along = plate.Centre() - start;
  const double length = glm::length(along);
  // From the one to the other a shaft gets evenly wider or narrower.
  const double first = 0.5 * glm::length(shaft.Before.Size());
  const double last = 0.5 * glm::length(plate.Size());
  const double count = std::clamp(std::ceil(0.5 * length / std::max(first, last)), 1.0, MostBalls);
  std::vector<Ball> balls;
  for (double i = 0.0; i < count; ++i)
  {
    const double widest =
      std::max(glm::mix(first, last, i / count), glm::mix(first, last, (i + 1.0) / count));
    balls.push_back({start + (i + 0.5) / count * along, widest + 0.5 * length / count});
  }
  return balls;
}

/// A shaft's convex hull.
struct Hull
{
  explicit Hull(const Shaft& shaft)
      : Corners(shaft.Part), Plate(shaft.Plate[0]), Normal(shaft.Normal)
  {
    for (int corner = 0; corner < 8 && shaft.Part.empty(); ++corner)
    {
      const Vec3 share(corner & 1, corner >> 1 & 1, corner >> 2);
      this->Corners.push_back(shaft.Before.Lower + share * shaft.Before.Size());
    }
    this->PlateCorners = static_cast<std::ptrdiff_t>(this->Corners.size());
    this->Corners.insert(this->Corners.end(), shaft.Plate.begin(), shaft.Plate.end());
    for (const Vec3& corner : this->Corners)
    {
      this->Bounds.Add({corner, corner});
      this->Lowest = std::min(this->Lowest, this->Height(corner));
    }
  }

  double Height(const Vec3& place) const { return glm::dot(place - this->Plate, this->Normal); }

  /// Whether a plane parts it from a triangle: that of a face of the box around it, the plate's, or
  /// the triangle's own.
  /// @param touch how far before the plate triangles still count as behind it, as lines end so far
  /// before what they lead to [m]
  bool PartedFrom(const Triangle& triangle, double touch) const
  {
    const Box bounds = BoundsOf(triangle);
    if (glm::any(glm::lessThan(bounds.Upper, this->Bounds.Lower)) ||
        glm::any(glm::lessThan(this->Bounds.Upper, bounds.Lower)) ||
        std::all_of(triangle.begin(), triangle.end(),
          [&](const Vec3& corner) { return this->Height(corner) <= this->Lowest + touch; }))
    {
      return true;
    }
    const Vec3 normal = AreaVector(triangle);
    const auto above = [&](const Vec3& corner) { return glm::dot(corner - triangle[0], normal); };
    return std::all_of(this->Corners.begin(), this->Corners.end(),
             [&](const Vec3& corner) { return above(corner) > 0.0; }) ||
           std::all_of(this->Corners.begin(), this->Corners.end(),
             [&](const Vec3& corner) { return above(corner) < 0.0; });
  }

  /// Of the box or its part, then of the plate; the place of the first of these.
  std::vector<Vec3> Corners;
  std::ptrdiff_t PlateCorners = 0;
  Box Bounds = Box::Nothing();
  Vec3 Plate, Normal;
  /// Height of its lowest corner: no plate is plane but for rounding.
  double Lowest = 0.0;
};

} // namespace

std::vector<Triangle> Geometry::SurfacesNear(const Vec3& place, double radius) const
{
  std::vector<Triangle> near;
  this->Surfaces_.AllNear(place, radius,
    [&near](const Triangle& triangle)
    {
      near.push_back(triangle);
      return true;
    });
  return near;
}

bool Geometry::Free(const Shaft& shaft) const
{
  const Hull hull(shaft);
  if (!std::all_of(hull.Corners.begin(), hull.Corners.begin() + hull.PlateCorners,
        [&](const Vec3& corner) { return hull.Height(corner) > this->Tolerance_; }))
  {
    return false;
  }
  const std::vector<Ball> balls = BallsAlong(shaft);
  for (const TriangleTree* tree : {&this->Surfaces_, &this->Emitters_})
  {
    int looks = 0;
    const auto parted = [&](const Triangle& triangle)
    { return ++looks <= MostLooks && hull.PartedFrom(triangle, this->Tolerance_); };
    if (!std::all_of(balls.begin(), balls.end(),
          [&](const Ball& ball)
          { return tree->AllNear(ball.Centre, ball.Radius + this->Tolerance_, parted); }))
    {
      return false;
    }
  }
  return true;
}

} // namespace smokevis
