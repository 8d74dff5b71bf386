// Reads a material table from CSV or JSON.
#include "MaterialTableText.h"

#include "Errors.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string_view>

namespace smokevis
{
namespace
{

using Json = nlohmann::json;

constexpr const char* KnownColumns = "name, reflectance, luminance, sign, sign_name and drop";
constexpr std::string_view ByteOrderMark = "\xEF\xBB\xBF";

/// More than any table needs, and little enough to hold in memory.
constexpr std::uintmax_t LargestFile = 64 << 20;

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

/// Checks the values of one row and puts them into it.
class RowBuilder
{
public:
  RowBuilder(const std::string& fileName, int line)
      : Where_("material table '" + fileName + "', line " + std::to_string(line))
  {
    this->Row_.Line = line;
  }

  void SetName(const std::string& name) { this->Row_.Pattern = name; }
  void SetSignName(const std::string& name) { this->Row_.Treatment.SignName = name; }
  void SetDrop(bool drop) { this->Row_.Treatment.Drop = drop; }

  void SetReflectance(const std::vector<double>& values)
  {
    this->CheckNumbers("reflectance", values, 1.0, "Give a diffuse reflectance from 0 to 1");
    this->Row_.Treatment.Reflectance = values;
  }

  void SetLuminance(const std::vector<double>& values)
  {
    this->CheckNumbers(
      "luminance", values, std::numeric_limits<float>::max(), "Give a luminance in cd/m2 from 0");
    this->Row_.Treatment.Luminance = values;
  }

  void SetSign(double value)
  {
    if (!(value >= -1.0 && value <= std::numeric_limits<int>::max()) || value != std::floor(value))
    {
      this->Refuse("sign is not a whole number from 0, or -1", "Give the sign's id, -1 for a lamp");
    }
    this->Row_.Treatment.SignId = static_cast<int>(value);
  }

  MaterialRow Finish() const
  {
    if (this->Row_.Pattern.empty())
    {
      this->Refuse("name is missing", "Give the name of a material or object, such as Glazing*");
    }
    const CadTreatment& own = this->Row_.Treatment;
    if (own.Drop.value_or(false) &&
        (own.IsEmitter() || !own.Reflectance.empty() || !own.SignName.empty()))
    {
      this->Refuse("it drops '" + this->Row_.Pattern + "' and describes its light",
        "Leave the other fields blank where drop is yes");
    }
    return this->Row_;
  }

  [[noreturn]] void Refuse(const std::string& what, const std::string& remedy) const
  {
    throw Error(this->Where_, what, remedy);
  }

private:
  void CheckNumbers(const std::string& quantity, const std::vector<double>& values, double most,
    const char* remedy) const
  {
    if (values.size() != 1 && values.size() != 3)
    {
      this->Refuse(quantity + " has " + std::to_string(values.size()) + " numbers",
        "Give one, or three for red, green and blue");
    }
    for (const double value : values)
    {
      if (!(value >= 0.0 && value <= most))
      {
        this->Refuse(quantity + " is out of range", remedy);
      }
    }
  }

  std::string Where_;
  MaterialRow Row_;
};

//------------------------------------------------------------------------------------------------
/// The numbers in a field, separated by blanks.
std::vector<double> Numbers(
  const std::string& column, const std::string& text, const RowBuilder& row)
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

bool Truth(const std::string& text, const RowBuilder& row)
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

void SetField(
  const std::string& column, const std::string& text, const std::string& where, RowBuilder& row)
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
      std::string("The columns are ") + KnownColumns);
  }
}

std::vector<MaterialRow> ReadCsv(const std::string& fileName, const std::string& text)
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
      columns = fields;
      std::transform(columns.begin(), columns.end(), columns.begin(), Lower);
      RowBuilder trial(fileName, line + 1);
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
    RowBuilder row(fileName, line + 1);
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

//------------------------------------------------------------------------------------------------
int LineOf(const std::string& text, std::size_t byte)
{
  return 1 + static_cast<int>(std::count(text.begin(),
               text.begin() + static_cast<std::ptrdiff_t>(std::min(byte, text.size())), '\n'));
}

