// How light varies over a plate.
#pragma once

#include "Emitters.h"
#include "GaussNodes.h"
#include "Types.h"

#include <array>
#include <cstddef>
#include <vector>

namespace smokevis
{

/// The light on the plate of a sign over its mean, quadratic along both edges of the rectangle
/// around it.
class PlateCourse
{
public:
  /// Gauss places of the rectangle.
  static constexpr std::size_t Places = Nodes3.size() * Nodes3.size();
  static Vec3 Place(const Sign& sign, std::size_t place);

  /// Even light.
  PlateCourse() = default;
  /// @param light at the places. It is even where it varies no more than by its own noise; else
  ///     as much of what it varies by is left out as noise may feign
  explicit PlateCourse(const std::array<DoubleLanes, Places>& light);

  /// Light on a cell of the sign.
  struct CellLight
  {
    /// Mean over the cell, over the mean over all cells.
    DoubleLanes Share{};
    /// Gradient in the middle of the cell, over the mean over it [1/m].
    Vec3 Gradient{0.0};
  };
  std::vector<CellLight> Cells(const EmitterSet& lights, const Sign& sign) const;

private:
  /// Of the light over its mean over the rectangle [1/m].
  Vec3 GradientAt(const Vec3& point, const Sign& sign) const;

  /// At the places, over the mean over the rectangle, less 1.
  std::array<DoubleLanes, Places> Excess_{};
};

} // namespace smokevis
