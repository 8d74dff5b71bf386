#include "Geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace smokevis
{

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

/// Shapes that touch lie within this share of the size of the part of the scene that matters: well
/// below anything that matters to light; and at least within that share of the whole: well above
/// the rounding of the single precision that Embree works in.
constexpr double RelativeTolerance = 1e-5;
constexpr double RoundingShare = 1e-6;
/// Cosine of the angle between surfaces above which those that touch lie in one another.
constexpr double SamePlane = 0.999;

} // namespace

Geometry::Geometry(
  const SurfaceMesh& surfaces, const SurfaceMesh& emitters, double sceneSize, double coreSize)
{
  Vec3 lower(Infinity);
  Vec3 upper(-Infinity);
  for (const SurfaceMesh* mesh : {&surfaces, &emitters})
  {
    for (const Vec3& point : mesh->Points)
    {
      lower = glm::min(lower, point);
      upper = glm::max(upper, point);
    }
  }
  if (surfaces.Points.empty() && emitters.Points.empty())
  {
    return;
  }
  const Vec3 centre = 0.5 * (lower + upper);
  const double size = std::max(sceneSize, glm::length(upper - lower));
  this->Tolerance_ = std::max(
    RelativeTolerance * (coreSize > 0.0 ? std::min(coreSize, size) : size), RoundingShare * size);
  const TriangleTree::Device device = TriangleTree::NewDevice();
  this->Surfaces_ = TriangleTree(device, surfaces, false, centre, this->Tolerance_);
  this->Emitters_ = TriangleTree(device, emitters, true, centre, this->Tolerance_);
}

bool Geometry::Touch(const Hit& surface, const Hit& plate, const Vec3& direction) const
{
  const double facing = std::abs(glm::dot(this->Emitters_.Normal(plate.Triangle), direction));
  return std::abs(plate.Distance - surface.Distance) * facing <= this->Tolerance_;
}

Hit Geometry::FirstOfModel(std::vector<Hit>::const_iterator nearest,
  std::vector<Hit>::const_iterator end, double gap, bool farthest) const
{
  if (nearest == end)
  {
    return {};
  }
  const auto behind = std::find_if(
    nearest, end, [&](const Hit& hit) { return hit.Distance > nearest->Distance + gap; });
  Hit first = farthest ? *(behind - 1) : *nearest;
  const Vec3 normal = this->Surfaces_.Normal(first.Triangle);
  for (auto other = nearest; other != behind; ++other)
  {
    const bool inside =
      std::abs(glm::dot(normal, this->Surfaces_.Normal(other->Triangle))) > SamePlane;
    first = inside && other->Triangle < first.Triangle ? *other : first;
  }
  return first;
}

void Geometry::IntersectBoth(const Vec3& origin, const Vec3& direction, double begin, double end,
  Hit& surface, Hit& plate) const
{
  surface = this->Surfaces_.Intersect(origin, direction, begin, end);
  const double reach = std::min(end, surface.Distance + 20.0 * this->Tolerance_);
  plate = this->Emitters_.Intersect(origin, direction, begin, reach);
}

Hit Geometry::Intersect(const Vec3& origin, const Vec3& direction, double begin, double end) const
{
  Hit surface;
  Hit plate;
  this->IntersectBoth(origin, direction, begin, end, surface, plate);
  if (!plate.Found())
  {
    return surface;
  }
  // A plate mounted on a wall is seen from its front only, whichever way rounding falls.
  if (surface.Found() && this->Touch(surface, plate, direction))
  {
    return plate.Side == 0 ? plate : surface;
  }
  return plate.Distance < surface.Distance ? plate : surface;
}

void Geometry::Cross(const Vec3& origin, const Vec3& direction, double begin, double end,
  std::vector<Crossing>& crossings) const
{
  crossings.clear();
  const double gap = 2.0 * this->Tolerance_;
  const auto otherSide = [](Hit hit)
  {
    hit.Side = 1 - hit.Side;
    return hit;
  };
  thread_local std::vector<Hit> surfaces;
  thread_local std::vector<Hit> plates;
  this->Surfaces_.IntersectAll(origin, direction, begin, end, surfaces);
  this->Emitters_.IntersectAll(origin, direction, begin, end, plates);
  auto nextSurface = surfaces.begin();
  auto nextPlate = plates.begin();
  while (end > begin)
  {
    const auto behind = [begin](const Hit& hit) { return hit.Distance >= begin; };
    nextSurface = std::find_if(nextSurface, surfaces.end(), behind);
    nextPlate = std::find_if(nextPlate, plates.end(), behind);
    // Where a line cuts an edge, it comes out of another surface than it went into: taken for
    // one, they would let it into a closed box, or out.
    const Hit surface = this->FirstOfModel(nextSurface, surfaces.end(), gap, false);
    const Hit last = this->FirstOfModel(nextSurface, surfaces.end(), gap, true);
    const Hit plate = nextPlate == plates.end() ? Hit() : *nextPlate;
    if (!surface.Found() && !plate.Found())
    {
      return;
    }
    Crossing crossing;
    if (surface.Found() && plate.Found() && this->Touch(surface, plate, direction))
    {
      crossing.Arrive = plate.Side == 0 ? plate : surface;
      crossing.Leave = otherSide(plate.Side == 0 ? last : plate);
    }
    else
    {
      const bool onPlate = plate.Distance < surface.Distance;
      crossing.Arrive = onPlate ? plate : surface;
      crossing.Leave = otherSide(onPlate ? plate : last);
    }
    begin = std::max(crossing.Arrive.Distance, crossing.Leave.Distance) + gap;
    // A line meets a plane triangle once: a second time is rounding at grazing incidence.
    const bool again = !crossings.empty() &&
                       crossings.back().Arrive.Triangle == crossing.Arrive.Triangle &&
                       crossings.back().Arrive.Emitter == crossing.Arrive.Emitter;
    if (!again)
    {
      crossings.push_back(crossing);
    }
  }
}

bool Geometry::Occluded(const Vec3& origin, const Vec3& direction, double begin, double end) const
{
  return this->Surfaces_.Occluded(origin, direction, begin, end) ||
         this->Emitters_.Occluded(origin, direction, begin, end);
}

bool Geometry::Visible(const Vec3& from, const Vec3& to) const
{
  const double length = glm::length(to - from);
  // Single precision places a far shape to a share of its distance.
  const double gap = std::max(2.0 * this->Tolerance_, 2e-6 * length);
  if (length <= 2.0 * gap)
  {
    return true;
  }
  return !this->Occluded(from, (to - from) / length, gap, length - gap);
}

} // namespace smokevis
