// Broken and awkward shapes: duplicate, flat, sliver and inside-out triangles, plates in and half
// inside walls, meshes that overlap or nest.
#include "Errors.h"
#include "RandomScenes.h"
#include "StressScenes.h"
#include "TestReport.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

/// A small furnished room that is quick to solve.
SceneDescription Room()
{
  SceneDescription scene;
  scene.Albedo = 0.7;
  const Vec3 upper(3, 2, 2);
  scene.Grids = {scenes::UniformSmoke(Vec3(0.0), upper, {15, 10, 10}, 0.5)};
  scenes::AddRoom(scene.Surfaces, Vec3(0.0), upper, 0.5, 0.5);
  scene.Emitters =
    scenes::Barcode({3, 1.1, 1.2}, {-1, 0, 0}, {0, 0, 1}, 0.6, 0.3, 5, 100.0, 0, 0.1);
  scene.Emitters.push_back(
    scenes::Plate({1, 0.7, 1.9}, {0, 0, -1}, {1, 0, 0}, 0.3, 0.3, 20.0, 0.5));
  return scene;
}

const Vec3 RoomEye{0.2, 0.9, 1.1};

const SignMeasurement& PlainSign()
{
  static const SignMeasurement sign =
    MeasureSign(*Solved(Room()).TheView, 0, RoomEye, Observer{0.0});
  return sign;
}

/// Expects a scene to be solved and its sign to look as in the plain room: 1 % of luminance and
/// 0.005 of contrast, the project's promise, for other random numbers are drawn.
void ExpectPlain(const std::string& name, const SceneDescription& scene)
{
  SCOPED_TRACE(name);
  const Solved solved(scene);
  stress::ExpectSaneField(solved);
  const SignMeasurement sign = MeasureSign(*solved.TheView, 0, RoomEye, Observer{0.0});
  stress::ExpectSaneSign(sign);
  report::Relative(name + ", lit", PlainSign().LitLuminance, sign.LitLuminance, 0.01,
    std::hypot(PlainSign().MeanLuminanceError, sign.MeanLuminanceError));
  report::Relative(name + ", unlit", PlainSign().UnlitLuminance, sign.UnlitLuminance, 0.01,
    std::hypot(PlainSign().MeanLuminanceError, sign.MeanLuminanceError));
  report::Absolute(name + ", contrast", PlainSign().Contrast, sign.Contrast, 0.005,
    std::hypot(PlainSign().ContrastError, sign.ContrastError));
}

TEST(DegenerateShapes, TrianglesThatChangeNothing)
{
  report::Head("Triangles that change nothing");
  SceneDescription twice = Room();
  SurfaceMesh& mesh = twice.Surfaces;
  const std::size_t count = mesh.Triangles.size();
  for (std::size_t i = 0; i < count; ++i)
  {
    mesh.Triangles.push_back(mesh.Triangles[i]);
    mesh.TriangleCell.push_back(mesh.TriangleCell[i]);
  }
  ExpectPlain("every triangle twice", twice);

  SceneDescription turned = Room();
  for (std::size_t i = 0; i < turned.Surfaces.Triangles.size(); ++i)
  {
    if (turned.Surfaces.TriangleCell[i] % 2 == 0)
    {
      std::swap(turned.Surfaces.Triangles[i][0], turned.Surfaces.Triangles[i][1]);
    }
  }
  // Both sides of a surface reflect: which one is the front does not matter.
  ExpectPlain("every other cell inside out", turned);

  SceneDescription slivers = Room();
  for (const double width : {0.0, 1e-30, 1e-12, 1e-7})
  {
    const auto first = static_cast<std::uint32_t>(slivers.Surfaces.Points.size());
    slivers.Surfaces.Points.insert(
      slivers.Surfaces.Points.end(), {{0.0, 0.4, 0.0}, {3.0, 0.4, 0.0}, {3.0, 0.4 + width, 0.0},
                                       {0.0, 2.0, 0.3}, {3.0, 2.0, 1.7}, {1.5, 2.0, 1.0 + width}});
    slivers.Surfaces.Triangles.push_back({first, first + 1, first + 2});
    slivers.Surfaces.Triangles.push_back({first + 3, first + 4, first + 5});
    slivers.Surfaces.TriangleCell.insert(slivers.Surfaces.TriangleCell.end(), 2, 0);
  }
  ExpectPlain("slivers on floor and wall", slivers);
}

// The other way round of every triangle, and a shell of the same triangles both ways.
TEST(DegenerateShapes, SurfacesWithFrontsBothWays)
{
  report::Head("Surfaces with fronts both ways");
  SceneDescription scene = Room();
  SurfaceMesh& mesh = scene.Surfaces;
  const std::size_t count = mesh.Triangles.size();
  for (std::size_t i = 0; i < count; ++i)
  {
    const auto triangle = mesh.Triangles[i];
    mesh.Triangles.push_back({triangle[0], triangle[2], triangle[1]});
    mesh.TriangleCell.push_back(static_cast<std::uint32_t>(mesh.CellReflectance.size()));
    mesh.CellReflectance.push_back({0.5, 0.5, 0.5});
  }
  ExpectPlain("every wall once each way", scene);
}

