// The scenes that tests are about, and the pieces they are put together from.
#pragma once

#include "Scene.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace smokevis::scenes
{

/// Adds a plane rectangle of nu x nv cells (two triangles each); its front is the side of
/// cross(edgeU, edgeV). Returns the index of its first cell; cells follow with u fastest.
std::size_t AddRectangle(SurfaceMesh& mesh, const Vec3& corner, const Vec3& edgeU,
  const Vec3& edgeV, int nu, int nv, double reflectance);

/// Adds the six walls of a box, fronts inwards, in cells no larger than a patch size. The walls
/// follow each other as low x, high x, low y, high y, low z, high z.
void AddRoom(
  SurfaceMesh& mesh, const Vec3& lower, const Vec3& upper, double patchSize, double reflectance);

/// Adds the six faces of a solid box, fronts outwards.
void AddBlock(
  SurfaceMesh& mesh, const Vec3& lower, const Vec3& upper, double patchSize, double reflectance);

/// Evenly spaced numbers, both ends included.
std::vector<double> Linear(double first, double last, int intervals);

SmokeGrid UniformSmoke(
  const Vec3& lower, const Vec3& upper, const std::array<int, 3>& cells, double extinction);

/// Extinction uniformly random between two bounds in each cell.
SmokeGrid NoisySmoke(const Vec3& lower, const Vec3& upper, const std::array<int, 3>& cells,
  double low, double high, std::uint64_t seed);

/// Lets cells of an even grid glow, with an extinction of 2 /m: two by two along x and y from one
/// on, of the four lowest layers.
/// @param first cell along x and y
void AddFlame(SmokeGrid& grid, const std::array<int, 2>& first, double luminance);

/// The parts of a grid on the low and high side of one of its nodes.
std::pair<SmokeGrid, SmokeGrid> Split(const SmokeGrid& grid, int axis, int node);

/// A rectangle that emits towards its normal.
EmitterCell Plate(const Vec3& centre, const Vec3& normal, const Vec3& up, double width,
  double height, double luminance, double reflectance = 0.0, int signId = -1);

/// A corridor of 60 x 4 x 4 m full of smoke, with lamps of one strength along its ceiling.
SceneDescription Corridor(
  double extinction, int lamps = 15, double albedo = 0.5, double reflectance = 0.0);

/// A corridor of 30 x 2.4 x 2.7 m with a layer of 1 /m above 1.98 m and 0.1 /m below, lit by
/// nothing but a sign at its end.
/// @param height of the sign's centre [m]
/// @param reflectance of the walls; of the sign half of that
SceneDescription LayeredCorridor(double height, double albedo, double reflectance);

/// Two rooms with a door between them, 6 m x 3 m x 2.5 m in all: in one a flame, in the other a
/// sign that it lights through the door.
SceneDescription FlameBehindADoor();

/// A sign of vertical stripes of equal width, every other one lit, beginning with a lit one.
std::vector<EmitterCell> Barcode(const Vec3& centre, const Vec3& normal, const Vec3& up,
  double width, double height, int bars, double luminance, int signId, double reflectance = 0.0);

/// A rectangle of nu x nv emitting cells that are one sign; its front is the side of
/// cross(edgeU, edgeV).
std::vector<EmitterCell> EmittingRectangle(const Vec3& corner, const Vec3& edgeU, const Vec3& edgeV,
  int nu, int nv, double luminance, double reflectance, int signId = 0);

/// The six walls of a box as emitters that face inwards, n x n cells each, a sign a wall.
std::vector<EmitterCell> EmittingRoom(
  const Vec3& lower, const Vec3& upper, int n, double luminance, double reflectance);

/// Triangles of an icosahedron whose faces were cut in four so many times, around a centre. The
/// corners lie outside the given radius such that the mean chord, 4 volume / surface, is the
/// sphere's.
std::vector<EmitterCell> EmittingSphere(
  const Vec3& centre, double radius, int cuts, bool inwards, double luminance, double reflectance);

/// The tunnel: a closed box of 4 x 1 x 1 m with walls of reflectance 0.2, uniform smoke in
/// 40 x 10 x 10 cells and a sign of nine stripes (five lit, luminance 1) 0.3 m square on the end
/// wall.
SceneDescription Tunnel(double extinction, double albedo);
/// Where the observer of the tunnel stands.
inline const Vec3 TunnelEye{0.001, 0.5, 0.5};
/// A lamp of 0.2 x 0.2 m and luminance 1 under the tunnel's ceiling.
EmitterCell TunnelLamp(double x);

/// A closed room with heterogeneous smoke, a block, a hanging lamp and a sign mounted on a wall.
/// The lamp is the last emitter.
SceneDescription FurnishedRoom(double albedo, double extinction);

/// A slab between z = 0 (emitting black wall of luminance 1/pi, so that the incident illuminance is
/// 1) and z = 1 (black patches), open at its sides, and so wide that these do not matter in the
/// middle.
struct Slab
{
  SceneDescription Description;
  /// Layers of cells between the walls.
  int Layers;
  /// Cells of each layer that lie in the middle: [layer][...].
  std::vector<std::vector<std::int64_t>> MiddleCells;
  /// Patches in the middle of the black wall and of the emitting wall.
  std::vector<std::size_t> FarPatches, NearPatches;
};
Slab MakeSlab(double opticalDepth, double albedo, int layers);

/// Multiplies all lengths by a factor and divides extinctions by it.
SceneDescription Scaled(SceneDescription description, double factor);
/// Moves everything.
SceneDescription Moved(SceneDescription description, const Vec3& offset);
/// Turns surfaces and emitters; the grids stay.
SceneDescription Turned(SceneDescription description, const glm::dmat3& turn);
glm::dmat3 Rotation(double degrees, const Vec3& axis);

} // namespace smokevis::scenes
