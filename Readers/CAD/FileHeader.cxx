// Looks for units and axes in the text of COLLADA, DXF and IFC files.
#include "FileHeader.h"

#include "FileBytes.h"
#include "StepRecord.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <string_view>

namespace smokevis
{
namespace
{

double SiPrefix(std::string_view prefix)
{
  static const std::map<std::string_view, double> prefixes = {{".KILO.", 1e3}, {".HECTO.", 1e2},
    {".DECA.", 10.0}, {".DECI.", 0.1}, {".CENTI.", 1e-2}, {".MILLI.", 1e-3}, {".MICRO.", 1e-6}};
  const auto found = prefixes.find(prefix);
  return found == prefixes.end() ? 1.0 : found->second;
}

/// The records of an IFC file that have to do with units, by number.
using Records = std::map<std::string, std::string, std::less<>>;

Records ReadUnitRecords(const std::string& fileName)
{
  Records records;
  const std::string text = FileBytes(fileName);
  ForEachRecord(text,
    [&](std::string_view number, std::string_view body, std::string_view)
    {
      for (const std::string_view name :
        {"IFCUNITASSIGNMENT", "IFCSIUNIT", "IFCMEASUREWITHUNIT", "IFCCONVERSIONBASEDUNIT"})
      {
        if (body.substr(0, name.size()) == name)
        {
          records.emplace(number, body);
        }
      }
    });
  return records;
}

/// Length [m] of the unit that a record defines; 0 where it is no unit of length.
double LengthUnit(const Records& records, std::string_view number)
{
  const auto found = records.find(number);
  if (found == records.end())
  {
    return 0.0;
  }
  const StepRecord unit = SplitRecord(found->second);
  if (unit.Fields.size() != 4 || unit.Fields[1] != ".LENGTHUNIT.")
  {
    return 0.0;
  }
  if (unit.Name == "IFCSIUNIT")
  {
    return SiPrefix(unit.Fields[2]);
  }
  const auto factor = records.find(unit.Fields[3]);
  if (factor == records.end())
  {
    return 0.0;
  }
  const StepRecord measure = SplitRecord(factor->second);
  if (measure.Fields.size() != 2)
  {
    return 0.0;
  }
  const auto base = records.find(measure.Fields[1]);
  const StepRecord value = SplitRecord(measure.Fields[0]);
  if (base == records.end() || value.Fields.empty())
  {
    return 0.0;
  }
  const StepRecord si = SplitRecord(base->second);
  return si.Fields.size() == 4 ? RecordNumber(value.Fields[0]) * SiPrefix(si.Fields[2]) : 0.0;
}

} // namespace

//------------------------------------------------------------------------------------------------
FileHeader ReadColladaHeader(const std::string& fileName)
{
  // <asset> comes first in the document, or in its library elements when there is none.
  constexpr std::size_t longest = 1 << 20;
  std::ifstream file(fileName, std::ios::binary);
  std::string text(longest, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  text.resize(std::min(text.size(), text.find("</asset>")));

  FileHeader header;
  const std::size_t unit = text.find("<unit");
  const std::size_t meter = unit == std::string::npos ? unit : text.find("meter=", unit);
  if (meter != std::string::npos && meter < text.find('>', unit))
  {
    const std::size_t quote = text.find_first_of("\"'", meter);
    if (quote != std::string::npos)
    {
      header.UnitScale = RecordNumber(std::string_view(text).substr(quote + 1));
    }
  }
  const std::size_t up = text.find("<up_axis>");
  if (up != std::string::npos)
  {
    const std::string_view axis =
      TrimRecord(std::string_view(text).substr(up + 9, text.find('<', up + 9) - up - 9));
    header.Up = axis == "X_UP"   ? UpAxis::X
                : axis == "Y_UP" ? UpAxis::Y
                : axis == "Z_UP" ? UpAxis::Z
                                 : UpAxis::Automatic;
  }
  return header;
}

//------------------------------------------------------------------------------------------------
FileHeader ReadDxfHeader(const std::string& fileName)
{
  // The codes of INSUNITS, DXF Reference, "HEADER Section Group Codes".
  static const std::map<double, double> lengths = {{1, 0.0254}, {2, 0.3048}, {3, 1609.344},
    {4, 1e-3}, {5, 1e-2}, {6, 1.0}, {7, 1e3}, {8, 2.54e-8}, {9, 2.54e-5}, {10, 0.9144}, {11, 1e-10},
    {12, 1e-9}, {13, 1e-6}, {14, 0.1}, {15, 10.0}, {16, 100.0}};
  FileHeader header;
  std::ifstream file(fileName);
  std::string line;
  while (std::getline(file, line))
  {
    const std::string_view text = TrimRecord(line);
    if (text == "ENDSEC")
    {
      break;
    }
    std::string code, value;
    if (text == "$INSUNITS" && std::getline(file, code) && std::getline(file, value))
    {
      const auto found = lengths.find(RecordNumber(value));
      header.UnitScale = found == lengths.end() ? 0.0 : found->second;
      break;
    }
  }
  return header;
}

//------------------------------------------------------------------------------------------------
FileHeader ReadIfcHeader(const std::string& fileName)
{
  FileHeader header;
  const Records records = ReadUnitRecords(fileName);
  for (const auto& [number, body] : records)
  {
    const StepRecord assignment = SplitRecord(body);
    if (assignment.Name != "IFCUNITASSIGNMENT" || assignment.Fields.size() != 1)
    {
      continue;
    }
    for (const std::string_view unit : SplitRecord(assignment.Fields[0]).Fields)
    {
      const double length = LengthUnit(records, unit);
      header.UnitScale = length > 0.0 ? length : header.UnitScale;
    }
  }
  return header;
}

} // namespace smokevis
