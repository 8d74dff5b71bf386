// The image that a camera in the smoke receives, pixel by pixel.
#pragma once

#include "Camera.h"
#include "Progress.h"
#include "View.h"

#include <cstddef>
#include <vector>

namespace smokevis
{

class Team;

/// Values a pixel, bottom row first. Luminances are photometric [cd/m2].
struct TracedImage
{
  std::vector<float> Luminance;
  /// Standard error of the luminance.
  std::vector<float> LuminanceError;
  /// What is left of the light of the surfaces and signs that end the rays.
  std::vector<float> Direct;
  /// Light that the smoke adds.
  std::vector<float> Veil;
  /// To the end of the ray; with three bands, of the middle one.
  std::vector<float> OpticalDepth;
  /// Luminance of each of three bands, 3 values a pixel.
  std::vector<float> LuminanceRGB;
  /// Id of the sign whose front the middle of the pixel sees, of the small sign whose middle the
  /// pixel holds, or -1.
  std::vector<int> SignIds;
  /// How many pixels have a pattern or an edge in their footprint, and are means of samples.
  std::size_t Averaged = 0;
  /// View::RaysCutShort of the image.
  std::size_t CutShort = 0;
  /// Points of the lens that the image is the mean of; 0: one, its centre.
  int LensPoints = 0;
};

/// Traces all pixels. A pixel that shows a plate of a sign or lamp averages over its footprint,
/// which is no smaller than the observer resolves; plates of a few pixels or less than one count by
/// their exact areas (SmallPlates). The result does not depend on the number of
/// threads. A camera with an aperture is the mean of pinhole cameras all over its lens; its SignIds
/// are those of the lens's centre. Throws Error when stopped.
/// @param acuity smallest angle that is resolved [rad]
/// @param team processes that share the pixels; all of them get the whole image
TracedImage TraceImage(
  const View& view, const Camera& camera, double acuity, Team& team, Progress& progress);

} // namespace smokevis
