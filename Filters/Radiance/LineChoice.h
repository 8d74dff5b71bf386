// How many lines a sweep draws, and through which boxes.
#pragma once

#include "GlobalLines.h"

#include <cstdint>
#include <vector>

namespace smokevis
{

class Medium;
class Scene;
struct LightField;

/// Lines through the scene that cross a smoke cell of its mesh's mean size about 1.5 times and meet
/// each patch that sends light on or out as often, in the mean; these more often below a tolerance
/// of 0.03, so that they need not be put together (PatchGroups), and less often in smoke where they
/// send on little of the light. Grids of much smaller cells get lines of their own, and so do the
/// places where most light is sent on for the first time; some more join places far apart.
/// @param field holds the direct light
GlobalLines ChooseLines(const Scene& scene, const LightField& field, int band, double tolerance);

/// How many of the lines are expected to meet a smoke cell.
double CellMeetings(const GlobalLines& lines, const Medium& smoke, std::int64_t cell);

/// Whether the smoke as a whole, or its dense part, sends nearly all that it takes up on and on:
/// light then is where few of a sweep's lines alone would not tell it from their number.
bool ScattersOften(const Scene& scene, int band);

/// The boxes that patches just fit in.
std::vector<Box> PatchBounds(const Scene& scene);

} // namespace smokevis
