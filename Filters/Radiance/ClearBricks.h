// Where a grid holds no smoke, so that rays that only meet smoke may leap over it.
#pragma once

#include "Places.h"

#include <array>
#include <cstdint>
#include <vector>

namespace smokevis
{

/// What the cells of a grid hold.
struct CellContents
{
  /// Extinction coefficient of each cell [1/m], x fastest, and the one up to which the air counts
  /// as clear.
  const float* Extinction = nullptr;
  float Trace = 0.0F;
  /// Luminance of what emits [cd/m2], which never counts as clear; null: nothing does.
  const float* Emitted = nullptr;
};

/// The box of all cells of a grid that hold smoke, and the bricks of cells that hold none, with how
/// far on the next ones hold none either.
class ClearBricks
{
public:
  /// Cells along the edge of a brick: this power of two.
  static constexpr int Shift = 3;
  static constexpr int Mask = (1 << Shift) - 1;

  ClearBricks() = default;
  /// @param size number of cells along each axis
  ClearBricks(const std::array<int, 3>& size, const CellContents& contents);

  /// Cells that rays need not stop in: those outside the box and, with bricks, those of clear ones.
  std::int64_t Cells() const { return this->Cells_; }
  /// Whether they are so many that looking for them pays.
  bool Worthwhile() const { return this->Worthwhile_; }
  /// First and last cells along each axis of the box around all smoke; the last lie before the
  /// first where there is none.
  const std::array<int, 3>& First() const { return this->First_; }
  const std::array<int, 3>& Last() const { return this->Last_; }
  /// Whether clear bricks within the box are many enough to look for.
  bool HasBricks() const { return !this->Reach_[0].empty(); }
  /// Number of the brick that a cell lies in.
  std::int64_t Brick(const std::array<int, 3>& cell) const
  {
    return PlaceNumber(this->Bricks_, {cell[0] >> Shift, cell[1] >> Shift, cell[2] >> Shift});
  }
  /// For each brick, the edge, in bricks, of a cube that starts with it and goes on in a ray's
  /// directions: without smoke, or, negative, without clear bricks. There are neither outside the
  /// grid.
  const std::int16_t* Reach(bool backX, bool backY, bool backZ) const
  {
    return this->Reach_[(backX ? 1 : 0) + (backY ? 2 : 0) + (backZ ? 4 : 0)].data();
  }

private:
  void FindReach(const std::vector<bool>& smoky);

  std::array<int, 3> First_{}, Last_{-1, -1, -1};
  /// Bricks along each axis.
  std::array<int, 3> Bricks_{};
  /// Of the eight combinations of directions; empty where looking for bricks does not pay.
  std::array<std::vector<std::int16_t>, 8> Reach_;
  std::int64_t Cells_ = 0;
  bool Worthwhile_ = false;
};

} // namespace smokevis
