// Geometry's part for all shapes that a line meets.
#include "Geometry.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace smokevis
{

namespace
{

/// Cosine of the angle between surfaces above which those that touch lie in one another.
constexpr double SamePlane = 0.999;

Hit OtherSide(Hit hit)
{
  hit.Side = 1 - hit.Side;
  return hit;
}

} // namespace

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

void Geometry::Cross(const Vec3& origin, const Vec3& direction, double begin, double end,
  std::vector<Crossing>& crossings) const
{
  crossings.clear();
  const double gap = 2.0 * this->Tolerance_;
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
      break;
    }
    Crossing crossing;
    const bool touch = surface.Found() && plate.Found() && this->Touch(surface, plate, direction);
    crossing.Several = touch || (surface.Found() && std::next(nextSurface) != surfaces.end() &&
                                  std::next(nextSurface)->Distance <= nextSurface->Distance + gap);
    if (touch)
    {
      crossing.Arrive = plate.Side == 0 ? plate : surface;
      crossing.Leave = OtherSide(plate.Side == 0 ? last : plate);
    }
    else
    {
      const bool onPlate = plate.Distance < surface.Distance;
      crossing.Arrive = onPlate ? plate : surface;
      crossing.Leave = OtherSide(onPlate ? plate : last);
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
  if (!this->Bodies_.empty())
  {
    this->PreferOwnBacks(surfaces, crossings);
  }
}

void Geometry::PreferOwnBacks(
  const std::vector<Hit>& surfaces, std::vector<Crossing>& crossings) const
{
  const double gap = 2.0 * this->Tolerance_;
  for (Crossing& crossing : crossings)
  {
    const double low = crossing.Arrive.Distance - gap;
    const double high = crossing.Arrive.Distance + gap;
    for (auto hit = surfaces.begin(); crossing.Several && hit != surfaces.end(); ++hit)
    {
      const std::uint32_t body = this->Bodies_[hit->Triangle];
      if (hit->Distance < low || hit->Distance > high || body == NoBody)
      {
        continue;
      }
      // Whether the line went into the body where it met that last, and leaves it where it will
      // meet it next.
      const auto ofBody = [&](const Hit& other) { return this->Bodies_[other.Triangle] == body; };
      const auto meets = [&](const Hit& place, int side)
      {
        return std::any_of(surfaces.begin(), surfaces.end(),
          [&](const Hit& other)
          {
            return ofBody(other) && other.Side == side &&
                   std::abs(other.Distance - place.Distance) <= gap;
          });
      };
      const auto last = std::find_if(surfaces.rbegin(), surfaces.rend(),
        [&](const Hit& other) { return other.Distance < low && ofBody(other); });
      const auto next = std::find_if(surfaces.begin(), surfaces.end(),
        [&](const Hit& other) { return other.Distance > high && ofBody(other); });
      if (hit->Side == 1 && !crossing.Arrive.Emitter && last != surfaces.rend() && meets(*last, 0))
      {
        crossing.Arrive = *hit;
      }
      if (hit->Side == 0 && !crossing.Leave.Emitter && next != surfaces.end() && meets(*next, 1))
      {
        crossing.Leave = OtherSide(*hit);
      }
    }
  }
}

} // namespace smokevis
