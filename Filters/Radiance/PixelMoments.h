// Contrast over the pixels of an observer's image, and its standard error.
#pragma once

#include "PlatePattern.h"

namespace smokevis
{

/// A coefficient of each value of the pattern, a value a batch, makes the luminance that arrives.
using Coefficients = std::array<std::array<double, PatternValues>, Batches>;

/// How what a block of the plate shows arrives at the eye.
struct SeenBlock
{
  /// Solid angle of a unit of the pattern's area, of what is not hidden.
  double Density;
  Coefficients Factors;
  /// By how much each factor differs over the block, where places are not averaged in pixels: along
  /// both edges, standard deviation over mean, with the sign of the change from one side to the
  /// other.
  std::array<glm::dvec2, PatternValues> Spread{};
};

/// Factors of the mean of all batches.
PatternVector MeanFactors(const Coefficients& factors);

double Dot(const PatternVector& a, const PatternVector& b);

/// Mean and standard deviation over the pixels of one sign.
struct Moments
{
  double Mean = 0.0;
  double Deviation = 0.0;
};

/// A value of the mean of all batches, then of the means of all but one of them.
using Resampled = std::array<double, 1 + Batches>;
using ResampledMoments = std::array<Moments, 1 + Batches>;

/// Weight of the pixels, and the sums of their luminance and of its square.
struct Sums
{
  double Weight = 0.0;
  Resampled First{};
  Resampled Second{};

  ResampledMoments Get() const;
};

/// Adds the pixels of a plane part of a sign.
/// @param blocks one a block of the pattern
void AddPixels(const PlatePattern& pattern, const std::vector<SeenBlock>& blocks, Sums& sums);

/// Deviation over (mean + dark) with its jackknife estimate, free of first-order bias, and standard
/// error (as large as two of it must be to hold what two of a normal law do: FewBatches).
void Jackknife(const ResampledMoments& resampled, double dark, double& value, double& error);

} // namespace smokevis
