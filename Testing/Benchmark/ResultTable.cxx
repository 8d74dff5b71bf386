#include "ResultTable.h"

#include <cmath>
#include <cstdio>
#include <stdexcept>

#include <sys/resource.h>

namespace smokevis::benchmark
{

//--------------------------------------------------------------------------------------------------
ResultTable::ResultTable(const std::string& path, const std::vector<std::string>& columns)
    : File_(path), Columns_(columns.size())
{
  if (!this->File_)
  {
    throw std::runtime_error("cannot write " + path);
  }
  this->Row(columns);
}

//--------------------------------------------------------------------------------------------------
void ResultTable::Row(const std::vector<std::string>& cells)
{
  if (cells.size() != this->Columns_)
  {
    throw std::logic_error("a row has another number of cells than the table has columns");
  }
  std::string line;
  for (const std::string& cell : cells)
  {
    if (cell.find(',') != std::string::npos)
    {
      throw std::logic_error("a comma in a cell: " + cell);
    }
    line += (line.empty() ? "" : ",") + cell;
  }
  this->File_ << line << std::endl;
  std::printf("%s\n", line.c_str());
  std::fflush(stdout);
}

//--------------------------------------------------------------------------------------------------
std::string Number(double value)
{
  if (std::isnan(value))
  {
    return {};
  }
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

//--------------------------------------------------------------------------------------------------
double ProcessorSeconds()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time)
  { return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec); };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

//--------------------------------------------------------------------------------------------------
double PeakMemory()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

} // namespace smokevis::benchmark
