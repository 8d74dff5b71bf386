// Takes the text of exchange files apart.
#include "StepRecord.h"

#include <charconv>
#include <cmath>

namespace smokevis
{

//------------------------------------------------------------------------------------------------
std::string_view TrimRecord(std::string_view text)
{
  const char* const blanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(blanks);
  return first == std::string_view::npos
           ? std::string_view()
           : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

//------------------------------------------------------------------------------------------------
StepRecord SplitRecord(std::string_view text)
{
  StepRecord record;
  const std::size_t open = text.find('(');
  const std::size_t close = text.rfind(')');
  if (open == std::string_view::npos || close == std::string_view::npos || close < open)
  {
    return record;
  }
  record.Name = TrimRecord(text.substr(0, open));
  const std::string_view inside = text.substr(open + 1, close - open - 1);
  int depth = 0;
  bool quoted = false;
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= inside.size(); ++i)
  {
    const char c = i < inside.size() ? inside[i] : ',';
    if (c == '\'')
    {
      quoted = !quoted;
    }
    else if (!quoted)
    {
      depth += c == '(';
      depth -= c == ')';
      if (i == inside.size() || (c == ',' && depth == 0))
      {
        record.Fields.push_back(TrimRecord(inside.substr(begin, i - begin)));
        begin = i + 1;
      }
    }
  }
  return record;
}

//------------------------------------------------------------------------------------------------
double RecordNumber(std::string_view text)
{
  text = TrimRecord(text);
  double value = 0.0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  return code == std::errc() && std::isfinite(value) ? value : 0.0;
}

//------------------------------------------------------------------------------------------------
void ForEachRecord(std::string_view text,
  const std::function<void(std::string_view, std::string_view, std::string_view)>& visit)
{
  std::size_t begin = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i)
  {
    quoted = quoted != (text[i] == '\'');
    if (text[i] == ';' && !quoted)
    {
      const std::string_view body = TrimRecord(text.substr(begin, i - begin));
      const std::size_t equals = body.find('=');
      const bool defines = !body.empty() && body[0] == '#' && equals != std::string_view::npos;
      visit(defines ? TrimRecord(body.substr(0, equals)) : std::string_view(),
        defines ? TrimRecord(body.substr(equals + 1)) : std::string_view(),
        text.substr(begin, i + 1 - begin));
      begin = i + 1;
    }
  }
}

} // namespace smokevis
