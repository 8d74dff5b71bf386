// The contrast of a sign without smoke, where everything is known.
#include "Contrast.h"
#include "FloorMap.h"
#include "PolygonLight.h"

#include <cmath>
#include <memory>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

/// A sign of nine stripes, 0.9 m x 0.3 m times a scale, in the plane x = 0, that faces towards +x;
/// every other stripe has the high luminance. No smoke.
SceneDescription Stripes(double high, double low, double scale = 1.0)
{
  SceneDescription scene;
  for (int bar = 0; bar < 9; ++bar)
  {
    const double y = 0.1 * bar - 0.45;
    EmitterCell cell;
    cell.Vertices = {{0, y, -0.15}, {0, y + 0.1, -0.15}, {0, y + 0.1, 0.15}, {0, y, 0.15}};
    for (Vec3& vertex : cell.Vertices)
    {
      vertex *= scale;
    }
    cell.Luminance.fill(bar % 2 == 0 ? high : low);
    cell.SignId = 4;
    scene.Emitters.push_back(cell);
  }
  return scene;
}

void AddWall(SurfaceMesh& mesh, double x, double y0, double y1)
{
  const auto first = static_cast<std::uint32_t>(mesh.Points.size());
  mesh.Points.insert(mesh.Points.end(), {{x, y0, -5}, {x, y1, -5}, {x, y1, 5}, {x, y0, 5}});
  mesh.Triangles.push_back({first, first + 1, first + 2});
  mesh.Triangles.push_back({first, first + 2, first + 3});
  mesh.TriangleCell.insert(
    mesh.TriangleCell.end(), 2, static_cast<std::uint32_t>(mesh.CellReflectance.size()));
  mesh.CellReflectance.push_back({});
}

std::unique_ptr<View> ViewOf(SceneDescription description)
{
  const auto scene = std::make_shared<const Scene>(std::move(description));
  Progress progress;
  const auto field =
    std::make_shared<const LightField>(SolveLightField(*scene, LightFieldOptions(), progress));
  return std::make_unique<View>(scene, field);
}

const Observer Plain{0.0};

// Five of nine equal stripes at H, four at L: mean (5 H + 4 L) / 9, deviation sqrt(20) / 9 (H - L).
// From far off on the axis the stripes' solid angles are equal to (0.45 / 100)^2.
TEST(Contrast, OfStripes)
{
  const double high = 100.0;
  const double low = 10.0;
  const auto view = ViewOf(Stripes(high, low));
  const SignMeasurement sign = MeasureSign(*view, 0, {100, 0, 0}, Plain);
  const double mean = (5.0 * high + 4.0 * low) / 9.0;
  const double deviation = std::sqrt(20.0) / 9.0 * (high - low);
  EXPECT_TRUE(sign.InView);
  EXPECT_NEAR(sign.VisibleFraction, 1.0, 1e-6);
  EXPECT_NEAR(sign.MeanLuminance, mean, 1e-4 * mean);
  EXPECT_NEAR(sign.LitLuminance, high, 1e-4 * high);
  EXPECT_NEAR(sign.UnlitLuminance, low, 1e-4 * low);
  EXPECT_NEAR(sign.Contrast, deviation / mean, 1e-4);
  EXPECT_NEAR(sign.WebberContrast, (high - low) / low, 1e-3);
  EXPECT_NEAR(sign.UL924Contrast, (high - low) / high, 1e-4);
  EXPECT_NEAR(sign.ContrastError, 0.0, 1e-12);
  EXPECT_EQ(sign.OpticalDepth, 0.0);
}

// A sign that is as bright everywhere is lit, and has no unlit part to be compared with.
TEST(Contrast, OfAnEvenSign)
{
  const auto view = ViewOf(Stripes(70.0, 70.0));
  const SignMeasurement sign = MeasureSign(*view, 0, {100, 0, 0}, Plain);
  EXPECT_NEAR(sign.LitLuminance, 70.0, 1e-4);
  EXPECT_EQ(sign.UnlitLuminance, 0.0);
  EXPECT_EQ(sign.WebberContrast, 0.0);
  EXPECT_EQ(sign.UL924Contrast, 0.0);
  EXPECT_NEAR(sign.Contrast, 0.0, 1e-6);
}

