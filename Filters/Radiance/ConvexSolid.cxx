#include "ConvexSolid.h"

#include "PolygonClip.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace smokevis
{

namespace
{

/// Corners of a cut that lie closer than this share of the solid's size are one.
constexpr double SameCorner = 1e-9;

} // namespace

//--------------------------------------------------------------------------------------------------
ConvexSolid::ConvexSolid(const Box& box)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    for (const double end : {box.Lower[axis], box.Upper[axis]})
    {
      std::vector<Vec3> face(4);
      for (int corner = 0; corner < 4; ++corner)
      {
        face[corner][axis] = end;
        face[corner][u] = corner == 1 || corner == 2 ? box.Upper[u] : box.Lower[u];
        face[corner][v] = corner >= 2 ? box.Upper[v] : box.Lower[v];
      }
      this->Faces_.push_back(std::move(face));
    }
  }
}

//--------------------------------------------------------------------------------------------------
void ConvexSolid::AddCorner(std::vector<Vec3>& corners, const Vec3& corner, double tolerance)
{
  const bool known = std::any_of(corners.begin(), corners.end(),
    [&](const Vec3& other) { return glm::distance(corner, other) <= tolerance; });
  if (!known)
  {
    corners.push_back(corner);
  }
}

//--------------------------------------------------------------------------------------------------
std::pair<ConvexSolid, ConvexSolid> ConvexSolid::Cut(const Plane& plane) const
{
  std::pair<ConvexSolid, ConvexSolid> parts;
  const Box bounds = this->Bounds();
  const double tolerance = SameCorner * glm::length(bounds.Upper - bounds.Lower);
  // Corners in the plane to rounding lie in it: they belong to both parts.
  const auto height = [&](const Vec3& point)
  {
    const double value = plane.Height(point);
    return std::abs(value) <= tolerance ? 0.0 : value;
  };
  std::vector<Vec3> cut;
  std::vector<Vec3> kept;
  bool front = false;
  bool back = false;
  for (const std::vector<Vec3>& face : this->Faces_)
  {
    for (const Vec3& corner : face)
    {
      front = front || height(corner) > 0.0;
      back = back || height(corner) < 0.0;
    }
  }
  if (!front || !back)
  {
    (front ? parts.first : parts.second) = *this;
    return parts;
  }
  for (const std::vector<Vec3>& face : this->Faces_)
  {
    for (const double sign : {1.0, -1.0})
    {
      KeepSide(
        face, [&](const Vec3& point) { return sign * height(point); }, kept);
      for (const Vec3& corner : kept)
      {
        if (height(corner) == 0.0)
        {
          AddCorner(cut, corner, tolerance);
        }
      }
      if (kept.size() >= 3)
      {
        (sign > 0.0 ? parts.first : parts.second).Faces_.push_back(kept);
      }
    }
  }
  Vec3 middle(0.0);
  for (const Vec3& corner : cut)
  {
    middle += corner / static_cast<double>(cut.size());
  }
  const Vec3 u =
    glm::normalize(std::abs(plane.Normal.x) < 0.5 ? Vec3(0.0, plane.Normal.z, -plane.Normal.y)
                                                  : Vec3(-plane.Normal.y, plane.Normal.x, 0.0));
  const Vec3 v = glm::cross(plane.Normal, u);
  const auto angle = [&](const Vec3& corner)
  { return std::atan2(glm::dot(corner - middle, v), glm::dot(corner - middle, u)); };
  std::sort(
    cut.begin(), cut.end(), [&](const Vec3& a, const Vec3& b) { return angle(a) < angle(b); });
  parts.first.Faces_.push_back(cut);
  parts.second.Faces_.push_back(std::move(cut));
  return parts;
}

//--------------------------------------------------------------------------------------------------
template <class Visit> void ConvexSolid::ForEachTetrahedron(Visit&& visit) const
{
  const Box bounds = this->Bounds();
  Vec3 inside(0.0);
  double count = 0.0;
  for (const std::vector<Vec3>& face : this->Faces_)
  {
    for (const Vec3& corner : face)
    {
      inside += corner - bounds.Lower;
      count += 1.0;
    }
  }
  inside = bounds.Lower + inside / std::max(1.0, count);
  for (const std::vector<Vec3>& face : this->Faces_)
  {
    for (std::size_t i = 2; i < face.size(); ++i)
    {
      const Vec3 a = face[0] - inside;
      const Vec3 b = face[i - 1] - inside;
      const Vec3 c = face[i] - inside;
      visit(std::abs(glm::dot(a, glm::cross(b, c))) / 6.0, inside + 0.25 * (a + b + c));
    }
  }
}

//--------------------------------------------------------------------------------------------------
double ConvexSolid::Volume() const
{
  double sum = 0.0;
  this->ForEachTetrahedron([&sum](double volume, const Vec3&) { sum += volume; });
  return sum;
}

//--------------------------------------------------------------------------------------------------
Vec3 ConvexSolid::Centre() const
{
  const Vec3 base = this->Bounds().Lower;
  Vec3 moment(0.0);
  double sum = 0.0;
  this->ForEachTetrahedron(
    [&](double volume, const Vec3& centre)
    {
      moment += volume * (centre - base);
      sum += volume;
    });
  return sum > 0.0 ? base + moment / sum : base;
}

//--------------------------------------------------------------------------------------------------
Box ConvexSolid::Bounds() const
{
  Box box = Box::Nothing();
  for (const std::vector<Vec3>& face : this->Faces_)
  {
    box.Add(Box::Around(face));
  }
  return this->Faces_.empty() ? Box() : box;
}

//--------------------------------------------------------------------------------------------------
std::vector<Vec3> ConvexSolid::Corners() const
{
  std::vector<Vec3> corners;
  for (const std::vector<Vec3>& face : this->Faces_)
  {
    corners.insert(corners.end(), face.begin(), face.end());
  }
  return corners;
}

} // namespace smokevis
