// Small scenes drawn at random from all that the solver is to bear, and the check that a solution
// holds nothing but finite numbers.
#pragma once

#include "Contrast.h"
#include "SceneLibrary.h"
#include "Solved.h"

#include <string>

namespace smokevis::stress
{

/// A scene, where to look from, and what to solve it with.
struct StressScene
{
  SceneDescription Description;
  Vec3 Eye{0.0};
  double Tolerance = 0.03;
  /// What was drawn, for messages.
  std::string Name;
};

/// A room, an open field or layers of smoke with blocks, signs and lamps. One seed, one scene.
StressScene DrawScene(std::uint64_t seed);

/// Expects every number of a light field to be finite and what counts light not to be negative.
void ExpectSaneField(const Solved& solved);

/// Expects a measured sign to hold finite numbers in their ranges.
void ExpectSaneSign(const SignMeasurement& sign);

} // namespace smokevis::stress