// From close by, stripes aside look slender: of lit stripes' share f of the plate's solid angle the
// contrast is sqrt(1/f - 1).
TEST(Contrast, FromCloseBy)
{
  const SceneDescription scene = Stripes(100.0, 0.0);
  const auto view = ViewOf(scene);
  for (const Vec3& eye : {Vec3(0.02, 0.03, 0.01), Vec3(0.05, 0, 0), Vec3(0.1, 0.3, 0.1),
         Vec3(0.2, -0.45, 0), Vec3(0.5, 0.1, 0.1), Vec3(0.1, 1.0, 0.4)})
  {
    double lit = 0.0;
    double all = 0.0;
    for (const EmitterCell& cell : scene.Emitters)
    {
      const std::vector<Vec3>& corner = cell.Vertices;
      const double angle = SolidAngle(eye, {corner[0], corner[1], corner[2], corner[3]});
      all += angle;
      lit += cell.Luminance[0] > 0.0 ? angle : 0.0;
    }
    const SignMeasurement sign = MeasureSign(*view, 0, eye, Plain);
    EXPECT_NEAR(sign.Contrast, std::sqrt(all / lit - 1.0), 1e-3) << eye.x << " m";
    EXPECT_NEAR(sign.MeanLuminance, 100.0 * lit / all, 0.05) << eye.x << " m";
  }
}

TEST(Contrast, DarkLuminanceOfTheObserver)
{
  const auto view = ViewOf(Stripes(1.0, 0.0));
  const SignMeasurement plain = MeasureSign(*view, 0, {100, 0, 0}, Plain);
  const SignMeasurement dark = MeasureSign(*view, 0, {100, 0, 0}, Observer{0.5});
  EXPECT_NEAR(plain.PerceivedContrast, plain.Contrast, 1e-9);
  EXPECT_NEAR(dark.Contrast, plain.Contrast, 1e-9);
  EXPECT_NEAR(dark.PerceivedContrast,
    plain.Contrast * plain.MeanLuminance / (plain.MeanLuminance + 0.5), 1e-6);
}

TEST(Contrast, FromTheBackAndFromTheEdge)
{
  const auto view = ViewOf(Stripes(1.0, 0.0));
  for (const Vec3& eye : {Vec3(-5, 0, 0), Vec3(0, 5, 0), Vec3(-1e-9, 0, 0)})
  {
    const SignMeasurement sign = MeasureSign(*view, 0, eye, Plain);
    EXPECT_FALSE(sign.InView);
    EXPECT_EQ(sign.Contrast, 0.0);
    EXPECT_EQ(sign.VisibleFraction, 0.0);
  }
}

// A wall half way hides everything on one side of the line through it.
TEST(Contrast, PartlyHidden)
{
  SceneDescription scene = Stripes(100.0, 0.0);
  AddWall(scene.Surfaces, 50.0, 0.0, 10.0);
  const auto view = ViewOf(std::move(scene));
  const SignMeasurement half = MeasureSign(*view, 0, {100, 0, 0}, Plain);
  EXPECT_TRUE(half.InView);
  EXPECT_NEAR(half.VisibleFraction, 0.5, 1.0 / 512.0);
  EXPECT_NEAR(half.LitLuminance, 100.0, 1e-2);
  const SignMeasurement none = MeasureSign(*view, 0, {100, 2, 0}, Plain);
  EXPECT_FALSE(none.InView);
  const SignMeasurement all = MeasureSign(*view, 0, {100, -2, 0}, Plain);
  EXPECT_NEAR(all.VisibleFraction, 1.0, 1e-6);
}

/// Share of Stripes() that lies before an edge, and contrast of what does where dark stripes send
/// nothing, by a sum over fine steps.
std::pair<double, double> BeforeEdge(const glm::dvec2& normal, double distance)
{
  constexpr int Steps = 1800;
  double seen = 0.0;
  double lit = 0.0;
  for (int i = 0; i < Steps; ++i)
  {
    for (int j = 0; j < Steps / 3; ++j)
    {
      const glm::dvec2 place =
        0.9 * glm::dvec2(i + 0.5, j + 0.5) / static_cast<double>(Steps) - glm::dvec2(0.45, 0.15);
      if (glm::dot(place, normal) < distance)
      {
        seen += 1.0;
        lit += 9 * i / Steps % 2 == 0 ? 1.0 : 0.0;
      }
    }
  }
  return {seen / (Steps * Steps / 3.0), lit > 0.0 ? std::sqrt(seen / lit - 1.0) : 0.0};
}

