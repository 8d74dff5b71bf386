#include "Exposure.h"

#include "Bodies.h"
#include "Geometry.h"
#include "PlateCovers.h"
#include "Sampler.h"
#include "Scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace smokevis
{

namespace
{

/// Places on a triangle that are looked at first, fewer where there are very many triangles, and
/// on one of which a part is covered.
constexpr std::size_t MostFirstPlaces = 8;
constexpr std::size_t FewestFirstPlaces = 2;
constexpr std::size_t AllFirstPlaces = 2'000'000;
constexpr std::size_t Places = 1024;
/// A patch of which less is left free counts as covered: places tell no more.
constexpr double SmallestShare = 0.005;

/// A triangle and where it belongs.
struct Piece
{
  Vec3 Corner, First, Second;
  double Area;
  std::size_t Patch;
  /// Its place among the surfaces' triangles or the emitters'.
  std::uint32_t Triangle;
  bool Emitter;
};

std::vector<Piece> PiecesOf(
  const Geometry& shapes, const SurfaceMesh& surfaces, const SurfaceMesh& emitters)
{
  std::vector<Piece> pieces;
  const auto add = [&pieces](const SurfaceMesh& mesh, const std::vector<std::size_t>& triangles,
                     std::size_t firstPatch, bool emitter)
  {
    for (std::size_t place = 0; place < triangles.size(); ++place)
    {
      const auto& corners = mesh.Triangles[triangles[place]];
      const Vec3& corner = mesh.Points[corners[0]];
      const Vec3 first = mesh.Points[corners[1]] - corner;
      const Vec3 second = mesh.Points[corners[2]] - corner;
      pieces.push_back({corner, first, second, 0.5 * glm::length(glm::cross(first, second)),
        firstPatch + mesh.TriangleCell[triangles[place]], static_cast<std::uint32_t>(place),
        emitter});
    }
  };
  add(surfaces, shapes.SurfaceTriangles(), 0, false);
  add(emitters, shapes.EmitterTriangles(), surfaces.CellReflectance.size(), true);
  return pieces;
}

/// Shares of a side that are exposed, and that a solid stands on.
struct Shares
{
  double Exposed = 0.0, Enclosed = 0.0;

  bool All() const { return this->Exposed == 1.0; }
};

/// Whether a line met a side of a piece.
bool IsFrom(const Piece& piece, const Hit& hit, int side)
{
  return hit.Emitter == piece.Emitter && hit.Triangle == piece.Triangle && hit.Side == side;
}

/// Of the front of a piece and of its back, by the first places on it.
std::array<Shares, 2> FindShares(const Geometry& shapes, const Bodies& bodies, const Piece& piece,
  std::uint64_t key, std::size_t places)
{
  const Vec3 normal = glm::normalize(glm::cross(piece.First, piece.Second));
  const double reach = 4.0 * shapes.Tolerance();
  const EvenPoints points(key);
  thread_local std::vector<Crossing> crossings;
  std::array<std::size_t, 2> exposed{};
  std::array<std::size_t, 2> enclosed{};
  for (std::size_t place = 0; place < places; ++place)
  {
    auto random = points.Point(place);
    if (random[0] + random[1] > 1.0)
    {
      random[0] = 1.0 - random[0];
      random[1] = 1.0 - random[1];
    }
    const Vec3 point = piece.Corner + random[0] * piece.First + random[1] * piece.Second;
    shapes.Cross(point + reach * normal, -normal, 0.0, 2.0 * reach, crossings);
    std::array<bool, 2> met{};
    bool several = false;
    for (const Crossing& crossing : crossings)
    {
      met[0] = met[0] || IsFrom(piece, crossing.Arrive, 0);
      met[1] = met[1] || IsFrom(piece, crossing.Leave, 1);
      several = several || crossing.Several;
    }
    for (int side = 0; side < 2; ++side)
    {
      // Behind a surface lies the inside of its own body.
      const bool dark =
        several && bodies.Enclose(point, side == 0 ? normal : -normal,
                     side == 1 && !piece.Emitter ? std::optional(piece.Triangle) : std::nullopt);
      enclosed[side] += dark ? 1 : 0;
      exposed[side] += met[side] && !dark ? 1 : 0;
    }
  }
  const auto share = [places](std::size_t count) { return static_cast<double>(count) / places; };
  return {{{share(exposed[0]), share(enclosed[0])}, {share(exposed[1]), share(enclosed[1])}}};
}

/// Whether plates, which may be too small for the first places, cover a part of a surface.
bool HasPlate(const PlateCovers& covers, const Piece& piece)
{
  if (piece.Emitter)
  {
    return false;
  }
  const auto parts =
    covers.On({piece.Corner, piece.Corner + piece.First, piece.Corner + piece.Second});
  return !parts[0].empty() || !parts[1].empty();
}

} // namespace

bool Exposure::AnyEnclosed() const
{
  return std::any_of(
    this->Enclosed.begin(), this->Enclosed.end(), [](double area) { return area > 0.0; });
}

Exposure FindExposure(const Geometry& shapes, const Bodies& bodies, const SurfaceMesh& surfaces,
  const SurfaceMesh& emitters)
{
  const std::vector<Piece> pieces = PiecesOf(shapes, surfaces, emitters);
  const PlateCovers covers(shapes, emitters);
  const std::size_t firstPlaces = std::clamp(
    AllFirstPlaces / std::max<std::size_t>(1, pieces.size()), FewestFirstPlaces, MostFirstPlaces);
  /// Of the places on each piece, and on each of its sides.
  std::vector<std::array<Shares, 2>> shares(pieces.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pieces.size(), 64),
    [&](const tbb::blocked_range<std::size_t>& range)
    {
      for (std::size_t i = range.begin(); i < range.end(); ++i)
      {
        shares[i] = FindShares(shapes, bodies, pieces[i], i, firstPlaces);
        if (!shares[i][0].All() || !shares[i][1].All() || HasPlate(covers, pieces[i]))
        {
          shares[i] = FindShares(shapes, bodies, pieces[i], i, Places);
        }
      }
    });
  const std::size_t patches = surfaces.CellReflectance.size() + emitters.CellReflectance.size();
  std::vector<double> areas(patches, 0.0);
  Exposure result{std::vector<double>(2 * patches, 0.0), std::vector<double>(2 * patches, 0.0)};
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    areas[pieces[i].Patch] += pieces[i].Area;
    for (int side = 0; side < 2; ++side)
    {
      result.Exposed[2 * pieces[i].Patch + side] += pieces[i].Area * shares[i][side].Exposed;
      result.Enclosed[2 * pieces[i].Patch + side] += pieces[i].Area * shares[i][side].Enclosed;
    }
  }
  for (std::size_t side = 0; side < 2 * patches; ++side)
  {
    double& exposed = result.Exposed[side];
    exposed = exposed < SmallestShare * areas[side / 2] ? 0.0 : exposed;
  }
  return result;
}

} // namespace smokevis
