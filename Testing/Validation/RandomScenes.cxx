#include "RandomScenes.h"

#include "Places.h"
#include "ReferenceIntegrator.h"
#include "SceneLibrary.h"

#include <algorithm>
#include <cmath>

namespace smokevis::scenes
{

namespace
{

/// Up to two lamps below the ceiling of a room, and an eye at its low end along x.
/// @param brightest of the lamps [cd/m2]
/// @param between(low, high) a random number between two bounds
template <class Between>
void AddLampsAndEye(RandomScene& room, const Vec3& upper, double brightest, const Between& between)
{
  const int lamps = static_cast<int>(between(0.0, 2.999));
  for (int lamp = 0; lamp < lamps; ++lamp)
  {
    room.Description.Emitters.push_back(
      Plate({between(0.5, upper.x - 0.5), between(0.5, upper.y - 0.5), upper.z - 0.1}, {0, 0, -1},
        {1, 0, 0}, 0.3, 0.3, between(2.0, brightest), 0.5));
  }
  room.Eye = {between(0.2, 0.6), between(0.5, upper.y - 0.5), between(1.5, 1.8)};
}

} // namespace

//--------------------------------------------------------------------------------------------------
RandomScene MakeRandomRoom(std::uint64_t seed)
{
  Pcg32 random(seed, 7);
  const auto between = [&](double low, double high)
  { return low + (high - low) * random.Uniform(); };
  RandomScene room;
  SceneDescription& scene = room.Description;
  const Vec3 upper(between(3.0, 5.0), between(2.0, 3.0), between(2.2, 2.8));
  scene.Albedo = between(0.2, 0.95);
  const double extinction = between(0.2, 1.2);
  scene.Grids.push_back(
    NoisySmoke(Vec3(0.0), upper, {20, 12, 12}, 0.2 * extinction, 1.8 * extinction, seed));
  AddRoom(scene.Surfaces, Vec3(0.0), upper, 0.25, between(0.05, 0.7));
  const Vec3 block(between(1.0, 2.0), between(0.2, 1.0), 0.0);
  AddBlock(
    scene.Surfaces, block, block + Vec3(0.6, 0.5, between(0.5, 1.2)), 0.25, between(0.05, 0.7));
  const Vec3 sign(upper.x, between(0.6, upper.y - 0.6), between(1.5, 2.0));
  scene.Emitters = Barcode(sign, {-1, 0, 0}, {0, 0, 1}, between(0.2, 0.5), between(0.15, 0.3),
    2 * static_cast<int>(between(1.0, 4.0)) + 1, 100.0, 0, between(0.0, 0.3));
  AddLampsAndEye(room, upper, 20.0, between);
  return room;
}

//--------------------------------------------------------------------------------------------------
RandomScene MakeRandomField(std::uint64_t seed)
{
  Pcg32 random(seed, 8);
  const auto between = [&](double low, double high)
  { return low + (high - low) * random.Uniform(); };
  RandomScene field;
  SceneDescription& scene = field.Description;
  const Vec3 upper(between(3.0, 6.0), between(2.0, 4.0), between(2.0, 3.0));
  scene.Albedo = between(0.0, 1.0);
  const double extinction = between(0.2, 1.2);
  SmokeGrid grid = UniformSmoke(Vec3(0.0), upper, {24, 16, 12}, extinction);
  if (seed % 2 == 0)
  {
    // Layers: thin smoke below, thicker and thicker above.
    const double thin = between(0.0, 0.3);
    for (std::size_t cell = 0; cell < grid.Extinction.size(); ++cell)
    {
      const auto layer = static_cast<double>(cell / (24 * 16));
      grid.Extinction[cell] =
        static_cast<float>(extinction * std::max(thin, std::min(1.0, 0.25 * (layer - 3.0))));
    }
  }
  scene.Grids.push_back(std::move(grid));
  // A floor, and a box that stands on it; the sides are open.
  AddRectangle(
    scene.Surfaces, Vec3(0.0), {upper.x, 0, 0}, {0, upper.y, 0}, 20, 12, between(0.05, 0.5));
  const Vec3 box(between(1.0, 2.0), between(0.2, 1.0), 0.0);
  AddBlock(scene.Surfaces, box, box + Vec3(0.5, 0.5, between(0.3, 1.0)), 0.2, between(0.05, 0.7));
  // The sign at the far end, then lamps: up to ten emitters in all.
  const Vec3 sign(upper.x - 0.2, between(0.6, upper.y - 0.6), between(1.2, 1.7));
  scene.Emitters = Barcode(sign, glm::normalize(Vec3(-1.0, between(-0.3, 0.3), 0.0)), {0, 0, 1},
    between(0.3, 0.6), between(0.2, 0.4), 2 * static_cast<int>(between(0.0, 4.0)) + 1, 100.0, 0);
  const int lamps = static_cast<int>(between(0.0, 9.999));
  for (int lamp = 0; lamp < lamps; ++lamp)
  {
    scene.Emitters.push_back(
      Plate({between(0.3, upper.x - 0.5), between(0.3, upper.y - 0.3), upper.z - 0.1}, {0, 0, -1},
        {1, 0, 0}, 0.3, 0.3, between(1.0, 10.0)));
  }
  field.Eye = {between(0.2, 0.6), between(0.5, upper.y - 0.5), between(1.3, 1.7)};
  return field;
}

//--------------------------------------------------------------------------------------------------
RandomScene MakeRandomClouds(std::uint64_t seed)
{
  Pcg32 random(seed, 9);
  const auto between = [&](double low, double high)
  { return low + (high - low) * random.Uniform(); };
  RandomScene room;
  SceneDescription& scene = room.Description;
  const Vec3 upper(between(4.0, 8.0), between(3.0, 5.0), between(2.4, 3.0));
  scene.Albedo = between(0.2, 0.95);
  const double edge = between(0.15, 0.3);
  std::array<int, 3> cells{};
  for (int axis = 0; axis < 3; ++axis)
  {
    cells[axis] = static_cast<int>(std::ceil(upper[axis] / edge));
  }
  SmokeGrid grid = UniformSmoke(Vec3(0.0), upper, cells, between(0.02, 0.2));
  const int clouds = 1 + static_cast<int>(between(0.0, 2.999));
  for (int cloud = 0; cloud < clouds; ++cloud)
  {
    const double extinction = between(0.5, 4.0);
    const bool round = random.Uniform() < 0.5;
    Vec3 middle;
    Vec3 half;
    for (int axis = 0; axis < 3; ++axis)
    {
      middle[axis] = between(0.2, 0.8) * upper[axis];
      half[axis] = between(0.4, 1.2);
    }
    std::size_t index = 0;
    ForEachPlace(cells,
      [&](const std::array<int, 3>& place)
      {
        const Vec3 at =
          (Vec3(place[0], place[1], place[2]) + 0.5) / Vec3(cells[0], cells[1], cells[2]) * upper;
        const Vec3 off = glm::abs(at - middle) / half;
        const double size = round ? glm::length(off) : std::max({off.x, off.y, off.z});
        if (size < 1.0)
        {
          grid.Extinction[index] = static_cast<float>(extinction);
        }
        ++index;
      });
  }
  scene.Grids.push_back(std::move(grid));
  AddRoom(scene.Surfaces, Vec3(0.0), upper, 0.4, between(0.05, 0.7));
  const Vec3 sign(upper.x - 0.01, between(0.6, upper.y - 0.6), between(1.5, 2.1));
  scene.Emitters = Barcode(sign, {-1, 0, 0}, {0, 0, 1}, between(0.2, 0.6), between(0.15, 0.3),
    2 * static_cast<int>(between(1.0, 4.999)) + 1, 100.0, 0, between(0.0, 0.3));
  AddLampsAndEye(room, upper, 50.0, between);
  return room;
}

} // namespace smokevis::scenes
