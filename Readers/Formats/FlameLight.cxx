#include "FlameLight.h"

#include "BlackBody.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace smokevis
{

namespace
{

constexpr double FourPi = 4.0 * std::numbers::pi;
constexpr double WattsPerKilowatt = 1000.0;

// Calls visit(cell, volume [m3]) for all cells, x fastest.
template <class Visit> void ForEachVolume(const SmvMesh& mesh, Visit&& visit)
{
  const auto& [x, y, z] = mesh.Nodes;
  std::size_t cell = 0;
  for (std::size_t k = 0; k + 1 < z.size(); ++k)
  {
    for (std::size_t j = 0; j + 1 < y.size(); ++j)
    {
      const double face = (z[k + 1] - z[k]) * (y[j + 1] - y[j]);
      for (std::size_t i = 0; i + 1 < x.size(); ++i, ++cell)
      {
        visit(cell, face * (x[i + 1] - x[i]));
      }
    }
  }
}

} // namespace

//------------------------------------------------------------------------------------------------
FlameLight& FlameLight::operator+=(const FlameLight& other)
{
  HeatRelease += other.HeatRelease;
  LumensAsked += other.LumensAsked;
  LumensPlaced += other.LumensPlaced;
  return *this;
}

//------------------------------------------------------------------------------------------------
FlameLight SpreadFlameLight(const SmvMesh& mesh, std::span<const float> heatRelease,
  std::span<const float> extinction, double albedo, double efficacy, std::span<float> luminance)
{
  FlameLight light;
  double smoky = 0.0; // heat release of burning cells with smoke [W]
  const auto absorption = [&](std::size_t cell) { return extinction[cell] * (1.0 - albedo); };
  ForEachVolume(mesh,
    [&](std::size_t cell, double volume)
    {
      if (heatRelease[cell] > 0.0F)
      {
        const double heat = WattsPerKilowatt * heatRelease[cell] * volume;
        light.HeatRelease += heat;
        smoky += absorption(cell) >= LeastAbsorption ? heat : 0.0;
      }
    });
  light.LumensAsked = efficacy * light.HeatRelease;
  light.LumensPlaced = smoky > 0.0 ? light.LumensAsked : 0.0;
  // Lumens per watt of the cells that do emit.
  const double share = smoky > 0.0 ? light.LumensAsked / smoky : 0.0;
  for (std::size_t cell = 0; cell < luminance.size(); ++cell)
  {
    const bool emits = heatRelease[cell] > 0.0F && absorption(cell) >= LeastAbsorption;
    luminance[cell] = emits ? static_cast<float>(share * WattsPerKilowatt * heatRelease[cell] /
                                                 (FourPi * absorption(cell)))
                            : 0.0F;
  }
  return light;
}

//------------------------------------------------------------------------------------------------
double TotalHeatRelease(const SmvMesh& mesh, std::span<const float> heatRelease)
{
  double total = 0.0;
  ForEachVolume(mesh, [&](std::size_t cell, double volume)
    { total += std::max(heatRelease[cell], 0.0F) * WattsPerKilowatt * volume; });
  return total;
}

//------------------------------------------------------------------------------------------------
FlameLight GlowOfSmoke(const SmvMesh& mesh, std::span<const float> temperature,
  std::span<const float> extinction, double albedo, std::span<float> luminance)
{
  FlameLight light;
  ForEachVolume(mesh,
    [&](std::size_t cell, double volume)
    {
      luminance[cell] = static_cast<float>(BlackBodyLuminance(temperature[cell]));
      light.LumensPlaced += FourPi * extinction[cell] * (1.0 - albedo) * luminance[cell] * volume;
    });
  light.LumensAsked = light.LumensPlaced;
  return light;
}

} // namespace smokevis
