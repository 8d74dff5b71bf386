// Block letters and the running man as polygons.
#include "SignFigures.h"

#include "Errors.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

namespace smokevis
{
namespace
{

using Line = std::vector<glm::dvec2>;

/// Stroke and gap of letters over their height, and widths of broad letters and of most.
constexpr double LetterStroke = 0.125;
constexpr double LetterGap = 0.125;
constexpr double LetterWidth = 0.6;
constexpr double BroadWidth = 0.8;

/// The middle lines of a letter's strokes: 0 to 1 across and up between the middles of its
/// outermost strokes.
struct Letter
{
  double Width;
  std::vector<Line> Lines;
};

const std::map<char, Letter>& Letters()
{
  constexpr double w = LetterWidth;
  constexpr double s = LetterStroke;
  // Rounded corners are cut off by so much of the width and height.
  constexpr double x = 0.3;
  constexpr double y = 0.18;
  static const Line ring = {
    {x, 0}, {1 - x, 0}, {1, y}, {1, 1 - y}, {1 - x, 1}, {x, 1}, {0, 1 - y}, {0, y}, {x, 0}};
  static const std::map<char, Letter> letters = {
    {'A', {w, {{{0, 0}, {0.5, 1}, {1, 0}}, {{0.2, 0.3}, {0.8, 0.3}}}}},
    {'B', {w, {{{0, 0}, {0, 1}, {1 - x, 1}, {1, 1 - y}, {1, 0.5 + y}, {1 - x, 0.5}, {0, 0.5}},
                {{1 - x, 0.5}, {1, 0.5 - y}, {1, y}, {1 - x, 0}, {0, 0}}}}},
    {'C', {w, {{{1, 0.25}, {1, y}, {1 - x, 0}, {x, 0}, {0, y}, {0, 1 - y}, {x, 1}, {1 - x, 1},
                {1, 1 - y}, {1, 0.75}}}}},
    {'D', {w, {{{0, 0}, {0, 1}, {1 - x, 1}, {1, 1 - y}, {1, y}, {1 - x, 0}, {0, 0}}}}},
    {'E', {w, {{{1, 0}, {0, 0}, {0, 1}, {1, 1}}, {{0, 0.5}, {0.85, 0.5}}}}},
    {'F', {w, {{{0, 0}, {0, 1}, {1, 1}}, {{0, 0.5}, {0.85, 0.5}}}}},
    {'G', {w, {{{1, 0.75}, {1, 1 - y}, {1 - x, 1}, {x, 1}, {0, 1 - y}, {0, y}, {x, 0}, {1 - x, 0},
                {1, y}, {1, 0.45}, {0.6, 0.45}}}}},
    {'H', {w, {{{0, 0}, {0, 1}}, {{1, 0}, {1, 1}}, {{0, 0.5}, {1, 0.5}}}}},
    {'I', {s, {{{0, 0}, {0, 1}}}}},
    {'J', {w, {{{1, 1}, {1, y}, {1 - x, 0}, {x, 0}, {0, y}, {0, 0.25}}}}},
    {'K', {w, {{{0, 0}, {0, 1}}, {{0, 0.4}, {1, 1}}, {{0.3, 0.55}, {1, 0}}}}},
    {'L', {w, {{{0, 1}, {0, 0}, {1, 0}}}}},
    {'M', {BroadWidth, {{{0, 0}, {0, 1}, {0.5, 0.35}, {1, 1}, {1, 0}}}}},
    {'N', {w, {{{0, 0}, {0, 1}, {1, 0}, {1, 1}}}}}, {'O', {w, {ring}}},
    {'P', {w, {{{0, 0}, {0, 1}, {1 - x, 1}, {1, 1 - y}, {1, 0.45 + y}, {1 - x, 0.45}, {0, 0.45}}}}},
    {'Q', {w, {ring, {{0.6, 0.25}, {1, 0}}}}},
    {'R', {w, {{{0, 0}, {0, 1}, {1 - x, 1}, {1, 1 - y}, {1, 0.45 + y}, {1 - x, 0.45}, {0, 0.45}},
                {{0.5, 0.45}, {1, 0}}}}},
    {'S',
      {w, {{{0, 0.3}, {0, y}, {x, 0}, {1 - x, 0}, {1, y}, {1, 0.5 - 0.5 * y}, {1 - x, 0.5},
            {x, 0.5}, {0, 0.5 + 0.5 * y}, {0, 1 - y}, {x, 1}, {1 - x, 1}, {1, 1 - y}, {1, 0.7}}}}},
    {'T', {w, {{{0, 1}, {1, 1}}, {{0.5, 0}, {0.5, 1}}}}},
    {'U', {w, {{{0, 1}, {0, y}, {x, 0}, {1 - x, 0}, {1, y}, {1, 1}}}}},
    {'V', {w, {{{0, 1}, {0.5, 0}, {1, 1}}}}},
    {'W', {BroadWidth, {{{0, 1}, {0.25, 0}, {0.5, 0.7}, {0.75, 0}, {1, 1}}}}},
    {'X', {w, {{{0, 0}, {1, 1}}, {{0, 1}, {1, 0}}}}},
    {'Y', {w, {{{0, 1}, {0.5, 0.45}, {1, 1}}, {{0.5, 0.45}, {0.5, 0}}}}},
    {'Z', {w, {{{0, 1}, {1, 1}, {0, 0}, {1, 0}}}}},
    {'0', {w, {ring, {{0.25, 0.25}, {0.75, 0.75}}}}}, {'1', {0.35, {{{0, 0.75}, {1, 1}, {1, 0}}}}},
    {'2', {w, {{{0, 0.7}, {0, 1 - y}, {x, 1}, {1 - x, 1}, {1, 1 - y}, {1, 0.6}, {0, 0}, {1, 0}}}}},
    {'3', {w, {{{0, 1}, {1, 1}, {0.45, 0.55}, {1 - x, 0.55}, {1, 0.55 - y}, {1, y}, {1 - x, 0},
                {x, 0}, {0, y}}}}},
    {'4', {w, {{{0.75, 0}, {0.75, 1}, {0, 0.3}, {1, 0.3}}}}},
    {'5', {w, {{{1, 1}, {0, 1}, {0, 0.55}, {1 - x, 0.55}, {1, 0.55 - y}, {1, y}, {1 - x, 0}, {x, 0},
                {0, y}}}}},
    {'6', {w, {{{1, 0.7}, {1, 1 - y}, {1 - x, 1}, {x, 1}, {0, 1 - y}, {0, y}, {x, 0}, {1 - x, 0},
                {1, y}, {1, 0.5 - y}, {1 - x, 0.5}, {0, 0.5}}}}},
    {'7', {w, {{{0, 1}, {1, 1}, {0.3, 0}}}}},
    {'8', {w, {{{x, 0.5}, {0, 0.5 + y}, {0, 1 - y}, {x, 1}, {1 - x, 1}, {1, 1 - y}, {1, 0.5 + y},
                {1 - x, 0.5}, {x, 0.5}, {0, 0.5 - y}, {0, y}, {x, 0}, {1 - x, 0}, {1, y},
                {1, 0.5 - y}, {1 - x, 0.5}}}}},
    {'9', {w, {{{0, 0.3}, {0, y}, {x, 0}, {1 - x, 0}, {1, y}, {1, 1 - y}, {1 - x, 1}, {x, 1},
                {0, 1 - y}, {0, 0.5 + y}, {x, 0.5}, {1, 0.5}}}}},
    {'-', {0.4, {{{0, 0.5}, {1, 0.5}}}}}, {'.', {s, {{{0, 0}, {0, 0.001}}}}},
    {'/', {w, {{{0, 0}, {1, 1}}}}},
    {'&', {w, {{{1, 0}, {0.2, 0.75}, {0.2, 0.9}, {0.4, 1}, {0.6, 0.9}, {0.6, 0.75}, {0, 0.3},
                {0, 0.12}, {0.2, 0}, {0.6, 0}, {1, 0.4}}}}},
    {'!', {s, {{{0, 0.3}, {0, 1}}, {{0, 0}, {0, 0.001}}}}}, {'\'', {s, {{{0, 0.75}, {0, 1}}}}},
    {'+', {w, {{{0.5, 0.2}, {0.5, 0.8}}, {{0, 0.5}, {1, 0.5}}}}}, {' ', {0.4, {}}}};
  return letters;
}

/// The part of a convex polygon within a box.
FigurePolygon ClipToBox(FigurePolygon polygon, const glm::dvec2& low, const glm::dvec2& high)
{
  for (int side = 0; side < 4; ++side)
  {
    const int axis = side % 2;
    const double sign = side < 2 ? 1.0 : -1.0;
    const double line = side < 2 ? low[axis] : high[axis];
    FigurePolygon kept;
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
      const glm::dvec2& here = polygon[i];
      const glm::dvec2& next = polygon[(i + 1) % polygon.size()];
      const double a = sign * (here[axis] - line);
      const double b = sign * (next[axis] - line);
      if (a >= 0.0)
      {
        kept.push_back(here);
      }
      if ((a > 0.0 && b < 0.0) || (a < 0.0 && b > 0.0))
      {
        kept.push_back(here + a / (a - b) * (next - here));
      }
    }
    polygon = std::move(kept);
  }
  return polygon;
}

FigurePolygon Disc(const glm::dvec2& centre, double radius)
{
  constexpr int corners = 24;
  FigurePolygon disc;
  for (int i = 0; i < corners; ++i)
  {
    const double angle = 2.0 * 3.14159265358979323846 * i / corners;
    disc.push_back(centre + radius * glm::dvec2(std::cos(angle), std::sin(angle)));
  }
  return disc;
}

} // namespace

