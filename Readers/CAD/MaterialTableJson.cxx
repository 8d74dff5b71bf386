// Reads a material table from JSON.
#include "MaterialRowBuilder.h"
#include "MaterialTableText.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace smokevis
{
namespace
{

using Json = nlohmann::json;

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

std::vector<double> Numbers(
  const std::string& key, const Json& value, const MaterialRowBuilder& row)
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

std::string Text(const std::string& key, const Json& value, const MaterialRowBuilder& row)
{
  if (!value.is_string())
  {
    row.Refuse(key + " is not text", "Write it in double quotes");
  }
  return value.get<std::string>();
}

MaterialRow RowOf(const Json& entry, MaterialRowBuilder row)
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
      row.Refuse(
        "the key '" + key + "' is not known", std::string("The keys are ") + MaterialColumns);
    }
  }
  return row.Finish();
}

} // namespace

//------------------------------------------------------------------------------------------------
std::vector<MaterialRow> ReadMaterialJson(const std::string& fileName, const std::string& text)
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
  catch (const Json::exception& error)
  {
    const std::string what = error.what();
    const std::size_t colon = what.rfind(": ");
    // What was read last is at most the character behind the one that is wrong.
    const auto byte = static_cast<std::size_t>(read - text.data());
    throw Error(where + ", line " + std::to_string(LineOf(text, byte > 0 ? byte - 1 : 0)),
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
    rows.push_back(RowOf(table[i], MaterialRowBuilder(fileName, lines.at(i))));
  }
  return rows;
}

} // namespace smokevis
