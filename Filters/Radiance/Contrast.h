// How well a sign stands out in the image that an observer gets of it.
#pragma once

#include "View.h"

namespace smokevis
{

/// The observer's limits.
struct Observer
{
  /// Equivalent luminance of the observer's own noise [cd/m2]; 0: none (plain eq. 4 of the paper).
  double DarkLuminance = 0.1;
  /// Smallest angle that is resolved [rad]; finer detail is averaged. Default: one minute of arc.
  double Acuity = 2.908882086657216e-4;
};

/// What is measured over the plate of one sign.
struct SignMeasurement
{
  /// False where no part of the sign's front is in view; all but InShadow is then zero.
  bool InView = false;
  /// Whether surfaces were found to hide all of it, so that none of its parts is looked at.
  bool InShadow = false;
  /// Whether it is cut off; all but InView is then zero.
  bool BelowCutOff = false;
  /// Whether nothing reaches between the eye and the plate, so that none of its parts is looked at.
  bool Clear = false;
  /// Share of the plate (by solid angle) that shows, 0 to 1.
  double VisibleFraction = 0.0;
  /// Standard deviation over mean of the luminance, its standard error by the light field's noise,
  /// and the one by how uneven the smoke is between the places of the plate that are looked at.
  double Contrast = 0.0;
  double ContrastError = 0.0;
  double ContrastDivisionError = 0.0;
  /// Standard deviation over (mean + DarkLuminance), and its standard errors.
  double PerceivedContrast = 0.0;
  double PerceivedContrastError = 0.0;
  double PerceivedContrastDivisionError = 0.0;
  /// (lit - unlit) / unlit; 0 where nothing unlit shows, or what does sends no light.
  double WebberContrast = 0.0;
  /// (lit - unlit) / lit; 0 where nothing unlit shows.
  double UL924Contrast = 0.0;
  /// Mean luminance of what shows, and of its lit and unlit parts [cd/m2].
  double MeanLuminance = 0.0;
  double MeanLuminanceError = 0.0;
  double LitLuminance = 0.0;
  double UnlitLuminance = 0.0;
  /// Mean optical depth between eye and sign.
  double OpticalDepth = 0.0;
  /// Rays that were gathered for the veil, where the light field knew it too badly.
  std::size_t Rays = 0;
  /// Whether it knew it too badly, but nothing was gathered: the sign is lost in the eye's own
  /// noise, or no smoke scatters light on the way to it.
  bool LeftUncertain = false;
  /// Whether the smoke before the plate is so uneven that it was looked at in more places.
  bool Uneven = false;
};

/// Measures a sign (index into EmitterSet::Signs) from an eye point. Where the light field leaves
/// its contrast uncertain by more than 0.005, the veil is gathered (View::GatherVeil), unless the
/// sign is fainter than a hundredth of the dark luminance. Where uneven smoke leaves the perceived
/// contrast uncertain by more than 0.002, the plate is divided more finely, with a ray for the veil
/// to each part. So has each part one where optical depths over the plate are rough (Roughness.h)
/// by more than 0.03 and the light field's tolerance, or they and the veil by more than 0.01 and a
/// third of the tolerance, or the plate has no pattern.
/// @param cutOff a sign whose own light, without the veil, has a smaller perceived contrast is
/// measured no further: an even veil can only lower it, and an uneven one is not the sign
SignMeasurement MeasureSign(const View& view, std::size_t sign, const Vec3& eye,
  const Observer& observer, double cutOff = 0.0);

} // namespace smokevis
