// Text from files, made fit to be shown.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace smokevis
{

/// The length of the UTF-8 character that @p text begins with; 0 where it is none that can be
/// shown: other bytes, control characters but tab and line feed, and marks that turn the direction
/// of what follows.
inline std::size_t PrintableLength(std::string_view text)
{
  const auto byte = [text](std::size_t i) -> unsigned
  { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  const unsigned first = byte(0);
  if (first < 0x80U)
  {
    return (first >= 0x20U && first != 0x7fU) || first == '\t' || first == '\n' ? 1 : 0;
  }
  const std::size_t length = first >= 0xf0U ? 4 : first >= 0xe0U ? 3 : 2;
  unsigned code = first & (0xffU >> (length + 1));
  for (std::size_t i = 1; i < length; ++i)
  {
    if ((byte(i) & 0xc0U) != 0x80U)
    {
      return 0;
    }
    code = code << 6U | (byte(i) & 0x3fU);
  }
  // Shorter forms exist of smaller codes; below 0xa0 they are control characters.
  constexpr std::array<unsigned, 5> least{0, 0, 0xa0, 0x800, 0x10000};
  const bool surrogate = code >= 0xd800U && code <= 0xdfffU;
  const bool turns = (code >= 0x202aU && code <= 0x202eU) || (code >= 0x2066U && code <= 0x2069U);
  const bool good = first >= 0xc0U && first < 0xf8U && code >= least[length] && code <= 0x10ffffU;
  return good && !surrogate && !turns ? length : 0;
}

/// The text with bytes that cannot be shown (see PrintableLength()) as \x and two digits: what
/// comes out is UTF-8 and does nothing to a terminal, whatever a damaged or hostile file holds.
inline std::string Printable(std::string_view text)
{
  constexpr std::string_view digits = "0123456789ABCDEF";
  std::string shown;
  shown.reserve(text.size());
  while (!text.empty())
  {
    const std::size_t length = PrintableLength(text);
    if (length > 0)
    {
      shown += text.substr(0, length);
    }
    else
    {
      const auto byte = static_cast<unsigned char>(text.front());
      shown += {'\\', 'x', digits[byte >> 4U], digits[byte & 15U]};
    }
    text.remove_prefix(length > 0 ? length : 1);
  }
  return shown;
}

} // namespace smokevis
