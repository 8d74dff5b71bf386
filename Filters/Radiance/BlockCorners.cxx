#include "BlockCorners.h"

namespace smokevis
{

namespace
{

/// Where the first diagonal begins, as shares of the block's edges, and which way it runs. The
/// others are its mirror images across two axes.
constexpr std::array<double, 3> DiagonalBegin = {0.5, 0.25, 0.75};
constexpr std::array<int, 3> DiagonalStep = {1, 1, -1};

} // namespace

std::array<int, 3> CornerOf(const Medium::Block& block, int index)
{
  const std::array<int, 3>& size = block.Size;
  return {index & 1 ? size[0] - 1 : 0, index & 2 ? size[1] - 1 : 0, index & 4 ? size[2] - 1 : 0};
}

std::array<int, 3> PlaceOnDiagonal(const Medium::Block& block, int steps, int diagonal)
{
  std::array<int, 3> place;
  for (int axis = 0; axis < 3; ++axis)
  {
    const int size = block.Size[axis];
    const int begin = static_cast<int>(DiagonalBegin[axis] * size);
    place[axis] = ((begin + DiagonalStep[axis] * steps) % size + size) % size;
    const bool mirrored = diagonal > 0 && axis + 1 != diagonal;
    place[axis] = mirrored ? size - 1 - place[axis] : place[axis];
  }
  return place;
}

double BetweenCorners(
  const std::array<double, 8>& corners, const Medium::Block& block, const std::array<int, 3>& place)
{
  Vec3 share(0.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    share[axis] =
      block.Size[axis] > 1 ? static_cast<double>(place[axis]) / (block.Size[axis] - 1) : 0.0;
  }
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner)
  {
    sum += corners[corner] * (corner & 1 ? share.x : 1.0 - share.x) *
           (corner & 2 ? share.y : 1.0 - share.y) * (corner & 4 ? share.z : 1.0 - share.z);
  }
  return sum;
}

} // namespace smokevis
