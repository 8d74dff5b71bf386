// Shafts: what is told of all lines between a plate and a box at once.
#include "Geometry.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <random>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

void AddTriangle(SurfaceMesh& mesh, const Triangle& corners)
{
  const auto first = static_cast<std::uint32_t>(mesh.Points.size());
  mesh.Points.insert(mesh.Points.end(), corners.begin(), corners.end());
  mesh.Triangles.push_back({first, first + 1, first + 2});
  mesh.TriangleCell.push_back(static_cast<std::uint32_t>(mesh.CellReflectance.size()));
  mesh.CellReflectance.push_back({0.5, 0.5, 0.5});
}

/// A lamp of 1 m under a ceiling at 3 m, and a box of half a metre below it.
Shaft Below()
{
  return {{Vec3(0.0, 0.0, 3.0), Vec3(0.0, 1.0, 3.0), Vec3(1.0, 1.0, 3.0), Vec3(1.0, 0.0, 3.0)},
    {0.0, 0.0, -1.0}, {Vec3(2.0, 0.0, 1.0), Vec3(2.5, 0.5, 1.5)}};
}

/// A ceiling, a wall behind the box, and a table under it.
SurfaceMesh Room()
{
  SurfaceMesh mesh;
  AddTriangle(mesh, {Vec3(-9.0, -9.0, 3.0), Vec3(9.0, -9.0, 3.0), Vec3(0.0, 9.0, 3.0)});
  AddTriangle(mesh, {Vec3(2.6, -9.0, -9.0), Vec3(2.6, 9.0, -9.0), Vec3(2.6, 0.0, 9.0)});
  AddTriangle(mesh, {Vec3(-9.0, -9.0, 0.9), Vec3(9.0, -9.0, 0.9), Vec3(0.0, 9.0, 0.9)});
  return mesh;
}

} // namespace

TEST(GeometryShafts, WhatLiesBesideAShaftLeavesItFree)
{
  const Geometry shapes(Room(), {});
  EXPECT_TRUE(shapes.Free(Below()));
  EXPECT_TRUE(Geometry().Free(Below()));
}

TEST(GeometryShafts, ItsOwnPlateLeavesItFree)
{
  const Shaft shaft = Below();
  SurfaceMesh plate;
  AddTriangle(plate, {shaft.Plate[0], shaft.Plate[1], shaft.Plate[2]});
  AddTriangle(plate, {shaft.Plate[0], shaft.Plate[2], shaft.Plate[3]});
  Geometry shapes(Room(), plate);
  EXPECT_TRUE(shapes.Free(shaft));
  // A post that stands on the plate, and reaches half a metre down.
  AddTriangle(plate, {Vec3(0.5, 0.5, 3.0), Vec3(0.6, 0.5, 3.0), Vec3(0.5, 0.5, 2.5)});
  shapes = Geometry(Room(), plate);
  const Geometry copy = shapes;
  shapes = Geometry();
  EXPECT_FALSE(copy.Free(shaft));
  EXPECT_TRUE(shapes.Free(shaft));
}

TEST(GeometryShafts, WhatLiesInAShaftIsMet)
{
  SurfaceMesh mesh = Room();
  // No wider than a hand.
  AddTriangle(mesh, {Vec3(1.4, 0.4, 2.1), Vec3(1.5, 0.4, 2.1), Vec3(1.4, 0.5, 2.2)});
  EXPECT_FALSE(Geometry(mesh, {}).Free(Below()));
  // A plate hides as a surface does.
  SurfaceMesh plates;
  AddTriangle(plates, {Vec3(1.4, 0.4, 2.1), Vec3(1.5, 0.4, 2.1), Vec3(1.4, 0.5, 2.2)});
  EXPECT_FALSE(Geometry(Room(), plates).Free(Below()));
}

TEST(GeometryShafts, ABoxThatThePlatesPlaneMeetsIsNot)
{
  Shaft shaft = Below();
  shaft.Before.Upper.z = 3.1;
  EXPECT_FALSE(Geometry(Room(), {}).Free(shaft));
}

// What lies before the plane of a box that it cuts is free of what the rest of the box holds.
TEST(GeometryShafts, APartOfABoxIsAllThatCounts)
{
  Shaft shaft = Below();
  shaft.Before.Lower.z = 0.5;
  EXPECT_FALSE(Geometry(Room(), {}).Free(shaft)) << "the table";
  shaft.Before.Upper.z = 3.1;
  shaft.Part = {{2.0, 0.0, 1.0}, {2.5, 0.0, 1.0}, {2.5, 0.5, 1.0}, {2.0, 0.0, 2.9}};
  EXPECT_TRUE(Geometry(Room(), {}).Free(shaft));
  shaft.Part.push_back({2.0, 0.5, 0.8});
  EXPECT_FALSE(Geometry(Room(), {}).Free(shaft));
}

