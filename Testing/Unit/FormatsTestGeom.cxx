// Complex geometry. FDS writes it only where it was built with more libraries than the runs at
// hand, so these files are built from the format.
#include "ErrorText.h"
#include "FormatsTestRun.h"
#include "GeomFile.h"

#include <gmock/gmock.h>

#include <cmath>

using testing::ElementsAre;
using testing::HasSubstr;

namespace smokevis
{

namespace
{

// A cube of this size, as eight points and twelve triangles that face outwards.
struct Cube
{
  explicit Cube(float size)
  {
    for (int corner = 0; corner < 8; ++corner)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        Points.push_back((corner >> axis & 1) != 0 ? size : 0.0F);
      }
    }
  }
  std::vector<float> Points;
  std::vector<int> Triangles{1, 3, 2, 2, 3, 4, 5, 6, 7, 6, 8, 7, 1, 2, 5, 2, 6, 5, 3, 7, 4, 4, 7, 8,
    1, 5, 3, 3, 5, 7, 2, 4, 6, 4, 8, 6};
};

void AddFrame(test::Records& records, float time, const Cube& cube, bool cutFaces, int surface)
{
  const auto n = static_cast<int>(cube.Triangles.size() / 3);
  records.Add(std::vector<float>{time});
  records.Add(std::vector<int>{static_cast<int>(cube.Points.size() / 3), n, 0});
  records.Add(cube.Points).Add(cube.Triangles);
  if (cutFaces)
  {
    records.Add(std::vector<int>(n, 0))
      .Add(std::vector<int>(n, surface))
      .Add(std::vector<int>(n, 1));
  }
  else
  {
    records.Add(std::vector<int>(n, surface)).Add(std::vector<float>(6 * n, 0.5F));
  }
}

test::Records Header(bool swapped, bool fixed, int version = 2)
{
  test::Records records(swapped);
  records.Add(std::vector<int>{1}).Add(std::vector<int>{version});
  records.Add(std::vector<int>{2, 1, fixed ? 1 : 0});
  records.Add(std::vector<float>{1.0F, 2.0F}).Add(std::vector<int>{7});
  return records;
}

// Area, and volume by the divergence theorem: positive where triangles face outwards.
std::pair<double, double> Measure(const GeomTriangles& solid)
{
  double area = 0.0;
  double volume = 0.0;
  for (const auto& [a, b, c] : solid.Triangles)
  {
    const auto& p = solid.Points[a];
    const auto& q = solid.Points[b];
    const auto& r = solid.Points[c];
    std::array<double, 3> n{};
    for (int i = 0; i < 3; ++i)
    {
      const int j = (i + 1) % 3;
      const int k = (i + 2) % 3;
      n[i] = (q[j] - p[j]) * (r[k] - p[k]) - (q[k] - p[k]) * (r[j] - p[j]);
    }
    area += 0.5 * std::hypot(n[0], n[1], n[2]);
    volume += (n[0] * p[0] + n[1] * p[1] + n[2] * p[2]) / 6.0;
  }
  return {area, volume};
}

std::string GeomError(const std::string& path)
{
  return test::ErrorText([&] { GeomFile(path, false).Read(0.0); });
}

} // namespace

TEST(GeomFile, ReadsSolidsThatFaceTheGas)
{
  test::Folder folder("geom");
  for (const bool swapped : {false, true})
  {
    for (const bool cutFaces : {false, true})
    {
      test::Records records = Header(swapped, true);
      AddFrame(records, 0.0F, Cube(2.0F), cutFaces, 3);
      GeomFile file(folder.Write("a.ge", records.Bytes()), cutFaces);
      EXPECT_FALSE(file.Moves());
      const GeomTriangles solid = file.Read(5.0);
      const auto [area, volume] = Measure(solid);
      EXPECT_NEAR(area, 24.0, 1e-6);
      EXPECT_NEAR(volume, 8.0, 1e-6);
      EXPECT_THAT(solid.Surfaces, testing::Each(3));
      EXPECT_EQ(file.Damage(), "");
    }
  }
}

TEST(GeomFile, MovesInTime)
{
  test::Folder folder("geommoves");
  test::Records records = Header(false, true);
  AddFrame(records, 0.0F, Cube(1.0F), false, 0);
  AddFrame(records, 10.0F, Cube(2.0F), false, 0);
  AddFrame(records, 20.0F, Cube(3.0F), false, 0);
  GeomFile file(folder.Write("a.ge", records.Bytes()), false);
  EXPECT_TRUE(file.Moves());
  EXPECT_NEAR(Measure(file.Read(0.0)).second, 1.0 + 8.0, 1e-5);
  EXPECT_NEAR(Measure(file.Read(19.9)).second, 1.0 + 8.0, 1e-5);
  EXPECT_NEAR(Measure(file.Read(20.0)).second, 1.0 + 27.0, 1e-5);
}

TEST(GeomFile, NamesWhatIsWrong)
{
  test::Folder folder("geomwrong");
  EXPECT_THAT(GeomError(folder.Path("none.ge")), HasSubstr("cannot be opened"));
  EXPECT_THAT(GeomError(folder.Write("a.ge", "a text")), HasSubstr("first record"));
  EXPECT_THAT(
    GeomError(folder.Write("a.ge", Header(false, true, 1).Bytes())), HasSubstr("version 1"));
  EXPECT_THAT(
    GeomError(folder.Write("a.ge", Header(false, true).Bytes())), HasSubstr("no whole frame"));
  test::Records corner = Header(false, true);
  Cube wrong(1.0F);
  wrong.Triangles[4] = 9;
  AddFrame(corner, 0.0F, wrong, false, 0);
  EXPECT_THAT(GeomError(folder.Write("a.ge", corner.Bytes())),
    HasSubstr("triangle 2 of the geometry has point 9 of 8"));
  test::Records nan = Header(false, true);
  Cube lost(1.0F);
  lost.Points[5] = std::nanf("");
  AddFrame(nan, 0.0F, lost, false, 0);
  EXPECT_THAT(GeomError(folder.Write("a.ge", nan.Bytes())),
    HasSubstr("point 2 of the geometry is not finite"));
  // Counts that no file of this size can hold.
  test::Records huge = Header(false, true);
  huge.Add(std::vector<float>{0.0F}).Add(std::vector<int>{1000000000, 2000000000, 1000000000});
  EXPECT_THAT(GeomError(folder.Write("a.ge", huge.Bytes())), HasSubstr("cut short or damaged"));
}

} // namespace smokevis
