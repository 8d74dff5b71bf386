#include "Exposure.h"

#include "Geometry.h"
#include "Sampler.h"
#include "Scene.h"

#include <algorithm>
#include <array>
#include <cmath>

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

/// How many of the first places on a piece are exposed, on its front and on its back.
std::array<std::size_t, 2> CountExposed(
  const Geometry& shapes, const Piece& piece, std::uint64_t key, std::size_t places)
{
  const Vec3 normal = glm::normalize(glm::cross(piece.First, piece.Second));
  const double reach = 4.0 * shapes.Tolerance();
  const EvenPoints points(key);
  thread_local std::vector<Crossing> crossings;
  std::array<std::size_t, 2> exposed{};
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
    const auto met = [&](const Hit& hit, int side)
    { return hit.Emitter == piece.Emitter && hit.Triangle == piece.Triangle && hit.Side == side; };
    for (const Crossing& crossing : crossings)
    {
      exposed[0] += met(crossing.Arrive, 0) ? 1 : 0;
      exposed[1] += met(crossing.Leave, 1) ? 1 : 0;
    }
  }
  return exposed;
}

} // namespace

std::vector<double> ExposedAreas(
  const Geometry& shapes, const SurfaceMesh& surfaces, const SurfaceMesh& emitters)
{
  const std::vector<Piece> pieces = PiecesOf(shapes, surfaces, emitters);
  const std::size_t firstPlaces = std::clamp(
    AllFirstPlaces / std::max<std::size_t>(1, pieces.size()), FewestFirstPlaces, MostFirstPlaces);
  std::vector<std::array<double, 2>> exposed(pieces.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pieces.size(), 64),
    [&](const tbb::blocked_range<std::size_t>& range)
    {
      for (std::size_t i = range.begin(); i < range.end(); ++i)
      {
        std::size_t places = firstPlaces;
        std::array<std::size_t, 2> count = CountExposed(shapes, pieces[i], i, places);
        if (count[0] != places || count[1] != places)
        {
          places = Places;
          count = CountExposed(shapes, pieces[i], i, places);
        }
        for (int side = 0; side < 2; ++side)
        {
          exposed[i][side] = pieces[i].Area * static_cast<double>(count[side]) / places;
        }
      }
    });
  const std::size_t patches = surfaces.CellReflectance.size() + emitters.CellReflectance.size();
  std::vector<double> areas(patches, 0.0);
  std::vector<double> result(2 * patches, 0.0);
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    areas[pieces[i].Patch] += pieces[i].Area;
    for (int side = 0; side < 2; ++side)
    {
      result[2 * pieces[i].Patch + side] += exposed[i][side];
    }
  }
  for (std::size_t side = 0; side < result.size(); ++side)
  {
    if (result[side] < SmallestShare * areas[side / 2])
    {
      result[side] = 0.0;
    }
  }
  return result;
}

} // namespace smokevis
