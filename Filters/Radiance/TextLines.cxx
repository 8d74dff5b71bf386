#include "TextLines.h"

#include "Errors.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

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
std::string ReadText(
  const std::string& fileName, const std::string& name, const std::string& remedy)
{
  std::error_code code;
  std::ifstream file(fileName, std::ios::binary);
  if (!file || std::filesystem::is_directory(fileName, code))
  {
    throw Error(name, "the file cannot be opened", remedy);
  }
  std::ostringstream stream;
  stream << file.rdbuf();
  std::string text = stream.str();
  if (text.rfind("\xFF\xFE", 0) == 0 || text.rfind("\xFE\xFF", 0) == 0 ||
      text.find('\0') != std::string::npos)
  {
    throw Error(name, "it is not plain text", "Save it as UTF-8, not as UTF-16");
  }
  if (text.rfind("\xEF\xBB\xBF", 0) == 0)
  {
    text.erase(0, 3);
  }
  return text;
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
  const std::string& fileName, const std::string& name, const std::string& remedy)
{
  std::vector<TextLine> result;
  int number = 0;
  for (const std::string& raw : SplitLines(ReadText(fileName, name, remedy)))
  {
    ++number;
    if (!utf8::is_valid(raw.begin(), raw.end()))
    {
      throw Error(name + ", line " + std::to_string(number),
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
