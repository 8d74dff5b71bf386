#include "SurfaceCuts.h"

#include "Box.h"
#include "Geometry.h"
#include "LightLeaves.h"
#include "LightSight.h"
#include "Triangle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

namespace smokevis
{

namespace
{

/// Times that a light, and each of its parts, is divided at most.
constexpr int MostCuts = 4;
/// Share of a plate across a line that each side of it has to have, and of the line through the
/// plate that surfaces have to lie on: a frame, and what is small against the plate, or round,
/// makes no swarm of lights.
constexpr double LeastShare = 0.02;
constexpr double LeastCovered = 1.0 / 3.0;
/// Lines that are looked at, those with the longest pieces of triangles first.
constexpr int MostLines = 16;

/// What a plane has of a triangle.
struct Piece
{
  Vec3 Begin, End;
  /// What lies on a plate [m].
  double Length = 0.0;

  /// Longest first, and the same whichever way the triangles come.
  bool operator<(const Piece& other) const
  {
    const auto key = [](const Piece& piece)
    {
      return std::make_tuple(-piece.Length, piece.Begin.x, piece.Begin.y, piece.Begin.z,
        piece.End.x, piece.End.y, piece.End.z);
    };
    return key(*this) < key(other);
  }
};

/// None of a triangle that lies on one side of the plane.
std::optional<Piece> InPlane(const Triangle& triangle, const Plane& plane)
{
  std::array<Vec3, 2> ends{};
  std::size_t found = 0;
  for (std::size_t corner = 0; corner < 3; ++corner)
  {
    const Vec3& here = triangle[corner];
    const Vec3& next = triangle[(corner + 1) % 3];
    const double a = plane.Height(here);
    const double b = plane.Height(next);
    if ((a > 0.0) != (b > 0.0))
    {
      ends[found++] = here + a / (a - b) * (next - here);
    }
  }
  return found == ends.size() ? std::optional(Piece{ends[0], ends[1]}) : std::nullopt;
}

/// Length of the straight line between two points that lies within a rectangle.
double LengthWithin(const Vec3& begin, const Vec3& end, const std::array<Vec3, 4>& rectangle)
{
  const auto place = [&rectangle](const Vec3& point)
  {
    const Vec3 u = rectangle[1] - rectangle[0];
    const Vec3 v = rectangle[3] - rectangle[0];
    const Vec3 from = point - rectangle[0];
    return Vec3(glm::dot(from, u) / glm::dot(u, u), glm::dot(from, v) / glm::dot(v, v), 0.0);
  };
  double from = 0.0;
  double to = 1.0;
  const bool meets = Box{Vec3(0.0, 0.0, -1.0), Vec3(1.0)}.Clip(
    place(begin), 1.0 / (place(end) - place(begin)), from, to);
  return meets ? (to - from) * glm::length(end - begin) : 0.0;
}

/// Whether a plane leaves enough of a plate with these corners on both sides.
bool Divides(const Plane& plane, std::span<const Vec3> corners)
{
  double below = 0.0;
  double above = 0.0;
  for (const Vec3& corner : corners)
  {
    const double height = plane.Height(corner);
    below = std::max(below, -height);
    above = std::max(above, height);
  }
  return std::min(below, above) >= LeastShare * (below + above);
}

std::vector<Vec3> CornersOf(const std::vector<LightGroup>& leaves)
{
  std::vector<Vec3> corners;
  for (const LightGroup& leaf : leaves)
  {
    corners.insert(corners.end(), leaf.Corners.begin(), leaf.Corners.end());
  }
  return corners;
}

} // namespace

std::optional<Plane> SurfaceCuts::Longest(
  const std::vector<LightGroup>& leaves, std::span<const Vec3> corners) const
{
  const Vec3& normal = leaves.front().Normal;
  const std::array<Vec3, 4> plate = RectangleAround(leaves, leaves.front().Centre);
  const Vec3 centre = 0.5 * (plate[0] + plate[2]);
  const double diagonal = glm::length(plate[2] - plate[0]);
  // Where rays to the plate end: walls that it lies in, or that end at it from behind, hide
  // nothing.
  const double lift = LightSight::Lift * this->Shapes_.Tolerance();
  const Plane before{normal, glm::dot(normal, centre) + lift};
  std::vector<Piece> pieces;
  for (const Triangle& triangle : this->Shapes_.SurfacesNear(centre, 0.5 * diagonal + lift))
  {
    if (std::optional<Piece> piece = InPlane(triangle, before))
    {
      piece->Length = LengthWithin(piece->Begin, piece->End, plate);
      if (piece->Length > lift)
      {
        pieces.push_back(*piece);
      }
    }
  }
  std::sort(pieces.begin(), pieces.end());
  std::optional<Plane> longest;
  double most = 0.0;
  for (int line = 0; line < MostLines && !pieces.empty(); ++line)
  {
    const Piece first = pieces.front();
    const Vec3 along = glm::normalize(first.End - first.Begin);
    const Vec3 across = glm::cross(normal, along);
    const Plane plane{across, glm::dot(across, first.Begin)};
    double covered = 0.0;
    std::erase_if(pieces,
      [&](const Piece& piece)
      {
        const bool lies =
          std::abs(plane.Height(piece.Begin)) <= lift && std::abs(plane.Height(piece.End)) <= lift;
        covered += lies ? piece.Length : 0.0;
        return lies;
      });
    const Vec3 reach = diagonal * along;
    const double all = LengthWithin(first.Begin - reach, first.End + reach, plate);
    covered = std::min(covered, all);
    if (covered >= LeastCovered * all && covered > most && Divides(plane, corners))
    {
      longest = plane;
      most = covered;
    }
  }
  return longest;
}

std::vector<std::vector<LightGroup>> SurfaceCuts::Divide(std::vector<LightGroup> leaves) const
{
  // What is seen of a group is told by the rectangle around it, which may reach through the wall
  // where the leaves do not.
  const auto ends = [this](const std::vector<LightGroup>& group)
  { return !this->Longest(group, RectangleAround(group, group.front().Centre)); };
  std::vector<std::vector<LightGroup>> parts;
  if (ends(leaves))
  {
    parts.push_back(std::move(leaves));
    return parts;
  }
  for (std::vector<LightGroup>& board : FilledParts(std::move(leaves)))
  {
    if (ends(board))
    {
      parts.push_back(std::move(board));
      continue;
    }
    if (this->Longest(board, CornersOf(board)))
    {
      // Not after the cut, as a lattice for a part would reach beyond it.
      board = Simplified(std::move(board));
    }
    // The wall stands at their edges: however far, they may be seen in part.
    std::for_each(board.begin(), board.end(), [](LightGroup& leaf) { leaf.Crossed = true; });
    std::vector<std::vector<LightGroup>> groups =
      DivideLeaves(std::move(board), [this](const std::vector<LightGroup>& group, int cuts)
        { return cuts < MostCuts ? this->Longest(group, CornersOf(group)) : std::nullopt; });
    for (std::vector<LightGroup>& group : groups)
    {
      for (std::vector<LightGroup>& part : GroupLeaves(std::move(group), ends))
      {
        parts.push_back(std::move(part));
      }
    }
  }
  return parts;
}

} // namespace smokevis
