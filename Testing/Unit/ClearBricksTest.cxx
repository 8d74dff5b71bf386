// Rays that leap over clear air meet the same smoke, to the bit, as those that step through it.
#include "CellParts.h"
#include "Medium.h"
#include "Places.h"
#include "Sampler.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;
constexpr double Infinity = std::numeric_limits<double>::infinity();

/// Cells of even or uneven width whose extinction is told by their place.
template <class Value>
SmokeGrid Grid(
  const Vec3& lower, const Vec3& upper, const std::array<int, 3>& cells, bool even, Value&& value)
{
  SmokeGrid grid;
  grid.Name = "test";
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int i = 0; i <= cells[axis]; ++i)
    {
      const double share = static_cast<double>(i) / cells[axis];
      const double place = even ? share : share * (0.4 + 0.6 * share);
      grid.Nodes[axis].push_back(lower[axis] + place * (upper[axis] - lower[axis]));
    }
  }
  ForEachPlace(cells, [&](const std::array<int, 3>& place)
    { grid.Extinction.push_back(static_cast<float>(value(place[0], place[1], place[2]))); });
  return grid;
}

double Ball(int x, int y, int z, double cx, double cy, double cz, double radius)
{
  return std::hypot(x - cx, y - cy, z - cz) < radius ? 0.1 + 0.01 * (x + 2 * y + 3 * z) : 0.0;
}

class Compared
{
public:
  explicit Compared(const std::vector<SmokeGrid>& grids) : Leaping(grids), Stepping(grids, false) {}

  /// Expects the same pieces of smoke, and the same optical depth.
  void Ray(const Vec3& origin, const Vec3& direction, double begin, double end)
  {
    std::vector<Segment> all;
    std::vector<Segment> smoke;
    this->Stepping.Walk(origin, direction, begin, end, all);
    this->Leaping.WalkSmoke(origin, direction, begin, end, smoke);
    std::erase_if(
      all, [this](const Segment& piece) { return this->Leaping.Extinction(piece.Cell) == 0.0F; });
    ASSERT_EQ(smoke.size(), all.size());
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      EXPECT_EQ(smoke[i].Cell, all[i].Cell);
      EXPECT_EQ(smoke[i].Begin, all[i].Begin);
      EXPECT_EQ(smoke[i].End, all[i].End);
    }
    EXPECT_EQ(this->Leaping.OpticalDepth(origin, direction, begin, end),
      this->Stepping.OpticalDepth(origin, direction, begin, end));
    this->Pieces += smoke.size();
  }

  /// Rays from in and around the smoke in any direction, along the axes and along diagonals of the
  /// cells, from nodes and from elsewhere.
  void Rays(int count, double width)
  {
    std::uint64_t key = 11;
    const auto next = [&key] { return ToUnit(Mix(key++)); };
    const Vec3 size = this->Leaping.Upper() - this->Leaping.Lower();
    for (int i = 0; i < count; ++i)
    {
      const Vec3 share = {next(), next(), next()};
      Vec3 origin = this->Leaping.Lower() + (1.6 * share - Vec3(0.3)) * size;
      Vec3 direction = Vec3{next(), next(), next()} - Vec3(0.5);
      if (i % 3 == 1)
      {
        origin =
          this->Leaping.Lower() + width * glm::floor((origin - this->Leaping.Lower()) / width);
      }
      if (i % 5 == 1)
      {
        direction = glm::round(3.0 * direction);
      }
      if (i % 5 == 2)
      {
        direction = glm::round(3.0 * direction) + 1e-15 * direction;
      }
      if (glm::length(direction) > 0.0)
      {
        direction = glm::normalize(direction);
        this->Ray(origin, direction, 0.0, Infinity);
        const double begin = next() * glm::length(size);
        this->Ray(origin, direction, begin, begin + next() * glm::length(size));
      }
    }
  }

  Medium Leaping, Stepping;
  std::size_t Pieces = 0;
};

TEST(ClearBricks, CountsWhatIsLeaptOver)
{
  const auto layer = [](int, int, int z) { return z < 12 ? 0.0 : 1.0; };
  const Medium upper({Grid(Vec3(0.0), Vec3(4, 3, 2), {40, 30, 20}, true, layer)});
  EXPECT_EQ(upper.LeaptCells(), 40 * 30 * 12);
  const auto ends = [](int x, int, int) { return x == 0 || x == 39 ? 1.0 : 0.0; };
  // The bricks at both ends are eight cells thick.
  const Medium both({Grid(Vec3(0.0), Vec3(4, 3, 2), {40, 30, 20}, true, ends)});
  EXPECT_EQ(both.LeaptCells(), 24 * 30 * 20);
  const auto none = [](int, int, int) { return 0.0; };
  EXPECT_EQ(Medium({Grid(Vec3(0.0), Vec3(1, 1, 1), {9, 9, 9}, true, none)}).LeaptCells(), 729);
  const auto hole = [](int x, int y, int z) { return x == 4 && y == 4 && z == 4 ? 0.0 : 1.0; };
  EXPECT_EQ(Medium({Grid(Vec3(0.0), Vec3(1, 1, 1), {9, 9, 9}, true, hole)}).LeaptCells(), 0);
}

