// Reads many signs from a table in a text file.
#include "ErrorCollector.h"
#include "Errors.h"
#include "SignPlate.h"
#include "TextLines.h"

#include <vtkDelimitedTextReader.h>
#include <vtkNew.h>
#include <vtkStringArray.h>
#include <vtkTable.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>

namespace smokevis
{
namespace
{

const std::vector<std::string> Columns = {"id", "name", "cx", "cy", "cz", "nx", "ny", "nz", "ux",
  "uy", "uz", "width", "height", "preset", "pattern", "design", "bars", "bar_fraction",
  "square_fraction", "pattern_file", "text", "figure_height", "luminance", "unlit_luminance",
  "uniformity", "exponent", "red", "green", "blue", "unlit_red", "unlit_green", "unlit_blue",
  "reflectance", "unlit_reflectance"};

template <class Kind> using Names = std::vector<std::pair<std::string, Kind>>;

const Names<SignPattern> Patterns = {{"Square", SignPattern::Square},
  {"Barcode", SignPattern::Barcode}, {"Image", SignPattern::Image}, {"Text", SignPattern::Text},
  {"RunningMan", SignPattern::RunningMan}};
const Names<SignDesign> Designs = {{"Stencil", SignDesign::Stencil}, {"Panel", SignDesign::Panel}};
const Names<SignPreset> Presets = {{"Custom", SignPreset::Custom}, {"EN1838", SignPreset::En1838},
  {"EN1838Smoke", SignPreset::En1838Smoke}, {"ISO3864", SignPreset::Iso3864},
  {"UL924Stencil", SignPreset::Ul924Stencil}, {"UL924Panel", SignPreset::Ul924Panel}};

/// Header of the column that catches fields beyond the last column.
const std::string Surplus = "#";

std::string Lower(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string ListOfColumns()
{
  std::string list;
  for (const std::string& column : Columns)
  {
    list += (list.empty() ? "" : ", ") + column;
  }
  return list;
}

/// Throws Error where two columns have one name: VTK would keep the last only.
void CheckHeader(const std::string& line, const std::string& where)
{
  std::set<std::string> names;
  std::istringstream fields(line);
  for (std::string field; std::getline(fields, field, ',');)
  {
    field = Lower(Trimmed(field));
    if (!field.empty() && !names.insert(field).second)
    {
      throw Error(where, "there are two columns '" + field + "'", "Leave one of them out");
    }
  }
}

/// One row of the table, asked by column.
class Row
{
public:
  Row(const std::map<std::string, vtkStringArray*>& columns, vtkIdType row, std::string where)
      : Columns_(columns), Row_(row), Where_(std::move(where))
  {
  }

  /// The field, or nothing where it is blank or the column is missing.
  std::string Text(const std::string& column) const
  {
    const auto found = this->Columns_.find(column);
    return found == this->Columns_.end() ? std::string()
                                         : Trimmed(found->second->GetValue(this->Row_));
  }

  template <class Number> Number Get(const std::string& column, Number otherwise) const
  {
    const std::string text = this->Text(column);
    if (text.empty())
    {
      return otherwise;
    }
    Number value{};
    const char* const begin = text.data() + (text[0] == '+' ? 1 : 0);
    const auto [end, code] = std::from_chars(begin, text.data() + text.size(), value);
    bool good = code == std::errc() && end == text.data() + text.size();
    if constexpr (std::is_floating_point_v<Number>)
    {
      good = good && std::isfinite(value);
    }
    if (!good)
    {
      throw Error(this->Where_, "column " + column + " holds '" + text + "', which is not a number",
        std::is_integral_v<Number> ? "Write a whole number"
                                   : "Write a number with a decimal point");
    }
    return value;
  }

  double Needed(const std::string& column) const
  {
    if (this->Text(column).empty())
    {
      throw Error(
        this->Where_, "column " + column + " is blank", "Give the sign's centre in metres");
    }
    return this->Get(column, 0.0);
  }

  template <class Value>
  Value Kind(const std::string& column, const Names<Value>& names, Value otherwise) const
  {
    const std::string text = this->Text(column);
    if (text.empty())
    {
      return otherwise;
    }
    std::string all;
    for (const auto& [name, value] : names)
    {
      if (Lower(text) == Lower(name))
      {
        return value;
      }
      all += (all.empty() ? "" : ", ") + name;
    }
    throw Error(
      this->Where_, "the " + column + " '" + text + "' is not known", "Write one of " + all);
  }

private:
  const std::map<std::string, vtkStringArray*>& Columns_;
  vtkIdType Row_;
  std::string Where_;
};

SignPlate ReadSign(const Row& row, const SignPlate& defaults, const std::filesystem::path& folder)
{
  SignPlate sign = defaults;
  sign.Apply(row.Kind("preset", Presets, SignPreset::Custom));
  sign.Id = row.Get("id", defaults.Id);
  sign.Name = row.Text("name");
  sign.Centre = {row.Needed("cx"), row.Needed("cy"), row.Needed("cz")};
  sign.Normal = {row.Get("nx", defaults.Normal.x), row.Get("ny", defaults.Normal.y),
    row.Get("nz", defaults.Normal.z)};
  sign.Up = {
    row.Get("ux", defaults.Up.x), row.Get("uy", defaults.Up.y), row.Get("uz", defaults.Up.z)};
  sign.Width = row.Get("width", defaults.Width);
  sign.Height = row.Get("height", defaults.Height);
  sign.Pattern = row.Kind("pattern", Patterns, sign.Pattern);
  sign.Design = row.Kind("design", Designs, sign.Design);
  sign.Bars = row.Get("bars", sign.Bars);
  sign.BarFraction = row.Get("bar_fraction", sign.BarFraction);
  sign.SquareFraction = row.Get("square_fraction", sign.SquareFraction);
  if (const std::string file = row.Text("pattern_file"); !file.empty())
  {
    sign.PatternFile = (folder / file).string();
  }
  if (const std::string text = row.Text("text"); !text.empty())
  {
    sign.Text = text;
  }
  sign.FigureHeight = row.Get("figure_height", sign.FigureHeight);
  sign.Luminance = row.Get("luminance", sign.Luminance);
  sign.UnlitLuminance = row.Get("unlit_luminance", sign.UnlitLuminance);
  sign.Uniformity = row.Get("uniformity", sign.Uniformity);
  sign.EmissionExponent = row.Get("exponent", sign.EmissionExponent);
  const char* const colours[3] = {"red", "green", "blue"};
  for (int band = 0; band < 3; ++band)
  {
    const std::string colour = colours[band];
    sign.Colour[band] = row.Get(colour, sign.Colour[band]);
    sign.UnlitColour[band] = row.Get("unlit_" + colour, sign.UnlitColour[band]);
  }
  sign.Reflectance = row.Get("reflectance", sign.Reflectance);
  sign.UnlitReflectance = row.Get("unlit_reflectance", sign.UnlitReflectance);
  return sign;
}

} // namespace

//------------------------------------------------------------------------------
std::vector<SignPlate> ReadSignTable(const std::string& fileName, const SignPlate& defaults)
{
  const std::string where = "sign table '" + fileName + "'";
  const std::vector<TextLine> lines =
    ReadTableLines(where, fileName, "Give a CSV file with a header line");
  if (lines.size() < 2)
  {
    throw Error(where, "it holds no sign", "Give a header line and a line for each sign");
  }
  const auto place = [&](std::size_t index)
  { return where + ", line " + std::to_string(lines[index].Number); };
  std::string text;
  for (std::size_t i = 0; i < lines.size(); ++i)
  {
    const std::string& line = lines[i].Text;
    if (std::count(line.begin(), line.end(), '"') % 2 != 0)
    {
      throw Error(place(i), "a double quote is not closed",
        "Put a second one at the end of the text, in the same line");
    }
    text += line + (i == 0 ? "," + Surplus : "") + "\n";
  }
  CheckHeader(lines.front().Text, place(0));
  vtkNew<vtkDelimitedTextReader> reader;
  vtkNew<ErrorCollector> errors;
  reader->AddObserver(vtkCommand::ErrorEvent, errors);
  reader->AddObserver(vtkCommand::WarningEvent, errors);
  reader->ReadFromInputStringOn();
  reader->SetInputString(text);
  reader->SetHaveHeaders(true);
  reader->SetDetectNumericColumns(false);
  reader->Update();
  vtkTable* table = reader->GetOutput();
  const auto rows = static_cast<vtkIdType>(lines.size()) - 1;
  if (!errors->Text().empty() || table->GetNumberOfRows() != rows)
  {
    throw Error(where, "it is not a table of comma-separated values",
      "Write one line for each sign, text that holds commas in double quotes");
  }

  std::map<std::string, vtkStringArray*> columns;
  for (vtkIdType i = 0; i < table->GetNumberOfColumns(); ++i)
  {
    auto* const column = vtkStringArray::SafeDownCast(table->GetColumn(i));
    const std::string name = column ? Lower(Trimmed(column->GetName())) : std::string();
    const bool known = std::find(Columns.begin(), Columns.end(), name) != Columns.end();
    if (!known && name != Surplus)
    {
      throw Error(place(0), "the column '" + name + "' is not known",
        "Separate columns by commas. They are " + ListOfColumns());
    }
    columns[name] = column;
  }
  for (const char* const needed : {"cx", "cy", "cz"})
  {
    if (columns.count(needed) == 0)
    {
      throw Error(place(0), std::string("the column ") + needed + " is missing",
        "Separate columns by commas and name them in the first line");
    }
  }

  std::vector<SignPlate> signs;
  std::map<int, int> lineOfId;
  for (vtkIdType i = 0; i < rows; ++i)
  {
    const int line = lines[i + 1].Number;
    const std::string here = place(i + 1);
    const Row row(columns, i, here);
    if (!row.Text(Surplus).empty())
    {
      throw Error(here, "it has more fields than the header",
        "Write decimal points, not commas, and put text that holds commas in double quotes");
    }
    SignPlate start = defaults;
    start.Id = defaults.Id + static_cast<int>(i);
    start.Origin = here;
    SignPlate sign = ReadSign(row, start, std::filesystem::path(fileName).parent_path());
    const auto [first, added] = lineOfId.emplace(sign.Id, line);
    if (!added)
    {
      throw Error(here,
        "id " + std::to_string(sign.Id) + " was given in line " + std::to_string(first->second),
        "Give each sign its own id");
    }
    signs.push_back(std::move(sign));
  }
  return signs;
}

} // namespace smokevis
