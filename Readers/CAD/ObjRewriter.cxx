// Brings OBJ texts into the form that assimp reads rightly.
#include "ObjRewriter.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace smokevis
{
namespace
{

constexpr std::string_view Blanks = " \t";

/// Whether a line holds numbers: others have names, in which # and points are letters.
bool HoldsNumbers(std::string_view line)
{
  static constexpr std::array<std::string_view, 6> keywords{"v", "vn", "vt", "f", "l", "p"};
  const std::size_t begin = std::min(line.find_first_not_of(Blanks), line.size());
  const std::size_t end = std::min(line.find_first_of(Blanks, begin), line.size());
  const std::string_view word = line.substr(begin, end - begin);
  return std::find(keywords.begin(), keywords.end(), word) != keywords.end();
}

/// Calls each(line, end of line) for all lines of a text.
template <class Each> void ForEachLine(std::string_view text, Each&& each)
{
  while (!text.empty())
  {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    const std::size_t next = std::min(text.find_first_not_of("\r\n", end), text.size());
    each(text.substr(0, end), text.substr(end, next - end));
    text.remove_prefix(next);
  }
}

bool BeginsWithPoint(std::string_view line, std::size_t place)
{
  return line[place] == '.' && place > 0 && Blanks.find(line[place - 1]) != std::string_view::npos;
}

bool IsMisread(std::string_view line)
{
  if (!HoldsNumbers(line))
  {
    return false;
  }
  bool misread = false;
  for (std::size_t i = 0; i < line.size(); ++i)
  {
    misread = misread || line[i] == '#' || BeginsWithPoint(line, i);
  }
  return misread;
}

} // namespace

//------------------------------------------------------------------------------------------------
std::string RewriteObj(const std::string& text)
{
  bool misread = false;
  ForEachLine(
    text, [&](std::string_view line, std::string_view) { misread = misread || IsMisread(line); });
  std::string result;
  if (!misread)
  {
    return result;
  }
  result.reserve(text.size() + text.size() / 8);
  ForEachLine(text,
    [&](std::string_view line, std::string_view end)
    {
      if (IsMisread(line))
      {
        line = line.substr(0, line.find('#'));
        for (std::size_t i = 0; i < line.size(); ++i)
        {
          result += BeginsWithPoint(line, i) ? "0." : std::string(1, line[i]);
        }
      }
      else
      {
        result += line;
      }
      result += end;
    });
  return result;
}

} // namespace smokevis
