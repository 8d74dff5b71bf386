// How much of a light is seen from a point.
#pragma once

#include "Geometry.h"
#include "Types.h"

#include <span>
#include <vector>

namespace smokevis
{

struct LightGroup;

enum class Sight
{
  None,
  Parted,
  Whole
};

/// Tells by shadow rays to places of a light's plate, given from 0 to 1 along both of its edges.
class LightSight
{
public:
  /// @param shapes what hides lights; must outlive this
  explicit LightSight(const Geometry& shapes) : Shapes_(shapes) {}

  /// How far before a plate places of it lie to which shadow rays lead, in tolerances of the
  /// shapes: a ray that grazes a wall in whose plane the plate lies must not run within rounding of
  /// that.
  static constexpr double Lift = 10.0;

  /// Whether a group is seen whole or not at all, for it is far and nothing crosses it.
  static bool Small(const LightGroup& group, const Vec3& point);
  /// Whether something stands on the plate of a group, or goes through it, between any two of its
  /// middle and its corners.
  bool Crossed(const LightGroup& group) const;
  /// Places, as evenly spread as edges of shadows ask for, that tell what is seen of a close group.
  static std::span<const glm::dvec2> Lattice();

  /// Which of the places are seen.
  std::vector<bool> Seen(
    const LightGroup& group, const Vec3& point, std::span<const glm::dvec2> places) const;
  /// Which of the centre, the corners and eleven places between them are seen.
  std::vector<bool> SeenOfAll(const LightGroup& group, const Vec3& point) const;
  /// As its centre and its corners tell.
  Sight OfCorners(const LightGroup& group, const Vec3& point) const;
  /// As all of SeenOfAll() tell.
  Sight OfAll(const LightGroup& group, const Vec3& point) const;
  /// The same; of a small one all or nothing.
  Sight Of(const LightGroup& group, const Vec3& point) const;
  /// Share of a group that is not hidden, as fewer such places tell.
  double Share(const LightGroup& group, const Vec3& point) const;

  /// Of a group some places of which are looked at.
  static Sight OfSeen(const std::vector<bool>& seen);

private:
  /// A place right before the plate of a group.
  Vec3 Before(const LightGroup& group, const glm::dvec2& place) const;

  const Geometry& Shapes_;
};

} // namespace smokevis
