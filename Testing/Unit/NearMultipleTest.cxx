// Twice scattered light right before a sign, in cells as large as its bars, against finer cells.
#include "GridRefinement.h"
#include "RandomScenes.h"
#include "SceneLibrary.h"
#include "Solved.h"

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

/// The same smoke in cells cut in so many along each axis.
SmokeGrid InParts(const SmokeGrid& grid, int parts)
{
  GridRefinement refinement;
  for (int axis = 0; axis < 3; ++axis)
  {
    refinement.Parts[axis].assign(grid.Nodes[axis].size() - 1, parts);
  }
  return Refined(grid, refinement);
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
  room.Description.Grids[0] = InParts(room.Description.Grids[0], 2);
  EXPECT_NEAR(coarse / LastVeil(room, Reach), 1.0, 0.12);
}

} // namespace
