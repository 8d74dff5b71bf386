#include "IndirectLight.h"

#include "DirectField.h"
#include "SourceShape.h"

#include <cmath>
#include <limits>

#include <glm/gtc/constants.hpp>

namespace smokevis
{

namespace
{

/// Closer than so many edges of a patch to where a ray begins, and to a light, what the light sends
/// to the end of the ray is not what it sends to the patch in the mean.
constexpr double CloseSizes = 4.0;

} // namespace

IndirectLight::IndirectLight(const Scene& scene, const LightField& field, const DirectField& direct,
  const CellShape& shape, int band, Reflection reflection)
    : Scene_(scene), Field_(field), Direct_(direct), Shape_(shape), Lights_(scene), Band_(band),
      Reflection_(reflection)
{
}

double IndirectLight::Radiance(
  const Vec3& origin, const Vec3& direction, double place, int batch) const
{
  const Medium& smoke = this->Scene_.Smoke();
  const Hit hit = this->Scene_.Shapes().Intersect(
    origin, direction, 0.0, std::numeric_limits<double>::infinity());
  thread_local std::vector<Segment> segments;
  smoke.WalkSmoke(origin, direction, 0.0, hit.Distance, segments);
  // What a cell's light is lies far from its neighbour's: all is fetched before it is used.
  for (const Segment& segment : segments)
  {
    __builtin_prefetch(
      &this->Field_.MultipleFluence[this->Field_.CellIndex(this->Band_, segment.Cell)]);
  }
  const double albedo = this->Scene_.Albedo();
  double depth = 0.0;
  double ahead = 1.0;
  double sum = 0.0;
  for (const Segment& segment : segments)
  {
    const std::int64_t cell = segment.Cell;
    const double extinction = this->Scene_.ExtinctionScale(this->Band_) * smoke.Extinction(cell);
    const std::size_t index = this->Field_.CellIndex(this->Band_, cell);
    const double multiple = this->Field_.MultipleFluence[index][batch];
    const double emitted = (1.0 - albedo) * smoke.EmittedLuminance(cell);
    // As for lines: what rays gather balances what they bring.
    const bool flat = extinction * smoke.LargestEdge() >= SourceShape::ThickestDepth &&
                      extinction * smoke.MeanChord(cell) >= SourceShape::ThickestDepth;
    const bool varies = this->Direct_.Varies(cell, this->Band_);
    const bool smooth = !varies && !flat && !this->Direct_.Near(cell);
    double begin = segment.Begin;
    const auto add = [&](double length, double direct)
    {
      const SmokePiece piece(
        cell, origin + begin * direction, length * direction, extinction * length);
      const double fluence =
        (smooth ? this->Direct_.SmoothEmerging(piece, this->Band_) : piece.Lost * direct) +
        multiple * (flat ? piece.Lost : this->Shape_.Emerging(piece));
      sum += ahead * (albedo / (4.0 * glm::pi<double>()) * fluence + piece.Lost * emitted);
      ahead *= piece.Passed;
      depth += piece.Depth;
      begin += length;
    };
    if (varies)
    {
      const double own = extinction * (segment.End - segment.Begin);
      this->Direct_.ForEachPart(
        cell, origin, direction, segment.Begin, segment.End, own, place, this->Band_, add);
    }
    else
    {
      add(segment.End - segment.Begin, this->Field_.DirectFluence[index]);
    }
    if (depth > DeepestVeil)
    {
      return sum;
    }
  }
  return sum + ahead * (hit.Found()
                           ? this->Leaving(hit, origin + hit.Distance * direction, direction, batch)
                           : this->Scene_.Sky());
}

double IndirectLight::DirectOn(std::size_t patch, const Hit& hit, const Vec3& point) const
{
  const double close = CloseSizes * std::sqrt(this->Scene_.PatchArea(patch));
  const EmitterSet& lights = this->Scene_.Lights();
  const std::size_t count = lights.Lights().size();
  bool near = false;
  if (this->Reflection_ == Reflection::OfPlaces && !hit.Emitter && hit.Distance < close)
  {
    for (std::size_t light = 0; light < count && !near; ++light)
    {
      const LightGroup& root = lights.Root(light);
      near = root.Distance(point) < close * root.Law.Sharpness();
    }
  }
  if (!near)
  {
    return this->Field_.DirectIlluminance[this->Field_.PatchIndex(this->Band_, patch, hit.Side)];
  }
  const Vec3& normal = this->Scene_.Shapes().Normal(hit);
  double sum = 0.0;
  for (std::size_t light = 0; light < count; ++light)
  {
    sum += this->Lights_.Illuminance(light, point, hit.Side == 0 ? normal : -normal)[this->Band_];
  }
  return sum;
}

double IndirectLight::Leaving(
  const Hit& hit, const Vec3& point, const Vec3& direction, int batch) const
{
  const std::size_t patch = this->Scene_.Patch(hit);
  const std::size_t side = this->Field_.PatchIndex(this->Band_, patch, hit.Side);
  const double reflectance = this->Scene_.PatchReflectance(patch)[this->Band_];
  double radiance =
    reflectance > 0.0
      ? reflectance / glm::pi<double>() *
          (this->DirectOn(patch, hit, point) + this->Field_.MultipleIlluminance[side][batch])
      : 0.0;
  const EmitterSet& lights = this->Scene_.Lights();
  const std::size_t cell = patch - this->Scene_.SurfacePatches();
  if (hit.Emitter && hit.Side == 0 && lights.LeftToLines(cell))
  {
    const double cosine = std::abs(glm::dot(direction, lights.CellNormal(cell)));
    radiance += lights.Cells()[cell].Luminance[this->Band_] *
                lights.CellLaw(cell).Relative(-direction, cosine);
  }
  return radiance;
}

} // namespace smokevis
