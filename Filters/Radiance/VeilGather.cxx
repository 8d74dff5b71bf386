#include "VeilGather.h"

#include "Sampler.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <glm/gtc/constants.hpp>

namespace smokevis
{

namespace
{

/// Rays of a batch. More of them would tell little of the noise of the light that they gather.
constexpr int RaysABatch = 64;
/// Share of the rays that begin as often as smoke scatters towards the eye, whatever the light
/// there is thought to be.
constexpr double BlindShare = 0.1;

/// A piece of a line of sight inside one cell.
struct Piece
{
  std::int64_t Cell;
  Vec3 Direction;
  double Begin, Length, Extinction;
  /// Share of the light from behind that is lost.
  double Lost;
  /// Mean luminance at the eye over fluence.
  double Weight;
  /// Share of the rays that begin here.
  double Share;
  /// Sum of the shares up to this piece's end.
  double Until;
};

/// Pieces that scatter, without their shares.
std::vector<Piece> PiecesOf(
  const IndirectLight& light, const Vec3& origin, const std::vector<SightLine>& lines)
{
  const Scene& scene = light.TheScene();
  const double scatter = scene.Albedo() / (4.0 * glm::pi<double>());
  std::vector<Segment> segments;
  std::vector<Piece> pieces;
  for (const SightLine& line : lines)
  {
    scene.Smoke().WalkSmoke(origin, line.Direction, 0.0, line.End, segments);
    double ahead = line.Weight;
    for (const Segment& segment : segments)
    {
      const double length = segment.End - segment.Begin;
      const double extinction =
        scene.ExtinctionScale(light.Band()) * scene.Smoke().Extinction(segment.Cell);
      const double lost = -std::expm1(-extinction * length);
      const double weight = scatter * ahead * lost;
      if (weight > 0.0)
      {
        pieces.push_back({segment.Cell, line.Direction, segment.Begin, length, extinction, lost,
          weight, 0.0, 0.0});
      }
      ahead *= 1.0 - lost;
    }
  }
  return pieces;
}

/// Rays begin where the light is thought to come from.
void FindShares(const IndirectLight& light, std::vector<Piece>& pieces)
{
  double weights = 0.0;
  double lights = 0.0;
  for (Piece& piece : pieces)
  {
    const std::size_t index = light.Field().CellIndex(light.Band(), piece.Cell);
    piece.Share = piece.Weight * (light.Field().DirectFluence[index] +
                                   std::max(0.0, Mean(light.Field().MultipleFluence[index])));
    weights += piece.Weight;
    lights += piece.Share;
  }
  const double blind = (lights > 0.0 ? BlindShare : 1.0) / weights;
  const double seen = lights > 0.0 ? (1.0 - BlindShare) / lights : 0.0;
  double until = 0.0;
  for (Piece& piece : pieces)
  {
    piece.Share = blind * piece.Weight + seen * piece.Share;
    until += piece.Share;
    piece.Until = until;
  }
}

/// Of the lines and of the field, so that rays of different ones are independent; but of nothing
/// that the unit of length, the place of the origin or the brightness of all lights changes.
std::uint64_t KeyOf(const IndirectLight& light, const std::vector<Piece>& pieces)
{
  std::uint64_t key = 0;
  // Steps far above what rounding changes: lines are known to double precision, light to single.
  constexpr double LineSteps = 1 << 20;
  constexpr double LightSteps = 1 << 10;
  const auto fold = [&key](double share, double steps)
  { key = Mix(key + static_cast<std::uint64_t>(std::llround(share * steps))); };
  DoubleLanes seen{};
  Vec3 before(0.0);
  double weights = 0.0;
  for (const Piece& piece : pieces)
  {
    if (piece.Direction != before)
    {
      before = piece.Direction;
      fold(before.x, LineSteps);
      fold(before.y, LineSteps);
      fold(before.z, LineSteps);
    }
    weights += piece.Weight;
    const std::size_t index = light.Field().CellIndex(light.Band(), piece.Cell);
    for (int batch = 0; batch < Batches; ++batch)
    {
      seen[batch] += piece.Weight * light.Field().MultipleFluence[index][batch];
    }
  }
  fold(weights, LineSteps);
  const double all = std::accumulate(seen.begin(), seen.end(), 0.0);
  for (const double one : seen)
  {
    fold(all > 0.0 ? one / all : 0.0, LightSteps);
  }
  return key;
}

/// What one ray adds to the mean of a batch.
double Sample(const IndirectLight& light, const Vec3& origin, const std::vector<Piece>& pieces,
  const std::array<double, 4>& random, int batch)
{
  // Among the pieces by their shares, inside one as often as smoke scatters towards the eye.
  const double at = random[0] * pieces.back().Until;
  const auto piece = std::lower_bound(pieces.begin(), pieces.end() - 1, at,
    [](const Piece& one, double value) { return one.Until < value; });
  const double within = std::clamp(1.0 - (piece->Until - at) / piece->Share, 0.0, 1.0);
  const double distance =
    piece->Begin + std::min(piece->Length, -std::log1p(-within * piece->Lost) / piece->Extinction);
  return piece->Weight / piece->Share * 4.0 * glm::pi<double>() *
         light.Radiance(origin + distance * piece->Direction, SphereDirection(random[1], random[2]),
           random[3], batch);
}

} // namespace

GatheredVeil GatherVeil(
  const IndirectLight& light, const Vec3& origin, const std::vector<SightLine>& lines)
{
  GatheredVeil veil;
  std::vector<Piece> pieces = PiecesOf(light, origin, lines);
  if (pieces.empty())
  {
    return veil;
  }
  FindShares(light, pieces);
  const std::uint64_t key = KeyOf(light, pieces);
  for (int batch = 0; batch < Batches; ++batch)
  {
    const EvenPoints points(Mix(key + batch));
    double sum = 0.0;
    for (int ray = 0; ray < RaysABatch; ++ray)
    {
      sum += Sample(light, origin, pieces, points.Point(ray), batch);
    }
    veil.Multiple[batch] = static_cast<float>(sum / RaysABatch);
  }
  veil.Rays = static_cast<std::size_t>(Batches) * RaysABatch;
  return veil;
}

} // namespace smokevis
