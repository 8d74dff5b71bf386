// Where most of what smoke sends on or out comes from.
#pragma once

#include "Box.h"

#include <vector>

namespace smokevis
{

class Scene;
struct LightField;

/// Cells that lie side by side and are among those that send out most.
struct BrightBody
{
  Box Bounds = Box::Nothing();
  /// Of all that is sent on for the first time or out along lines (FirstSource).
  double Share = 0.0;
};

/// The brightest cells that together make seven tenths of the light that smoke emits and scatters
/// for the first time: flames, and what lies before signs and lamps. Body by body in the order of
/// cells, the eight strongest ones, or fewer where the last of these are alike; those that fit into
/// one box about as well are one.
/// @param field holds the direct light
/// @param outer box around the scene
std::vector<BrightBody> BrightBodies(
  const Scene& scene, const LightField& field, int band, const Box& outer);
/// The same of nine tenths of what smoke emits alone. None where it emits nothing.
std::vector<BrightBody> GlowingBodies(
  const Scene& scene, const LightField& field, int band, const Box& outer);

} // namespace smokevis
