// Text from files, made fit to be shown.
#pragma once

#include <string>
#include <string_view>

#include <utf8.h>

namespace smokevis
{

/// Whether a character can be shown: neither a control character but tab and line feed nor a mark
/// that turns the direction of what follows.
inline bool IsPrintable(char32_t code)
{
  const bool controls = code < 0x20 || (code >= 0x7f && code < 0xa0);
  const bool turns = (code >= 0x202a && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
  return code == '\t' || code == '\n' || (!controls && !turns);
}

/// The text with bytes that are no UTF-8 and with what is not IsPrintable() as \x and two digits a
/// byte: what comes out is UTF-8 and does nothing to a terminal, whatever a damaged or hostile file
/// holds.
inline std::string Printable(std::string_view text)
{
  constexpr std::string_view digits = "0123456789ABCDEF";
  std::string shown;
  shown.reserve(text.size());
  const auto escape = [&shown, digits](std::string_view bytes)
  {
    for (const char byte : bytes)
    {
      const auto value = static_cast<unsigned char>(byte);
      shown += {'\\', 'x', digits[value >> 4U], digits[value & 15U]};
    }
  };
  while (!text.empty())
  {
    const char* next = text.data();
    try
    {
      const char32_t code = utf8::next(next, text.data() + text.size());
      const std::string_view character = text.substr(0, next - text.data());
      if (IsPrintable(code))
      {
        shown += character;
      }
      else
      {
        escape(character);
      }
      text.remove_prefix(character.size());
    }
    catch (const utf8::exception&)
    {
      escape(text.substr(0, 1));
      text.remove_prefix(1);
    }
  }
  return shown;
}

} // namespace smokevis
