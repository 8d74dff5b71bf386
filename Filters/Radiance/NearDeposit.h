// What a light leaves in the smoke right before it, sent out from the light itself.
#pragma once

#include "Types.h"

#include <cstdint>
#include <vector>

namespace smokevis
{

class Scene;

/// Mean fluences over cells that a plate touches or lies in. Gauss points in the cells would miss
/// how steep the light is there, the steeper the thicker the smoke; rays that start evenly on the
/// plate have its power to a digit, and leave it where it stays.
class NearDeposit
{
public:
  /// @param light index into EmitterSet::Lights
  /// @param cells that are asked for
  /// @param coarse whether it will do to know each to a percent
  NearDeposit(const Scene& scene, std::size_t light, std::vector<std::int64_t> cells, bool coarse);

  /// Mean fluence over each of the cells [lx].
  std::vector<Spectrum> Run() const;

private:
  struct Ray;

  /// A ray of a leaf's light.
  /// @param leaf place among the leaves
  /// @param index of so many
  Ray Draw(std::size_t leaf, std::uint64_t index, std::uint64_t count) const;
  /// Adds what it leaves in the cells.
  void Follow(const Ray& ray, std::vector<Spectrum>& sums) const;
  void FindLeaves(int group);

  const Scene& Scene_;
  /// Sorted.
  std::vector<std::int64_t> Cells_;
  std::vector<std::size_t> Order_;
  /// Indices of the light's leaves among the groups.
  std::vector<int> Leaves_;
  /// Distance from the light within which the cells lie [m].
  double Reach_ = 0.0;
  bool Coarse_;
};

} // namespace smokevis
