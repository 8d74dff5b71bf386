// Scenes that are drawn at random for comparison with the reference integrator.
#pragma once

#include "Scene.h"

#include <cstdint>

namespace smokevis::scenes
{

struct RandomScene
{
  SceneDescription Description;
  Vec3 Eye;
};

/// A room with smoke like noise, up to two lamps, a block and a sign.
RandomScene MakeRandomRoom(std::uint64_t seed);
/// An open field of uniform or layered smoke over a floor, with a box, a sign and up to nine lamps.
RandomScene MakeRandomField(std::uint64_t seed);
/// A room with up to three clouds, boxes and ellipsoids of denser smoke, in thin smoke, with up to
/// two lamps and a sign.
RandomScene MakeRandomClouds(std::uint64_t seed);
/// Two rooms with a door between them, layers of smoke, and perhaps a flame and a window in the
/// first one, up to two lamps in either, and a sign in the second.
RandomScene MakeRandomBuilding(std::uint64_t seed);

} // namespace smokevis::scenes
