// The one conversion of VTK data to a scene that the solver understands.
#pragma once

#include "Scene.h"
#include "SceneBlocks.h"

namespace smokevis
{

/// What a scene needs besides its blocks.
struct SceneOptions
{
  /// 1: luminance, 3: red, green, blue.
  int Bands = 1;
  Spectrum ExtinctionScale = {1.0, 1.0, 1.0};
  double Albedo = 0.3;
  /// Luminance of the sky [cd/m2].
  double Sky = 0.0;
};

/// Describes the scene of the blocks. Grids, surface cells and emitter cells keep their order;
/// grids are refined as their blocks say. With
/// one band, three-component luminances and reflectances count with their photometric weights.
/// Throws Error that names array, block and cell of a value that is out of range. Surfaces without
/// Reflectance and emitters without it reflect nothing; smoke in hidden cells counts as clear.
SceneDescription BuildScene(const SceneBlocks& blocks, const SceneOptions& options);

/// Whether all bands of a scene have the same extinction, luminances and reflectances, so that one
/// solution serves them all.
bool BandsAreEqual(const SceneDescription& scene);

} // namespace smokevis
