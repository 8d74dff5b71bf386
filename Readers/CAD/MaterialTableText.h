// The text of a material table.
#pragma once

#include "MaterialTable.h"

#include <string>
#include <vector>

namespace smokevis
{

/// The rows of a table in a CSV or JSON file, in their order. Throws Error that names file and
/// line.
///
/// CSV: the first line names the columns, in any order: name (needed), reflectance, luminance,
/// sign, sign_name, drop. Blank fields say nothing; blank lines and lines that begin with # are
/// skipped; text that holds commas stands in double quotes.
///
/// JSON: an array of objects with the same keys.
std::vector<MaterialRow> ReadMaterialRows(const std::string& fileName);

/// The rows in the text of a CSV file.
std::vector<MaterialRow> ReadMaterialCsv(const std::string& fileName, const std::string& text);

/// The rows in the text of a JSON file.
std::vector<MaterialRow> ReadMaterialJson(const std::string& fileName, const std::string& text);

} // namespace smokevis
