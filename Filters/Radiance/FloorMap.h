// The Floor Map of Visibility: the best sign's contrast over a grid of standing places.
#pragma once

#include "Eye.h"
#include "Progress.h"

#include <limits>

namespace smokevis
{

struct FloorMapOptions
{
  /// First place and steps between places along x and y [m]; z is the height of the eye.
  Vec3 FirstPlace{0.0};
  double StepX = 1.0, StepY = 1.0;
  int PlacesX = 12, PlacesY = 8;
  /// Perceived contrast below which a sign counts as invisible.
  double ContrastThreshold = 0.2;
  /// Standard deviation of that threshold over observers.
  double ThresholdSpread = 0.04;
  /// Signs that are cut off (MeasureSign) count as 0; 0: none is.
  double CutOff = 0.0;
  /// Whether signs that face away are left out without a look; off: to measure what that saves.
  bool SkipsAway = true;
  Observer Eye;
  Adaptation State;
  /// Most worker threads; 0: as many as the machine has.
  int Threads = 0;
  /// Only places from the first up to, not including, the end are computed, where several processes
  /// share the work; the others keep their initial values.
  std::size_t First = 0;
  std::size_t End = std::numeric_limits<std::size_t>::max();

  /// The eye at a place, x fastest.
  Vec3 EyeAt(std::size_t place) const
  {
    return this->FirstPlace + Vec3(static_cast<double>(place % this->PlacesX) * this->StepX,
                                static_cast<double>(place / this->PlacesX) * this->StepY, 0.0);
  }
};

enum class PlaceStatus : signed char
{
  Seen = 0,
  BelowThreshold = 1,
  NoSignInView = 2,
  InsideSolid = 3
};

/// Values a place, x fastest; a sign's values follow each other: [place * signs + sign].
struct FloorMap
{
  std::size_t Signs = 0;
  std::vector<PlaceStatus> Status;
  /// Largest perceived contrast, its standard errors by the light field's noise and by the division
  /// of the sign's plate, the sign's id (-1: none), and along the line
  /// to that sign the optical depth and Jin's visibility 3/K [m] of the mean extinction.
  std::vector<float> Visibility, VisibilityError, VisibilityDivisionError, OpticalDepth,
    JinVisibility;
  /// Share of observers who see a sign, 0 to 1, and the equivalent luminance of the eye's noise,
  /// glare and adaptation when looking at the best sign [cd/m2].
  std::vector<float> VisibleProbability, EyeLuminance;
  std::vector<int> BestSign;
  std::vector<float> Contrast, PerceivedContrast, SignLuminance, VisibleFraction;
  std::vector<WorkItem> Report;
};

/// Computes the map. Throws Error where there is no sign, or when stopped.
FloorMap ComputeFloorMap(const View& view, const FloorMapOptions& options, Progress& progress);

} // namespace smokevis
