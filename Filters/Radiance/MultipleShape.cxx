#include "MultipleShape.h"

#include "Scene.h"

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

CellShape ShapeOfMultiple(const Scene& scene, const std::vector<float>& means)
{
  if (scene.Albedo() == 0.0)
  {
    return {};
  }
  return {scene, [&means](std::int64_t, std::int64_t cell) { return means[cell]; }};
}

} // namespace smokevis
