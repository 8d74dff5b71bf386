#include "LightSight.h"

#include "Emitters.h"

#include <algorithm>
#include <array>
#include <iterator>

namespace smokevis
{

namespace
{

/// How far from the edges of a plate that something crosses places lie to which shadow rays lead,
/// in tolerances of the shapes: these do not tell what stands closer. At most a share of each edge.
constexpr double Margin = 4.0;
constexpr double MostMargin = 0.25;
/// Below this radius over distance a light is seen whole or not at all.
constexpr double SmallRatio = 0.05;
/// Places of a light that is partly hidden to which shadow rays lead: a lattice of Fibonacci's, so
/// that no two lie level with each other along either edge.
constexpr int ShadowPlaces = 55;
constexpr int ShadowStep = 34;
/// The same where what is seen of a close light is weighted place by place.
constexpr int ClosePlaces = 144;
constexpr int CloseStep = 89;
/// Each such place is looked at to tell whether anything is hidden.
constexpr int FewShadowPlaces = 5;

/// Where in its part of each edge a place lies: off the middle, as edges of shadows often run
/// through fractions of a plate, where rounding would decide.
constexpr glm::dvec2 ShadowShift(0.4637, 0.5417);

/// The places of a lattice, 0 to 1 along both edges.
template <int Count, int Step> constexpr std::array<glm::dvec2, Count> MakeLattice()
{
  std::array<glm::dvec2, Count> places{};
  for (int number = 0; number < Count; ++number)
  {
    places[number] =
      (glm::dvec2(number, number * Step % Count) + ShadowShift) / static_cast<double>(Count);
  }
  return places;
}

constexpr auto ShadowLattice = MakeLattice<ShadowPlaces, ShadowStep>();
constexpr auto CloseLattice = MakeLattice<ClosePlaces, CloseStep>();

/// The centre and the corners, which lie in from the edges: those may touch what the light hangs
/// on.
constexpr double Inset = 0.04;
constexpr std::array<glm::dvec2, 5> CornerPlaces = {glm::dvec2(0.5, 0.5), glm::dvec2(Inset, Inset),
  glm::dvec2(Inset, 1.0 - Inset), glm::dvec2(1.0 - Inset, Inset),
  glm::dvec2(1.0 - Inset, 1.0 - Inset)};

/// These and some of the lattice.
static_assert(ShadowPlaces % FewShadowPlaces == 0);
constexpr auto FewPlaces = []
{
  std::array<glm::dvec2, CornerPlaces.size() + ShadowPlaces / FewShadowPlaces> places{};
  std::copy(CornerPlaces.begin(), CornerPlaces.end(), places.begin());
  for (std::size_t i = CornerPlaces.size(); i < places.size(); ++i)
  {
    places[i] = ShadowLattice[(i - CornerPlaces.size()) * FewShadowPlaces];
  }
  return places;
}();

} // namespace

bool LightSight::Small(const LightGroup& group, const Vec3& point)
{
  return !group.Crossed && group.Radius < SmallRatio * glm::length(group.Centre - point);
}

bool LightSight::Crossed(const LightGroup& group) const
{
  // A wall may go right through the middle: corners look at each other, too.
  std::vector<LineOfSight> lines;
  for (auto one = CornerPlaces.begin(); one != CornerPlaces.end(); ++one)
  {
    for (auto other = std::next(one); other != CornerPlaces.end(); ++other)
    {
      lines.push_back({this->Before(group, *one), this->Before(group, *other)});
    }
  }
  return OfSeen(this->Shapes_.Visible(lines)) != Sight::Whole;
}

Vec3 LightSight::Before(const LightGroup& group, const glm::dvec2& place) const
{
  const double tolerance = this->Shapes_.Tolerance();
  glm::dvec2 at = place;
  if (group.Crossed)
  {
    // Away from what may stand at the edges.
    const std::array<Vec3, 4>& corners = group.Corners;
    const glm::dvec2 lengths(
      glm::length(glm::mix(corners[1] - corners[0], corners[2] - corners[3], at.y)),
      glm::length(glm::mix(corners[3] - corners[0], corners[2] - corners[1], at.x)));
    const glm::dvec2 margin =
      glm::min(glm::dvec2(MostMargin), Margin * tolerance / glm::max(lengths, tolerance));
    at = glm::clamp(at, margin, 1.0 - margin);
  }
  return group.At(at.x, at.y) + Lift * tolerance * group.Normal;
}

std::span<const glm::dvec2> LightSight::Lattice()
{
  return CloseLattice;
}

std::vector<bool> LightSight::Seen(
  const LightGroup& group, const Vec3& point, std::span<const glm::dvec2> places) const
{
  std::vector<LineOfSight> lines;
  lines.reserve(places.size());
  for (const glm::dvec2& place : places)
  {
    lines.push_back({point, this->Before(group, place)});
  }
  return this->Shapes_.Visible(lines);
}

Sight LightSight::OfSeen(const std::vector<bool>& seen)
{
  const auto count = std::count(seen.begin(), seen.end(), true);
  return count == 0 ? Sight::None : (count == std::ssize(seen) ? Sight::Whole : Sight::Parted);
}

std::vector<bool> LightSight::SeenOfAll(const LightGroup& group, const Vec3& point) const
{
  return this->Seen(group, point, FewPlaces);
}

Sight LightSight::OfCorners(const LightGroup& group, const Vec3& point) const
{
  return OfSeen(this->Seen(group, point, CornerPlaces));
}

Sight LightSight::OfAll(const LightGroup& group, const Vec3& point) const
{
  return OfSeen(this->SeenOfAll(group, point));
}

Sight LightSight::Of(const LightGroup& group, const Vec3& point) const
{
  if (Small(group, point))
  {
    return this->Shapes_.Visible(point, group.Centre) ? Sight::Whole : Sight::None;
  }
  return this->OfAll(group, point);
}

double LightSight::Share(const LightGroup& group, const Vec3& point) const
{
  const std::vector<bool> seen = this->Seen(group, point, ShadowLattice);
  return static_cast<double>(std::count(seen.begin(), seen.end(), true)) / ShadowPlaces;
}

} // namespace smokevis