// Triangles of 1e-3 of a micrometre that hang in the room do no harm.
TEST(DegenerateShapes, DustOfTriangles)
{
  report::Head("Dust");
  SceneDescription scene = Room();
  Pcg32 random(1, 1);
  const auto cell = static_cast<std::uint32_t>(scene.Surfaces.CellReflectance.size());
  scene.Surfaces.CellReflectance.push_back({0.5, 0.5, 0.5});
  for (int i = 0; i < 200; ++i)
  {
    const auto first = static_cast<std::uint32_t>(scene.Surfaces.Points.size());
    const Vec3 at(0.5 + 2.0 * random.Uniform(), 0.5 + random.Uniform(), 0.5 + random.Uniform());
    scene.Surfaces.Points.insert(
      scene.Surfaces.Points.end(), {at, at + Vec3(1e-9, 0, 0), at + Vec3(0, 1e-9, 1e-9)});
    scene.Surfaces.Triangles.push_back({first, first + 1, first + 2});
    scene.Surfaces.TriangleCell.push_back(cell);
  }
  ExpectPlain("200 specks", scene);
}

// A sign in the plane of its wall, in front by a hair, behind by a hair.
TEST(DegenerateShapes, SignInThePlaneOfItsWall)
{
  report::Head("Sign in the plane of its wall");
  for (const double offset : {-1e-6, -1e-12, 1e-12, 1e-6})
  {
    SceneDescription scene = Room();
    for (std::size_t cell = 0; cell < 5; ++cell)
    {
      for (Vec3& vertex : scene.Emitters[cell].Vertices)
      {
        vertex.x -= offset;
      }
    }
    ExpectPlain(std::to_string(1e6 * offset) + " um", scene);
  }
}

// A hollow block in dense white smoke, whose light diffusion completes: it is dark inside,
// whichever way the copy of one of its triangles faces.
TEST(DegenerateShapes, HollowBlockWithATwinTriangle)
{
  SceneDescription scene = Room();
  scene.Albedo = 0.99;
  scene.Grids = {scenes::UniformSmoke(Vec3(0.0), {3, 2, 2}, {6, 4, 4}, 10.0)};
  scenes::AddBlock(scene.Surfaces, {1.3, 0.8, 0.6}, {1.7, 1.2, 0.9}, 1.0, 0.98);
  scene.Surfaces.Triangles.push_back(scene.Surfaces.Triangles.back());
  std::swap(scene.Surfaces.Triangles.back()[0], scene.Surfaces.Triangles.back()[1]);
  scene.Surfaces.TriangleCell.push_back(scene.Surfaces.TriangleCell.back());
  const Solved solved(scene, 0.03);
  EXPECT_GT(WorkCount(solved.Field->Report, "blocks of diffusion"), 0.0);
  const double outside = solved.Fluence(Vec3(1.2, 1.0, 0.7)).Mean;
  for (const Vec3 inside : {Vec3(1.4, 0.9, 0.7), {1.6, 1.1, 0.8}})
  {
    const Estimate fluence = solved.Fluence(inside);
    // Rounding lets a hundred-thousandth through its edges.
    EXPECT_LT(std::abs(fluence.Mean), 1e-3 * outside);
    EXPECT_LT(fluence.StandardError, 1e-3 * outside);
  }
}

// The lower half of the sign is hidden in a block: half shows, and of that the contrast.
TEST(DegenerateShapes, SignHalfInsideABlock)
{
  report::Head("Sign half inside a block");
  SceneDescription scene = Room();
  scenes::AddBlock(scene.Surfaces, {2.8, 0.5, 0.5}, {3.0, 1.7, 1.2}, 0.3, 0.5);
  const Solved solved(scene);
  stress::ExpectSaneField(solved);
  const SignMeasurement sign = MeasureSign(*solved.TheView, 0, {0.2, 1.1, 1.3}, Observer{0.0});
  stress::ExpectSaneSign(sign);
  // The eye looks down on the block's upper edge: by similar triangles, 0.2 m of 2.8 m behind the
  // edge, the view ends 0.0077 m below it.
  report::Absolute("visible fraction", 0.5, sign.VisibleFraction, 0.03);
  EXPECT_GT(sign.Contrast, 0.5);
}

