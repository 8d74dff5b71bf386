#include "TestReport.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace smokevis::report
{

namespace
{

/// Share of itself that the standard error of a value is, at most: else any value would do.
constexpr double KnownError = 0.15;

void Row(const std::string& name, double reference, double value, double standardError)
{
  const double deviation = value - reference;
  const double relative = reference != 0.0 ? 100.0 * deviation / std::abs(reference) : 0.0;
  std::printf("| %-44s | %12.6g | %12.6g | %+10.4f %% |", name.c_str(), reference, value, relative);
  if (standardError > 0.0)
  {
    std::printf(" %+6.2f |\n", deviation / standardError);
  }
  else
  {
    std::printf("      - |\n");
  }
  std::fflush(stdout);
}

void Judge(const std::string& name, double reference, double value, double allowed)
{
  EXPECT_TRUE(std::abs(value - reference) <= allowed)
    << name << ": " << value << " instead of " << reference << ", allowed +-" << allowed;
}

std::vector<std::string> SplitLine(const std::string& line)
{
  std::vector<std::string> cells;
  // A last cell that is empty counts, too.
  std::istringstream stream(line + ',');
  std::string cell;
  while (std::getline(stream, cell, ','))
  {
    while (!cell.empty() && (cell.back() == '\r' || cell.back() == ' '))
    {
      cell.pop_back();
    }
    cells.push_back(cell);
  }
  return cells;
}

} // namespace

//--------------------------------------------------------------------------------------------------
void Head(const std::string& caption)
{
  std::printf("%s\n| %-44s | %12s | %12s | %12s | %6s |\n", caption.c_str(), "quantity",
    "reference", "value", "deviation", "z");
  std::fflush(stdout);
}

//--------------------------------------------------------------------------------------------------
void Relative(
  const std::string& name, double reference, double value, double tolerance, double standardError)
{
  Row(name, reference, value, standardError);
  Judge(name, reference, value, tolerance * std::abs(reference) + 3.0 * standardError);
  EXPECT_LE(standardError, KnownError * std::abs(reference)) << name << " is not known";
}

//--------------------------------------------------------------------------------------------------
void Absolute(
  const std::string& name, double reference, double value, double tolerance, double standardError)
{
  Row(name, reference, value, standardError);
  Judge(name, reference, value, tolerance + 3.0 * standardError);
  EXPECT_LE(standardError, tolerance) << name << " is not known";
}

//--------------------------------------------------------------------------------------------------
ReferenceTable::ReferenceTable(const std::string& fileName)
{
  const std::string path = std::string(SMOKEVIS_REFERENCES_DIR) + "/" + fileName;
  std::ifstream file(path);
  if (!file)
  {
    throw std::runtime_error("cannot open " + path);
  }
  std::string line;
  while (std::getline(file, line))
  {
    if (line.empty() || line[0] == '#')
    {
      continue;
    }
    if (this->Columns_.empty())
    {
      this->Columns_ = SplitLine(line);
      continue;
    }
    this->Cells_.push_back(SplitLine(line));
    if (this->Cells_.back().size() != this->Columns_.size())
    {
      throw std::runtime_error(path + ": a row has another number of columns than the head");
    }
  }
}

//--------------------------------------------------------------------------------------------------
const std::string& ReferenceTable::Text(std::size_t row, const std::string& column) const
{
  const auto found = std::find(this->Columns_.begin(), this->Columns_.end(), column);
  if (found == this->Columns_.end())
  {
    throw std::runtime_error("the reference table has no column " + column);
  }
  return this->Cells_.at(row)[static_cast<std::size_t>(found - this->Columns_.begin())];
}

//--------------------------------------------------------------------------------------------------
double ReferenceTable::Number(std::size_t row, const std::string& column) const
{
  const std::string& text = this->Text(row, column);
  return text == "inf" ? std::numeric_limits<double>::infinity() : std::stod(text);
}

} // namespace smokevis::report
