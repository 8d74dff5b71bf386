#include "MultipleShape.h"

#include "OwnGlow.h"
#include "Scene.h"

#include <cmath>

#include <tbb/parallel_for.h>

namespace smokevis
{

namespace
{

/// Relative standard error of a cell's multiply scattered fluence above which shapes do not follow
/// it. A single batch may then bring most of that light, and the first order of its noise
/// (ShapeNoise), many times the light of brighter cells beside it, would be all that is seen there.
constexpr double MostNoise = 0.3;

} // namespace

std::vector<float> WellKnownMeans(const LightField& field, int band)
{
  const Lanes* const lanes = field.MultipleFluence.data() + field.CellIndex(band, 0);
  std::vector<float> means(field.Cells);
  tbb::parallel_for(std::size_t{0}, field.Cells,
    [&](std::size_t cell)
    {
      const double mean = Mean(lanes[cell]);
      means[cell] = StandardError(lanes[cell]) < MostNoise * mean ? static_cast<float>(mean) : 0.0F;
    });
  return means;
}

CellShape ShapeOfMultiple(const Scene& scene, int band, const std::vector<float>& means)
{
  if (scene.Albedo() == 0.0)
  {
    return {};
  }
  const OwnGlow glow(scene, band);
  return {scene, [&](std::int64_t cell, std::int64_t other)
    {
      const float own = means[cell];
      const float there = means[other];
      const double share = own > 0.0F && there > 0.0F ? glow.VaryingShare(cell, own) : 1.0;
      return share < 1.0 ? static_cast<float>(own * std::pow(there / own, share)) : there;
    }};
}

} // namespace smokevis
