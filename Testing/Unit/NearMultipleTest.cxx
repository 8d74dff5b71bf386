// Twice scattered light right before a sign, in cells as large as its bars, against finer cells.
#include "RandomScenes.h"
#include "SceneLibrary.h"
#include "Solved.h"

#include <array>
#include <vector>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

/// The same smoke in cells cut in two along each axis.
SmokeGrid Halved(const SmokeGrid& grid)
{
  SmokeGrid fine;
  fine.Name = grid.Name;
  std::array<std::size_t, 3> cells;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto& nodes = grid.Nodes[axis];
    cells[axis] = nodes.size() - 1;
    for (std::size_t i = 0; i < cells[axis]; ++i)
    {
      fine.Nodes[axis].push_back(nodes[i]);
      fine.Nodes[axis].push_back(0.5 * (nodes[i] + nodes[i + 1]));
    }
    fine.Nodes[axis].push_back(nodes.back());
  }
  for (std::size_t k = 0; k < 2 * cells[2]; ++k)
  {
    for (std::size_t j = 0; j < 2 * cells[1]; ++j)
    {
      for (std::size_t i = 0; i < 2 * cells[0]; ++i)
      {
        fine.Extinction.push_back(grid.Extinction[i / 2 + cells[0] * (j / 2 + cells[1] * (k / 2))]);
      }
    }
  }
  return fine;
}

/// Veil of multiply scattered light over the last cell before a sign's first bar [cd/m2].
/// @param reach length of that cell along the ray [m]
double LastVeil(const scenes::RandomScene& room, double reach)
{
  const Solved solved(room.Description, 0.03);
  const Vec3 way = solved.TheScene->Lights().CellCentre(0) - room.Eye;
  const double length = glm::length(way);
  return Mean(
    solved.TheView->TraceVeil(room.Eye, way / length, length - reach, length, 0).VeilMultiple);
}

// From the means of neighbouring cells a quarter of it would be missing. Noise of the light in the
// cell is 4 %, and as much is left that does not vary linearly there.
TEST(NearMultiple, VeilRightBeforeABar)
{
  constexpr double Reach = 0.184;
  scenes::RandomScene room = scenes::MakeRandomRoom(21);
  const double coarse = LastVeil(room, Reach);
  room.Description.Grids[0] = Halved(room.Description.Grids[0]);
  EXPECT_NEAR(coarse / LastVeil(room, Reach), 1.0, 0.12);
}

} // namespace
