// Linear images in OpenEXR files.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace smokevis
{

/// A linear image: named channels of width x height values, bottom row first, and header entries.
struct ImageFile
{
  int Width = 0;
  int Height = 0;
  std::map<std::string, std::vector<float>> Channels;
  /// Numbers (double attributes) and texts (string attributes) of the header.
  std::map<std::string, double> Numbers;
  std::map<std::string, std::string> Texts;

  /// Throws Error where the image is not whole or the file cannot be written.
  void Write(const std::string& fileName) const;
  static ImageFile Read(const std::string& fileName);
};

} // namespace smokevis
