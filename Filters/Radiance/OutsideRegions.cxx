#include "OutsideRegions.h"

#include "LooseParts.h"
#include "Sampler.h"
#include "Scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <unordered_map>

#include <boost/pending/disjoint_sets.hpp>
#include <tbb/parallel_for.h>

namespace smokevis
{

namespace
{

/// Rays from each place that light comes from: together about so many, and within these bounds.
constexpr std::size_t AllRays = 262'144;
constexpr std::size_t FewestRays = 4;
constexpr std::size_t MostRays = 64;
/// From so many on they tell where light hardly passes.
constexpr std::size_t FewestToPart = 16;

/// Faces of smoke cells that light leaves all smoke through, those of a cell next to each other.
std::vector<OutsideRegions::Face> OpenFacesOf(const Scene& scene)
{
  const Medium& smoke = scene.Smoke();
  const double gap = 10.0 * scene.Shapes().Tolerance();
  std::vector<OutsideRegions::Face> faces;
  for (std::size_t i = 0; i < smoke.Cells(); ++i)
  {
    const auto cell = static_cast<std::int64_t>(i);
    for (int face = 0; face < 6 && smoke.OwnVolume(cell) > 0.0; ++face)
    {
      const int axis = face / 2;
      const int side = face % 2;
      if (smoke.Neighbour(cell, axis, side) >= 0)
      {
        continue;
      }
      Vec3 direction(0.0);
      direction[axis] = side == 0 ? -1.0 : 1.0;
      const Vec3 size = smoke.CellSize(cell);
      if (!scene.Shapes().Occluded(smoke.CellCentre(cell), direction, 0.0, 0.5 * size[axis] + gap))
      {
        faces.push_back({cell, axis, side, FaceArea(size, axis)});
      }
    }
  }
  return faces;
}

/// A plane piece that light comes from, towards its normal.
struct Piece
{
  Triangle Corners;
  Vec3 Normal;
  /// [m2].
  double Area;
};

/// Both halves of a cell's face.
std::array<Piece, 2> PiecesOf(const Medium& smoke, const OutsideRegions::Face& face)
{
  const Vec3 half = 0.5 * smoke.CellSize(face.Cell);
  Vec3 normal(0.0);
  normal[face.Axis] = face.Side == 0 ? -1.0 : 1.0;
  const Vec3 centre = smoke.CellCentre(face.Cell) + half * normal;
  Vec3 along(0.0);
  Vec3 across(0.0);
  along[(face.Axis + 1) % 3] = half[(face.Axis + 1) % 3];
  across[(face.Axis + 2) % 3] = half[(face.Axis + 2) % 3];
  return {Piece{{centre - along - across, centre + along - across, centre + along + across}, normal,
            0.5 * face.Area},
    Piece{{centre - along - across, centre + along + across, centre - along + across}, normal,
      0.5 * face.Area}};
}

/// What is seen from a place, and how much of it looks out of all smoke.
struct Reach
{
  std::vector<std::size_t> Places;
  /// Area outside of all smoke, and of that what light leaves the scene from [m2].
  double Area = 0.0, Escaping = 0.0;
};

/// The places that light comes from: sides of patches, 2 * patch + side, and after them cells with
/// open faces.
class Places
{
public:
  Places(const Scene& scene, const std::vector<OutsideRegions::Face>& faces)
      : Scene_(scene), Patches_(TrianglesOfPatches(scene))
  {
    for (const OutsideRegions::Face& face : faces)
    {
      const std::size_t cell =
        this->Cells_.try_emplace(face.Cell, this->Cells_.size()).first->second;
      this->PiecesOfCells_.resize(this->Cells_.size());
      for (const Piece& piece : PiecesOf(scene.Smoke(), face))
      {
        this->PiecesOfCells_[cell].push_back(piece);
      }
    }
    this->Rays_ = std::clamp(AllRays / this->Count(), FewestRays, MostRays);
  }

