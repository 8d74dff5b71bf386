// Which neighbouring smoke cells light passes between freely.
#pragma once

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

  /// @param axis 0..2, @param side 0: low, 1: high
  bool Open(std::int64_t cell, int axis, int side) const
  {
    return (this->Faces_[cell] >> (2 * axis + side) & 1) != 0;
  }

private:
  /// Bit 2 axis + side of each cell.
  std::vector<unsigned char> Faces_;
};

} // namespace smokevis
