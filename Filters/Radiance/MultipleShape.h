// How multiply scattered light varies inside the cells of a solved light field.
#pragma once

#include "CellShape.h"
#include "LightField.h"

#include <vector>

namespace smokevis
{

class Scene;

/// Means over the batches of what is not direct of the fluence in a band [lx]; 0 where it is known
/// so badly that shapes do not follow it.
std::vector<float> WellKnownMeans(const LightField& field, int band);

/// Shapes from those means; none where nothing scatters.
CellShape ShapeOfMultiple(const Scene& scene, int band, const std::vector<float>& means);

} // namespace smokevis