// An edge across a sign, upright, aslant and nearly level, that leaves more and more of it. Blocks
// along it are a thirtieth of the sign wide at most and looked at in 16 places each.
TEST(Contrast, EdgeAcrossASign)
{
  for (const double angle : {0.0, 0.6, 1.4})
  {
    const glm::dvec2 normal(std::cos(angle), std::sin(angle));
    const double reach = 0.45 * normal.x + 0.15 * normal.y;
    for (int share = 1; share < 25; ++share)
    {
      const double distance = reach * (share / 12.5 - 1.0);
      SceneDescription scene = Stripes(100.0, 0.0);
      AddWall(scene.Surfaces, 50.0, 0.5 * distance, 10.0);
      for (Vec3& point : scene.Surfaces.Points)
      {
        point = {point.x, normal.x * point.y - normal.y * point.z,
          normal.y * point.y + normal.x * point.z};
      }
      const auto [fraction, contrast] = BeforeEdge(normal, distance);
      if (fraction < 0.02)
      {
        continue;
      }
      const auto view = ViewOf(std::move(scene));
      const SignMeasurement sign = MeasureSign(*view, 0, {100, 0, 0}, Plain);
      EXPECT_TRUE(sign.InView) << angle << " " << fraction;
      EXPECT_NEAR(sign.VisibleFraction, fraction, 0.002) << angle;
      EXPECT_NEAR(sign.Contrast, contrast, 0.01) << angle << " " << fraction;
    }
  }
}

// A slit in a wall shows a thin strip of a sign, between the middles of its blocks, and a post
// hides one.
TEST(Contrast, SlitAndPost)
{
  for (const double place : {-0.02, 0.0, 0.013, 0.4})
  {
    for (const double width : {0.03, 0.05})
    {
      SceneDescription slit = Stripes(100.0, 0.0);
      AddWall(slit.Surfaces, 50.0, -10.0, 0.5 * (place - 0.5 * width));
      AddWall(slit.Surfaces, 50.0, 0.5 * (place + 0.5 * width), 10.0);
      const auto through = ViewOf(std::move(slit));
      const SignMeasurement strip = MeasureSign(*through, 0, {100, 0, 0}, Plain);
      EXPECT_TRUE(strip.InView) << place << " " << width;
      EXPECT_NEAR(strip.VisibleFraction, width / 0.9, 0.002) << place;
      SceneDescription post = Stripes(100.0, 0.0);
      AddWall(post.Surfaces, 50.0, 0.5 * (place - 0.5 * width), 0.5 * (place + 0.5 * width));
      const auto behind = ViewOf(std::move(post));
      EXPECT_NEAR(
        MeasureSign(*behind, 0, {100, 0, 0}, Plain).VisibleFraction, 1.0 - width / 0.9, 0.002)
        << place;
    }
  }
}

// A lit board before a dark one of the same sign, from far off: what it hides is not seen.
TEST(Contrast, BoardBeforeABoard)
{
  for (const bool front : {false, true})
  {
    for (const double gap : {0.002, 0.02})
    {
      SceneDescription scene;
      for (const bool second : {false, true})
      {
        const double x = second ? gap : 0.0;
        const double half = second ? 0.1 : 0.2;
        EmitterCell cell;
        cell.Vertices = {{x, -half, -0.1}, {x, half, -0.1}, {x, half, 0.1}, {x, -half, 0.1}};
        cell.Luminance.fill(second == front ? 100.0 : 0.0);
        cell.SignId = 0;
        scene.Emitters.push_back(cell);
      }
      const auto view = ViewOf(std::move(scene));
      const SignMeasurement sign = MeasureSign(*view, 0, {100, 0, 0}, Plain);
      EXPECT_NEAR(sign.VisibleFraction, 2.0 / 3.0, 0.002) << gap;
      EXPECT_NEAR(sign.MeanLuminance, 50.0, 0.2) << gap;
      EXPECT_NEAR(sign.Contrast, 1.0, 0.004) << gap;
    }
  }
}

// Dark stripes have no law of emission: whatever theirs says, pixels mix them with lit ones.
TEST(Contrast, PixelsMixCellsOfOtherExponents)
{
  SceneDescription scene = Stripes(100.0, 0.0, 0.01);
  for (EmitterCell& cell : scene.Emitters)
  {
    cell.Exponent = cell.Luminance[0] > 0.0 ? 1.0 : 0.0;
  }
  const auto view = ViewOf(std::move(scene));
  EXPECT_LT(MeasureSign(*view, 0, {20, 0, 0}, Plain).Contrast, 0.2);
}

