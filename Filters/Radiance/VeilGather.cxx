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

/// Rays of a batch. More of them would tell little of the noise of the light that they gather.
constexpr int RaysABatch = 64;
/// Share of the rays that begin as often as smoke scatters towards the eye, whatever the light
/// there is thought to be.
constexpr double BlindShare = 0.1;

} // namespace

VeilGather::VeilGather(const Scene& scene, const LightField& field, const IndirectLight& indirect,
  int band, const Vec3& origin, const std::vector<SightLine>& lines)
    : Indirect_(indirect), Origin_(origin)
{
  const double scatter = scene.Albedo() / (4.0 * glm::pi<double>());
  std::vector<Segment> segments;
  double weights = 0.0;
  double lights = 0.0;
  const auto fold = [this](auto bits) { this->Key_ = Mix(this->Key_ + bits); };
  for (const SightLine& line : lines)
  {
    scene.Smoke().WalkSmoke(origin, line.Direction, 0.0, line.End, segments);
    double ahead = line.Weight;
    for (const Segment& segment : segments)
    {
      Piece piece;
      piece.Direction = line.Direction;
      piece.Begin = segment.Begin;
      piece.Length = segment.End - segment.Begin;
      piece.Extinction = scene.ExtinctionScale(band) * scene.Smoke().Extinction(segment.Cell);
      piece.Lost = -std::expm1(-piece.Extinction * piece.Length);
      piece.Weight = scatter * ahead * piece.Lost;
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
      ahead *= 1.0 - piece.Lost;
      fold(std::bit_cast<std::uint32_t>(multiple[0]));
      this->Pieces_.push_back(piece);
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      fold(std::bit_cast<std::uint64_t>(origin[axis]));
      fold(std::bit_cast<std::uint64_t>(line.Direction[axis]));
    }
  }
  const double blind = lights > 0.0 ? BlindShare : 1.0;
  double until = 0.0;
  for (Piece& piece : this->Pieces_)
  {
    piece.Share =
      blind * piece.Weight / weights + (lights > 0.0 ? (1.0 - blind) * piece.Share / lights : 0.0);
    until += piece.Share;
    piece.Until = until;
  }
}

double VeilGather::Sample(int batch, const std::array<double, 4>& random) const
{
  // Among the pieces by their shares, inside one as often as smoke scatters towards the eye.
  const double at = random[0] * this->Pieces_.back().Until;
  const auto piece = std::lower_bound(this->Pieces_.begin(), this->Pieces_.end() - 1, at,
    [](const Piece& one, double value) { return one.Until < value; });
  const double within = std::clamp(1.0 - (piece->Until - at) / piece->Share, 0.0, 1.0);
  const double distance =
    piece->Begin + std::min(piece->Length, -std::log1p(-within * piece->Lost) / piece->Extinction);
  const double height = 2.0 * random[1] - 1.0;
  const double radius = std::sqrt(std::max(0.0, 1.0 - height * height));
  const double turn = glm::two_pi<double>() * random[2];
  const Vec3 towards(radius * std::cos(turn), radius * std::sin(turn), height);
  return piece->Weight / piece->Share * 4.0 * glm::pi<double>() *
         this->Indirect_.Radiance(
           this->Origin_ + distance * piece->Direction, towards, random[3], batch);
}

GatheredVeil VeilGather::Run() const
{
  GatheredVeil veil;
  if (this->Pieces_.empty())
  {
    return veil;
  }
  for (int batch = 0; batch < Batches; ++batch)
  {
    const EvenPoints points(Mix(this->Key_ + batch));
    double sum = 0.0;
    for (int ray = 0; ray < RaysABatch; ++ray)
    {
      sum += this->Sample(batch, points.Point(ray));
    }
    veil.Multiple[batch] = static_cast<float>(sum / RaysABatch);
  }
  veil.Rays = static_cast<std::size_t>(Batches) * RaysABatch;
  return veil;
}

} // namespace smokevis