TEST(ClearBricks, LayerOfSmoke)
{
  for (const bool even : {true, false})
  {
    Compared layer({Grid(Vec3(0.0), Vec3(4, 3, 2), {40, 30, 20}, even,
      [](int x, int y, int z) { return z < 11 ? 0.0 : 0.1 + 0.01 * (x + y + z); })});
    layer.Rays(4000, 0.1);
    EXPECT_GT(layer.Pieces, 10000U);
  }
}

TEST(ClearBricks, SmokeHereAndThere)
{
  const Vec3 base(1e3, -2e3, 0.5);
  for (const bool even : {true, false})
  {
    Compared balls({Grid(base, base + Vec3(7.3, 4.1, 2.9), {73, 41, 29}, even,
      [](int x, int y, int z)
      {
        return Ball(x, y, z, 10.0, 12.0, 9.0, 7.0) + Ball(x, y, z, 60.0, 30.0, 20.0, 4.0) +
               (x == 35 && y == 20 && z == 27 ? 5.0 : 0.0);
      })});
    EXPECT_GT(balls.Leaping.LeaptCells(), 70 * 41 * 29 / 2);
    EXPECT_EQ(balls.Stepping.LeaptCells(), 0);
    balls.Rays(20000, 0.1);
    EXPECT_GT(balls.Pieces, 1000U);
  }
}

// What a simulation leaves in clear air counts as none, unless it emits or is all there is.
TEST(ClearBricks, TracesOfSmoke)
{
  const auto layer = [](int x, int, int z) { return z < 16 ? 1e-13 * (x % 3) : 1.0; };
  SmokeGrid grid = Grid(Vec3(0.0), Vec3(4, 3, 2.4), {40, 30, 24}, true, layer);
  const Medium leaping({grid});
  const Medium stepping({grid}, false);
  EXPECT_EQ(leaping.LeaptCells(), 40 * 30 * 16);
  const Vec3 direction = glm::normalize(Vec3(1.0, 0.3, 0.2));
  const Vec3 origin(0.1, 0.2, 0.3);
  EXPECT_EQ(leaping.OpticalDepth(origin, direction, 0.0, 3.0), 0.0);
  EXPECT_GT(stepping.OpticalDepth(origin, direction, 0.0, 3.0), 0.0);
  EXPECT_NEAR(leaping.OpticalDepth(origin, direction, 0.0, 9.0),
    stepping.OpticalDepth(origin, direction, 0.0, 9.0), 1e-10);
  grid.EmittedLuminance.assign(grid.Extinction.size(), 0.0F);
  grid.EmittedLuminance[1] = 5.0F;
  EXPECT_EQ(Medium({grid}).LeaptCells(), 40 * 30 * 16 - 512);
  const auto thin = [](int, int, int z) { return z < 16 ? 1e-15 : 1e-14; };
  EXPECT_EQ(Medium({Grid(Vec3(0.0), Vec3(4, 3, 2.4), {40, 30, 24}, true, thin)}).LeaptCells(), 0);
}

TEST(ClearBricks, OverlappingAndClearGrids)
{
  const auto ball = [](int x, int y, int z) { return Ball(x, y, z, 12.0, 10.0, 10.0, 6.0); };
  const auto clear = [](int, int, int) { return 0.0; };
  Compared nested({Grid(Vec3(0.0), Vec3(4, 2, 2), {24, 20, 20}, true, ball),
    Grid({1.0, 0.5, 0.5}, {3.0, 1.5, 1.5}, {40, 20, 20}, false, ball),
    Grid({1.5, 0.9, 0.2}, {1.8, 1.1, 1.9}, {12, 12, 12}, true, clear)});
  nested.Rays(20000, 0.1);
  EXPECT_GT(nested.Pieces, 1000U);
  Compared row({Grid(Vec3(0.0), Vec3(1, 1, 1), {10, 10, 10}, true, clear),
    Grid({1, 0, 0}, {3, 1, 1}, {20, 20, 20}, true, ball),
    Grid({3, 0, 0}, {4, 1, 1}, {10, 10, 10}, true, ball)});
  row.Rays(20000, 0.1);
  EXPECT_GT(row.Pieces, 1000U);
}

} // namespace
