// Where smoke that shines by itself lies.
#pragma once

#include "Box.h"

#include <vector>

namespace smokevis
{

class Scene;

/// Cells that touch each other and are among those that send out most of what smoke does.
struct GlowingBody
{
  Box Bounds = Box::Nothing();
  /// Of the power of all smoke and all emitters.
  double Share = 0.0;
};

/// The brightest cells that together send out nine tenths of the smoke's light, body by body, the
/// strongest ones first, eight at most; bodies that fit into one box about as well are one. None
/// where no smoke emits.
std::vector<GlowingBody> GlowingBodies(const Scene& scene, int band);

} // namespace smokevis
