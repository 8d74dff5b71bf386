// Reads the file of a material table.
#include "MaterialTableText.h"

#include "Errors.h"
#include "TextFile.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace smokevis
{

//------------------------------------------------------------------------------------------------
std::vector<MaterialRow> ReadMaterialRows(const std::string& fileName)
{
  const std::string where = "material table '" + fileName + "'";
  const std::string text = ReadTextFile(where, fileName, "Check the path and its spelling");
  std::string extension = std::filesystem::path(fileName).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  std::vector<MaterialRow> rows =
    extension == ".json" ? ReadMaterialJson(fileName, text) : ReadMaterialCsv(fileName, text);
  if (rows.empty())
  {
    throw Error(where, "it holds no row", "Give a row for each material or object to change");
  }
  return rows;
}

} // namespace smokevis