/// Reads characters and knows how many were read.
class CountingIterator
{
public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  CountingIterator(const char* at, const char** farthest) : At_(at), Farthest_(farthest) {}
  reference operator*() const { return *this->At_; }
  CountingIterator& operator++()
  {
    *this->Farthest_ = ++this->At_;
    return *this;
  }
  CountingIterator operator++(int)
  {
    CountingIterator old = *this;
    ++*this;
    return old;
  }
  bool operator==(const CountingIterator& other) const { return this->At_ == other.At_; }
  bool operator!=(const CountingIterator& other) const { return this->At_ != other.At_; }

private:
  const char* At_;
  const char** Farthest_;
};

std::vector<double> Numbers(const std::string& key, const Json& value, const RowBuilder& row)
{
  std::vector<double> values;
  for (const Json& part : value.is_array() ? value : Json::array({value}))
  {
    if (!part.is_number())
    {
      row.Refuse(key + " is not a number or an array of three", "Write 0.8 or [0.8, 0.7, 0.6]");
    }
    values.push_back(part.get<double>());
  }
  return values;
}

std::string Text(const std::string& key, const Json& value, const RowBuilder& row)
{
  if (!value.is_string())
  {
    row.Refuse(key + " is not text", "Write it in double quotes");
  }
  return value.get<std::string>();
}

MaterialRow RowOf(const Json& entry, RowBuilder row)
{
  for (const auto& [key, value] : entry.items())
  {
    if (key == "name")
    {
      row.SetName(Text(key, value, row));
    }
    else if (key == "sign_name")
    {
      row.SetSignName(Text(key, value, row));
    }
    else if (key == "reflectance")
    {
      row.SetReflectance(Numbers(key, value, row));
    }
    else if (key == "luminance")
    {
      row.SetLuminance(Numbers(key, value, row));
    }
    else if (key == "sign")
    {
      row.SetSign(value.is_number() ? value.get<double>() : -2.0);
    }
    else if (key == "drop")
    {
      if (!value.is_boolean())
      {
        row.Refuse("drop is not true or false", "Write true or false without quotes");
      }
      row.SetDrop(value.get<bool>());
    }
    else
    {
      row.Refuse("the key '" + key + "' is not known", std::string("The keys are ") + KnownColumns);
    }
  }
  return row.Finish();
}

std::vector<MaterialRow> ReadJson(const std::string& fileName, const std::string& text)
{
  const std::string where = "material table '" + fileName + "'";
  // The lines on which the objects of the array begin.
  std::vector<int> lines;
  Json table;
  const char* read = text.data();
  const auto note = [&](int depth, Json::parse_event_t event, Json&)
  {
    if (depth == 1 && event == Json::parse_event_t::object_start)
    {
      lines.push_back(LineOf(text, static_cast<std::size_t>(read - text.data())));
    }
    return true;
  };
  try
  {
    table = Json::parse(CountingIterator(text.data(), &read),
      CountingIterator(text.data() + text.size(), &read), note);
  }
  catch (const Json::parse_error& error)
  {
    std::string what = error.what();
    const std::size_t colon = what.rfind(": ");
    throw Error(
      where + ", line " + std::to_string(LineOf(text, error.byte > 0 ? error.byte - 1 : 0)),
      "it is not JSON (" + (colon == std::string::npos ? what : what.substr(colon + 2)) + ")",
      "Write an array of objects, such as [{\"name\": \"Glazing*\", \"drop\": true}]");
  }
  std::vector<MaterialRow> rows;
  const bool isTable = table.is_array() && std::all_of(table.begin(), table.end(),
                                             [](const Json& entry) { return entry.is_object(); });
  if (!isTable)
  {
    throw Error(where, "it is not an array of objects",
      "Write an array of objects, such as [{\"name\": \"Glazing*\", \"drop\": true}]");
  }
  for (std::size_t i = 0; i < table.size(); ++i)
  {
    rows.push_back(RowOf(table[i], RowBuilder(fileName, lines.at(i))));
  }
  return rows;
}

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
  const bool isJson = Lower(std::filesystem::path(fileName).extension().string()) == ".json";
  std::vector<MaterialRow> rows = isJson ? ReadJson(fileName, text) : ReadCsv(fileName, text);
  if (rows.empty())
  {
    throw Error(where, "it holds no row", "Give a row for each material or object to change");
  }
  return rows;
}

} // namespace smokevis
