// Rows of the validation report and the assertions behind them; reading of reference tables.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace smokevis::report
{

/// Prints the head of a table with a caption.
void Head(const std::string& caption);

/// Prints a row (reference, value, relative deviation, and z-score where there is a standard error)
/// and fails where |value - reference| > tolerance |reference| + 3 standardError, or where the
/// standard error is above 15 % of the reference.
void Relative(const std::string& name, double reference, double value, double tolerance,
  double standardError = 0.0);

/// The same with a tolerance in the values' own unit, which their standard error may not exceed.
void Absolute(const std::string& name, double reference, double value, double tolerance,
  double standardError = 0.0);

/// A table of numbers and words, separated by commas; lines that begin with # are comments.
class ReferenceTable
{
public:
  /// Reads a file of the references directory; throws std::runtime_error where it cannot.
  explicit ReferenceTable(const std::string& fileName);

  std::size_t Rows() const { return this->Cells_.size(); }
  const std::string& Text(std::size_t row, const std::string& column) const;
  double Number(std::size_t row, const std::string& column) const;

private:
  std::vector<std::string> Columns_;
  std::vector<std::vector<std::string>> Cells_;
};

} // namespace smokevis::report