//------------------------------------------------------------------------------
SignFigure TextFigure(const std::string& text, const std::string& where)
{
  SignFigure figure;
  double left = 0.0;
  for (const char given : text)
  {
    const char capital = static_cast<char>(std::toupper(static_cast<unsigned char>(given)));
    const auto found = Letters().find(capital);
    if (found == Letters().end())
    {
      throw Error(where, "the text '" + text + "' holds a character that there is no letter for",
        "Write A to Z, 0 to 9, blanks and - . / & ! ' +, or give an image");
    }
    const Letter& letter = found->second;
    const glm::dvec2 low(left, 0.0);
    const glm::dvec2 high(left + letter.Width, 1.0);
    const glm::dvec2 size = high - low - LetterStroke;
    for (const Line& line : letter.Lines)
    {
      Line points;
      for (const glm::dvec2& point : line)
      {
        points.push_back(low + 0.5 * LetterStroke + size * point);
      }
      for (const FigurePolygon& part : Stroke(points, LetterStroke))
      {
        FigurePolygon inside = ClipToBox(part, low, high);
        if (inside.size() > 2)
        {
          figure.Polygons.push_back(std::move(inside));
        }
      }
    }
    left = high.x + LetterGap;
  }
  if (figure.Polygons.empty())
  {
    throw Error(where, "its text has no letters", "Write for example EXIT");
  }
  figure.Width = left - LetterGap;
  return figure;
}

