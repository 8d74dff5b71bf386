// A NetCDF file that is being written.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace smokevis
{

/// Thin, exception-throwing handle of a file in the classic format with 64-bit offsets, which every
/// NetCDF reader knows. Where it is not finished the file is removed again.
class NetcdfFile
{
public:
  /// Throws Error where the file cannot be made.
  explicit NetcdfFile(const std::string& path);
  ~NetcdfFile();
  NetcdfFile(const NetcdfFile&) = delete;
  NetcdfFile& operator=(const NetcdfFile&) = delete;

  /// A dimension; a length of 0 makes the one that grows.
  int Dimension(const std::string& name, std::size_t length);
  enum class Type
  {
    Character,
    Integer,
    Float,
    Double
  };
  int Variable(const std::string& name, Type type, const std::vector<int>& dimensions);
  /// Attributes of a variable, or of the file for Whole.
  static const int Whole;
  void Attribute(int variable, const std::string& name, const std::string& text);
  void Attribute(int variable, const std::string& name, double value);
  void Attribute(int variable, const std::string& name, const std::vector<int>& values);
  void EndDefinitions();

  /// Writes a block that begins at an index along each dimension.
  void Write(int variable, const std::vector<std::size_t>& start,
    const std::vector<std::size_t>& count, const double* values);
  void Write(int variable, const std::vector<std::size_t>& start,
    const std::vector<std::size_t>& count, const char* text);
  /// Closes the file for good.
  void Finish();

private:
  void Check(int status) const;

  std::string Path_;
  int Id_ = -1;
  bool Open_ = false;
};

} // namespace smokevis
