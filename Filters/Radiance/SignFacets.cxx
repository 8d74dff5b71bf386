#include "SignFacets.h"

#include "PlateColumns.h"
#include "PolygonClip.h"

#include <algorithm>
#include <cmath>

namespace smokevis
{

namespace
{

/// Cells seen this much edge on in the plane of the plate have no extent there.
constexpr double LeastFacing = 1e-3;
/// Share of a sign's radius that its surface may lie off the plane of a facet: what is farther
/// before it hides it.
constexpr double LargestStep = 1e-3;

} // namespace

//--------------------------------------------------------------------------------------------------
std::vector<Facet> FacetsOf(const EmitterSet& lights, const Sign& sign, const Vec3& eye)
{
  std::vector<Facet> facets;
  for (const std::size_t cell : sign.Cells)
  {
    const Vec3& normal = lights.CellNormal(cell);
    if (glm::dot(eye - lights.CellCentre(cell), normal) <= 0.0 ||
        std::abs(glm::dot(normal, sign.Normal)) < LeastFacing)
    {
      continue;
    }
    const bool luminous = Luminance(lights.Cells()[cell].Luminance, lights.Bands()) > 0.0;
    const auto same = [&](const Facet& facet)
    {
      return lights.InOnePlane(cell, facet.Cells.front()) &&
             (!luminous || !facet.Luminous ||
               lights.CellLaw(cell) == lights.CellLaw(*facet.Luminous));
    };
    auto facet = std::find_if(facets.begin(), facets.end(), same);
    if (facet == facets.end())
    {
      facets.push_back({normal, {}, {}});
      facet = facets.end() - 1;
    }
    facet->Cells.push_back(cell);
    if (luminous && !facet->Luminous)
    {
      facet->Luminous = cell;
    }
  }
  return facets;
}

//--------------------------------------------------------------------------------------------------
Vec3 OnFacet(
  const EmitterSet& lights, const Sign& sign, const Facet& facet, const glm::dvec2& place)
{
  const Vec3 point = OnPlate(sign, place.x, place.y);
  const Vec3 off = lights.CellCentre(facet.Cells.front()) - point;
  return point + glm::dot(off, facet.Normal) / glm::dot(sign.Normal, facet.Normal) * sign.Normal;
}

//--------------------------------------------------------------------------------------------------
double SightReach(const View& view, const Sign& sign, double distance)
{
  return 20.0 * view.TheScene().Shapes().Tolerance() + 1e-5 * distance + LargestStep * sign.Radius;
}

//--------------------------------------------------------------------------------------------------
bool Sees(const View& view, const Sign& sign, const Vec3& eye, const Vec3& point)
{
  const Vec3 to = point - eye;
  const double distance = glm::length(to);
  const Geometry& shapes = view.TheScene().Shapes();
  const double reach = SightReach(view, sign, distance);
  const Hit hit = view.FirstHit(eye, to / distance, distance + reach);
  if (!hit.Found() || !hit.Emitter || hit.Side != 0 || hit.Distance < distance - reach)
  {
    return false;
  }
  // On the seam between two cells of a sign either may be hit.
  return view.TheScene().Lights().Cells()[shapes.Cell(hit)].SignId == sign.Id;
}

//--------------------------------------------------------------------------------------------------
bool NothingBefore(const View& view, const Sign& sign, const Vec3& eye, const Facet& facet)
{
  const Scene& scene = view.TheScene();
  const auto corner = [&](double u, double v) {
    return OnFacet(scene.Lights(), sign, facet, {u, v});
  };
  // What touches a plate leaves it free, which another sign does not.
  const Shaft shaft{{corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)},
    facet.Normal, {eye, eye}};
  return view.Skips().Looks && sign.Alone && scene.Shapes().Free(shaft);
}

//--------------------------------------------------------------------------------------------------
PlateLook LookAt(const View& view, const Sign& sign, const Vec3& eye, const Facet& facet)
{
  const EmitterSet& lights = view.TheScene().Lights();
  std::vector<FlatPolygon> cells;
  for (const std::size_t cell : facet.Cells)
  {
    FlatPolygon& corners = cells.emplace_back();
    for (const Vec3& vertex : lights.Cells()[cell].Vertices)
    {
      corners.push_back(PlaceOnPlate(sign, vertex));
    }
  }
  return [&view, &sign, &lights, &facet, eye, cells = std::move(cells)](const glm::dvec2& place)
  {
    if (std::none_of(
          cells.begin(), cells.end(), [&](const FlatPolygon& cell) { return Holds(cell, place); }))
    {
      return PlateSight::Nothing;
    }
    return Sees(view, sign, eye, OnFacet(lights, sign, facet, place)) ? PlateSight::Seen
                                                                      : PlateSight::Hidden;
  };
}

//--------------------------------------------------------------------------------------------------
std::vector<bool> LitCells(const EmitterSet& lights, const Sign& sign)
{
  std::vector<double> brightness(lights.Cells().size(), 0.0);
  double brightest = 0.0;
  double darkest = 1e300;
  for (const bool reflecting : {false, true})
  {
    for (const std::size_t cell : sign.Cells)
    {
      const EmitterCell& emitter = lights.Cells()[cell];
      brightness[cell] =
        Luminance(reflecting ? emitter.Reflectance : emitter.Luminance, lights.Bands());
      brightest = std::max(brightest, brightness[cell]);
      darkest = std::min(darkest, brightness[cell]);
    }
    if (brightest > 0.0)
    {
      break;
    }
    darkest = 1e300;
  }
  std::vector<bool> lit(lights.Cells().size(), false);
  for (const std::size_t cell : sign.Cells)
  {
    const int part = lights.Cells()[cell].Part;
    const bool even = brightest == darkest && brightest > 0.0;
    lit[cell] = part < 0 ? even || brightness[cell] > 0.5 * (brightest + darkest) : part == 1;
  }
  return lit;
}

} // namespace smokevis
