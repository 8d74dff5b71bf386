// The course of light over the plate of a sign.
#include "PlateCourse.h"
#include "ReferenceIntegrator.h"
#include "SceneLibrary.h"

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

constexpr double Width = 0.6;
constexpr double Height = 0.2;

/// Three bars, and two triangles in the place of a fourth, askew in space.
EmitterSet Lights()
{
  const Vec3 normal = glm::normalize(Vec3(-1.0, 0.4, 0.0));
  std::vector<EmitterCell> cells =
    scenes::Barcode({5, 2, 1}, normal, {0, 0, 1}, Width, Height, 4, 0.0, 0, 0.5);
  const EmitterCell last = cells.back();
  cells.pop_back();
  for (const int first : {0, 2})
  {
    EmitterCell half = last;
    half.Vertices = {
      last.Vertices[first], last.Vertices[first + 1], last.Vertices[(first + 2) % 4]};
    cells.push_back(half);
  }
  EmitterSet lights(std::move(cells), 1);
  lights.FormLights(1e9);
  return lights;
}

using Function = std::function<double(double along, double up)>;

/// Along the edges of the rectangle around the sign, in metres.
double ValueAt(const Function& light, const Sign& sign, const Vec3& point)
{
  return light(glm::dot(point - sign.Corners[0], glm::normalize(sign.Corners[1] - sign.Corners[0])),
    glm::dot(point - sign.Corners[0], glm::normalize(sign.Corners[3] - sign.Corners[0])));
}

PlateCourse CourseOf(
  const Function& light, const Sign& sign, const std::function<double(int batch)>& noise)
{
  std::array<DoubleLanes, PlateCourse::Places> values{};
  for (std::size_t place = 0; place < values.size(); ++place)
  {
    for (int batch = 0; batch < Batches; ++batch)
    {
      values[place][batch] = ValueAt(light, sign, PlateCourse::Place(sign, place)) + noise(batch);
    }
  }
  return PlateCourse(values);
}

/// Mean over a polygon, by the middles of small parts of the triangles of its fan.
double MeanOver(const Function& light, const Sign& sign, const std::vector<Vec3>& polygon)
{
  constexpr int Steps = 200;
  double sum = 0.0;
  double weights = 0.0;
  for (std::size_t corner = 1; corner + 1 < polygon.size(); ++corner)
  {
    const Vec3 first = polygon[corner] - polygon[0];
    const Vec3 second = polygon[corner + 1] - polygon[0];
    const double area = glm::length(glm::cross(first, second));
    for (int i = 0; i < Steps; ++i)
    {
      for (int j = 0; j < Steps; ++j)
      {
        // A parallelogram folded onto the triangle.
        double u = (i + 0.5) / Steps;
        double v = (j + 0.5) / Steps;
        if (u + v > 1.0)
        {
          u = 1.0 - u;
          v = 1.0 - v;
        }
        sum += area * ValueAt(light, sign, polygon[0] + u * first + v * second);
        weights += area;
      }
    }
  }
  return sum / weights;
}

TEST(PlateCourse, IsExactForQuadratics)
{
  const EmitterSet lights = Lights();
  const Sign& sign = lights.Signs()[0];
  ASSERT_EQ(sign.Cells.size(), 5U);
  const Function light = [](double along, double up)
  { return 3.0 + 2.0 * along - 4.0 * up + along * along + 5.0 * along * up - 2.0 * up * up; };
  const PlateCourse course = CourseOf(light, sign, [](int) { return 0.0; });
  const std::vector<PlateCourse::CellLight> cells = course.Cells(lights, sign);
  ASSERT_EQ(cells.size(), sign.Cells.size());
  std::vector<double> means;
  double whole = 0.0;
  for (const std::size_t cell : sign.Cells)
  {
    means.push_back(MeanOver(light, sign, lights.Cells()[cell].Vertices));
    whole += lights.CellArea(cell) / (Width * Height) * means.back();
  }
  const Vec3 along = glm::normalize(sign.Corners[1] - sign.Corners[0]);
  const Vec3 up = glm::normalize(sign.Corners[3] - sign.Corners[0]);
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    // The middles of parts of 1/200 are off by some 1e-5 of the bends.
    EXPECT_NEAR(cells[i].Share[0], means[i] / whole, 1e-5);
    EXPECT_NEAR(cells[i].Share[Batches - 1], means[i] / whole, 1e-5);
    const Vec3 centre = lights.CellCentre(sign.Cells[i]);
    const double a = glm::dot(centre - sign.Corners[0], along);
    const double b = glm::dot(centre - sign.Corners[0], up);
    const Vec3 gradient = (2.0 + 2.0 * a + 5.0 * b) * along + (-4.0 + 5.0 * a - 4.0 * b) * up;
    EXPECT_LT(glm::length(cells[i].Gradient - gradient / means[i]), 1e-4);
  }
}

// What each place gets differs by noise alone: nothing is told of the course. Of light that varies
// by ten times as much little is left out.
TEST(PlateCourse, LeavesNoiseOut)
{
  const EmitterSet lights = Lights();
  const Sign& sign = lights.Signs()[0];
  constexpr double Noise = 0.1;
  constexpr int Trials = 200;
  int even = 0;
  double kept = 0.0;
  for (int trial = 0; trial < Trials; ++trial)
  {
    Pcg32 random(1, trial);
    const auto noise = [&](int) { return Noise * std::sqrt(12.0) * (random.Uniform() - 0.5); };
    const auto flat = CourseOf([](double, double) { return 1.0; }, sign, noise).Cells(lights, sign);
    even += glm::length(flat[0].Gradient) == 0.0 && flat[0].Share[0] == 1.0 ? 1 : 0;
    // From 0.57 to 1.43 of its mean: a deviation of 0.25 of it, of the noise of a mean 0.025.
    const auto steep =
      CourseOf([](double along, double) { return 0.57 + 0.86 * along / Width; }, sign, noise)
        .Cells(lights, sign);
    kept += (Mean(steep[0].Share) - 1.0) / (-0.86 * 0.375) / Trials;
  }
  // Of 8 values that differ by noise alone, the variance is 2 FewBatches^2 times its mean once in
  // 66 times (chi-square of 8 degrees of freedom, 0.015 above 19).
  EXPECT_GT(even, 0.9 * Trials);
  EXPECT_LT(even, Trials);
  EXPECT_NEAR(kept, 1.0, 0.03);
}

// A quadratic that falls to nothing within a plate is let no lower.
TEST(PlateCourse, IsNowhereNegative)
{
  const EmitterSet lights = Lights();
  const Sign& sign = lights.Signs()[0];
  const PlateCourse course =
    CourseOf([](double along, double) { return std::max(0.0, 1.0 - 3.0 * along / Width); }, sign,
      [](int) { return 0.0; });
  double sum = 0.0;
  for (const PlateCourse::CellLight& cell : course.Cells(lights, sign))
  {
    EXPECT_GE(Mean(cell.Share), 0.0);
    sum += Mean(cell.Share);
  }
  EXPECT_GT(sum, 1.0);
}

} // namespace
