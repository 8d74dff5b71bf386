#include "TextLines.h"

#include "Errors.h"
#include "TextFile.h"

#include <algorithm>

#include <utf8.h>

namespace smokevis
{

//------------------------------------------------------------------------------
std::string Trimmed(const std::string& text)
{
  const char* const blanks = " \t\r\n\f\v";
  const std::size_t first = text.find_first_not_of(blanks);
  return first == std::string::npos ? std::string()
                                    : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

//------------------------------------------------------------------------------
std::vector<std::string> SplitLines(const std::string& text)
{
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size();)
  {
    const std::size_t end = std::min(text.find_first_of("\r\n", begin), text.size());
    lines.push_back(text.substr(begin, end - begin));
    begin = end + (text.compare(end, 2, "\r\n") == 0 ? 2 : 1);
  }
  return lines;
}

//------------------------------------------------------------------------------
std::vector<TextLine> ReadTableLines(
  const std::string& where, const std::string& fileName, const std::string& remedy)
{
  std::vector<TextLine> result;
  int number = 0;
  for (const std::string& raw : SplitLines(ReadTextFile(where, fileName, remedy)))
  {
    ++number;
    if (!utf8::is_valid(raw.begin(), raw.end()))
    {
      throw Error(where + ", line " + std::to_string(number),
        "it holds a letter that is not UTF-8, as files in Latin-1 or Windows-1252 do",
        "Save the file as UTF-8");
    }
    std::string line = Trimmed(raw);
    if (!line.empty() && line[0] != '#')
    {
      result.push_back({number, std::move(line)});
    }
  }
  return result;
}

} // namespace smokevis
