// Signs that surfaces hide as a whole are told by the shadows of these, and only those.
#include "SignShadow.h"
#include "Contrast.h"
#include "Dice.h"
#include "SceneLibrary.h"
#include "Solved.h"

#include <cstdio>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

/// A room of 8 m x 4 m x 3 m with a sign of 0.6 m x 0.3 m on its high end.
SceneDescription RoomWithSign()
{
  SceneDescription scene;
  scene.Albedo = 0.5;
  scene.Grids = {scenes::UniformSmoke(Vec3(0.0), {8, 4, 3}, {16, 8, 6}, 0.2)};
  scenes::AddRoom(scene.Surfaces, Vec3(0.0), {8, 4, 3}, 1.0, 0.5);
  scene.Emitters =
    scenes::Barcode({7.99, 2.0, 2.0}, {-1, 0, 0}, {0, 0, 1}, 0.6, 0.3, 5, 50.0, 0, 0.1);
  return scene;
}

const Vec3 Eye{1.0, 2.1, 1.7};

bool InShadow(const SceneDescription& scene, const Vec3& eye = Eye)
{
  const Solved solved(scene, 0.1);
  const bool told = InShadowOfSurfaces(*solved.TheView, solved.TheScene->Lights().Signs()[0], eye);
  const View all(solved.TheScene, solved.Field, {.HiddenSigns = false});
  const SignMeasurement looked = MeasureSign(all, 0, eye, Observer{});
  EXPECT_FALSE(looked.InShadow);
  EXPECT_EQ(MeasureSign(*solved.TheView, 0, eye, Observer{}).Contrast, looked.Contrast);
  // What is told is so; whether all is told that could be is for each test.
  EXPECT_FALSE(told && looked.InView);
  return told;
}

/// A wall across the room between two places along its width, of cells of a size.
void AddWall(SceneDescription& scene, double x, double from, double to, int cells)
{
  scenes::AddRectangle(
    scene.Surfaces, {x, from, 0}, {0, to - from, 0}, {0, 0, 3}, cells, cells, 0.3);
}

TEST(SignShadow, WallsOfFewAndManyTriangles)
{
  EXPECT_FALSE(InShadow(RoomWithSign()));
  for (const int cells : {1, 4, 16})
  {
    SceneDescription scene = RoomWithSign();
    AddWall(scene, 4.0, 0.0, 4.0, cells);
    EXPECT_TRUE(InShadow(scene)) << cells;
  }
}

// Through 2 mm between two walls a 129th of the sign shows, but for what its looks at parts miss; a
// third wall behind the gap hides it again.
TEST(SignShadow, NarrowGap)
{
  SceneDescription scene = RoomWithSign();
  AddWall(scene, 4.0, 0.0, 2.0, 2);
  AddWall(scene, 4.0, 2.002, 4.0, 2);
  const Vec3 before{1.0, 2.001, 1.7};
  EXPECT_FALSE(InShadow(scene, before));
  AddWall(scene, 4.5, 1.9, 2.1, 1);
  EXPECT_TRUE(InShadow(scene, before));
}

// What is listed twice hides no more than once.
TEST(SignShadow, HalfOfItTwice)
{
  SceneDescription scene = RoomWithSign();
  AddWall(scene, 4.0, 0.0, 2.0, 2);
  AddWall(scene, 4.0, 0.0, 2.0, 2);
  AddWall(scene, 4.1, 0.0, 2.0, 1);
  EXPECT_FALSE(InShadow(scene));
}

// The wall that a sign is mounted on, or sunk into, lies behind it; one before it hides it.
TEST(SignShadow, WallsAtThePlate)
{
  for (const double off : {0.0, 1e-9, 1e-6, 1e-3})
  {
    SceneDescription scene = RoomWithSign();
    AddWall(scene, 7.99 + off, 0.0, 4.0, 3);
    EXPECT_FALSE(InShadow(scene)) << off;
  }
  SceneDescription scene = RoomWithSign();
  AddWall(scene, 7.9, 0.0, 4.0, 3);
  EXPECT_TRUE(InShadow(scene));
}

// Triangles at random: wherever a shadow is told, no look at a part of the sign finds it.
TEST(SignShadow, TrianglesAtRandom)
{
  Pcg32 random(7, 1);
  SceneDescription scene = RoomWithSign();
  SurfaceMesh& mesh = scene.Surfaces;
  const auto within = [&random](const Vec3& lower, const Vec3& upper)
  {
    const double x = random.Uniform();
    const double y = random.Uniform();
    return lower + Vec3(x, y, random.Uniform()) * (upper - lower);
  };
  for (int triangle = 0; triangle < 40; ++triangle)
  {
    const auto first = static_cast<std::uint32_t>(mesh.Points.size());
    const Vec3 middle = within({2.0, 0.0, 0.0}, {7.0, 4.0, 3.0});
    for (int corner = 0; corner < 3; ++corner)
    {
      mesh.Points.push_back(middle + within(Vec3(-0.8), Vec3(0.8)));
    }
    mesh.Triangles.push_back({first, first + 1, first + 2});
    mesh.TriangleCell.push_back(static_cast<std::uint32_t>(mesh.CellReflectance.size()));
    mesh.CellReflectance.emplace_back();
    mesh.CellReflectance.back().fill(0.3);
  }
  const Solved solved(scene, 0.1);
  const View all(solved.TheScene, solved.Field, {.HiddenSigns = false});
  int told = 0;
  int hidden = 0;
  constexpr int Eyes = 300;
  for (int i = 0; i < Eyes; ++i)
  {
    const Vec3 eye = within(Vec3(0.1), {1.1, 3.9, 2.9});
    const SignMeasurement looked = MeasureSign(all, 0, eye, Observer{});
    const SignMeasurement seen = MeasureSign(*solved.TheView, 0, eye, Observer{});
    EXPECT_EQ(seen.Contrast, looked.Contrast);
    EXPECT_EQ(seen.InView, looked.InView);
    told += seen.InShadow ? 1 : 0;
    hidden += looked.InView ? 0 : 1;
  }
  std::printf("of %d eyes the sign is hidden from %d, and this told of %d\n", Eyes, hidden, told);
  EXPECT_GT(hidden, Eyes / 10);
  EXPECT_LT(hidden, Eyes);
  EXPECT_GE(told, 9 * hidden / 10);
}

} // namespace