// A corner given twice is one corner.
TEST(Contrast, RepeatedCorner)
{
  SceneDescription scene = Stripes(100.0, 0.0);
  for (EmitterCell& cell : scene.Emitters)
  {
    cell.Vertices.insert(cell.Vertices.begin(), cell.Vertices.front());
    cell.Vertices.push_back(cell.Vertices.front());
  }
  const auto twice = ViewOf(std::move(scene));
  const auto once = ViewOf(Stripes(100.0, 0.0));
  EXPECT_EQ(MeasureSign(*twice, 0, {9, 1, 0}, Plain).Contrast,
    MeasureSign(*once, 0, {9, 1, 0}, Plain).Contrast);
}

// Stripes far below the resolution melt into their mean: 1 mm at 20 m is a sixth of a minute of
// arc.
TEST(Contrast, FinerThanTheEyeResolves)
{
  SceneDescription scene = Stripes(100.0, 0.0, 0.01);
  AddWall(scene.Surfaces, 25.0, -5.0, 5.0);
  const auto view = ViewOf(std::move(scene));
  const SignMeasurement near = MeasureSign(*view, 0, {0.5, 0, 0}, Plain);
  const SignMeasurement far = MeasureSign(*view, 0, {20, 0, 0}, Plain);
  EXPECT_NEAR(near.Contrast, std::sqrt(20.0) / 5.0, 1e-3);
  EXPECT_NEAR(far.VisibleFraction, 1.0, 1e-6);
  EXPECT_LT(far.Contrast, 0.2);
  EXPECT_NEAR(far.MeanLuminance, 500.0 / 9.0, 0.5);
}

/// Standard deviation over mean of equal pixels that average stripes, lit and dark in turn, by a
/// sum over fine steps.
double StripesThroughPixels(int stripes, int pixels)
{
  constexpr int steps = 2000;
  double first = 0.0;
  double second = 0.0;
  for (int pixel = 0; pixel < pixels; ++pixel)
  {
    int lit = 0;
    for (int step = 0; step < steps; ++step)
    {
      lit += static_cast<int>((pixel + (step + 0.5) / steps) / pixels * stripes) % 2 == 0 ? 1 : 0;
    }
    const double value = static_cast<double>(lit) / steps;
    first += value / pixels;
    second += value * value / pixels;
  }
  return std::sqrt(second - first * first) / first;
}

// Pixels average the pattern exactly, finer or coarser than its stripes of 1 cm. Both sides take
// stripes cut by a pixel's edge for what they are, to the step of the sum.
TEST(Contrast, PixelsAverageThePattern)
{
  SceneDescription scene = Stripes(100.0, 0.0);
  scene.Emitters.clear();
  constexpr int stripes = 91;
  for (int stripe = 0; stripe < stripes; ++stripe)
  {
    EmitterCell cell;
    const double y = 0.01 * (stripe - 0.5 * stripes);
    cell.Vertices = {{0, y, -0.15}, {0, y + 0.01, -0.15}, {0, y + 0.01, 0.15}, {0, y, 0.15}};
    cell.Luminance.fill(stripe % 2 == 0 ? 100.0 : 0.0);
    cell.SignId = 0;
    scene.Emitters.push_back(cell);
  }
  const auto view = ViewOf(std::move(scene));
  for (const double distance : {36.0, 50.0, 90.0, 200.0, 600.0})
  {
    const double acuity = Plain.Acuity;
    const double angle = 2.0 * std::atan(0.5 * 0.01 * stripes / distance);
    const int pixels = static_cast<int>(angle / acuity);
    EXPECT_NEAR(MeasureSign(*view, 0, {distance, 0, 0}, Plain).Contrast,
      StripesThroughPixels(stripes, pixels), 2e-3)
      << distance << " m, " << pixels << " pixels";
  }
}

