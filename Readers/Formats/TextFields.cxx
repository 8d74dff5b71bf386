#include "TextFields.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

namespace smokevis
{

namespace
{

constexpr std::string_view Blanks = " \t\r\n";

bool IsDigit(char c)
{
  return c >= '0' && c <= '9';
}

// How long the first number of a token without blanks is; decimals is the number of digits behind
// the decimal point that this format writes.
std::size_t NumberLength(std::string_view token, std::size_t decimals)
{
  std::size_t end = 0;
  const auto skipDigits = [&](std::size_t most)
  {
    const std::size_t begin = end;
    while (end < token.size() && end - begin < most && IsDigit(token[end]))
    {
      ++end;
    }
    return end - begin;
  };
  constexpr std::size_t any = std::numeric_limits<std::size_t>::max();
  if (end < token.size() && (token[end] == '-' || token[end] == '+'))
  {
    ++end;
  }
  std::size_t digits = skipDigits(any);
  if (end < token.size() && token[end] == '.')
  {
    ++end;
    digits += skipDigits(decimals);
  }
  if (digits == 0)
  {
    return 0;
  }
  // An exponent: a letter and a sign or a digit, or Fortran's bare sign and three digits.
  const std::size_t mantissa = end;
  if (end < token.size() && std::string_view("EeDd").find(token[end]) != std::string_view::npos)
  {
    ++end;
    if (end < token.size() && (token[end] == '-' || token[end] == '+'))
    {
      ++end;
    }
    if (skipDigits(3) == 0)
    {
      end = mantissa;
    }
  }
  return end;
}

std::optional<double> ToNumber(std::string_view text)
{
  double value = 0.0;
  // Most numbers are plain, and an index has millions of them.
  const char* const end = text.data() + text.size();
  const auto quick = std::from_chars(text.data(), end, value);
  if (quick.ec == std::errc() && quick.ptr == end)
  {
    return value;
  }
  std::string plain(text.starts_with('+') ? text.substr(1) : text);
  std::replace_if(
    plain.begin(), plain.end(), [](char c) { return c == 'D' || c == 'd'; }, 'E');
  const auto [rest, problem] = std::from_chars(plain.data(), plain.data() + plain.size(), value);
  if (problem == std::errc::result_out_of_range && rest == plain.data() + plain.size())
  {
    // Underflow is zero in effect; overflow is not a coordinate that any run has.
    const bool tiny = plain.find("E-") != std::string::npos;
    return tiny ? std::optional<double>(0.0) : std::nullopt;
  }
  if (problem != std::errc() || rest != plain.data() + plain.size())
  {
    return std::nullopt;
  }
  return value;
}

} // namespace

//------------------------------------------------------------------------------------------------
std::string_view Trim(std::string_view text)
{
  const std::size_t begin = text.find_first_not_of(Blanks);
  if (begin == std::string_view::npos)
  {
    return {};
  }
  return text.substr(begin, text.find_last_not_of(Blanks) - begin + 1);
}

//------------------------------------------------------------------------------------------------
std::vector<double> SplitNumbers(std::string_view text)
{
  std::vector<double> numbers;
  text = Trim(text);
  while (!text.empty())
  {
    std::string_view token = text.substr(0, text.find_first_of(Blanks));
    text = Trim(text.substr(token.size()));
    // Several decimal points: the digits behind the last one are the format's decimals.
    std::size_t decimals = std::numeric_limits<std::size_t>::max();
    if (std::count(token.begin(), token.end(), '.') > 1)
    {
      decimals = 0;
      while (token.rfind('.') + 1 + decimals < token.size() &&
             IsDigit(token[token.rfind('.') + 1 + decimals]))
      {
        ++decimals;
      }
    }
    while (!token.empty())
    {
      const std::size_t length = NumberLength(token, decimals);
      const std::optional<double> value =
        length == 0 ? std::nullopt : ToNumber(token.substr(0, length));
      if (!value)
      {
        return numbers;
      }
      numbers.push_back(*value);
      token.remove_prefix(length);
    }
  }
  return numbers;
}

//------------------------------------------------------------------------------------------------
std::vector<int> SplitIntegers(std::string_view text, std::size_t count, std::size_t width)
{
  const auto asIntegers = [count](const std::vector<double>& numbers)
  {
    std::vector<int> integers;
    for (const double number : numbers)
    {
      if (integers.size() == count || std::abs(number) > std::numeric_limits<int>::max() ||
          number != std::floor(number))
      {
        break;
      }
      integers.push_back(static_cast<int>(number));
    }
    return integers;
  };
  std::vector<int> integers = asIntegers(SplitNumbers(text));
  if (integers.size() == count)
  {
    return integers;
  }
  std::vector<double> columns;
  for (std::size_t begin = 0; begin < text.size() && columns.size() < count; begin += width)
  {
    const std::vector<double> one = SplitNumbers(text.substr(begin, width));
    if (one.size() != 1)
    {
      break;
    }
    columns.push_back(one.front());
  }
  std::vector<int> byColumns = asIntegers(columns);
  return byColumns.size() == count ? byColumns : integers;
}

//------------------------------------------------------------------------------------------------
std::string_view Before(std::string_view text, char mark)
{
  return text.substr(0, text.find(mark));
}

//------------------------------------------------------------------------------------------------
std::string_view After(std::string_view text, char mark)
{
  const std::size_t place = text.find(mark);
  return place == std::string_view::npos ? std::string_view() : text.substr(place + 1);
}

//------------------------------------------------------------------------------------------------
std::pair<std::string_view, std::string_view> AroundLast(std::string_view text, char mark)
{
  const std::size_t place = text.rfind(mark);
  return place == std::string_view::npos ? std::pair(text, std::string_view())
                                         : std::pair(text.substr(0, place), text.substr(place + 1));
}

} // namespace smokevis
