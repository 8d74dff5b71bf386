// Walks through the lines of an FDS index and fills an SmvFile.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace smokevis
{

class SmvFile;
struct SmvQuantity;
struct SmvEvent;

/// The parser behind SmvFile. Keyword lines start in the first column; what follows one is read by
/// its handler; keywords without a handler are skipped. A run that still goes, or that crashed,
/// ends its index in the middle of an entry: after the meshes that entry is left out with a
/// warning.
class SmvParser
{
public:
  /// Fills @p index from the file that index.Path names.
  explicit SmvParser(SmvFile& index);
  void Run();

private:
  /// Thrown and caught inside the parser when the lines run out.
  struct EndOfIndex
  {
  };

  void ReadLines();
  void Parse(std::string_view line);
  void Check();

  std::string_view Next();
  std::string NextText();
  /// As NextText(), for what is shown rather than looked for on the disk.
  std::string NextLabel();
  std::vector<double> NextNumbers(std::size_t atLeast, const char* what);
  int NextCount(const char* what, std::size_t linesEach);
  int MeshNumber(int oneBased, const char* what) const;
  SmvQuantity NextQuantity();
  [[noreturn]] void Fail(const std::string& what) const;

  void ParseSurface();
  void ParseGrid(std::string_view line);
  void ParseNodes(int axis);
  void ParseObstructions();
  void ParseVents(bool circular);
  void ParseSlice(std::string_view line, bool cellCentred);
  void ParseSmoke3D(std::string_view line);
  void ParsePlot3D(std::string_view line);
  void ParseBoundary(std::string_view line, bool cellCentred);
  void ParseDevice();
  void ParseEvent(std::string_view line, bool obstruction, bool on);
  void LeaveOutChange(const std::string& what);
  std::array<int, 6> CheckedRange(
    const std::vector<double>& numbers, int mesh, const char* what) const;

  SmvFile& index_;
  std::string text_;
  std::vector<std::string_view> lines_;
  std::size_t line_ = 0;
  std::array<int, 3> cells_{};
  /// The first change that is left out, and how many are.
  std::string strangeChange_;
  int strangeChanges_ = 0;
};

} // namespace smokevis
