#include "PlateGather.h"

#include "DirectField.h"
#include "Errors.h"
#include "Sampler.h"
#include "SourceShape.h"
#include "Team.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/constants.hpp>
#include <tbb/parallel_for.h>

namespace smokevis
{

namespace
{

/// Share of the surface of the box around the scene.
constexpr double LargestShare = 0.02;
/// Rays of a batch: first, and most.
constexpr int FirstRays = 32;
constexpr int MostRays = 2048;
/// Smoke behind this optical depth adds less than single precision shows.
constexpr double DeepestDepth = 20.0;

} // namespace

PlateGather::PlateGather(const Scene& scene, const LightFieldOptions& options,
  const DirectField& direct, const SourceShape& shape, LightField& field, int band)
    : Scene_(scene), Options_(options), Direct_(direct), Shape_(shape), Field_(field), Band_(band)
{
  this->LargestPlate_ = LargestShare * BoxSurface(scene.Upper() - scene.Lower());
}

std::pair<std::size_t, std::size_t> PlateGather::Run(Team& team, const Progress& progress)
{
  const std::vector<Sign>& signs = this->Scene_.Lights().Signs();
  std::vector<std::size_t> wanted;
  for (std::size_t sign = 0; sign < signs.size(); ++sign)
  {
    if (this->Wanted(signs[sign]))
    {
      wanted.push_back(sign);
    }
  }
  // Signs see each other as the lines left them, whichever is gathered first.
  std::vector<Result> results(wanted.size());
  tbb::parallel_for(std::size_t{0}, team.OwnCount(wanted.size()),
    [&](std::size_t i)
    {
      const std::size_t own = team.OwnItem(i);
      results[own] = this->Gather(wanted[own], progress);
    });
  progress.ThrowIfStopped("light field");
  team.Complete<Result>(results.size(), [&](std::size_t i, auto&& take) { take(results[i]); });
  std::size_t rays = 0;
  for (std::size_t i = 0; i < wanted.size(); ++i)
  {
    rays += results[i].Rays;
    for (const std::size_t cell : signs[wanted[i]].Cells)
    {
      this->Field_.MultipleIlluminance[this->Field_.PatchIndex(
        this->Band_, this->Scene_.SurfacePatches() + cell, 0)] = results[i].Illuminance;
    }
  }
  return {wanted.size(), rays};
}

bool PlateGather::Wanted(const Sign& sign) const
{
  const EmitterSet& lights = this->Scene_.Lights();
  double area = 0.0;
  bool plane = true;
  bool reflects = false;
  for (const std::size_t cell : sign.Cells)
  {
    area += lights.CellArea(cell);
    plane = plane && glm::dot(lights.CellNormal(cell), sign.Normal) > 1.0 - 1e-6;
    reflects = reflects || lights.Cells()[cell].Reflectance[this->Band_] > 0.0;
  }
  return plane && reflects && area <= this->LargestPlate_;
}

PlateGather::Result PlateGather::Gather(std::size_t index, const Progress& progress) const
{
  const Sign& sign = this->Scene_.Lights().Signs()[index];
  const Vec3 edgeU = sign.Corners[1] - sign.Corners[0];
  const Vec3 edgeV = sign.Corners[3] - sign.Corners[0];
  const Vec3 tangent = glm::normalize(edgeU);
  const Vec3 base = sign.Corners[0] + 10.0 * this->Scene_.Shapes().Tolerance() * sign.Normal;
  double direct = 0.0;
  double area = 0.0;
  for (const std::size_t cell : sign.Cells)
  {
    const double own = this->Scene_.Lights().CellArea(cell);
    direct += own * this->Field_.DirectIlluminance[this->Field_.PatchIndex(
                      this->Band_, this->Scene_.SurfacePatches() + cell, 0)];
    area += own;
  }
  direct /= area;

  std::array<double, Batches> sums{};
  Result result;
  Lanes& illuminance = result.Illuminance;
  int done = 0;
  for (int rays = FirstRays;; rays *= 2)
  {
    for (int batch = 0; batch < Batches; ++batch)
    {
      // Even over the plate, and over directions by their cosine.
      const std::uint64_t key = Mix(this->Options_.Seed + 0x51A7EULL * (index + 1)) + batch;
      const EvenPoints points(key);
      for (int ray = done; ray < rays; ++ray)
      {
        const auto random = points.Point(ray);
        const Vec3 direction = LambertianDirection(sign.Normal, tangent, random[2], random[3]);
        sums[batch] +=
          glm::pi<double>() * this->Radiance(base + random[0] * edgeU + random[1] * edgeV,
                                direction, ToUnit(Mix(key + ray)), batch);
      }
      illuminance[batch] = static_cast<float>(sums[batch] / rays);
    }
    result.Rays += static_cast<std::size_t>(Batches) * (rays - done);
    done = rays;
    if (StandardError(illuminance) <= this->Options_.Tolerance * (Mean(illuminance) + direct) ||
        2 * rays > MostRays || progress.ShouldStop())
    {
      break;
    }
  }
  return result;
}

double PlateGather::Radiance(
  const Vec3& origin, const Vec3& direction, double place, int batch) const
{
  const Medium& smoke = this->Scene_.Smoke();
  const Hit hit = this->Scene_.Shapes().Intersect(
    origin, direction, 0.0, std::numeric_limits<double>::infinity());
  thread_local std::vector<Segment> segments;
  smoke.WalkSmoke(origin, direction, 0.0, hit.Distance, segments);
  const double albedo = this->Scene_.Albedo();
  double depth = 0.0;
  double sum = 0.0;
  for (const Segment& segment : segments)
  {
    const double extinction =
      this->Scene_.ExtinctionScale(this->Band_) * smoke.Extinction(segment.Cell);
    const double multiple =
      this->Field_.MultipleFluence[this->Field_.CellIndex(this->Band_, segment.Cell)][batch];
    const double emitted = (1.0 - albedo) * smoke.EmittedLuminance(segment.Cell);
    const double mean =
      this->Field_.DirectFluence[this->Field_.CellIndex(this->Band_, segment.Cell)];
    // The source varies as it does for lines.
    const SourceShape::Shaped* shape = this->Shape_.Find(segment.Cell);
    const double shaped = shape ? multiple + (shape->DirectVaries ? 0.0 : mean) : 0.0;
    const Vec3 slope =
      shape ? shaped * Vec3(shape->Change[0], shape->Change[1], shape->Change[2]) : Vec3(0.0);
    const Vec3 centre = shape ? shape->Centre : Vec3(0.0);
    double at = segment.Begin;
    const auto add = [&](double length, double direct)
    {
      const double own = extinction * length;
      const double shift = glm::dot(slope, origin + (at + 0.5 * length) * direction - centre);
      const double escaping = -std::expm1(-own);
      const double tilt = SourceShape::Tilt(
        static_cast<float>(own), own > 0.0 ? static_cast<float>(escaping / own) : 1.0F);
      const double scattered =
        escaping * (direct + multiple + shift) - tilt * glm::dot(slope, direction) * length;
      sum +=
        std::exp(-depth) * (albedo / (4.0 * glm::pi<double>()) * scattered + escaping * emitted);
      depth += own;
      at += length;
    };
    if (this->Direct_.Varies(segment.Cell, this->Band_))
    {
      this->Direct_.ForEachPart(
        segment.Cell, origin, direction, segment.Begin, segment.End, place, this->Band_, add);
    }
    else
    {
      add(segment.End - segment.Begin, mean);
    }
    if (depth > DeepestDepth)
    {
      return sum;
    }
  }
  return sum + std::exp(-depth) *
                 (hit.Found() ? this->Leaving(hit, direction, batch) : this->Scene_.Sky());
}

double PlateGather::Leaving(const Hit& hit, const Vec3& direction, int batch) const
{
  const std::size_t patch = this->Scene_.Patch(hit);
  const std::size_t side = this->Field_.PatchIndex(this->Band_, patch, hit.Side);
  double radiance =
    this->Scene_.PatchReflectance(patch)[this->Band_] / glm::pi<double>() *
    (this->Field_.DirectIlluminance[side] + this->Field_.MultipleIlluminance[side][batch]);
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
