// Reads a material table from comma-separated values.
#include "MaterialRowBuilder.h"
#include "MaterialTableText.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <string_view>

namespace smokevis
{
namespace
{

std::string Trim(std::string_view text)
{
  const char* const blanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(blanks);
  return std::string(first == std::string_view::npos
                       ? std::string_view()
                       : text.substr(first, text.find_last_not_of(blanks) - first + 1));
}

std::string Lower(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// The numbers in a field, separated by blanks.
std::vector<double> Numbers(
  const std::string& column, const std::string& text, const MaterialRowBuilder& row)
{
  std::vector<double> values;
  for (std::size_t begin = 0; begin < text.size();)
  {
    const std::size_t end = std::min(text.find_first_of(" \t", begin), text.size());
    double value = 0.0;
    const auto [stop, code] = std::from_chars(text.data() + begin, text.data() + end, value);
    if (code != std::errc() || stop != text.data() + end)
    {
      row.Refuse(column + " holds '" + text + "', which is not a number",
        "Write numbers with a decimal point, three of them separated by blanks");
    }
    values.push_back(value);
    begin = std::min(text.find_first_not_of(" \t", end), text.size());
  }
  return values;
}

bool Truth(const std::string& text, const MaterialRowBuilder& row)
{
  const std::string word = Lower(text);
  if (word == "yes" || word == "true" || word == "1")
  {
    return true;
  }
  if (word == "no" || word == "false" || word == "0")
  {
    return false;
  }
  row.Refuse("drop holds '" + text + "'", "Write yes or no");
}

/// The fields of a line; a doubled quote within quotes is a quote.
std::vector<std::string> SplitLine(const std::string& line, const std::string& where)
{
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i)
  {
    if (line[i] == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"')
    {
      fields.back() += line[++i];
    }
    else if (line[i] == '"')
    {
      quoted = !quoted;
    }
    else if (line[i] == ',' && !quoted)
    {
      fields.emplace_back();
    }
    else
    {
      fields.back() += line[i];
    }
  }
  if (quoted)
  {
    throw Error(where, "a double quote is not closed", "Close it, or write it twice within quotes");
  }
  for (std::string& field : fields)
  {
    field = Trim(field);
  }
  return fields;
}

void SetField(const std::string& column, const std::string& text, const std::string& where,
  MaterialRowBuilder& row)
{
  if (column == "name")
  {
    row.SetName(text);
  }
  else if (column == "sign_name")
  {
    row.SetSignName(text);
  }
  else if (column == "reflectance")
  {
    row.SetReflectance(Numbers(column, text, row));
  }
  else if (column == "luminance")
  {
    row.SetLuminance(Numbers(column, text, row));
  }
  else if (column == "sign")
  {
    const std::vector<double> values = Numbers(column, text, row);
    row.SetSign(values.size() == 1 ? values[0] : -2.0);
  }
  else if (column == "drop")
  {
    row.SetDrop(Truth(text, row));
  }
  else
  {
    throw Error(where, "the column '" + column + "' is not known",
      std::string("The columns are ") + MaterialColumns);
  }
}

} // namespace

//------------------------------------------------------------------------------------------------
std::vector<MaterialRow> ReadMaterialCsv(const std::string& fileName, const std::string& text)
{
  std::vector<MaterialRow> rows;
  std::vector<std::string> columns;
  int line = 0;
  for (std::size_t begin = 0; begin < text.size(); ++line)
  {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string content = Trim(std::string_view(text).substr(begin, end - begin));
    begin = end + 1;
    if (content.empty() || content[0] == '#')
    {
      continue;
    }
    const std::string where = "material table '" + fileName + "', line " + std::to_string(line + 1);
    const std::vector<std::string> fields = SplitLine(content, where);
    if (columns.empty())
    {
      if (fields.size() == 1 && content.find_first_of(";\t") != std::string::npos)
      {
        throw Error(where, "its columns are separated by semicolons or tabs",
          "Save it with commas between the columns, and with decimal points");
      }
      columns = fields;
      std::transform(columns.begin(), columns.end(), columns.begin(), Lower);
      MaterialRowBuilder trial(fileName, line + 1);
      for (const std::string& column : columns)
      {
        // A value that every known column takes, to find the unknown ones.
        SetField(column,
          column == "reflectance" || column == "luminance" || column == "sign" || column == "drop"
            ? "1"
            : "x",
          where, trial);
      }
      if (std::find(columns.begin(), columns.end(), "name") == columns.end())
      {
        throw Error(where, "the column name is missing",
          "Separate columns by commas and name them in the first line");
      }
      continue;
    }
    if (fields.size() > columns.size())
    {
      throw Error(where, "it has more fields than the header",
        "Write decimal points, not commas, and put text that holds commas in double quotes");
    }
    MaterialRowBuilder row(fileName, line + 1);
    for (std::size_t i = 0; i < fields.size(); ++i)
    {
      if (!fields[i].empty())
      {
        SetField(columns[i], fields[i], where, row);
      }
    }
    rows.push_back(row.Finish());
  }
  return rows;
}

} // namespace smokevis
