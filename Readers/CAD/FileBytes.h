// The content of a file as a text.
#pragma once

#include <fstream>
#include <iterator>
#include <string>

namespace smokevis
{

/// All bytes of a file; none where it cannot be read.
inline std::string FileBytes(const std::string& fileName)
{
  std::ifstream file(fileName, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

} // namespace smokevis
