#include "VeilGather.h"

#include "Sampler.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <glm/gtc/constants.hpp>

namespace smokevis
{

namespace
{

/// Rays of a batch: first, and most; the noise of the light that they gather is left then.
constexpr int FirstRays = 8;
constexpr int MostRays = 64;
/// Share of the rays that begin as often as smoke scatters towards the eye, whatever the light
/// there is thought to be.
constexpr double BlindShare = 0.1;

} // namespace

VeilGather::VeilGather(const Scene& scene, const LightField& field, const IndirectLight& indirect,
  int band, const Vec3& origin, const Vec3& direction, double end)
    : Indirect_(indirect), Origin_(origin), Direction_(direction)
{
  const double scatter = scene.Albedo() / (4.0 * glm::pi<double>());
  std::vector<Segment> segments;
  scene.Smoke().WalkSmoke(origin, direction, 0.0, end, segments);
  double ahead = 1.0;
  double weights = 0.0;
  double lights = 0.0;
  for (const Segment& segment : segments)
  {
    Piece piece;
    piece.Begin = segment.Begin;
    piece.Length = segment.End - segment.Begin;
    piece.Extinction = scene.ExtinctionScale(band) * scene.Smoke().Extinction(segment.Cell);
    const double lost = -std::expm1(-piece.Extinction * piece.Length);
    piece.Weight = scatter * ahead * lost;
    if (!(piece.Weight > 0.0))
    {
      continue;
    }
    // Rays begin where the light is thought to come from.
    const std::size_t index = field.CellIndex(band, segment.Cell);
    const Lanes& multiple = field.MultipleFluence[index];
    piece.Share = piece.Weight * (field.DirectFluence[index] + std::max(0.0, Mean(multiple)));
    weights += piece.Weight;
    lights += piece.Share;
    ahead *= 1.0 - lost;
    this->Key_ = Mix(this->Key_ + std::bit_cast<std::uint32_t>(multiple[0]));
    this->Pieces_.push_back(piece);
  }
  double until = 0.0;
  for (Piece& piece : this->Pieces_)
  {
    const double blind = lights > 0.0 ? BlindShare : 1.0;
    piece.Share =
      blind * piece.Weight / weights + (lights > 0.0 ? (1.0 - blind) * piece.Share / lights : 0.0);
    until += piece.Share;
    piece.Until = until;
  }
  for (const double place : {origin.x, origin.y, origin.z, direction.x, direction.y, direction.z})
  {
    this->Key_ = Mix(this->Key_ + std::bit_cast<std::uint64_t>(place));
  }
}

double VeilGather::Sample(int batch, const std::array<double, 4>& random) const
{
  // Among the pieces by their shares, inside one as often as smoke scatters towards the eye.
  const double at = random[0] * this->Pieces_.back().Until;
  const auto piece = std::lower_bound(this->Pieces_.begin(), this->Pieces_.end() - 1, at,
    [](const Piece& one, double value) { return one.Until < value; });
  const double within = std::clamp(1.0 - (piece->Until - at) / piece->Share, 0.0, 1.0);
  const double lost = -std::expm1(-piece->Extinction * piece->Length);
  const double distance =
    piece->Begin + std::min(piece->Length, -std::log1p(-within * lost) / piece->Extinction);
  const double height = 2.0 * random[1] - 1.0;
  const double radius = std::sqrt(std::max(0.0, 1.0 - height * height));
  const double turn = glm::two_pi<double>() * random[2];
  const Vec3 towards(radius * std::cos(turn), radius * std::sin(turn), height);
  return piece->Weight / piece->Share * 4.0 * glm::pi<double>() *
         this->Indirect_.Radiance(
           this->Origin_ + distance * this->Direction_, towards, random[3], batch);
}

GatheredVeil VeilGather::Run(double wanted) const
{
  GatheredVeil veil;
  if (this->Pieces_.empty())
  {
    return veil;
  }
  DoubleLanes sums{};
  for (int done = 0, rays = FirstRays; rays <= MostRays; done = rays, rays *= 2)
  {
    for (int batch = 0; batch < Batches; ++batch)
    {
      const EvenPoints points(Mix(this->Key_ + batch));
      for (int ray = done; ray < rays; ++ray)
      {
        sums[batch] += this->Sample(batch, points.Point(ray));
      }
      veil.Multiple[batch] = static_cast<float>(sums[batch] / rays);
    }
    veil.Rays = static_cast<std::size_t>(Batches) * rays;
    if (StandardError(veil.Multiple) <= wanted)
    {
      break;
    }
  }
  return veil;
}

} // namespace smokevis