// A disc of triangles, without a rectangle in it: its area is exact whatever the pixels.
TEST(Contrast, TrianglesThroughPixels)
{
  SceneDescription scene;
  constexpr int corners = 24;
  constexpr double radius = 0.3;
  const auto corner = [](int index, double r)
  {
    const double angle = 2.0 * 3.14159265358979 * index / corners;
    return Vec3(0.0, r * std::cos(angle), r * std::sin(angle));
  };
  for (int i = 0; i < corners; ++i)
  {
    for (const bool inner : {true, false})
    {
      EmitterCell cell;
      cell.Vertices = {inner ? Vec3(0.0) : corner(i, 0.5 * radius),
        corner(i, inner ? 0.5 * radius : radius), corner(i + 1, inner ? 0.5 * radius : radius)};
      if (!inner)
      {
        cell.Vertices.push_back(corner(i + 1, 0.5 * radius));
      }
      cell.Luminance.fill(inner ? 80.0 : 20.0);
      cell.SignId = 0;
      scene.Emitters.push_back(cell);
    }
  }
  const auto view = ViewOf(std::move(scene));
  // A quarter of the area is bright.
  const double mean = 0.25 * 80.0 + 0.75 * 20.0;
  const double deviation = 60.0 * std::sqrt(0.25 * 0.75);
  for (const double distance : {10.0, 20.0, 40.0})
  {
    const SignMeasurement sign = MeasureSign(*view, 0, {distance, 0, 0}, Plain);
    EXPECT_NEAR(sign.MeanLuminance, mean, 1e-3 * mean);
    EXPECT_NEAR(sign.LitLuminance, 80.0, 0.01);
    EXPECT_NEAR(sign.VisibleFraction, 1.0, 1e-6);
    // The pixels along the inner circle are mixed: a ring as wide as a pixel at most.
    const double pixel = distance * Plain.Acuity / radius;
    EXPECT_LT(sign.Contrast, deviation / mean);
    EXPECT_GT(sign.Contrast, deviation / mean * (1.0 - 2.0 * pixel));
  }
  // Right before it every cell is resolved.
  EXPECT_NEAR(MeasureSign(*view, 0, {2, 0, 0}, Plain).Contrast, deviation / mean, 0.01);
}

// Without smoke a sign's own light is all there is: it is cut off just above its contrast.
TEST(Contrast, CutOff)
{
  const auto view = ViewOf(Stripes(1.0, 0.2));
  const Observer observer;
  for (const Vec3& eye : {Vec3(1, 0, 0), Vec3(5, 4, 1), Vec3(0.2, 3, 0), Vec3(300, 0, 0)})
  {
    const double contrast = MeasureSign(*view, 0, eye, observer).PerceivedContrast;
    const SignMeasurement kept = MeasureSign(*view, 0, eye, observer, (1.0 - 1e-9) * contrast);
    EXPECT_FALSE(kept.BelowCutOff);
    EXPECT_EQ(kept.PerceivedContrast, contrast);
    const SignMeasurement cut = MeasureSign(*view, 0, eye, observer, (1.0 + 1e-9) * contrast);
    EXPECT_TRUE(cut.InView);
    EXPECT_TRUE(cut.BelowCutOff);
    EXPECT_EQ(cut.PerceivedContrast, 0.0);
  }
}

// Places before, behind and, for a wall between, out of sight of the sign.
TEST(FloorMap, StatusOfPlaces)
{
  SceneDescription scene = Stripes(100.0, 0.0);
  AddWall(scene.Surfaces, 5.0, -10.0, 10.0);
  const auto view = ViewOf(std::move(scene));
  FloorMapOptions options;
  options.FirstPlace = {-2, 0, 0};
  options.StepX = 4.0;
  options.PlacesX = 3;
  options.PlacesY = 1;
  Progress progress;
  const FloorMap map = ComputeFloorMap(*view, options, progress);
  ASSERT_EQ(map.Status.size(), 3U);
  EXPECT_EQ(map.Signs, 1U);
  EXPECT_EQ(map.Status[0], PlaceStatus::NoSignInView);
  EXPECT_EQ(map.Status[1], PlaceStatus::Seen);
  EXPECT_EQ(map.Status[2], PlaceStatus::NoSignInView);
  EXPECT_EQ(map.BestSign[1], 4);
  EXPECT_EQ(map.BestSign[0], -1);
  EXPECT_NEAR(map.Visibility[1], std::sqrt(20.0) / 5.0, 0.02);
  EXPECT_EQ(map.Visibility[0], 0.0F);
  EXPECT_FLOAT_EQ(map.VisibleFraction[1], 1.0F);
}

} // namespace
