// The noise that a field's variation inside a cell has of the neighbouring cells.
#pragma once

#include "CellShape.h"
#include "Types.h"

#include <cstdint>
#include <vector>

namespace smokevis
{

class OpenFaces;
class Scene;

/// The shape of a cell comes from the means of its neighbours, noise and all. The mean over the
/// batches stays what it is if each has slopes of its own, to first order, and their spread then
/// tells that noise too. It is alike in many rays, so that it counts most where they are averaged;
/// and where a cell is known better than its neighbours, as the first one of thick smoke that a
/// lamp shines into, it is all there is.
class ShapeNoise
{
public:
  /// None.
  ShapeNoise() = default;
  /// @param lanes batches of the field, a value a cell; must outlive this
  /// @param means of the batches; must outlive this
  /// @param shape from those means; must outlive this
  ShapeNoise(const Scene& scene, const Lanes* lanes, const std::vector<float>& means,
    const CellShape& shape);

  /// Adds weight times what the batches of the neighbours change at a point of a cell.
  void Add(std::int64_t cell, const Vec3& point, double weight, Lanes& sum) const;

private:
  const Scene* Scene_ = nullptr;
  const OpenFaces* Open_ = nullptr;
  const Lanes* Lanes_ = nullptr;
  const std::vector<float>* Means_ = nullptr;
  const CellShape* Shape_ = nullptr;
};

} // namespace smokevis
