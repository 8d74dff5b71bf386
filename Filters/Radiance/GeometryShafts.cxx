// Geometry's part for shafts: whether all lines between a plate and a box are clear at once.
#include "Geometry.h"

#include <algorithm>
#include <cmath>

#include <embree3/rtcore.h>

namespace smokevis
{

namespace
{

/// Triangles near to a shaft that are looked at: where there are more, lines cost less.
constexpr int MostLooks = 512;

} // namespace

/// A shaft as Embree's search passes it on, in the scene's units from its centre.
struct TriangleTree::ShaftSearch
{
  explicit ShaftSearch(const TriangleTree& tree) : Tree(tree) {}

  const TriangleTree& Tree;
  std::array<Vec3, 12> Corners{};
  Box Bounds = Box::Nothing();
  Vec3 Plate{0.0}, Normal{0.0};
  int Looks = 0;
  bool Met = false;

  /// Whether a plane parts a triangle from the shaft: the plate's, that of a face of the box around
  /// the shaft, or the triangle's own.
  bool Parted(const Triangle& triangle) const
  {
    const Box bounds = BoundsOf(triangle);
    if (glm::any(glm::lessThan(bounds.Upper, this->Bounds.Lower)) ||
        glm::any(glm::lessThan(this->Bounds.Upper, bounds.Lower)))
    {
      return true;
    }
    if (std::all_of(triangle.begin(), triangle.end(),
          [this](const Vec3& corner)
          { return glm::dot(corner - this->Plate, this->Normal) <= this->Tree.Tolerance_; }))
    {
      return true;
    }
    const Vec3 normal = AreaVector(triangle);
    const auto height = [&](const Vec3& corner) { return glm::dot(corner - triangle[0], normal); };
    return std::all_of(this->Corners.begin(), this->Corners.end(),
             [&](const Vec3& corner) { return height(corner) > 0.0; }) ||
           std::all_of(this->Corners.begin(), this->Corners.end(),
             [&](const Vec3& corner) { return height(corner) < 0.0; });
  }

  static bool Look(RTCPointQueryFunctionArguments* arguments)
  {
    auto& search = *static_cast<ShaftSearch*>(arguments->userPtr);
    ++search.Looks;
    if (!search.Met && search.Looks <= MostLooks &&
        search.Parted(search.Tree.FromCentre(arguments->primID)))
    {
      return false;
    }
    search.Met = true;
    // Nothing else needs to be looked at.
    arguments->query->radius = 0.0F;
    return true;
  }
};

Triangle TriangleTree::FromCentre(std::uint32_t triangle) const
{
  Triangle corners;
  for (int corner = 0; corner < 3; ++corner)
  {
    const float* const place =
      this->Vertices_ + 3 * std::size_t{this->Indices_[3 * std::size_t{triangle} + corner]};
    corners[corner] = Vec3(place[0], place[1], place[2]);
  }
  return corners;
}

bool TriangleTree::Free(const Shaft& shaft) const
{
  if (this->Empty())
  {
    return true;
  }
  ShaftSearch search(*this);
  search.Normal = shaft.Normal;
  search.Plate = shaft.Plate[0] - this->Centre_;
  for (int corner = 0; corner < 8; ++corner)
  {
    const Vec3 share(corner & 1, corner >> 1 & 1, corner >> 2);
    search.Corners[corner] = shaft.Before.Lower + share * shaft.Before.Size() - this->Centre_;
    if (!(glm::dot(search.Corners[corner] - search.Plate, search.Normal) > this->Tolerance_))
    {
      return false;
    }
  }
  for (int corner = 0; corner < 4; ++corner)
  {
    search.Corners[8 + corner] = shaft.Plate[corner] - this->Centre_;
  }
  for (const Vec3& corner : search.Corners)
  {
    search.Bounds.Add({corner, corner});
  }
  const Vec3 centre = search.Bounds.Centre();
  RTCPointQuery query;
  query.x = static_cast<float>(centre.x);
  query.y = static_cast<float>(centre.y);
  query.z = static_cast<float>(centre.z);
  query.time = 0.0F;
  query.radius = static_cast<float>(0.5 * glm::length(search.Bounds.Size()));
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(this->Tree_.get(), &query, &context, ShaftSearch::Look, &search);
  return !search.Met;
}

bool Geometry::Free(const Shaft& shaft) const
{
  return this->Surfaces_.Free(shaft) && this->Emitters_.Free(shaft);
}

} // namespace smokevis
