// The light that flames send out, as the luminance that the smoke in burning cells emits.
#pragma once

#include "SmvFile.h"

#include <span>

namespace smokevis
{

/// The flames' light, in sums over cells.
struct FlameLight
{
  /// Heat release rate [W]; 0 where it is not asked for.
  double HeatRelease = 0.0;
  /// Light that the model asks for, and the part that burning cells with smoke send out [lm].
  double LumensAsked = 0.0;
  double LumensPlaced = 0.0;

  FlameLight& operator+=(const FlameLight& other);
};

/// Least absorption coefficient [1/m] of a cell that is given light to emit.
constexpr double LeastAbsorption = 1e-3;

/// Spreads @p efficacy [lm/W] times the heat release over the burning cells of a mesh in proportion
/// to their heat release rate: in dL/ds = k_a (L_emit - L) a cell of volume V sends out
/// 4 pi k_a L_emit V lumens, where k_a = K (1 - albedo). Light of burning cells with less than
/// LeastAbsorption, which can hardly emit, goes to the mesh's other burning cells, in the same
/// proportion; where there are none it is not placed.
/// @param heatRelease [kW/m3], extinction [1/m] and luminance [cd/m2], a cell each, x fastest
FlameLight SpreadFlameLight(const SmvMesh& mesh, std::span<const float> heatRelease,
  std::span<const float> extinction, double albedo, double efficacy, std::span<float> luminance);

/// Heat release rate of a mesh [W].
/// @param heatRelease [kW/m3], a cell each, x fastest
double TotalHeatRelease(const SmvMesh& mesh, std::span<const float> heatRelease);

/// Lets the smoke glow like a black body of its temperature: L_emit is BlackBodyLuminance().
/// @param temperature [C]
FlameLight GlowOfSmoke(const SmvMesh& mesh, std::span<const float> temperature,
  std::span<const float> extinction, double albedo, std::span<float> luminance);

} // namespace smokevis
