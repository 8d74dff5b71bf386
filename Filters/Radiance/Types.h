// Small value types that every part of the radiance solver shares.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include <glm/glm.hpp>

namespace smokevis
{

/// Points [m] and directions, in double precision.
using Vec3 = glm::dvec3;

/// Most colour bands that a scene can have.
inline constexpr int MaxBands = 3;

/// One value a band.
using Spectrum = std::array<double, MaxBands>;

/// Adds a share of one spectrum to another.
inline void Accumulate(Spectrum& sum, const Spectrum& value, double share = 1.0)
{
  for (std::size_t band = 0; band < sum.size(); ++band)
  {
    sum[band] += share * value[band];
  }
}

inline bool IsLit(const Spectrum& value)
{
  return std::any_of(value.begin(), value.end(), [](double each) { return each > 0.0; });
}

/// Independent batches of the light-field estimate. Sixteen fill one 512-bit register of floats,
/// and sixteen batches give a standard error that is itself good to 18 %.
inline constexpr int Batches = 16;

/// One value a batch.
struct alignas(64) Lanes
{
  float Value[Batches] = {};

  float operator[](int batch) const { return this->Value[batch]; }
  float& operator[](int batch) { return this->Value[batch]; }
};

/// Adds a weight times a term, batch by batch.
inline void Add(Lanes& sum, const Lanes& term, float weight)
{
  for (int batch = 0; batch < Batches; ++batch)
  {
    sum.Value[batch] += weight * term.Value[batch];
  }
}

/// The same in double precision, in which many can be summed.
using DoubleLanes = std::array<double, Batches>;

/// Mean of the batches.
double Mean(const Lanes& lanes);
double Mean(const DoubleLanes& lanes);
/// Standard error of that mean, from the spread of the batches. So few know their spread roughly,
/// and two standard errors of their own would hold 93.6 % (Student's t with 15 degrees of freedom);
/// times this, two hold 95.45 %, as those of a normal law do (JCGM 100:2008, annex G.3).
double StandardError(const Lanes& lanes);
double StandardError(const DoubleLanes& lanes);
inline constexpr double FewBatches = 1.0906;

/// Photopic weights of three bands, which turn band luminances into one luminance. The values are
/// those of the linear sRGB primaries (IEC 61966-2-1), so that equal bands give the same luminance.
inline constexpr Spectrum PhotopicWeights = {0.2126, 0.7152, 0.0722};

/// Luminance of a spectrum of so many bands (1 or 3).
inline double Luminance(const Spectrum& value, int bands)
{
  return bands == 1 ? value[0]
                    : PhotopicWeights[0] * value[0] + PhotopicWeights[1] * value[1] +
                        PhotopicWeights[2] * value[2];
}

} // namespace smokevis