  std::size_t Rays() const { return this->Rays_; }
  std::size_t Sides() const { return 2 * this->Patches_.size(); }
  std::size_t Count() const { return this->Sides() + this->Cells_.size(); }
  std::size_t OfCell(std::int64_t cell) const { return this->Sides() + this->Cells_.at(cell); }

  Reach From(std::size_t place) const
  {
    const std::vector<Piece> pieces = this->Pieces(place);
    const double area = std::accumulate(pieces.begin(), pieces.end(), 0.0,
      [](double sum, const Piece& piece) { return sum + piece.Area; });
    const EvenPoints points(place);
    const double share = 1.0 / static_cast<double>(this->Rays_);
    Reach reach;
    for (std::size_t ray = 0; ray < this->Rays_ && area > 0.0; ++ray)
    {
      this->Follow(pieces, area, points.Point(ray), place < this->Sides(), reach);
    }
    const double exposed =
      place < this->Sides() ? this->Scene_.ExposedArea(place / 2, place % 2) : area;
    reach.Area *= share * exposed;
    reach.Escaping *= share * exposed;
    return reach;
  }

private:
  std::vector<Piece> Pieces(std::size_t place) const
  {
    if (place >= this->Sides())
    {
      return this->PiecesOfCells_[place - this->Sides()];
    }
    std::vector<Piece> pieces;
    for (const Triangle& corners : this->Patches_[place / 2])
    {
      const Vec3 vector = AreaVector(corners);
      const double area = glm::length(vector);
      pieces.push_back({corners, (place % 2 == 0 ? 1.0 : -1.0) / area * vector, area});
    }
    return pieces;
  }

  /// Adds a ray to what is seen; counts rays in its areas.
  void Follow(const std::vector<Piece>& pieces, double area, const std::array<double, 4>& random,
    bool ofSide, Reach& reach) const
  {
    // The piece that a share of the area falls into, and where in it.
    double share = random[0] * area;
    auto piece = pieces.begin();
    while (piece + 1 != pieces.end() && share > piece->Area)
    {
      share -= piece->Area;
      ++piece;
    }
    const double root = std::sqrt(std::clamp(share / piece->Area, 0.0, 1.0));
    const Triangle& corners = piece->Corners;
    const Vec3 along = corners[1] - corners[0];
    const Vec3 origin = corners[0] + root * (1.0 - random[1]) * along +
                        root * random[1] * (corners[2] - corners[0]) +
                        10.0 * this->Scene_.Shapes().Tolerance() * piece->Normal;
    const Medium& smoke = this->Scene_.Smoke();
    if (ofSide && smoke.Locate(origin) >= 0)
    {
      return;
    }
    reach.Area += 1.0;
    const Vec3 direction =
      LambertianDirection(piece->Normal, glm::normalize(along), random[2], random[3]);
    const double far = 2.0 * glm::length(this->Scene_.Upper() - this->Scene_.Lower());
    const Hit hit = this->Scene_.Shapes().Intersect(origin, direction, 0.0, far);
    thread_local std::vector<Segment> met;
    smoke.Walk(origin, direction, 0.0, std::min(far, hit.Distance), met);
    const auto cell = met.empty() ? this->Cells_.end() : this->Cells_.find(met.front().Cell);
    if (cell != this->Cells_.end())
    {
      reach.Places.push_back(this->Sides() + cell->second);
    }
    else if (met.empty() && hit.Found())
    {
      // Of surfaces that lie in one another, the one that lines meet.
      thread_local std::vector<Crossing> crossings;
      const double gap = 2.0 * this->Scene_.Shapes().Tolerance();
      this->Scene_.Shapes().Cross(
        origin, direction, std::max(0.0, hit.Distance - gap), hit.Distance + gap, crossings);
      const Hit arrive = crossings.empty() ? hit : crossings.front().Arrive;
      reach.Places.push_back(2 * this->Scene_.Patch(arrive) + arrive.Side);
    }
    reach.Escaping += met.empty() && !hit.Found() ? 1.0 : 0.0;
  }

