// Which neighbouring smoke cells light passes between freely.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace smokevis
{

class Scene;

/// A face between two smoke cells is open where no surface stands between the cells' centres.
class OpenFaces
{
public:
  explicit OpenFaces(const Scene& scene);

  /// The cell that light passes to freely through a face, or -1.
  /// @param axis 0..2, @param side 0: low, 1: high
  std::int64_t Neighbour(std::int64_t cell, int axis, int side) const
  {
    return this->Neighbours_[cell][2 * axis + side];
  }

private:
  std::vector<std::array<std::int32_t, 6>> Neighbours_;
};

} // namespace smokevis
