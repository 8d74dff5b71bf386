// How many lines a sweep draws, and through which boxes.
#pragma once

#include "GlobalLines.h"

#include <vector>

namespace smokevis
{

class Scene;

/// Lines through the scene that cross a smoke cell of mean size about 1.5 times and meet each patch
/// that sends light on or out as often, in the mean; these more often below a tolerance of 0.03, so
/// that they need not be put together (PatchGroups).
GlobalLines ChooseLines(const Scene& scene, int band, double tolerance);

/// Whether the smoke as a whole sends nearly all that it takes up on and on: light then is where
/// few of a sweep's lines alone would not tell it from their number.
bool ScattersOften(const Scene& scene, int band);

/// Which patches lie in a box.
std::vector<bool> PatchesIn(const Scene& scene, const Box& box);

} // namespace smokevis
