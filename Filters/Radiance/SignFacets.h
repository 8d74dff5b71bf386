// The plane parts of a sign that an eye looks at, and what it sees of them.
#pragma once

#include "PlateEdges.h"
#include "View.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace smokevis
{

/// A plane part of a sign, with one law of emission.
struct Facet
{
  Vec3 Normal;
  /// Its cells that face the eye.
  std::vector<std::size_t> Cells;
  /// The first one that emits, if any does: it tells the law.
  std::optional<std::size_t> Luminous;
};

std::vector<Facet> FacetsOf(const EmitterSet& lights, const Sign& sign, const Vec3& eye);

/// The point of a facet in front of a place on the sign's rectangle.
Vec3 OnFacet(
  const EmitterSet& lights, const Sign& sign, const Facet& facet, const glm::dvec2& place);

/// How far before a point of a sign, at a distance from the eye, what the eye meets still counts as
/// that point [m].
double SightReach(const View& view, const Sign& sign, double distance);

/// Whether the straight way from the eye ends at a point on the front of a sign.
bool Sees(const View& view, const Sign& sign, const Vec3& eye, const Vec3& point);

/// Whether nothing can lie between the eye and any place of a facet, which it then sees whole.
bool NothingBefore(const View& view, const Sign& sign, const Vec3& eye, const Facet& facet);

/// A look from the eye at places of a facet.
/// @param facet must, as all but the eye, outlive it
PlateLook LookAt(const View& view, const Sign& sign, const Vec3& eye, const Facet& facet);

/// Whether each emitter cell counts as lit: as it says or, where it does not, brighter by itself
/// than the mean of the sign's darkest and brightest, or as bright as all others. A sign that only
/// reflects is judged by its reflectance. Cells of other signs are not.
std::vector<bool> LitCells(const EmitterSet& lights, const Sign& sign);

} // namespace smokevis
