// Rows of a benchmark, written to a CSV file and to the terminal as they come.
#pragma once

#include <chrono>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

namespace smokevis::benchmark
{

/// A CSV file that is begun anew. Each row is written at once, so that a run that is cut short
/// leaves what it measured.
class ResultTable
{
public:
  ResultTable(const std::string& path, const std::vector<std::string>& columns);

  /// As many cells as there are columns, without commas.
  void Row(const std::vector<std::string>& cells);

private:
  std::ofstream File_;
  std::size_t Columns_;
};

/// Four significant digits; empty for NaN, which stands for "not measured".
std::string Number(double value);

/// Takes one of so many values into their root mean square, which begins as 0.
inline void AddToRootMeanSquare(double value, int count, double& all)
{
  all = std::sqrt(all * all + value * value / count);
}

/// Processor time that this process has used so far, over all threads [s].
double ProcessorSeconds();

/// Time since it was made: on the clock, and of the processors, which says more on a busy machine.
class StopWatch
{
public:
  double Processors() const { return ProcessorSeconds() - this->Processors_; }
  double Seconds() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - this->Start_).count();
  }

private:
  std::chrono::steady_clock::time_point Start_ = std::chrono::steady_clock::now();
  double Processors_ = ProcessorSeconds();
};

/// Largest resident memory of this process so far [MiB].
double PeakMemory();

} // namespace smokevis::benchmark
