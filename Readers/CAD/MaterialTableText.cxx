// Reads the file of a material table.
#include "MaterialTableText.h"

#include "Errors.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>

namespace smokevis
{
namespace
{

constexpr std::string_view ByteOrderMark = "\xEF\xBB\xBF";

/// More than any table needs, and little enough to hold in memory.
constexpr std::uintmax_t LargestFile = 64 << 20;

} // namespace

//------------------------------------------------------------------------------------------------
std::vector<MaterialRow> ReadMaterialRows(const std::string& fileName)
{
  const std::string where = "material table '" + fileName + "'";
  std::error_code problem;
  if (std::filesystem::file_size(fileName, problem) > LargestFile && !problem)
  {
    throw Error(where, "the file is too large for a table", "Check the path");
  }
  std::ifstream file(fileName, std::ios::binary);
  if (!file || !std::filesystem::is_regular_file(fileName, problem))
  {
    throw Error(where, "the file cannot be opened", "Check the path and its spelling");
  }
  std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (text.compare(0, ByteOrderMark.size(), ByteOrderMark) == 0)
  {
    text.erase(0, ByteOrderMark.size());
  }
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
