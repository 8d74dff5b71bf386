// Lines through a scene: what they carry, with and without lines through the smoke's box alone.
#include "GlobalLines.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

struct Sums
{
  /// Mean number of lines that meet a body, and the sum of their weights times their lengths in it,
  /// with its standard error.
  double Meetings = 0.0;
  double Chords = 0.0;
  double Error = 0.0;
};

Sums Through(const GlobalLines& lines, const Box& body)
{
  constexpr int draws = 400;
  Sums sums;
  double squares = 0.0;
  for (int draw = 0; draw < draws; ++draw)
  {
    const GlobalLines::Draw these(lines, 1000 + draw);
    double chords = 0.0;
    for (std::size_t i = 0; i < lines.Count(); ++i)
    {
      const GlobalLines::Line line = these.Get(i);
      double begin = 0.0;
      double end = line.Length;
      if (body.Clip(line.Origin, 1.0 / line.Direction, begin, end))
      {
        sums.Meetings += 1.0 / draws;
        chords += line.Weight * (end - begin);
      }
    }
    sums.Chords += chords / draws;
    squares += chords * chords / draws;
  }
  sums.Error = std::sqrt((squares - sums.Chords * sums.Chords) / (draws - 1));
  return sums;
}

// The path lengths of all directed lines in a body sum to 4 pi volumes; a line serves both ways.
TEST(GlobalLines, ChordsFillEveryBody)
{
  const Box scene = {{-150, -150, -1}, {150, 150, 10}};
  const Box smoke = {{0, 0, 0}, {4, 3, 2.5}};
  const Box inSmoke = {{1, 1, 0.5}, {2, 1.7, 1.5}};
  const Box outside = {{-60, -40, 0}, {-20, 10, 5}};
  const Box across = {{3, 2, 1}, {30, 20, 9}};
  const GlobalLines plain(scene, 2000);
  GlobalLines both(scene, 2000);
  both.AddInner(smoke, 300);
  GlobalLines nested = both;
  nested.AddInner({{0.5, 0.5, 0}, {2.5, 2, 2}}, 100);
  nested.AddInner({{0.8, 0.8, 0.2}, {3.5, 2.5, 2}}, 100);
  // Lines that join places are not counted on: they come beside the others.
  GlobalLines joined = nested;
  joined.AddJoining(smoke, smoke, 300);
  joined.AddJoining({{1, 1, 0}, {1.5, 2, 1}}, scene, 300);
  joined.AddJoining({{0.5, 0.5, 0.1}, {3, 2, 0.4}}, smoke, 300);
  for (const GlobalLines& lines : {plain, both, nested, joined})
  {
    for (const Box& body : {inSmoke, outside, across, smoke})
    {
      const Vec3 size = body.Upper - body.Lower;
      const Sums sums = Through(lines, body);
      // Four standard errors: of eight values hardly one in a thousand runs would be refused.
      EXPECT_NEAR(sums.Chords, 2.0 * std::numbers::pi * size.x * size.y * size.z, 4.0 * sums.Error);
    }
    // Cauchy's formula, to four standard errors of a count; lines through the smoke go on outside.
    for (const Box& body : {inSmoke, outside})
    {
      const bool inside = smoke.Contains(body.Lower);
      const double least = lines.Meetings(body.Surface(), body);
      const double meetings = Through(lines, body).Meetings;
      const double error = std::sqrt(least / 400.0);
      EXPECT_GT(meetings, least - 4.0 * error);
      if ((inside && lines.Count() != joined.Count()) || lines.Count() == plain.Count())
      {
        EXPECT_LT(meetings, least + 4.0 * error);
      }
    }
  }
}

// Two places in a corridor lie a third of its length apart in the mean; a line through the corridor
// runs four times its volume over its surface.
TEST(GlobalLines, SomeRunFar)
{
  const Box corridor = {{0, 0, 0}, {30, 2, 2}};
  const auto meanLength = [](const GlobalLines& lines)
  {
    const GlobalLines::Draw draw(lines, 7);
    double sum = 0.0;
    for (std::size_t i = 0; i < lines.Count(); ++i)
    {
      sum += draw.Get(i).Length;
    }
    return sum / static_cast<double>(lines.Count());
  };
  const double chord = 4.0 * corridor.Volume() / corridor.Surface();
  GlobalLines lines(corridor, 4000);
  // The standard deviation of a chord is about itself: five standard errors.
  EXPECT_NEAR(meanLength(lines), chord, 0.08 * chord);
  lines.AddJoining(corridor, corridor, 4000);
  EXPECT_GT(meanLength(lines), 0.5 * (chord + 10.0));
}

TEST(GlobalLines, BeginAndEndOnTheScenesBorder)
{
  const Box scene = {{-10, -10, -1}, {10, 10, 10}};
  GlobalLines lines(scene, 500);
  lines.AddInner({{0, 0, 0}, {1, 1, 1}}, 500);
  lines.AddJoining({{0, 0, 0}, {1, 1, 1}}, {{0, 0, 0}, {1, 1, 1}}, 500);
  lines.AddJoining({{0, 0, 0}, {1, 1, 1}}, scene, 500);
  const GlobalLines::Draw draw(lines, 7);
  const auto onBorder = [&scene](const Vec3& point)
  {
    const Vec3 gap = glm::min(glm::abs(point - scene.Lower), glm::abs(point - scene.Upper));
    return std::min({gap.x, gap.y, gap.z}) < 1e-9;
  };
  for (std::size_t i = 0; i < lines.Count(); ++i)
  {
    const GlobalLines::Line line = draw.Get(i);
    EXPECT_NEAR(glm::length(line.Direction), 1.0, 1e-12);
    EXPECT_TRUE(onBorder(line.Origin));
    EXPECT_TRUE(onBorder(line.Origin + line.Length * line.Direction));
  }
}

} // namespace
