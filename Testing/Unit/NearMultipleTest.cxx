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

/// Veils of multiply scattered light over the last cell before each of a sign's first bars, in all
/// [cd/m2].
/// @param reach length of that cell along the rays [m]
double LastVeils(const scenes::RandomScene& room, int bars, double reach)
{
  const Solved solved(room.Description, 0.03);
  double sum = 0.0;
  for (int bar = 0; bar < bars; ++bar)
  {
    const Vec3 way = solved.TheScene->Lights().CellCentre(bar) - room.Eye;
    const double length = glm::length(way);
    sum += Mean(
      solved.TheView->TraceVeil(room.Eye, way / length, length - reach, length, 0).VeilMultiple);
  }
  return sum;
}

// From the means of neighbouring cells a quarter of it would be missing. Noise of the light in the
// cell is 4 %, and as much is left that does not vary linearly there.
TEST(NearMultiple, VeilRightBeforeABar)
{
  constexpr double Reach = 0.184;
  scenes::RandomScene room = scenes::MakeRandomRoom(21);
  const double coarse = LastVeils(room, 1, Reach);
  room.Description.Grids[0] = InParts(room.Description.Grids[0], 2);
  EXPECT_NEAR(coarse / LastVeils(room, 1, Reach), 1.0, 0.12);
}

// Half of such a cell lies before the sign, along its faces or askew, and bars are narrower than
// it. Taken from places in all of the cell, a quarter of the light would be missing.
TEST(NearMultiple, VeilInACellThatASignCuts)
{
  constexpr double Reach = 0.25;
  const Vec3 size(4.0, 3.0, 3.0);
  for (const double turned : {0.0, 20.0})
  {
    scenes::RandomScene room;
    room.Eye = {0.5, 1.5, 1.6};
    room.Description.Albedo = 0.9;
    room.Description.Grids = {scenes::UniformSmoke(Vec3(0.0), size, {8, 6, 6}, 0.8)};
    scenes::AddRoom(room.Description.Surfaces, Vec3(0.0), size, 0.5, 0.2);
    const Vec3 normal = scenes::Rotation(turned, {0, 0, 1}) * Vec3(-1.0, 0.0, 0.0);
    room.Description.Emitters =
      scenes::Barcode({3.25, 1.7, 1.8}, normal, {0, 0, 1}, 0.4, 0.3, 3, 100.0, 0);
    const double coarse = LastVeils(room, 3, Reach);
    room.Description.Grids[0] = InParts(room.Description.Grids[0], 4);
    EXPECT_NEAR(coarse / LastVeils(room, 3, Reach), 1.0, 0.12) << "turned by " << turned;
  }
}

} // namespace
