// Two rooms, drawn at random, with what a fire makes of them.
#include "RandomScenes.h"

#include "Dice.h"
#include "Places.h"
#include "SceneLibrary.h"

#include <algorithm>
#include <cmath>

namespace smokevis::scenes
{

namespace
{

/// The rooms lie one behind the other along x, with a wall of one cell between them.
struct Plan
{
  double Edge;
  Vec3 Upper;
  /// Where the wall begins and ends, and the door in it.
  double WallBegin, WallEnd, DoorLow, DoorHigh, DoorTop;
  double Patch;
};

Plan DrawPlan(Dice& dice)
{
  Plan plan;
  plan.Edge = dice.Between(0.2, 0.35);
  const auto cells = [&](double low, double high)
  { return std::floor(dice.Between(low, high) / plan.Edge) * plan.Edge; };
  plan.WallBegin = cells(3.0, 6.0);
  plan.WallEnd = plan.WallBegin + plan.Edge;
  plan.Upper = Vec3{plan.WallEnd + cells(2.0, 5.0), cells(2.5, 4.5), cells(2.4, 3.2)};
  plan.DoorLow = plan.Edge * std::ceil(dice.Between(0.1, 0.5) * plan.Upper.y / plan.Edge);
  plan.DoorHigh = std::min(plan.DoorLow + cells(0.8, 1.2), plan.Upper.y - plan.Edge);
  plan.DoorTop = std::min(cells(1.9, 2.2), plan.Upper.z - plan.Edge);
  plan.Patch = glm::length(plan.Upper) / 50.0;
  return plan;
}

/// A layer of smoke below the ceiling of each room, thinner in the second one, that fades out
/// below; in the first one a flame, perhaps.
SmokeGrid DrawSmoke(Dice& dice, const Plan& plan)
{
  std::array<int, 3> cells{};
  for (int axis = 0; axis < 3; ++axis)
  {
    cells[axis] = static_cast<int>(std::lround(plan.Upper[axis] / plan.Edge));
  }
  SmokeGrid grid = UniformSmoke(Vec3(0.0), plan.Upper, cells, 0.0);
  grid.EmittedLuminance.assign(grid.Extinction.size(), 0.0F);
  const std::array<double, 2> height = {dice.Between(0.8, 2.2), dice.Between(1.2, 2.4)};
  const double thickest = dice.Magnitude(0.1, 2.0);
  const std::array<double, 2> extinction = {thickest, thickest * dice.Between(0.1, 1.0)};
  const double fade = dice.Between(0.05, 0.8);
  const double below = dice.Between(0.0, 0.2);
  const double noise = dice.Between(0.0, 0.5);
  const bool burns = dice.Chance(0.6);
  const Vec3 fire{dice.Between(0.8, plan.WallBegin - 0.8), dice.Between(0.8, plan.Upper.y - 0.8),
    dice.Between(0.6, 1.5)};
  const double radius = dice.Between(0.25, 0.5);
  const double soot = dice.Between(1.0, 2.0);
  const auto luminance = static_cast<float>(dice.Magnitude(100.0, 3000.0));
  std::size_t index = 0;
  ForEachPlace(cells,
    [&](const std::array<int, 3>& place)
    {
      const Vec3 at = plan.Edge * (Vec3(place[0], place[1], place[2]) + 0.5);
      const int room = at.x < plan.WallBegin ? 0 : 1;
      const double share =
        below + (1.0 - below) * 0.5 * (1.0 + std::tanh((at.z - height[room]) / fade));
      double own = extinction[room] * share * (1.0 + noise * dice.Between(-1.0, 1.0));
      const bool inFire =
        burns && at.z < fire.z && std::hypot(at.x - fire.x, at.y - fire.y) < radius;
      own += inFire ? soot : 0.0;
      const bool inDoor = at.y > plan.DoorLow && at.y < plan.DoorHigh && at.z < plan.DoorTop;
      const bool solid = at.x > plan.WallBegin && at.x < plan.WallEnd && !inDoor;
      grid.Extinction[index] = solid ? 0.0F : static_cast<float>(own);
      grid.EmittedLuminance[index] = inFire ? luminance : 0.0F;
      ++index;
    });
  return grid;
}

/// The walls around both rooms, that at the low end along x with a window, perhaps, and the one
/// between them.
void AddWalls(Dice& dice, const Plan& plan, SceneDescription& scene)
{
  SurfaceMesh& mesh = scene.Surfaces;
  const double reflectance = dice.Between(0.1, 0.75);
  const auto add = [&](const Vec3& corner, const Vec3& edgeU, const Vec3& edgeV)
  {
    const auto pieces = [&](const Vec3& edge)
    { return std::max(1, static_cast<int>(std::ceil(glm::length(edge) / plan.Patch))); };
    AddRectangle(mesh, corner, edgeU, edgeV, pieces(edgeU), pieces(edgeV), reflectance);
  };
  const Vec3 x(plan.Upper.x, 0, 0);
  const Vec3 y(0, plan.Upper.y, 0);
  const Vec3 z(0, 0, plan.Upper.z);
  add(x, z, y);
  add({0, 0, 0}, z, x);
  add(y, x, z);
  add({0, 0, 0}, x, y);
  add(z, y, x);
  if (dice.Chance(0.4))
  {
    scene.Sky = dice.Magnitude(1.0, 1000.0);
    add({0, 0, 0}, y, 0.3 * z);
    add(0.7 * z, y, 0.3 * z);
    add(0.3 * z, 0.35 * y, 0.4 * z);
    add(0.3 * z + 0.65 * y, 0.35 * y, 0.4 * z);
  }
  else
  {
    add({0, 0, 0}, y, z);
  }
  const auto block = [&](double lowY, double highY, double lowZ)
  {
    AddBlock(mesh, {plan.WallBegin, lowY, lowZ}, {plan.WallEnd, highY, plan.Upper.z}, plan.Patch,
      reflectance);
  };
  block(0.0, plan.DoorLow, 0.0);
  block(plan.DoorHigh, plan.Upper.y, 0.0);
  block(plan.DoorLow, plan.DoorHigh, plan.DoorTop);
  for (int left = dice.Count(0, 3); left > 0; --left)
  {
    // Lower than any line from the eye to the sign.
    const Vec3 corner{
      dice.Between(0.3, plan.WallBegin - 1.3), dice.Between(0.2, plan.Upper.y - 0.9), 0.0};
    const Vec3 size{dice.Between(0.3, 0.9), 0.5, dice.Between(0.4, 1.2)};
    const double own = dice.Between(0.05, 0.7);
    AddBlock(mesh, corner, corner + size, plan.Patch, own);
  }
}

} // namespace

//--------------------------------------------------------------------------------------------------
RandomScene MakeRandomBuilding(std::uint64_t seed)
{
  Dice dice(seed, 21);
  RandomScene building;
  SceneDescription& scene = building.Description;
  const Plan plan = DrawPlan(dice);
  scene.Albedo = dice.Between(0.2, 0.9);
  scene.Grids.push_back(DrawSmoke(dice, plan));
  AddWalls(dice, plan, scene);
  const Vec3 sign{plan.Upper.x - 0.02, dice.Between(0.5, plan.Upper.y - 0.5),
    dice.Between(1.5, std::min(2.4, plan.Upper.z - 0.3))};
  const double width = dice.Between(0.3, 0.6);
  const double height = dice.Between(0.15, 0.3);
  const int bars = 2 * (1 + dice.Count(0, 3)) + 1;
  const double luminance = dice.Magnitude(5.0, 300.0);
  const double reflectance = dice.Between(0.0, 0.3);
  scene.Emitters =
    Barcode(sign, {-1, 0, 0}, {0, 0, 1}, width, height, bars, luminance, 0, reflectance);
  const double lamps = dice.Magnitude(1.0, 1000.0);
  for (int left = dice.Count(0, 2); left > 0; --left)
  {
    const bool first = dice.Chance(0.5);
    const Vec3 place{first ? dice.Between(0.6, plan.WallBegin - 0.6)
                           : dice.Between(plan.WallEnd + 0.6, plan.Upper.x - 0.6),
      dice.Between(0.6, plan.Upper.y - 0.6), plan.Upper.z - dice.Between(0.02, 0.3)};
    scene.Emitters.push_back(Plate(place, {0, 0, -1}, {1, 0, 0}, 0.6, 0.6, lamps, 0.5));
  }
  building.Eye = {plan.WallEnd + dice.Between(0.1, 0.8), dice.Between(0.4, plan.Upper.y - 0.4),
    dice.Between(1.5, 1.8)};
  return building;
}

} // namespace smokevis::scenes
