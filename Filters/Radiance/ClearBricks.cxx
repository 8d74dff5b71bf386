#include "ClearBricks.h"

#include <algorithm>

namespace smokevis
{

namespace
{

/// Share of a grid's cells outside the box, and of the box's cells in clear bricks, from which on
/// leaping over them saves more than looking for them costs.
constexpr double LeastShare = 1.0 / 32.0;
constexpr double LeastInBox = 1.0 / 4.0;
/// Longest edge of a cube of bricks.
constexpr int LongestReach = 1000;

} // namespace

//--------------------------------------------------------------------------------------------------
ClearBricks::ClearBricks(const std::array<int, 3>& size, const CellContents& contents)
{
  std::int64_t bricks = 1;
  for (int axis = 0; axis < 3; ++axis)
  {
    this->First_[axis] = size[axis];
    this->Bricks_[axis] = (size[axis] + Mask) >> Shift;
    bricks *= this->Bricks_[axis];
  }
  std::vector<bool> smoky(bricks, false);
  std::int64_t number = 0;
  ForEachPlace(size,
    [&](const std::array<int, 3>& cell)
    {
      const float extinction = contents.Extinction[number];
      if (extinction > contents.Trace ||
          (extinction > 0.0F && contents.Emitted && contents.Emitted[number] > 0.0F))
      {
        smoky[this->Brick(cell)] = true;
        for (int axis = 0; axis < 3; ++axis)
        {
          this->First_[axis] = std::min(this->First_[axis], cell[axis]);
          this->Last_[axis] = std::max(this->Last_[axis], cell[axis]);
        }
      }
      ++number;
    });
  const auto edge = [this](int axis, int brick)
  {
    return std::max(0, std::min(this->Last_[axis], (brick << Shift) + Mask) -
                         std::max(this->First_[axis], brick << Shift) + 1);
  };
  std::int64_t box = 1;
  for (int axis = 0; axis < 3; ++axis)
  {
    box *= std::max(0, this->Last_[axis] - this->First_[axis] + 1);
  }
  std::int64_t clear = box;
  auto brick = smoky.begin();
  ForEachPlace(this->Bricks_,
    [&](const std::array<int, 3>& place)
    {
      clear -= *brick++ ? static_cast<std::int64_t>(edge(0, place[0])) * edge(1, place[1]) *
                            edge(2, place[2])
                        : 0;
    });
  const auto reaches = [](std::int64_t part, double share, std::int64_t all)
  { return part > 0 && static_cast<double>(part) >= share * static_cast<double>(all); };
  const std::int64_t all = static_cast<std::int64_t>(size[0]) * size[1] * size[2];
  this->Cells_ = all - box;
  if (reaches(clear, LeastInBox, box))
  {
    this->Cells_ += clear;
    this->FindReach(smoky);
  }
  this->Worthwhile_ = reaches(this->Cells_, LeastShare, all);
}

//--------------------------------------------------------------------------------------------------
void ClearBricks::FindReach(const std::vector<bool>& smoky)
{
  for (int way = 0; way < 8; ++way)
  {
    std::vector<std::int16_t>& reach = this->Reach_[way];
    reach.resize(smoky.size());
    const auto place = [&](int axis, int i)
    { return (way >> axis & 1) != 0 ? i : this->Bricks_[axis] - 1 - i; };
    const auto number = [&](const std::array<int, 3>& from) {
      return PlaceNumber(this->Bricks_, {place(0, from[0]), place(1, from[1]), place(2, from[2])});
    };
    // From where rays leave the grid back to where they enter it: a cube is alike where the brick
    // is like the seven cubes, an edge less, that start with its neighbours.
    ForEachPlace(this->Bricks_,
      [&](const std::array<int, 3>& from)
      {
        const std::int64_t own = number(from);
        const int sign = smoky[own] ? -1 : 1;
        int least = LongestReach - 1;
        for (int next = 1; next < 8; ++next)
        {
          const std::array<int, 3> other = {
            from[0] - (next & 1), from[1] - (next >> 1 & 1), from[2] - (next >> 2 & 1)};
          if (*std::min_element(other.begin(), other.end()) >= 0)
          {
            least = std::clamp(sign * reach[number(other)], 0, least);
          }
        }
        reach[own] = static_cast<std::int16_t>(sign * (least + 1));
      });
  }
}

} // namespace smokevis
