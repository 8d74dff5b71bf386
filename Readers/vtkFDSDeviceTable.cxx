#include "vtkFDSDeviceTable.h"

#include "Errors.h"
#include "PrintableText.h"
#include "SmvFile.h"
#include "TextFields.h"

#include "vtkDelimitedTextReader.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <limits>

namespace smokevis
{

namespace
{

std::string ReadText(const std::string& path)
{
  std::error_code problem;
  const auto size = std::filesystem::file_size(path, problem);
  std::ifstream stream;
  // Only files have a size; a pipe in their place would wait for ever.
  if (!problem)
  {
    stream.open(path, std::ios::binary);
  }
  if (!stream.is_open())
  {
    throw Error(path, "the device table cannot be opened", "Check its permissions");
  }
  if (size > static_cast<std::uintmax_t>(std::numeric_limits<int>::max()))
  {
    throw Error(path, "the device table is larger than 2 GiB", "Thin it out");
  }
  std::string text(size, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(size));
  if (!stream)
  {
    throw Error(path, "reading the device table failed", "Check the disk");
  }
  return text;
}

// Text of headings as VTK's reader of tables takes it, to which a backslash is the begin of an
// escape.
std::string Headings(const std::string& text)
{
  std::string escaped;
  for (const char c : Printable(text))
  {
    escaped.append(c == '\\' ? 2 : 1, c);
  }
  return escaped;
}

// One line or a whole table of comma-separated, perhaps quoted fields.
vtkSmartPointer<vtkTable> ParseCsv(const std::string& text, bool header)
{
  vtkNew<vtkDelimitedTextReader> reader;
  reader->SetReadFromInputString(true);
  reader->SetInputString(text.c_str(), static_cast<int>(text.size()));
  reader->SetHaveHeaders(header);
  reader->SetFieldDelimiterCharacters(",");
  reader->SetUseStringDelimiter(true);
  reader->SetDetectNumericColumns(header);
  reader->SetForceDouble(true);
  reader->SetTrimWhitespacePriorToNumericConversion(true);
  reader->Update();
  return reader->GetOutput();
}

void AppendTable(const SmvFile& index, const std::string& path, vtkTable* table,
  vtkStringArray* units, vtkDoubleArray* positions)
{
  std::string text = ReadText(path);
  std::erase(text, '\r');
  // A run that still goes has not finished its last line.
  text.erase(text.rfind('\n') == std::string::npos ? 0 : text.rfind('\n') + 1);
  const std::size_t unitsEnd = text.find('\n');
  if (unitsEnd == std::string::npos || text.find('\n', unitsEnd + 1) == std::string::npos)
  {
    throw Error(path, "the device table lacks its two heading lines (units and names)",
      "Wait until the run has written them, or run FDS again");
  }
  const std::size_t namesEnd = text.find('\n', unitsEnd + 1);
  const auto unitRow = ParseCsv(Headings(text.substr(0, unitsEnd + 1)), false);
  const auto values = ParseCsv(
    Headings(text.substr(unitsEnd + 1, namesEnd - unitsEnd)) + text.substr(namesEnd + 1), true);
  if (table->GetNumberOfColumns() > 0 && table->GetNumberOfRows() != values->GetNumberOfRows())
  {
    throw Error(path, "its number of rows differs from that of the run's other device tables",
      "Wait until the run has ended, or keep the devices of a run in one file");
  }
  for (vtkIdType column = 0; column < values->GetNumberOfColumns(); ++column)
  {
    vtkAbstractArray* array = values->GetColumn(column);
    const std::string name(Trim(array->GetName() ? array->GetName() : ""));
    if (column == 0 && table->GetNumberOfColumns() > 0)
    {
      continue; // the times once more
    }
    if (values->GetNumberOfRows() > 0 && !vtkDataArray::SafeDownCast(array))
    {
      throw Error(path, "column '" + name + "' of the device table holds something not a number",
        "The file is damaged: run FDS again");
    }
    array->SetName(name.c_str());
    table->AddColumn(array);
    units->InsertNextValue(column < unitRow->GetNumberOfColumns()
                             ? std::string(Trim(unitRow->GetValue(0, column).ToString()))
                             : std::string());
    const auto device = std::find_if(index.Devices.begin(), index.Devices.end(),
      [&name](const SmvDevice& one) { return one.Name == name; });
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const std::array<double, 3> nowhere{nan, nan, nan};
    positions->InsertNextTuple(
      device == index.Devices.end() ? nowhere.data() : device->Position.data());
  }
}

} // namespace

//------------------------------------------------------------------------------------------------
std::vector<std::string> ReadDeviceTable(const SmvFile& index, vtkTable* table)
{
  vtkNew<vtkStringArray> units;
  units->SetName("Units");
  vtkNew<vtkDoubleArray> positions;
  positions->SetName("Position");
  positions->SetNumberOfComponents(3);
  vtkNew<vtkTable> result;
  std::vector<std::string> warnings;
  for (const auto& [type, file] : index.Tables)
  {
    const std::string path = index.Resolve(file);
    std::error_code problem;
    if (type == "devc" && !std::filesystem::exists(path, problem))
    {
      warnings.push_back(path + ": the device table is missing, so Devices is empty. Copy the file "
                                "that the index names beside the index.");
    }
    else if (type == "devc")
    {
      AppendTable(index, path, result, units, positions);
    }
  }
  result->GetFieldData()->AddArray(units);
  result->GetFieldData()->AddArray(positions);
  table->ShallowCopy(result);
  return warnings;
}

//------------------------------------------------------------------------------------------------
std::vector<std::string> DeviceTableDamages(const SmvFile& index)
{
  std::vector<std::string> lines;
  for (const auto& [type, file] : index.Tables)
  {
    const std::string path = index.Resolve(file);
    std::error_code problem;
    if (type != "devc" || !std::filesystem::is_regular_file(path, problem))
    {
      continue;
    }
    std::ifstream stream(path, std::ios::binary);
    if (stream.seekg(-1, std::ios::end) && stream.get() != '\n')
    {
      lines.push_back(path + ": its last line is cut short");
    }
  }
  return lines;
}

} // namespace smokevis
