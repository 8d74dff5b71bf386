#include "ReferenceIntegrator.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace smokevis
{

namespace
{

using std::numbers::pi;
constexpr std::uint64_t ChunkSize = 1024;
/// Paths lighter than this are continued by Russian roulette.
constexpr double RouletteWeight = 0.25;

Vec3 SphereDirection(Pcg32& random)
{
  const double z = 1.0 - 2.0 * random.Uniform();
  const double azimuth = 2.0 * pi * random.Uniform();
  const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
  return {r * std::cos(azimuth), r * std::sin(azimuth), z};
}

/// Density cos / pi: the normal plus a point of the unit sphere.
Vec3 CosineDirection(const Vec3& normal, Pcg32& random)
{
  for (;;)
  {
    const Vec3 direction = normal + SphereDirection(random);
    const double length = glm::length(direction);
    if (length > 1e-9)
    {
      return direction / length;
    }
  }
}

} // namespace

//--------------------------------------------------------------------------------------------------
Pcg32::Pcg32(std::uint64_t seed, std::uint64_t stream) : Increment_((stream << 1U) | 1U)
{
  this->Next();
  this->State_ += seed;
  this->Next();
}

//--------------------------------------------------------------------------------------------------
std::uint32_t Pcg32::Next()
{
  const std::uint64_t old = this->State_;
  this->State_ = old * 6364136223846793005ULL + this->Increment_;
  const auto mixed = static_cast<std::uint32_t>(((old >> 18U) ^ old) >> 27U);
  const auto turn = static_cast<std::uint32_t>(old >> 59U);
  return (mixed >> turn) | (mixed << ((32U - turn) & 31U));
}

//--------------------------------------------------------------------------------------------------
Vec3 PlaceIn(const Box& box, Pcg32& random)
{
  const double x = random.Uniform();
  const double y = random.Uniform();
  return box.Lower + Vec3(x, y, random.Uniform()) * box.Size();
}

//--------------------------------------------------------------------------------------------------
ReferenceIntegrator::ReferenceIntegrator(const Scene& scene, int band)
    : Scene_(&scene), Band_(band), Scale_(scene.ExtinctionScale(band))
{
  // Longer than any straight line between two things of the scene.
  this->Far_ = 4.0 * glm::length(scene.Upper() - scene.Lower()) + 1.0;
  const EmitterSet& lights = scene.Lights();
  for (std::size_t cell = 0; cell < lights.Cells().size(); ++cell)
  {
    const EmitterCell& emitter = lights.Cells()[cell];
    const std::vector<Vec3>& corners = emitter.Vertices;
    this->Exitance_.push_back(2.0 * pi * emitter.Luminance[band] / (emitter.Exponent + 2.0));
    if (this->Exitance_.back() <= 0.0)
    {
      continue;
    }
    for (std::size_t i = 2; i < corners.size(); ++i)
    {
      const double area =
        0.5 * glm::length(glm::cross(corners[i - 1] - corners[0], corners[i] - corners[0]));
      this->TotalFlux_ += this->Exitance_.back() * area;
      this->Lights_.push_back({{corners[0], corners[i - 1], corners[i]}, cell, this->TotalFlux_});
    }
  }
}

//--------------------------------------------------------------------------------------------------
template <std::size_t Values, class Sample>
std::array<Estimate, Values> ReferenceIntegrator::RunAll(
  std::uint64_t samples, std::uint64_t seed, const Sample& sample) const
{
  struct Sums
  {
    std::array<double, Values> First{};
    std::array<double, Values> Second{};
  };
  const std::uint64_t chunks = (samples + ChunkSize - 1) / ChunkSize;
  std::vector<Sums> parts(chunks);
  tbb::parallel_for(tbb::blocked_range<std::uint64_t>(0, chunks, 1),
    [&](const tbb::blocked_range<std::uint64_t>& range)
    {
      Flight flight;
      for (std::uint64_t chunk = range.begin(); chunk != range.end(); ++chunk)
      {
        Pcg32 random(seed, chunk);
        const std::uint64_t end = std::min(samples, (chunk + 1) * ChunkSize);
        for (std::uint64_t i = chunk * ChunkSize; i < end; ++i)
        {
          const std::array<double, Values> values = sample(random, flight);
          for (std::size_t value = 0; value < Values; ++value)
          {
            parts[chunk].First[value] += values[value];
            parts[chunk].Second[value] += values[value] * values[value];
          }
        }
      }
    });
  std::array<Estimate, Values> estimates;
  const auto count = static_cast<double>(samples);
  for (std::size_t value = 0; value < Values; ++value)
  {
    double first = 0.0;
    double second = 0.0;
    for (const Sums& part : parts)
    {
      first += part.First[value];
      second += part.Second[value];
    }
    const double mean = first / count;
    const double variance = std::max(0.0, second / count - mean * mean);
    estimates[value] = {mean, std::sqrt(variance / std::max(1.0, count - 1.0))};
  }
  return estimates;
}

//--------------------------------------------------------------------------------------------------
template <class Sample>
Estimate ReferenceIntegrator::Run(
  std::uint64_t samples, std::uint64_t seed, const Sample& sample) const
{
  return this->RunAll<1>(samples, seed,
    [&](Pcg32& random, Flight& flight)
    { return std::array<double, 1>{sample(random, flight)}; })[0];
}

//--------------------------------------------------------------------------------------------------
Estimate ReferenceIntegrator::Radiance(
  const Ray& ray, std::uint64_t samples, std::uint64_t seed) const
{
  return this->Run(samples, seed,
    [&](Pcg32& random, Flight& flight)
    { return this->RadianceSample(ray, false, random, flight); });
}

//--------------------------------------------------------------------------------------------------
Estimate ReferenceIntegrator::Veil(const Ray& ray, std::uint64_t samples, std::uint64_t seed) const
{
  return this->Run(samples, seed,
    [&](Pcg32& random, Flight& flight) { return this->RadianceSample(ray, true, random, flight); });
}

//--------------------------------------------------------------------------------------------------
Estimate ReferenceIntegrator::MeanRadiance(
  const std::function<Ray(Pcg32&)>& draw, std::uint64_t samples, std::uint64_t seed) const
{
  return this->Run(samples, seed,
    [&](Pcg32& random, Flight& flight)
    { return this->RadianceSample(draw(random), false, random, flight); });
}

//--------------------------------------------------------------------------------------------------
RayMoments ReferenceIntegrator::MomentsOfRadiance(
  const std::function<Ray(Pcg32&)>& draw, std::uint64_t samples, std::uint64_t seed) const
{
  const auto [radiance, added, square] = this->RunAll<3>(samples, seed,
    [&](Pcg32& random, Flight& flight)
    {
      const Ray ray = draw(random);
      this->Fly(ray, Vec3(0.0), flight);
      const double seen = std::exp(-flight.OpticalDepth) * this->Arriving(ray, flight.End);
      const double all = this->RadianceSample(ray, false, random, flight);
      // (seen + added)^2 - added^2, in which the noise of what is added counts once.
      return std::array<double, 3>{all, all - seen, seen * (2.0 * all - seen)};
    });
  return {radiance, added, square};
}

//--------------------------------------------------------------------------------------------------
Estimate ReferenceIntegrator::Fluence(
  const Vec3& point, std::uint64_t samples, std::uint64_t seed) const
{
  return this->MeanFluence([&](Pcg32&) { return point; }, samples, seed);
}

//--------------------------------------------------------------------------------------------------
Estimate ReferenceIntegrator::MeanFluence(
  const std::function<Vec3(Pcg32&)>& draw, std::uint64_t samples, std::uint64_t seed) const
{
  return this->Run(samples, seed,
    [&](Pcg32& random, Flight& flight) {
      return 4.0 * pi * this->Collect({draw(random), Vec3(0.0), false}, random, flight);
    });
}

//--------------------------------------------------------------------------------------------------
Estimate ReferenceIntegrator::Illuminance(
  const Vec3& point, const Vec3& normal, std::uint64_t samples, std::uint64_t seed) const
{
  const Vertex vertex{point, normal, true};
  return this->Run(samples, seed,
    [&](Pcg32& random, Flight& flight) { return pi * this->Collect(vertex, random, flight); });
}

//--------------------------------------------------------------------------------------------------
double ReferenceIntegrator::EmitterSeen(const Ray& ray) const
{
  Flight flight;
  this->Fly(ray, Vec3(0.0), flight);
  return std::exp(-flight.OpticalDepth) * this->Emitted(ray, flight.End);
}

//--------------------------------------------------------------------------------------------------
void ReferenceIntegrator::Fly(const Ray& ray, const Vec3& shift, Flight& flight) const
{
  flight.End = this->Scene_->Shapes().Intersect(ray.Origin + shift, ray.Direction, 0.0, this->Far_);
  flight.Length = std::min(flight.End.Distance, this->Far_);
  flight.Pieces.clear();
  this->Scene_->Smoke().Walk(ray.Origin, ray.Direction, 0.0, flight.Length, flight.Pieces);
  flight.OpticalDepth = 0.0;
  for (const Segment& piece : flight.Pieces)
  {
    flight.OpticalDepth += this->Depth(piece);
  }
}

//--------------------------------------------------------------------------------------------------
double ReferenceIntegrator::Depth(const Segment& piece) const
{
  return this->Scale_ * this->Scene_->Smoke().Extinction(piece.Cell) * (piece.End - piece.Begin);
}

//--------------------------------------------------------------------------------------------------
double ReferenceIntegrator::DistanceAt(const Flight& flight, double opticalDepth) const
{
  double before = 0.0;
  for (const Segment& piece : flight.Pieces)
  {
    const double depth = this->Depth(piece);
    if (depth > 0.0 && before + depth >= opticalDepth)
    {
      return piece.Begin + (piece.End - piece.Begin) * (opticalDepth - before) / depth;
    }
    before += depth;
  }
  return flight.Length;
}

//--------------------------------------------------------------------------------------------------
double ReferenceIntegrator::SmokeEmission(const Flight& flight) const
{
  if (!this->Scene_->Smoke().Emits())
  {
    return 0.0;
  }
  double transmittance = 1.0;
  double sum = 0.0;
  for (const Segment& piece : flight.Pieces)
  {
    const double depth = this->Depth(piece);
    sum -= this->Scene_->Smoke().EmittedLuminance(piece.Cell) * transmittance * std::expm1(-depth);
    transmittance *= std::exp(-depth);
  }
  return (1.0 - this->Scene_->Albedo()) * sum;
}

//--------------------------------------------------------------------------------------------------
double ReferenceIntegrator::Emitted(const Ray& ray, const Hit& hit) const
{
  if (!hit.Found() || !hit.Emitter || hit.Side != 0)
  {
    return 0.0;
  }
  const std::size_t index = this->Scene_->Shapes().Cell(hit);
  const EmitterCell& cell = this->Scene_->Lights().Cells()[index];
  const double cosine =
    std::max(0.0, -glm::dot(ray.Direction, this->Scene_->Lights().CellNormal(index)));
  return cell.Luminance[this->Band_] *
         (cell.Exponent > 0.0 ? std::pow(cosine, cell.Exponent) : 1.0);
}

//--------------------------------------------------------------------------------------------------
double ReferenceIntegrator::Arriving(const Ray& ray, const Hit& hit) const
{
  return hit.Found() ? this->Emitted(ray, hit) : this->Scene_->Sky();
}

//--------------------------------------------------------------------------------------------------
double ReferenceIntegrator::ReflectanceAt(const Hit& hit) const
{
  const std::size_t cell = this->Scene_->Shapes().Cell(hit);
  const std::size_t patch = hit.Emitter ? this->Scene_->SurfacePatches() + cell : cell;
  return this->Scene_->PatchReflectance(patch)[this->Band_];
}

//--------------------------------------------------------------------------------------------------
ReferenceIntegrator::Vertex ReferenceIntegrator::SurfaceVertex(const Ray& ray, const Hit& hit) const
{
  const Vec3 front = this->Scene_->Shapes().Normal(hit);
  const Vec3 normal = glm::dot(front, ray.Direction) < 0.0 ? front : -front;
  return {ray.Origin + ray.Direction * hit.Distance, normal, true};
}

//--------------------------------------------------------------------------------------------------
Vec3 ReferenceIntegrator::Shift(const Vertex& vertex) const
{
  return vertex.Normal * this->Scene_->Shapes().Tolerance();
}

//--------------------------------------------------------------------------------------------------
double ReferenceIntegrator::RadianceSample(
  const Ray& ray, bool veilOnly, Pcg32& random, Flight& flight) const
{
  this->Fly(ray, Vec3(0.0), flight);
  const Hit end = flight.End;
  const double transmittance = std::exp(-flight.OpticalDepth);
  double value = this->SmokeEmission(flight);
  if (!veilOnly)
  {
    value += transmittance * this->Arriving(ray, end);
  }

  // Scattering on the line of sight. Half of the points follow the transmittance, half are uniform
  // in distance: light from afar would be starved by the first kind alone.
  const double albedo = this->Scene_->Albedo();
  if (albedo > 0.0 && flight.OpticalDepth > 0.0)
  {
    const double first = flight.Pieces.front().Begin;
    const double span = flight.Pieces.back().End - first;
    const double collision = -std::expm1(-flight.OpticalDepth);
    const double distance = random.Uniform() < 0.5
                              ? this->DistanceAt(flight, -std::log1p(-random.Uniform() * collision))
                              : first + span * random.Uniform();
    double depth = 0.0;
    double extinction = 0.0;
    for (const Segment& piece : flight.Pieces)
    {
      const double local = this->Depth(piece);
      if (distance < piece.End)
      {
        if (distance >= piece.Begin)
        {
          extinction = this->Scale_ * this->Scene_->Smoke().Extinction(piece.Cell);
          depth += extinction * (distance - piece.Begin);
        }
        break;
      }
      depth += local;
    }
    const double rate = extinction * std::exp(-depth);
    if (rate > 0.0)
    {
      const double density = 0.5 * rate / collision + 0.5 / span;
      const Vertex vertex{ray.Origin + ray.Direction * distance, Vec3(0.0), false};
      value += albedo * rate / density * this->Collect(vertex, random, flight);
    }
  }

  if (!veilOnly && end.Found())
  {
    const double reflectance = this->ReflectanceAt(end);
    if (reflectance > 0.0)
    {
      value +=
        transmittance * reflectance * this->Collect(this->SurfaceVertex(ray, end), random, flight);
    }
  }
  return value;
}

//--------------------------------------------------------------------------------------------------
double ReferenceIntegrator::Collect(Vertex vertex, Pcg32& random, Flight& flight) const
{
  double weight = 1.0;
  double sum = 0.0;
  for (;;)
  {
    sum += weight * this->NextEvent(vertex, random);

    // Directions follow the integrand's own kernel, which leaves the weight as it is.
    const Vec3 direction =
      vertex.OnSurface ? CosineDirection(vertex.Normal, random) : SphereDirection(random);
    const double density = vertex.OnSurface ? glm::dot(vertex.Normal, direction) / pi : 0.25 / pi;
    const Ray ray{vertex.Point, direction};
    const Vec3 shift = this->Shift(vertex);
    this->Fly(ray, shift, flight);
    const double emitted = this->Emitted(ray, flight.End);
    if (emitted > 0.0)
    {
      const double share = density / (density + this->LightDensity(ray, flight.End));
      sum += weight * share * std::exp(-flight.OpticalDepth) * emitted;
    }
    else if (!flight.End.Found())
    {
      sum += weight * std::exp(-flight.OpticalDepth) * this->Scene_->Sky();
    }
    sum += weight * this->SmokeEmission(flight);

    const double depth = -std::log(random.Uniform());
    if (depth < flight.OpticalDepth)
    {
      weight *= this->Scene_->Albedo();
      const double distance = this->DistanceAt(flight, depth);
      vertex = {ray.Origin + direction * distance, Vec3(0.0), false};
    }
    else if (flight.End.Found())
    {
      weight *= this->ReflectanceAt(flight.End);
      vertex = this->SurfaceVertex({ray.Origin + shift, direction}, flight.End);
    }
    else
    {
      return sum;
    }
    if (weight < RouletteWeight)
    {
      const double survival = weight / RouletteWeight;
      if (random.Uniform() >= survival)
      {
        return sum;
      }
      weight = RouletteWeight;
    }
  }
}

//--------------------------------------------------------------------------------------------------
double ReferenceIntegrator::NextEvent(const Vertex& vertex, Pcg32& random) const
{
  if (this->Lights_.empty())
  {
    return 0.0;
  }
  const double target = random.Uniform() * this->TotalFlux_;
  const auto found = std::upper_bound(this->Lights_.begin(), this->Lights_.end() - 1, target,
    [](double flux, const LightTriangle& light) { return flux < light.CumulativeFlux; });
  const double root = std::sqrt(random.Uniform());
  const double along = random.Uniform();
  const Vec3 point = found->Corners[0] * (1.0 - root) + found->Corners[1] * (root * (1.0 - along)) +
                     found->Corners[2] * (root * along);

  const Vec3 offset = point - vertex.Point;
  const double distance = glm::length(offset);
  if (distance <= 0.0)
  {
    return 0.0;
  }
  const Vec3 direction = offset / distance;
  const EmitterSet& lights = this->Scene_->Lights();
  const EmitterCell& cell = lights.Cells()[found->Cell];
  const double lightCosine = -glm::dot(direction, lights.CellNormal(found->Cell));
  const double cosine = vertex.OnSurface ? glm::dot(direction, vertex.Normal) : 1.0;
  if (lightCosine <= 0.0 || cosine <= 0.0 ||
      !this->Scene_->Shapes().Visible(vertex.Point + this->Shift(vertex), point))
  {
    return 0.0;
  }
  const double transmittance = std::exp(
    -this->Scale_ * this->Scene_->Smoke().OpticalDepth(vertex.Point, direction, 0.0, distance));
  const double emitted = cell.Luminance[this->Band_] *
                         (cell.Exponent > 0.0 ? std::pow(lightCosine, cell.Exponent) : 1.0);
  const double kernel = vertex.OnSurface ? cosine / pi : 0.25 / pi;
  const double lightDensity =
    this->Exitance_[found->Cell] / this->TotalFlux_ * distance * distance / lightCosine;
  // Balance heuristic: share / lightDensity with share = lightDensity / (lightDensity + kernel).
  return kernel * emitted * transmittance / (lightDensity + kernel);
}

//--------------------------------------------------------------------------------------------------
double ReferenceIntegrator::LightDensity(const Ray& ray, const Hit& hit) const
{
  const std::size_t cell = this->Scene_->Shapes().Cell(hit);
  const double cosine = -glm::dot(ray.Direction, this->Scene_->Lights().CellNormal(cell));
  return this->Exitance_[cell] / this->TotalFlux_ * hit.Distance * hit.Distance / cosine;
}

} // namespace smokevis