  const Scene& Scene_;
  std::vector<std::vector<Triangle>> Patches_;
  /// Numbers of cells with open faces.
  std::unordered_map<std::int64_t, std::size_t> Cells_;
  std::vector<std::vector<Piece>> PiecesOfCells_;
  std::size_t Rays_ = 0;
};

} // namespace

OutsideRegions::OutsideRegions(const Scene& scene)
    : Faces_(OpenFacesOf(scene)), OfSide_(2 * scene.Patches(), -1)
{
  if (this->Faces_.empty())
  {
    return;
  }
  const Places places(scene, this->Faces_);
  std::vector<Reach> reaches(places.Count());
  std::vector<char> seen(places.Count(), 0);
  boost::disjoint_sets_with_storage<> joined(places.Count());
  std::vector<std::size_t> starts(places.Count() - places.Sides());
  std::iota(starts.begin(), starts.end(), places.Sides());
  std::fill(seen.begin() + static_cast<std::ptrdiff_t>(places.Sides()), seen.end(), 1);
  while (!starts.empty())
  {
    tbb::parallel_for(std::size_t{0}, starts.size(),
      [&](std::size_t i) { reaches[starts[i]] = places.From(starts[i]); });
    std::vector<std::size_t> next;
    for (const std::size_t start : starts)
    {
      for (const std::size_t place : reaches[start].Places)
      {
        joined.union_set(start, place);
        // A side that a solid stands on would lead into it.
        if (seen[place] == 0 && !(scene.EnclosedArea(place / 2, static_cast<int>(place % 2)) > 0.0))
        {
          next.push_back(place);
        }
        seen[place] = 1;
      }
    }
    starts = std::move(next);
  }

  std::unordered_map<std::size_t, std::vector<std::size_t>> together;
  std::vector<std::vector<std::size_t>> reached(places.Count());
  std::vector<double> areas(places.Count(), 0.0);
  for (std::size_t place = 0; place < places.Count(); ++place)
  {
    if (seen[place] != 0)
    {
      together[joined.find_set(place)].push_back(place);
      areas[place] = reaches[place].Area;
      reached[place] = reaches[place].Places;
    }
  }
  std::vector<std::int32_t> regions(places.Count(), -1);
  for (std::size_t place = 0; place < places.Count(); ++place)
  {
    const auto members = seen[place] != 0 ? together.find(joined.find_set(place)) : together.end();
    if (members == together.end() || regions[place] >= 0)
    {
      continue;
    }
    for (const std::vector<std::size_t>& part :
      places.Rays() < FewestToPart ? std::vector<std::vector<std::size_t>>{members->second}
                                   : LooseParts(members->second, reached, areas))
    {
      double area = 0.0;
      double escaping = 0.0;
      for (const std::size_t member : part)
      {
        regions[member] = static_cast<std::int32_t>(this->EscapingShare_.size());
        area += areas[member];
        escaping += reaches[member].Escaping;
      }
      this->BoundingArea_.push_back(area);
      this->EscapingShare_.push_back(escaping / std::max(area, 1e-300));
    }
  }
  for (const Face& face : this->Faces_)
  {
    this->OfFace_.push_back(regions[places.OfCell(face.Cell)]);
  }
  std::copy_n(regions.begin(), places.Sides(), this->OfSide_.begin());
  for (std::size_t place = 0; place < places.Count(); ++place)
  {
    for (const std::size_t other : reached[place])
    {
      if (regions[other] != regions[place])
      {
        // Either way tells it.
        this->Passages_[std::minmax(regions[place], regions[other])] +=
          0.5 * areas[place] / static_cast<double>(places.Rays());
      }
    }
  }
}

} // namespace smokevis
