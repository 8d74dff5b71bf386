// The CAD formats that can be read, and what each is known for.
#pragma once

#include "CadModel.h"

#include <string>
#include <string_view>
#include <vector>

namespace smokevis
{

/// Which library reads a format.
enum class CadLibrary
{
  BRep,
  Mesh
};

struct CadFormat
{
  std::string_view Name;
  /// Lower case, separated by blanks.
  std::string_view Extensions;
  CadLibrary Library;
  /// Unit [m] and up axis of files that do not say.
  double UnitScale;
  UpAxis Up;
  /// Whether colours are linear by the format's definition.
  bool LinearColors;
};

/// Every format.
const std::vector<CadFormat>& CadFormats();

/// The format of a file by its extension, in upper or lower case. Throws Error for others.
const CadFormat& FormatOfFile(const std::string& fileName);

} // namespace smokevis