TEST(GeometryShafts, ManyTrianglesNearAShaftAreNotAllLookedAt)
{
  SurfaceMesh mesh;
  for (int i = 0; i < 2000; ++i)
  {
    const double x = 1e-3 * i;
    AddTriangle(mesh, {Vec3(x, 0.0, 0.9), Vec3(x, 0.4, 0.9), Vec3(x, 0.2, 0.8)});
  }
  EXPECT_FALSE(Geometry(mesh, {}).Free(Below()));
}

/// Free shafts hold no line that is not clear, among random triangles; and many are free.
TEST(GeometryShafts, AllLinesOfFreeOnesAreClear)
{
  std::mt19937 random(20);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const auto place = [&] { return Vec3(share(random), share(random), share(random)); };
  int free = 0;
  constexpr int Scenes = 400;
  for (int scene = 0; scene < Scenes; ++scene)
  {
    SurfaceMesh mesh;
    for (int triangle = 0; triangle < 5; ++triangle)
    {
      const Vec3 corner = 4.0 * place();
      AddTriangle(mesh, {corner, corner + 2.0 * place() - 1.0, corner + 2.0 * place() - 1.0});
    }
    const Geometry shapes(mesh, {});
    const Vec3 along = glm::normalize(place() - 0.5);
    const Vec3 normal = glm::normalize(glm::cross(along, place() - 0.5));
    const Vec3 up = 0.5 * glm::cross(normal, along);
    const Vec3 corner = 1.0 + 2.0 * place();
    Shaft shaft{{corner, corner + along, corner + along + up, corner + up}, normal, {}};
    shaft.Before.Lower = corner + 2.0 * normal + place();
    shaft.Before.Upper = shaft.Before.Lower + 0.5 * place();
    if (!shapes.Free(shaft))
    {
      continue;
    }
    ++free;
    for (int line = 0; line < 100; ++line)
    {
      const Vec3 from = shaft.Before.Lower + place() * shaft.Before.Size();
      const Vec3 to = corner + share(random) * along + share(random) * up;
      EXPECT_TRUE(shapes.Visible(from, to)) << scene;
    }
  }
  EXPECT_GT(free, Scenes / 3);
  EXPECT_LT(free, Scenes);
}

/// From a place far off to a sign in a hall whose floor and ceiling are many triangles, of which
/// few are near to the lines.
TEST(GeometryShafts, LongOnesAreFreeBetweenFinelyDividedFloors)
{
  SurfaceMesh mesh;
  for (int i = 0; i < 80; ++i)
  {
    for (int j = 0; j < 40; ++j)
    {
      const double x = 0.5 * i;
      const double y = 0.5 * j - 10.0;
      AddTriangle(mesh, {Vec3(x, y, 0.0), Vec3(x + 0.5, y, 0.0), Vec3(x, y + 0.5, 0.0)});
      AddTriangle(mesh, {Vec3(x, y, 5.0), Vec3(x + 0.5, y, 5.0), Vec3(x, y + 0.5, 5.0)});
    }
  }
  const Vec3 eye(1.0, -8.0, 1.7);
  const Shaft shaft{
    {Vec3(39.0, 0.0, 2.0), Vec3(39.0, 1.0, 2.0), Vec3(39.0, 1.0, 2.5), Vec3(39.0, 0.0, 2.5)},
    {-1.0, 0.0, 0.0}, {eye, eye}};
  EXPECT_TRUE(Geometry(mesh, {}).Free(shaft));
}

/// Specks anywhere between the corners of shafts of all lengths, from points and from boxes.
TEST(GeometryShafts, ASpeckAnywhereInOneIsMet)
{
  std::mt19937 random(21);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const auto place = [&] { return Vec3(share(random), share(random), share(random)); };
  for (int scene = 0; scene < 2000; ++scene)
  {
    const Vec3 along = glm::normalize(place() - 0.5);
    const Vec3 normal = glm::normalize(glm::cross(along, place() - 0.5));
    const Vec3 up = 0.3 * glm::cross(normal, along);
    const Vec3 corner = place();
    Shaft shaft{{corner, corner + along, corner + along + up, corner + up}, normal, {}};
    const double distance = std::exp(6.0 * share(random));
    shaft.Before.Lower = corner + distance * (normal + share(random) * along) + 1.0;
    shaft.Before.Upper =
      shaft.Before.Lower + (scene % 2 == 0 ? 0.0 : 3.0 * share(random)) * place();
    const Vec3 from = shaft.Before.Lower + place() * shaft.Before.Size();
    const Vec3 to = corner + share(random) * along + share(random) * up;
    const Vec3 speck = glm::mix(to, from, 0.01 + 0.98 * share(random));
    SurfaceMesh mesh;
    AddTriangle(mesh, {speck, speck + 1e-3 * (place() - 0.5), speck + 1e-3 * (place() - 0.5)});
    EXPECT_FALSE(Geometry(mesh, {}).Free(shaft)) << scene << ", " << distance << " m";
  }
}
