// Boxes that lines bring most of the noise through.
#include "NoisyBoxes.h"

#include "GlobalLines.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

const Box Building = {{-1, 2, 0}, {9, 6, 3}};
constexpr std::size_t LineCount = 20000;

/// Whether a line meets a box.
bool MeetsBox(const SurveyedLine& line, const Box& box)
{
  double begin = 0.0;
  double end = std::numeric_limits<double>::infinity();
  return box.Clip(Building.Lower + Vec3(line.Origin), 1.0 / Vec3(line.Direction), begin, end);
}

/// Lines all over the scene.
/// @param square of what each brings
std::vector<SurveyedLine> Survey(const std::function<float(const SurveyedLine&)>& square)
{
  const GlobalLines lines(Building, LineCount);
  const GlobalLines::Draw draw(lines, 5);
  std::vector<SurveyedLine> surveyed;
  for (std::size_t i = 0; i < LineCount; ++i)
  {
    const GlobalLines::Line line = draw.Get(i);
    surveyed.push_back(
      {line.Origin - Building.Lower, line.Direction, static_cast<float>(line.Density()), 0.0F});
    surveyed.back().Square = square(surveyed.back());
  }
  return surveyed;
}

// A door of which each line brings a hundred times as much as others gets several times its lines,
// and other boxes lie at it.
TEST(NoisyBoxes, AreFound)
{
  const Box door = {{4, 3.5, 0}, {4.25, 4.5, 2}};
  const auto lines =
    Survey([&](const SurveyedLine& line) { return MeetsBox(line, door) ? 100.0F : 1.0F; });
  const std::vector<NoisyBox> boxes = FindNoisyBoxes(lines, Building, LineCount);
  ASSERT_FALSE(boxes.empty());
  const Box& found = boxes.front().Bounds;
  EXPECT_TRUE(found.Contains(door.Centre()));
  EXPECT_LT(found.Surface(), 2.0 * door.Surface());
  const double met = static_cast<double>(std::count_if(
    lines.begin(), lines.end(), [&](const SurveyedLine& line) { return MeetsBox(line, door); }));
  EXPECT_GT(boxes.front().Lines, 3.0 * met);
  double more = 0.0;
  for (const NoisyBox& box : boxes)
  {
    EXPECT_TRUE(box.Bounds.Meets(door));
    more += box.Lines;
  }
  EXPECT_LE(more, LineCount);
}

// Where lines bring about as much everywhere, or a few bring all, no place needs more.
TEST(NoisyBoxes, NoneWhereNoiseIsEven)
{
  EXPECT_TRUE(FindNoisyBoxes({}, Building, LineCount).empty());
  EXPECT_TRUE(
    FindNoisyBoxes(Survey([](const SurveyedLine&) { return 0.0F; }), Building, LineCount).empty());
  EXPECT_TRUE(FindNoisyBoxes(
    Survey([](const SurveyedLine& line) { return 1.0F + line.Direction.x; }), Building, LineCount)
                .empty());
  const Box speck = {{4, 3.5, 0}, {4.1, 3.6, 0.1}};
  const auto few =
    Survey([&](const SurveyedLine& line) { return MeetsBox(line, speck) ? 1e9F : 1.0F; });
  EXPECT_TRUE(FindNoisyBoxes(few, Building, LineCount).empty());
}

// A sweep of more lines than were surveyed gets as many more as it is larger.
TEST(NoisyBoxes, LinesAreASweeps)
{
  const Box door = {{4, 3.5, 0}, {4.25, 4.5, 2}};
  auto lines =
    Survey([&](const SurveyedLine& line) { return MeetsBox(line, door) ? 100.0F : 1.0F; });
  const std::vector<NoisyBox> boxes = FindNoisyBoxes(lines, Building, LineCount);
  ASSERT_FALSE(boxes.empty());
  for (SurveyedLine& line : lines)
  {
    line.Density *= 3.0F;
  }
  const std::vector<NoisyBox> more = FindNoisyBoxes(lines, Building, 3 * LineCount);
  ASSERT_EQ(more.size(), boxes.size());
  for (std::size_t box = 0; box < boxes.size(); ++box)
  {
    EXPECT_NEAR(more[box].Lines / boxes[box].Lines, 3.0, 0.01);
  }
}

} // namespace
