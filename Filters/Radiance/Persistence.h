// How long light lasts in the parts of a scene.
#pragma once

#include <vector>

namespace smokevis
{

class GlobalLines;
class Scene;

/// Share [0, 1] of the light around surfaces that is still there a sweep later, where it is
/// largest. In a white room that is part of a dark building it is much more than of all light
/// together, and how little of that changes says nothing of the room.
///
/// Random lines tell which surfaces light each other. Those that lie close together and face the
/// same way count as one, so that no light seems to be caught between two patches that the same
/// line met. What leaves the scene, and what smoke and surfaces take up, is lost; what smoke
/// scatters goes on as if it had not been scattered, which brings it somewhere nearby.
/// @param lines of which some draws are taken
/// @param lit whether a side of a patch, [2 * patch + side], holds any light to speak of
double LongestPersistence(
  const Scene& scene, const GlobalLines& lines, int band, const std::vector<bool>& lit);

} // namespace smokevis