// A sign that goes through a wall askew: what is on this side shows.
TEST(DegenerateShapes, SignThroughAWall)
{
  SceneDescription scene = Room();
  scene.Emitters = scenes::Barcode(
    {3, 1.0, 1.2}, glm::normalize(Vec3(-1, 1, 0)), {0, 0, 1}, 0.6, 0.3, 5, 100.0, 0, 0.1);
  const Solved solved(scene);
  stress::ExpectSaneField(solved);
  const SignMeasurement sign = MeasureSign(*solved.TheView, 0, {2.0, 1.9, 1.2}, Observer{0.0});
  stress::ExpectSaneSign(sign);
  EXPECT_GT(sign.VisibleFraction, 0.3);
  EXPECT_LT(sign.VisibleFraction, 0.7);
}

// Two signs in one place: the eye sees one of them, and no number goes wrong.
TEST(DegenerateShapes, TwoSignsInOnePlace)
{
  SceneDescription scene = Room();
  const auto again =
    scenes::Barcode({3, 1.1, 1.2}, {-1, 0, 0}, {0, 0, 1}, 0.6, 0.3, 5, 100.0, 1, 0.1);
  scene.Emitters.insert(scene.Emitters.end(), again.begin(), again.end());
  const Solved solved(scene);
  stress::ExpectSaneField(solved);
  double shown = 0.0;
  for (std::size_t sign = 0; sign < 2; ++sign)
  {
    const SignMeasurement measured = MeasureSign(*solved.TheView, sign, RoomEye, Observer{0.0});
    stress::ExpectSaneSign(measured);
    shown += measured.VisibleFraction;
  }
  report::Absolute("share of both that is seen", 1.0, shown, 1e-6);
}

// The room's smoke as meshes that touch, leave a hair and overlap.
TEST(DegenerateShapes, MeshesInPieces)
{
  report::Head("Smoke in pieces");
  const Vec3 upper(3, 2, 2);
  const auto smoke = [](const Vec3& lower, const Vec3& top, const std::array<int, 3>& cells)
  { return scenes::UniformSmoke(lower, top, cells, 0.5); };
  for (const double gap : {0.0, 1e-9, -1e-9, -0.1})
  {
    SceneDescription scene = Room();
    scene.Grids = {
      smoke(Vec3(0.0), {1.4, 2, 2}, {7, 10, 10}), smoke({1.4 + gap, 0, 0}, upper, {8, 10, 10})};
    ExpectPlain("two meshes, gap " + std::to_string(1e9 * gap) + " nm", scene);
  }
}

// A mesh inside another with cells of an eighth of the size.
TEST(DegenerateShapes, NestedMeshes)
{
  report::Head("Smoke in nested meshes");
  SceneDescription nested = Room();
  nested.Grids.push_back(scenes::UniformSmoke({1.2, 0.6, 0.6}, {1.6, 1.0, 1.0}, {16, 16, 16}, 0.5));
  ExpectPlain("nested 1:8", nested);
}

// A black triangle far outside of a closed room, which makes the scene many times as large, changes
// nothing but the random lines, although it makes shapes known less exactly: rays to a plate along
// the wall that it hangs on do not run into that.
TEST(DegenerateShapes, FarOutsideOfARoom)
{
  constexpr double tolerance = 0.01;
  for (const std::uint64_t seed : {2U, 3U, 6U})
  {
    const scenes::RandomScene room = scenes::MakeRandomRoom(seed);
    report::Head("Random room " + std::to_string(seed) + ", a triangle 30 and 100 m off");
    const auto measure = [&room](const SceneDescription& scene)
    { return MeasureSign(*Solved(scene, tolerance).TheView, 0, room.Eye, Observer{0.0}); };
    const SignMeasurement alone = measure(room.Description);
    for (const double distance : {30.0, 100.0})
    {
      SceneDescription scene = room.Description;
      scenes::AddRectangle(
        scene.Surfaces, {-distance, 0.3 * distance, 0.0}, {0, 1, 0}, {0, 0, 1}, 1, 1, 0.0);
      const SignMeasurement other = measure(scene);
      report::Absolute("contrast", alone.Contrast, other.Contrast, 0.001,
        std::hypot(alone.ContrastError, other.ContrastError));
      report::Relative(
        "luminance of dark bars", alone.UnlitLuminance, other.UnlitLuminance, tolerance);
    }
  }
}

// So far outside that rays no longer tell a sign from its wall: an error that says so, not a map
// without the sign.
TEST(DegenerateShapes, TooFarOutsideOfARoom)
{
  SceneDescription scene = scenes::MakeRandomRoom(2).Description;
  scenes::AddRectangle(scene.Surfaces, {-1e6, 0.0, 0.0}, {0, 1, 0}, {0, 0, 1}, 1, 1, 0.0);
  try
  {
    const Scene made(scene);
    FAIL() << "no error";
  }
  catch (const Error& error)
  {
    const std::string text = error.what();
    EXPECT_NE(text.find("sign "), std::string::npos) << text;
    EXPECT_NE(text.find("Leave out"), std::string::npos) << text;
  }
}

} // namespace
