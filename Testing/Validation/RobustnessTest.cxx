// Input that must be refused with a useful word, and odd input that must give a right answer.
#include "Contrast.h"
#include "Errors.h"
#include "SceneLibrary.h"
#include "Solved.h"
#include "TestReport.h"

#include <cmath>
#include <functional>
#include <limits>
#include <optional>

namespace
{

using namespace smokevis;

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
constexpr double Infinity = std::numeric_limits<double>::infinity();

/// Expects that the tunnel, spoilt, is refused with a message that holds all the words.
void ExpectRefused(const std::string& what, const std::function<void(SceneDescription&)>& spoil,
  const std::vector<std::string>& words)
{
  SCOPED_TRACE(what);
  SceneDescription description = scenes::Tunnel(1.0, 0.9);
  spoil(description);
  try
  {
    const Solved solved(description);
    ADD_FAILURE() << "accepted";
  }
  catch (const Error& error)
  {
    const std::string message = error.what();
    for (const std::string& word : words)
    {
      EXPECT_NE(message.find(word), std::string::npos) << message;
    }
    // Where, what and a remedy: two sentences.
    EXPECT_NE(message.find(": "), std::string::npos) << message;
    EXPECT_NE(message.find(". "), std::string::npos) << message;
    EXPECT_EQ(message.back(), '.') << message;
  }
}

TEST(BadInput, Smoke)
{
  ExpectRefused("extinction is not a number",
    [](SceneDescription& scene) { scene.Grids[0].Extinction[17] = static_cast<float>(NaN); },
    {"17", "extinction", "uniform smoke"});
  ExpectRefused("extinction is negative",
    [](SceneDescription& scene) { scene.Grids[0].Extinction[5] = -1.0F; },
    {"cell 5", "extinction", "-1"});
  ExpectRefused("extinction is infinite",
    [](SceneDescription& scene) { scene.Grids[0].Extinction[5] = static_cast<float>(Infinity); },
    {"cell 5", "extinction"});
  ExpectRefused("nodes fall",
    [](SceneDescription& scene)
    { std::swap(scene.Grids[0].Nodes[1][3], scene.Grids[0].Nodes[1][4]); },
    {"axis y", "increasing"});
  ExpectRefused("nodes repeat",
    [](SceneDescription& scene) { scene.Grids[0].Nodes[2][4] = scene.Grids[0].Nodes[2][3]; },
    {"axis z", "node 4"});
  ExpectRefused("a node is not a number",
    [](SceneDescription& scene) { scene.Grids[0].Nodes[0][0] = NaN; }, {"axis x"});
  ExpectRefused("one node only", [](SceneDescription& scene) { scene.Grids[0].Nodes[0].resize(1); },
    {"axis x"});
  ExpectRefused("too few values",
    [](SceneDescription& scene) { scene.Grids[0].Extinction.pop_back(); }, {"3999", "4000"});
  ExpectRefused("smoke beyond all sums",
    [](SceneDescription& scene) { scene.Grids[0].Extinction[17] = 1e30F; },
    {"cell 17", "extinction coefficient", "1e+30", "unit"});
  ExpectRefused("too few emitted luminances",
    [](SceneDescription& scene) { scene.Grids[0].EmittedLuminance.assign(7, 1.0F); },
    {"emitted luminance"});
  ExpectRefused("emitted luminance is negative",
    [](SceneDescription& scene) { scene.Grids[0].EmittedLuminance.assign(4000, -1.0F); },
    {"emitted luminance", "cell 0"});
}

TEST(BadInput, Scene)
{
  for (const double albedo : {-0.1, 1.1, NaN})
  {
    ExpectRefused("albedo " + std::to_string(albedo),
      [&](SceneDescription& scene) { scene.Albedo = albedo; }, {"albedo", "0 and 1"});
  }
  ExpectRefused("two bands", [](SceneDescription& scene) { scene.Bands = 2; }, {"2 bands"});
  ExpectRefused("negative scale of extinction",
    [](SceneDescription& scene) { scene.ExtinctionScale[0] = -1.0; }, {"extinction", "band 0"});
  ExpectRefused("no emitters", [](SceneDescription& scene) { scene.Emitters.clear(); }, {"emit"});
  ExpectRefused("nothing at all", [](SceneDescription& scene) { scene = {}; }, {"empty"});
}

TEST(BadInput, Surfaces)
{
  for (const double reflectance : {-0.1, 1.5, NaN})
  {
    ExpectRefused("reflectance " + std::to_string(reflectance),
      [&](SceneDescription& scene) { scene.Surfaces.CellReflectance[3][0] = reflectance; },
      {"cell 3", "reflectance"});
  }
  ExpectRefused("a corner without a point",
    [](SceneDescription& scene) { scene.Surfaces.Triangles[2][1] = 1000000; }, {"triangle 2"});
  ExpectRefused("a triangle without a cell",
    [](SceneDescription& scene) { scene.Surfaces.TriangleCell.pop_back(); }, {"cell"});
  ExpectRefused("a cell without a reflectance",
    [](SceneDescription& scene) { scene.Surfaces.CellReflectance.pop_back(); }, {"reflectance"});
  ExpectRefused("a point that is not a number",
    [](SceneDescription& scene) { scene.Surfaces.Points[0].x = NaN; }, {"finite"});
}

TEST(BadInput, Emitters)
{
  ExpectRefused("luminance is negative",
    [](SceneDescription& scene) { scene.Emitters[2].Luminance[0] = -1.0; },
    {"emitter cell 2", "luminance"});
  ExpectRefused("luminance is not a number",
    [](SceneDescription& scene) { scene.Emitters[2].Luminance[0] = NaN; },
    {"emitter cell 2", "luminance"});
  ExpectRefused("luminances beyond all sums",
    [](SceneDescription& scene) { scene.Emitters[2].Luminance[0] = 1e300; },
    {"direct light", "finite", "luminances"});
  ExpectRefused("reflectance above 1",
    [](SceneDescription& scene) { scene.Emitters[2].Reflectance[0] = 1.5; },
    {"emitter cell 2", "reflectance"});
  ExpectRefused("exponent is negative",
    [](SceneDescription& scene) { scene.Emitters[2].Exponent = -1.0; },
    {"emitter cell 2", "exponent"});
  ExpectRefused("polygon of two corners",
    [](SceneDescription& scene) { scene.Emitters[2].Vertices.resize(2); },
    {"emitter cell 2", "area"});
  ExpectRefused("polygon without corners",
    [](SceneDescription& scene) { scene.Emitters[2].Vertices.clear(); }, {"emitter cell 2"});
  ExpectRefused("polygon in one line",
    [](SceneDescription& scene) {
      scene.Emitters[2].Vertices = {Vec3(0.0), Vec3(1.0), Vec3(2.0)};
    },
    {"emitter cell 2", "area"});
  ExpectRefused("a corner that is not a number",
    [](SceneDescription& scene) { scene.Emitters[2].Vertices[0].y = NaN; }, {"emitter cell 2"});
  ExpectRefused("bent polygon",
    [](SceneDescription& scene) { scene.Emitters[2].Vertices[0].x += 0.05; },
    {"emitter cell 2", "plane"});
}

/// The tunnel in the dark, as it comes.
const SignMeasurement& PlainTunnel()
{
  static const SignMeasurement sign =
    MeasureSign(*Solved(scenes::Tunnel(1.0, 0.9)).TheView, 0, scenes::TunnelEye, Observer{0.0});
  return sign;
}

void ExpectSameSign(const std::string& name, const SignMeasurement& sign, double tolerance)
{
  const SignMeasurement& plain = PlainTunnel();
  report::Head(name);
  report::Relative("lit luminance", plain.LitLuminance, sign.LitLuminance, tolerance);
  report::Relative("unlit luminance", plain.UnlitLuminance, sign.UnlitLuminance, tolerance,
    std::hypot(plain.MeanLuminanceError, sign.MeanLuminanceError));
  report::Absolute("contrast", plain.Contrast, sign.Contrast, 0.001);
}

// Triangles that are there twice, and triangles of no width, change nothing but the random numbers.
TEST(OddInput, DuplicateAndSliverTriangles)
{
  SceneDescription scene = scenes::Tunnel(1.0, 0.9);
  SurfaceMesh& mesh = scene.Surfaces;
  const std::size_t count = mesh.Triangles.size();
  for (std::size_t i = 0; i < count; i += 3)
  {
    mesh.Triangles.push_back(mesh.Triangles[i]);
    mesh.TriangleCell.push_back(mesh.TriangleCell[i]);
  }
  for (std::uint32_t i = 0; i + 2 < 60; i += 3)
  {
    // Three corners on one line, and one corner three times.
    mesh.Triangles.push_back({i, i + 1, i});
    mesh.Triangles.push_back({i, i, i});
    mesh.TriangleCell.insert(mesh.TriangleCell.end(), 2, 0);
  }
  // A sliver 1e-9 m wide along the floor.
  const auto first = static_cast<std::uint32_t>(mesh.Points.size());
  mesh.Points.insert(mesh.Points.end(), {{0, 0.5, 0}, {4, 0.5, 0}, {4, 0.5 + 1e-9, 0}});
  mesh.Triangles.push_back({first, first + 1, first + 2});
  mesh.TriangleCell.push_back(0);
  const Solved solved(scene);
  ExpectSameSign("Duplicates and slivers",
    MeasureSign(*solved.TheView, 0, scenes::TunnelEye, Observer{0.0}), 0.01);
}

// A room on a ground a hundred times as wide: lines go through the smoke's box, too, so that they
// need not be a hundred times as many.
TEST(OddInput, SmokeInALargeScene)
{
  const auto scene = [](double ground)
  {
    SceneDescription description;
    description.Albedo = 0.8;
    description.Grids = {scenes::UniformSmoke(Vec3(0.0), {4, 3, 2.5}, {16, 12, 10}, 0.4)};
    scenes::AddRectangle(description.Surfaces, Vec3(-ground, -ground, -0.05),
      {4 + 2 * ground, 0, 0}, {0, 3 + 2 * ground, 0}, 8, 8, 0.0);
    scenes::AddRectangle(description.Surfaces, Vec3(0.0), {4, 0, 0}, {0, 3, 0}, 16, 12, 0.3);
    scenes::AddRectangle(description.Surfaces, Vec3(0, 0, 2.5), {0, 3, 0}, {4, 0, 0}, 12, 16, 0.7);
    description.Emitters =
      scenes::Barcode({3.9, 1.5, 2.0}, {-1, 0, 0}, {0, 0, 1}, 0.8, 0.4, 8, 300.0, 0, 0.5);
    return description;
  };
  const Solved small(scene(2.0));
  const Solved large(scene(200.0));
  const auto lines = [](const Solved& solved)
  {
    double count = 0.0;
    for (const auto& row : solved.Field->Report)
    {
      count += row.What.find("lines a sweep") != std::string::npos ? row.Count : 0.0;
    }
    return count;
  };
  EXPECT_LT(lines(large), 3.0 * lines(small));
  report::Head("Smoke in a scene a hundred times as wide, against the reference integrator");
  const ReferenceIntegrator integrator(*large.TheScene);
  for (const Ray& ray : {Ray{{0.5, 1.5, 1.6}, glm::normalize(Vec3(4.0, -1.0, 0.0))},
         Ray{{2.0, 0.5, 1.6}, {0.0, 1.0, 0.0}}, Ray{{0.5, 1.0, 1.6}, {0.6, 0.0, -0.8}}})
  {
    const Hit hit = large.TheView->FirstHit(ray.Origin, ray.Direction);
    const auto value = large.TheView->Trace(ray.Origin, ray.Direction, hit, 0);
    const Estimate judge = integrator.Radiance(ray, 200000, 5);
    // 1 %, the tolerance, and its own noise.
    report::Relative("luminance", judge.Mean, value.Total(), 0.02, judge.StandardError);
  }
}

// A sign partly behind the corner of a bright side room: smoke in there is not on the way to what
// shows. Against the mean over rays to places on the sign.
TEST(OddInput, SignBehindACorner)
{
  report::Head("Sign behind the corner of a bright room");
  for (const double lamp : {0.0, 5000.0})
  {
    SceneDescription scene;
    scene.Albedo = 0.8;
    const Vec3 upper(8, 5, 3);
    scene.Grids = {scenes::UniformSmoke(Vec3(0.0), upper, {32, 20, 12}, 0.8)};
    scenes::AddRoom(scene.Surfaces, Vec3(0.0), upper, 1.0, 0.2);
    scenes::AddRectangle(scene.Surfaces, {1, 2, 0}, {3, 0, 0}, {0, 0, 3}, 6, 6, 0.2);
    scenes::AddRectangle(scene.Surfaces, {4, 2, 0}, {0, 3, 0}, {0, 0, 3}, 6, 6, 0.2);
    scenes::AddRectangle(scene.Surfaces, {1, 2, 0}, {0, 3, 0}, {0, 0, 3}, 6, 6, 0.2);
    scene.Emitters = scenes::Barcode({7.99, 2, 1.5}, {-1, 0, 0}, {0, 0, 1}, 1.2, 0.4, 5, 100.0, 0);
    scene.Emitters.push_back(scenes::Plate({6, 1.5, 2.99}, {0, 0, -1}, {1, 0, 0}, 0.4, 0.4, 100.0));
    scene.Emitters.push_back(
      scenes::Plate({2.5, 3.5, 2.99}, {0, 0, -1}, {1, 0, 0}, 0.6, 0.6, lamp));
    const Solved solved(std::move(scene), 0.03);
    const Vec3 eye(0.5, 1.8, 1.5);
    const Sign& sign = solved.TheScene->Lights().Signs()[0];
    double weight = 0.0;
    double first = 0.0;
    double second = 0.0;
    for (int i = 0; i < 200; ++i)
    {
      for (int j = 0; j < 8; ++j)
      {
        const Vec3 place = sign.Corners[0] +
                           (i + 0.5) / 200.0 * (sign.Corners[1] - sign.Corners[0]) +
                           (j + 0.5) / 8.0 * (sign.Corners[3] - sign.Corners[0]);
        const Vec3 direction = glm::normalize(place - eye);
        const Hit hit = solved.TheView->FirstHit(eye, direction);
        if (hit.Emitter && hit.Side == 0)
        {
          const double luminance = solved.TheView->Trace(eye, direction, hit, 0).Total();
          weight += 1.0;
          first += luminance;
          second += luminance * luminance;
        }
      }
    }
    const double mean = first / weight;
    const double contrast = std::sqrt(second / weight - mean * mean) / mean;
    const SignMeasurement measured = MeasureSign(*solved.TheView, 0, eye, Observer{0.0});
    const std::string name = "lamp of " + std::to_string(lamp) + " cd/m2: ";
    report::Absolute(name + "fraction", weight / 1600.0, measured.VisibleFraction, 0.005);
    report::Absolute(name + "contrast", contrast, measured.Contrast, 0.005);
    EXPECT_LT(measured.ContrastError, 0.01);
  }
}

// Walls that show their backs to the room reflect as well: a sign that only reflects is as bright.
TEST(OddInput, ReflectingSignInARoomInsideOut)
{
  std::vector<Estimate> values;
  for (const bool insideOut : {false, true})
  {
    SceneDescription scene;
    scene.Albedo = 0.5;
    scene.Grids = {scenes::UniformSmoke(Vec3(0.0), Vec3(4, 4, 3), {16, 16, 12}, 0.2)};
    scenes::AddRoom(scene.Surfaces, Vec3(0.0), Vec3(4, 4, 3), 0.5, 0.6);
    if (insideOut)
    {
      for (auto& triangle : scene.Surfaces.Triangles)
      {
        std::swap(triangle[1], triangle[2]);
      }
    }
    scene.Emitters = {scenes::Plate({2, 2, 2.99}, {0, 0, -1}, {1, 0, 0}, 1.5, 1.5, 500.0),
      scenes::Plate({2, 3.5, 1.5}, {0, -1, 0}, {0, 0, 1}, 1.0, 0.4, 0.0, 0.8, 0)};
    const Solved solved(std::move(scene), 0.1);
    values.push_back(solved.Luminance({{2.0, 1.0, 1.5}, {0, 1, 0}}));
  }
  report::Head("Reflecting sign in a room of outward surfaces");
  report::Relative("luminance [cd/m2]", values[0].Mean, values[1].Mean, 0.01,
    std::hypot(values[0].StandardError, values[1].StandardError));
}

// Half of a sign that only reflects is sunk into a block: what shows of it is as bright as a sign
// that ends there, and as the reference integrator has it.
TEST(OddInput, ReflectingSignHalfInABlock)
{
  SceneDescription scene;
  scene.Albedo = 0.5;
  scene.Grids = {scenes::UniformSmoke(Vec3(0.0), Vec3(4, 4, 3), {16, 16, 12}, 0.2)};
  scenes::AddRoom(scene.Surfaces, Vec3(0.0), Vec3(4, 4, 3), 0.5, 0.6);
  scenes::AddBlock(scene.Surfaces, {1, 3, 0}, {2, 4, 3}, 0.5, 0.6);
  scene.Emitters = {scenes::Plate({3, 1, 2.99}, {0, 0, -1}, {1, 0, 0}, 0.4, 0.4, 5000.0),
    scenes::Plate({2, 3.5, 1.5}, {0, -1, 0}, {0, 0, 1}, 1.0, 0.4, 0.0, 0.8, 0)};
  const Solved solved(std::move(scene), 0.02);
  const Vec3 eye(2.3, 1.0, 1.5);
  const Ray ray{eye, {0, 1, 0}};
  const ReferenceIntegrator integrator(*solved.TheScene);
  const Estimate reference = integrator.Radiance(ray, 100000, 5);
  const Estimate value = solved.Luminance(ray);
  report::Head("What shows of a reflecting sign that is half in a block");
  report::Relative("luminance [cd/m2]", reference.Mean, value.Mean, 0.02,
    std::hypot(reference.StandardError, value.StandardError));
  EXPECT_LT(value.StandardError, 0.02 * value.Mean);
}

// The sign may lie in the wall, a hair in front of it or a hair behind it.
TEST(OddInput, SignFlushWithTheWall)
{
  for (const double offset : {-2e-6, -1e-9, 1e-9, 2e-6, 1e-3})
  {
    SceneDescription scene = scenes::Tunnel(1.0, 0.9);
    for (EmitterCell& cell : scene.Emitters)
    {
      for (Vec3& vertex : cell.Vertices)
      {
        vertex.x -= offset;
      }
    }
    const SignMeasurement sign =
      MeasureSign(*Solved(scene).TheView, 0, scenes::TunnelEye, Observer{0.0});
    EXPECT_TRUE(sign.InView);
    EXPECT_NEAR(sign.VisibleFraction, 1.0, 1e-3) << offset;
    ExpectSameSign("Sign " + std::to_string(1e6 * offset) + " um before the wall", sign, 0.01);
  }
}

// An eye on a wall, in a corner and outside of everything gives finite numbers.
TEST(OddInput, EyesInOddPlaces)
{
  const Solved solved(scenes::Tunnel(1.0, 0.9));
  for (const Vec3& eye : {Vec3(0, 0.5, 0.5), Vec3(0.0), Vec3(4, 1, 1), Vec3(4, 0.5, 0.5),
         Vec3(4.0 - 1e-9, 0.5, 0.5), Vec3(-10, 0.5, 0.5), Vec3(1e6, 1e6, 1e6), Vec3(2, 0, 0.5)})
  {
    const SignMeasurement sign = MeasureSign(*solved.TheView, 0, eye, {});
    EXPECT_TRUE(std::isfinite(sign.Contrast) && sign.Contrast >= 0.0);
    EXPECT_TRUE(std::isfinite(sign.MeanLuminance) && sign.MeanLuminance >= 0.0);
    EXPECT_TRUE(std::isfinite(sign.PerceivedContrastError));
    EXPECT_GE(sign.VisibleFraction, 0.0);
    EXPECT_LE(sign.VisibleFraction, 1.0 + 1e-6);
  }
}

// Any depth with all light lost or none. White walls and lossless smoke leave the black plate of
// the sign alone to absorb: no NaN, no hang.
TEST(OddInput, Extremes)
{
  for (const double extinction : {0.0, 1e-20, 2.5e5})
  {
    for (const double loss : {0.0, 1.0})
    {
      SceneDescription scene = scenes::Tunnel(extinction, 1.0 - loss);
      for (Spectrum& reflectance : scene.Surfaces.CellReflectance)
      {
        // White walls and nothing between them that absorbs would reflect without end.
        reflectance.fill(extinction < 1.0 ? 0.5 : 1.0);
      }
      std::optional<Solved> kept;
      try
      {
        kept.emplace(scene, 0.03);
      }
      catch (const Error& error)
      {
        // In white opaque smoke between white walls light takes a thousand million scatterings to
        // come out: there is an answer, but a word that it was not reached will do.
        EXPECT_TRUE(extinction > 1.0 && loss == 0.0) << error.what();
        EXPECT_NE(std::string(error.what()).find("did not settle"), std::string::npos);
        continue;
      }
      const Solved& solved = *kept;
      const SignMeasurement sign =
        MeasureSign(*solved.TheView, 0, scenes::TunnelEye, Observer{0.0});
      EXPECT_TRUE(std::isfinite(sign.Contrast));
      EXPECT_TRUE(std::isfinite(sign.MeanLuminance));
      for (const float value : solved.Field->DirectFluence)
      {
        ASSERT_TRUE(std::isfinite(value) && value >= 0.0F);
      }
      for (const Lanes& lanes : solved.Field->MultipleFluence)
      {
        ASSERT_TRUE(std::isfinite(Mean(lanes)));
      }
    }
  }
}

/// Compares the deterministic parts of two solutions of what should be one scene.
void CompareDirect(
  const std::string& name, const Solved& plain, const Solved& other, double tolerance)
{
  double fluence = 0.0;
  for (std::size_t i = 0; i < plain.Field->DirectFluence.size(); ++i)
  {
    const double a = plain.Field->DirectFluence[i];
    fluence = std::max(fluence, std::abs(other.Field->DirectFluence[i] - a) / std::max(a, 1e-30));
  }
  double illuminance = 0.0;
  for (std::size_t i = 0; i < plain.Field->DirectIlluminance.size(); ++i)
  {
    const double a = plain.Field->DirectIlluminance[i];
    if (a > 0.0)
    {
      illuminance = std::max(illuminance, std::abs(other.Field->DirectIlluminance[i] - a) / a);
    }
  }
  report::Head(name);
  report::Absolute("largest relative change, direct fluence", 0.0, fluence, tolerance);
  report::Absolute("largest relative change, direct illuminance", 0.0, illuminance, tolerance);
}

// Lengths times s and extinctions divided by s: luminances stay.
TEST(OddInput, ScaleOfLengths)
{
  const Solved plain(scenes::Tunnel(1.0, 0.9));
  for (const double factor : {1e-3, 1e3})
  {
    const Solved scaled(scenes::Scaled(scenes::Tunnel(1.0, 0.9), factor));
    CompareDirect("Tunnel times " + std::to_string(factor), plain, scaled, 1e-5);
    ExpectSameSign(
      "Its sign", MeasureSign(*scaled.TheView, 0, factor * scenes::TunnelEye, Observer{0.0}), 0.01);
  }
}

// Doubles at 1e6 m resolve 1e-10 m: parts in 1e8 of a cell, and 1e-5 where angles are steep.
TEST(OddInput, FarFromTheOrigin)
{
  const Vec3 offset(1e6, -1e6, 1e6);
  const Solved plain(scenes::Tunnel(1.0, 0.9));
  const Solved moved(scenes::Moved(scenes::Tunnel(1.0, 0.9), offset));
  CompareDirect("Tunnel a million metres away", plain, moved, 1e-5);
  ExpectSameSign(
    "Its sign", MeasureSign(*moved.TheView, 0, scenes::TunnelEye + offset, Observer{0.0}), 0.01);
}

} // namespace
