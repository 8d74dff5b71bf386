// Reads the small text files that describe signs, lamps and cameras.
#pragma once

#include "Errors.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace smokevis
{

/// The whole of a text file, without a byte order mark. Throws Error for what is no file, such as a
/// folder or a device without an end, for what is too large to have been written for this, and for
/// what is no plain text (UTF-16, bytes of 0).
/// @param where names the file in messages
inline std::string ReadTextFile(
  const std::string& where, const std::string& fileName, const std::string& remedy)
{
  constexpr std::uintmax_t largest = 64U << 20U;
  const std::string byteOrderMark = "\xEF\xBB\xBF";
  std::error_code problem;
  // Asked before it is opened: opening a pipe would wait for somebody to write.
  if (!std::filesystem::is_regular_file(fileName, problem))
  {
    throw Error(where, "there is no such file", remedy);
  }
  const std::uintmax_t size = std::filesystem::file_size(fileName, problem);
  if (!problem && size > largest)
  {
    throw Error(
      where, "its " + std::to_string(size) + " bytes are too many for such a file", remedy);
  }
  std::ifstream file(fileName, std::ios::binary);
  if (!file)
  {
    throw Error(where, "the file cannot be opened", remedy);
  }
  std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (text.compare(0, byteOrderMark.size(), byteOrderMark) == 0)
  {
    text.erase(0, byteOrderMark.size());
  }
  if (text.compare(0, 2, "\xFF\xFE") == 0 || text.compare(0, 2, "\xFE\xFF") == 0 ||
      text.find('\0') != std::string::npos)
  {
    throw Error(where, "it is not plain text", "Save it as UTF-8, not as UTF-16");
  }
  return text;
}

} // namespace smokevis
