// A plain, unbiased path tracer that shares nothing with the solver but the scene: the judge in
// tests.
#pragma once

#include "Scene.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace smokevis
{

/// Permuted congruential generator (O'Neill 2014, XSH-RR 64/32): small, and with streams that do
/// not overlap, so that each chunk of samples has its own.
class Pcg32
{
public:
  Pcg32(std::uint64_t seed, std::uint64_t stream);

  std::uint32_t Next();
  /// Uniform in the open interval (0, 1).
  double Uniform() { return (this->Next() + 0.5) * 0x1p-32; }

private:
  std::uint64_t State_ = 0;
  std::uint64_t Increment_;
};

/// A place in a box, evenly over its volume.
Vec3 PlaceIn(const Box& box, Pcg32& random);

/// A Monte Carlo result.
struct Estimate
{
  double Mean = 0.0;
  double StandardError = 0.0;
};

/// What rays show of emitters, exactly, and what smoke and surfaces add to it by scattering.
struct RayMoments
{
  Estimate Radiance;
  Estimate Added;
  /// Mean square of the radiance less that of what is added.
  Estimate Square;
};

struct Ray
{
  Vec3 Origin{0.0};
  Vec3 Direction{1.0, 0.0, 0.0};
};

/// Path tracer in one band. Emission that a ray meets directly and emission of the smoke are
/// integrated exactly; scattered light by distance sampling, with next-event estimation on the
/// emitters' areas and direction sampling combined by the balance heuristic (Veach 1997).
/// Results depend on the seed alone, not on the number of threads.
class ReferenceIntegrator
{
public:
  explicit ReferenceIntegrator(const Scene& scene, int band = 0);

  /// All light that arrives along a ray [cd/m2].
  Estimate Radiance(const Ray& ray, std::uint64_t samples, std::uint64_t seed) const;
  /// Only what smoke scatters or emits on the way to the first surface [cd/m2].
  Estimate Veil(const Ray& ray, std::uint64_t samples, std::uint64_t seed) const;
  /// Mean of the radiance over rays drawn by the caller, one a sample.
  Estimate MeanRadiance(
    const std::function<Ray(Pcg32&)>& draw, std::uint64_t samples, std::uint64_t seed) const;
  /// The same with what tells of the variance over the rays.
  RayMoments MomentsOfRadiance(
    const std::function<Ray(Pcg32&)>& draw, std::uint64_t samples, std::uint64_t seed) const;
  /// Fluence at a point [lx].
  Estimate Fluence(const Vec3& point, std::uint64_t samples, std::uint64_t seed) const;
  /// Mean of the fluence over points drawn by the caller, one a sample.
  Estimate MeanFluence(
    const std::function<Vec3(Pcg32&)>& draw, std::uint64_t samples, std::uint64_t seed) const;
  /// Illuminance at a point of a plane with a unit normal [lx].
  Estimate Illuminance(
    const Vec3& point, const Vec3& normal, std::uint64_t samples, std::uint64_t seed) const;

  /// Luminance of the emitter that ends a ray as it arrives, exact; 0 where there is none [cd/m2].
  double EmitterSeen(const Ray& ray) const;

private:
  /// Where a path changes direction: in smoke (Normal is zero) or on a surface.
  struct Vertex
  {
    Vec3 Point{0.0};
    Vec3 Normal{0.0};
    bool OnSurface = false;
  };

  /// A triangle of an emitter cell's fan and the sum of fluxes up to and including it.
  struct LightTriangle
  {
    std::array<Vec3, 3> Corners;
    std::size_t Cell;
    double CumulativeFlux;
  };

  /// A straight piece of a path as far as the next surface.
  struct Flight
  {
    Hit End;
    double Length = 0.0;
    double OpticalDepth = 0.0;
    std::vector<Segment> Pieces;
  };

  /// Means of what a sample gives.
  template <std::size_t Values, class Sample>
  std::array<Estimate, Values> RunAll(
    std::uint64_t samples, std::uint64_t seed, const Sample& sample) const;
  template <class Sample>
  Estimate Run(std::uint64_t samples, std::uint64_t seed, const Sample& sample) const;

  /// Follows a ray to the next surface, which is sought from a point shifted off the surface that
  /// the ray leaves.
  void Fly(const Ray& ray, const Vec3& shift, Flight& flight) const;
  Vec3 Shift(const Vertex& vertex) const;
  double Depth(const Segment& piece) const;
  /// Distance at which the flight has a given optical depth.
  double DistanceAt(const Flight& flight, double opticalDepth) const;
  double SmokeEmission(const Flight& flight) const;
  double Emitted(const Ray& ray, const Hit& hit) const;
  /// What comes from the end of a ray without having been scattered: of an emitter, or of the sky.
  double Arriving(const Ray& ray, const Hit& hit) const;
  double ReflectanceAt(const Hit& hit) const;
  Vertex SurfaceVertex(const Ray& ray, const Hit& hit) const;

  double RadianceSample(const Ray& ray, bool veilOnly, Pcg32& random, Flight& flight) const;
  /// Light that a vertex collects, an estimate of fluence / (4 pi) or of illuminance / pi.
  double Collect(Vertex vertex, Pcg32& random, Flight& flight) const;
  double NextEvent(const Vertex& vertex, Pcg32& random) const;
  /// Density over solid angle with which NextEvent finds the emitter that a ray met.
  double LightDensity(const Ray& ray, const Hit& hit) const;

  const Scene* Scene_;
  int Band_;
  double Scale_;
  double Far_;
  std::vector<LightTriangle> Lights_;
  double TotalFlux_ = 0.0;
  /// Density over area with which NextEvent samples each emitter cell, times TotalFlux_.
  std::vector<double> Exitance_;
};

} // namespace smokevis
