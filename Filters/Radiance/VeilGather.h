// The veil of multiply scattered light before an eye, gathered along rays.
#pragma once

#include "IndirectLight.h"

#include <cstddef>
#include <vector>

namespace smokevis
{

/// A line of sight from the eye.
struct SightLine
{
  /// Unit direction.
  Vec3 Direction;
  /// Length [m].
  double End = 0.0;
  /// Share in the mean over several lines.
  double Weight = 1.0;
};

/// A veil and what it took.
struct GatheredVeil
{
  /// Batches of the veil [cd/m2].
  Lanes Multiple;
  /// Rays of all batches; none where no smoke scatters.
  std::size_t Rays = 0;
};

/// Mean over lines of sight from one origin of the multiply scattered light that smoke sends to it.
/// In the dark, few random lines bring light to the cells that an eye looks through, so that the
/// light field knows their light badly. Rays from places along the lines of sight tell it better:
/// what each brings is a mean over all cells that it passes. A batch has rays of its own through
/// its own light, so that the batches stay independent but for the shapes inside cells. There are
/// always as many rays: those that happen to agree are not the best ones.
GatheredVeil GatherVeil(
  const IndirectLight& light, const Vec3& origin, const std::vector<SightLine>& lines);

} // namespace smokevis