//------------------------------------------------------------------------------
SignFigure RunningManFigure()
{
  constexpr double frame = 0.07;
  constexpr double limb = 0.09;
  SignFigure figure;
  figure.Width = 1.0;
  const auto add = [&figure](const Line& line, double thickness)
  {
    for (const FigurePolygon& part : Stroke(line, thickness))
    {
      FigurePolygon inside = ClipToBox(part, {0.0, 0.0}, {1.0, 1.0});
      if (inside.size() > 2)
      {
        figure.Polygons.push_back(std::move(inside));
      }
    }
  };
  // The door: two posts and a lintel.
  add(
    {{0.5 * frame, 0.0}, {0.5 * frame, 1.0 - 0.5 * frame}, {0.62, 1.0 - 0.5 * frame}, {0.62, 0.68}},
    frame);
  add({{0.62, 0.0}, {0.62, 0.1}}, frame);
  // The man, who runs to the left: head, trunk, arms, legs.
  figure.Polygons.push_back(Disc({0.47, 0.8}, 0.075));
  add({{0.5, 0.64}, {0.6, 0.42}}, 0.14);
  add({{0.48, 0.65}, {0.33, 0.6}, {0.24, 0.7}}, limb);
  add({{0.55, 0.66}, {0.7, 0.62}, {0.78, 0.5}}, limb);
  add({{0.58, 0.4}, {0.42, 0.3}, {0.4, 0.1}, {0.3, 0.1}}, limb);
  add({{0.62, 0.4}, {0.74, 0.27}, {0.93, 0.22}}, limb);
  return figure;
}

} // namespace smokevis
