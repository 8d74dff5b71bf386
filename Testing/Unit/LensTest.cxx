// The lens, the response curve and the photograph against the laws and standards that they follow.
#include "Camera.h"
#include "ErrorText.h"
#include "Errors.h"
#include "Photograph.h"
#include "ThinLens.h"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <numeric>

#include <gtest/gtest.h>

namespace smokevis
{
namespace
{

std::string WrittenCurve(const std::string& text)
{
  const std::string name = testing::TempDir() + "/response.csv";
  std::ofstream(name) << text;
  return name;
}

std::string CurveError(const std::string& text)
{
  return test::ErrorText([&] { ResponseCurve::Read(WrittenCurve(text)); });
}

} // namespace

TEST(ThinLens, ObeysTheLensEquation)
{
  const ThinLens lens = ThinLens::Focused(0.05, 4.1);
  EXPECT_NEAR(lens.ObjectDistance + lens.ImageDistance, 4.1, 1e-14);
  EXPECT_NEAR(1.0 / lens.ObjectDistance + 1.0 / lens.ImageDistance, 20.0, 1e-12);
  EXPECT_GT(lens.ObjectDistance, lens.ImageDistance);
  EXPECT_NEAR(lens.Magnification(), lens.ImageDistance / lens.ObjectDistance, 1e-16);
  // Life size at four focal lengths, and no image nearer than that.
  EXPECT_NEAR(ThinLens::Focused(0.05, 0.2).Magnification(), 1.0, 1e-6);
  EXPECT_THROW(ThinLens::Focused(0.05, 0.19), Error);
  EXPECT_THROW(ThinLens::FocusedAtInfinity(0.0), Error);
  const ThinLens far = ThinLens::FocusedAtInfinity(0.05);
  EXPECT_EQ(far.ImageDistance, 0.05);
  EXPECT_EQ(far.Magnification(), 0.0);
  // From afar both focal planes lie at the focal length, to rounding.
  EXPECT_NEAR(ThinLens::Focused(0.05, 1e9).ImageDistance, 0.05, 1e-11);
}

TEST(ThinLens, BlursByTheTriangleOfRaysBehindTheLens)
{
  const ThinLens lens = ThinLens::Focused(0.05, 2.0);
  const double aperture = 0.02;
  for (const double distance : {0.7, 1.5, 3.0, 50.0})
  {
    const double image = 1.0 / (1.0 / 0.05 - 1.0 / distance);
    EXPECT_NEAR(lens.BlurDiameter(aperture, distance),
      aperture * std::abs(lens.ImageDistance - image) / image, 1e-12);
  }
  EXPECT_NEAR(lens.BlurDiameter(aperture, lens.ObjectDistance), 0.0, 1e-15);
}

TEST(Camera, SeesThePlaneInFocusAlikeThroughAllOfTheLens)
{
  Camera camera =
    Camera::LookAt({1.0, 2.0, 3.0}, {4.0, 3.0, 2.0}, {0.0, 0.0, 1.0}, 50.0, 36.0, 24.0, 90, 60);
  camera.Aperture = 0.1;
  camera.FocusDistance = 2.5;
  const auto inFocus = [&](const Camera& lens, double x, double y)
  {
    const Vec3 ray = lens.Direction(x, y);
    return lens.Position + ray * (2.5 / glm::dot(ray, camera.Forward));
  };
  Vec3 mean(0.0);
  double square = 0.0;
  for (int point = 0; point < 64; ++point)
  {
    const Camera lens = camera.ThroughLens(point, 64);
    const Vec3 off = lens.Position - camera.Position;
    mean += off / 64.0;
    square += glm::dot(off, off) / 64.0;
    EXPECT_NEAR(glm::dot(off, camera.Forward), 0.0, 1e-14);
    EXPECT_LT(glm::length(off), 0.05);
    EXPECT_LT(glm::distance(inFocus(lens, 7.0, 51.0), inFocus(camera, 7.0, 51.0)), 1e-12);
  }
  // Moments of a disc of radius R: 0 and R^2 / 2.
  EXPECT_LT(glm::length(mean), 0.001);
  EXPECT_NEAR(square, 0.5 * 0.05 * 0.05, 1e-6);
}

TEST(ResponseCurve, IsFilmLikeByDefault)
{
  const ResponseCurve film;
  // ISO 12232: the standard output sensitivity S gives 118 for 10 / S lx s.
  EXPECT_NEAR(film.Value(0.1), 118.0, 1e-9);
  EXPECT_EQ(film.Value(0.0), 0.0);
  EXPECT_EQ(film.Value(-1.0), 0.0);
  EXPECT_NEAR(film.Value(1e9), 255.0, 1e-9);
  double before = 0.0;
  for (double exposure = 1e-5; exposure < 10.0; exposure *= 1.3)
  {
    EXPECT_GT(film.Value(exposure), before);
    before = film.Value(exposure);
  }
  // At the exposure that saturates an ISO 100 sensor film still tells some light from more.
  EXPECT_LT(film.Value(0.78), 240.0);
}

TEST(ResponseCurve, ReadsATable)
{
  const ResponseCurve curve =
    ResponseCurve::Read(WrittenCurve("# a camera\nexposure, pixel_value\n0,0\n0.01,20\n\n1,220\n"));
  EXPECT_NEAR(curve.Value(0.005), 10.0, 1e-12);
  EXPECT_NEAR(curve.Value(0.1), 120.0, 1e-12);
  EXPECT_NEAR(curve.Value(7.0), 220.0, 1e-12);
}

TEST(ResponseCurve, SaysWhatIsWrongAndWhere)
{
  EXPECT_THROW(ResponseCurve::Read("no such file.csv"), Error);
  EXPECT_NE(CurveError("a,b\n").find("line 1: the header"), std::string::npos);
  EXPECT_NE(CurveError("exposure,pixel_value\n0,0,1\n").find("line 2"), std::string::npos);
  EXPECT_NE(
    CurveError("exposure,pixel_value\n0,x\n").find("'x' is not a number"), std::string::npos);
  EXPECT_NE(CurveError("exposure,pixel_value\n0,0\n1,256\n").find("line 3"), std::string::npos);
  EXPECT_NE(CurveError("exposure,pixel_value\n0,9\n1,8\n").find("falls"), std::string::npos);
  EXPECT_NE(CurveError("exposure,pixel_value\n0,9\n").find("fewer than two"), std::string::npos);
  EXPECT_NE(CurveError("exposure,pixel_value\nnan,9\n").find("not a number"), std::string::npos);
  EXPECT_NE(CurveError("exposure,pixel_value\r0,0\r1,300\r").find("line 3"), std::string::npos);
}

TEST(Photograph, IsExposedByTheStandards)
{
  ExposureSettings settings;
  settings.FNumber = 16.0;
  // Exposure value 15 at ISO 100 is 4096 cd/m2 (K = 12.5), or 1/128 s at f/16.
  EXPECT_NEAR(MeteredTime(4096.0, settings), 1.0 / 128.0, 1e-12);
  EXPECT_EQ(MeteredTime(0.0, settings), 30.0);
  EXPECT_EQ(MeteredTime(1e12, settings), 1.0 / 8000.0);
  settings.FNumber = 2.0;
  EXPECT_NEAR(FocalPlaneExposure(100.0, settings, 0.01), 0.65 * 100.0 * 0.01 / 4.0, 1e-15);
  settings.Magnification = 1.0;
  EXPECT_NEAR(FocalPlaneExposure(100.0, settings, 0.01), 0.65 * 100.0 * 0.01 / 16.0, 1e-15);
}

TEST(Photograph, HasTheIlluminanceOfTheStandard)
{
  // ISO 12232: pi/4 T v cos^4(a) L f^2 / (N i)^2 with T = 0.9, v = 0.98 and a = 10 degrees, and the
  // image at a distance i behind the lens. The standard rounds the factors' 0.6516 to 0.65.
  const double factor = 0.25 * 3.14159265358979 * 0.9 * 0.98 * std::pow(std::cos(0.174532925), 4.0);
  for (const double focus : {0.25, 0.6, 4.0, 1e6})
  {
    const ThinLens lens = ThinLens::Focused(0.05, focus);
    ExposureSettings settings;
    settings.FNumber = 5.6;
    settings.Magnification = lens.Magnification();
    const double stop = 5.6 * lens.ImageDistance / 0.05;
    EXPECT_NEAR(SensorIlluminance(80.0, settings) / (factor * 80.0 / (stop * stop)), 1.0, 3e-3);
    EXPECT_NEAR(
      FocalPlaneExposure(80.0, settings, 0.02), 0.02 * SensorIlluminance(80.0, settings), 1e-15);
  }
}

TEST(Photograph, KeepsAMeteredGreyInTheMiddle)
{
  // 0.65 * 12.5 = 8.125 lx s over the speed, a little below the 10 that give 118.
  ExposureSettings settings;
  const std::vector<float> grey(10, 3.0F);
  const Photograph photograph = TakePhotograph(grey, 1, settings, ResponseCurve());
  EXPECT_NEAR(photograph.Values[0], 107, 1);
  settings.Iso = 1600.0;
  EXPECT_EQ(TakePhotograph(grey, 1, settings, ResponseCurve()).Values, photograph.Values);
  settings.Time = 10.0 / (0.65 * 3.0 * 1600.0) * settings.FNumber * settings.FNumber;
  EXPECT_EQ(TakePhotograph(grey, 1, settings, ResponseCurve()).Values[3], 118);
}

TEST(Photograph, HasTheNoiseThatWasAskedFor)
{
  // A linear response, so that the noise of the values is that of the exposure.
  const ResponseCurve linear =
    ResponseCurve::Read(WrittenCurve("exposure,pixel_value\n0,0\n2.55,255\n"));
  ExposureSettings settings;
  settings.FNumber = 1.0;
  settings.Time = 1.0;
  // 1 lx s is a value of 100; the noise 0.1 * 0.78 lx s or 7.8.
  const std::vector<float> grey(20000, static_cast<float>(1.0 / 0.65));
  EXPECT_EQ(TakePhotograph(grey, 1, settings, linear).Values[0], 100);
  settings.ReadNoise = 0.1;
  const auto values = TakePhotograph(grey, 1, settings, linear).Values;
  EXPECT_EQ(values, TakePhotograph(grey, 1, settings, linear).Values);
  const double mean =
    std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  double variance = 0.0;
  for (const double value : values)
  {
    variance += (value - mean) * (value - mean) / static_cast<double>(values.size());
  }
  // Four standard errors; rounding to whole values adds 1/12 to the variance.
  EXPECT_NEAR(mean, 100.0, 4.0 * 7.8 / std::sqrt(20000.0));
  EXPECT_NEAR(std::sqrt(variance - 1.0 / 12.0), 7.8, 4.0 * 7.8 / std::sqrt(40000.0));
  settings.Seed = 2;
  EXPECT_NE(values, TakePhotograph(grey, 1, settings, linear).Values);
}

} // namespace smokevis
