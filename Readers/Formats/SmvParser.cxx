// The way through the index's lines, and the checks at its end.
#include "SmvParser.h"

#include "Errors.h"
#include "PrintableText.h"
#include "SmvFile.h"
#include "TextFields.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>

namespace smokevis
{

namespace
{
// A thousand meshes with thousands of obstructions each stay far below.
constexpr std::uintmax_t MostBytes = std::uintmax_t{4} << 30;
} // namespace

//------------------------------------------------------------------------------------------------
SmvParser::SmvParser(SmvFile& index) : index_(index)
{
}

//------------------------------------------------------------------------------------------------
void SmvParser::Run()
{
  this->ReadLines();
  std::size_t entry = 0;
  try
  {
    while (line_ < lines_.size())
    {
      entry = line_;
      this->Parse(this->Next());
    }
  }
  catch (const EndOfIndex&)
  {
    const std::string place = "the index ends inside the entry " +
                              std::string(Trim(lines_[entry])) + " of line " +
                              std::to_string(entry + 1);
    const bool meshesWhole =
      !index_.Meshes.empty() &&
      index_.Slices.size() + index_.Smoke3D.size() + index_.Plot3D.size() > 0;
    if (!meshesWhole)
    {
      throw Error(
        index_.Path, place, "Wait until the run has written its meshes, or run FDS again");
    }
    index_.Warnings.push_back(index_.Path + ": " + place + ", which is left out.");
  }
  this->Check();
}

//------------------------------------------------------------------------------------------------
void SmvParser::ReadLines()
{
  std::error_code problem;
  std::ifstream stream;
  // Opening a pipe would wait for whoever writes into it.
  if (std::filesystem::is_regular_file(index_.Path, problem))
  {
    stream.open(index_.Path, std::ios::binary);
  }
  if (!stream.is_open())
  {
    throw Error(index_.Path, "the FDS index cannot be opened", "Check the name and permissions");
  }
  const std::uintmax_t bytes = std::filesystem::file_size(index_.Path);
  if (bytes > MostBytes)
  {
    throw Error(index_.Path,
      "it has " + std::to_string(bytes) + " bytes, more than the index of any run",
      "Choose the .smv file that FDS wrote beside its results");
  }
  text_.resize(bytes);
  stream.read(text_.data(), static_cast<std::streamsize>(text_.size()));
  if (!stream)
  {
    throw Error(index_.Path, "reading the FDS index failed", "Check the disk");
  }
  // A crash of the file system leaves zeros, which would end messages early.
  std::replace(text_.begin(), text_.end(), '\0', ' ');
  if (Trim(text_).empty())
  {
    throw Error(
      index_.Path, "the FDS index is empty", "Wait until the run has written it, or run FDS again");
  }
  std::string_view rest = text_;
  while (!rest.empty())
  {
    const std::size_t end = rest.find('\n');
    std::string_view line = rest.substr(0, end);
    rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
    if (line.ends_with('\r'))
    {
      line.remove_suffix(1);
    }
    lines_.push_back(line);
  }
}

//------------------------------------------------------------------------------------------------
void SmvParser::Parse(std::string_view line)
{
  const std::string_view word = Before(line, ' ');
  const std::string_view rest = Trim(line.substr(word.size()));
  static constexpr std::array<std::string_view, 3> nodes{"TRNX", "TRNY", "TRNZ"};
  if (word.empty())
  {
    return;
  }
  if (word == "CHID")
  {
    index_.Chid = this->NextLabel();
  }
  else if (word == "TITLE")
  {
    index_.Title = this->NextLabel();
  }
  else if (word == "FDSVERSION" || word == "VERSION")
  {
    index_.Version = this->NextLabel();
  }
  else if (word == "SURFDEF")
  {
    index_.DefaultSurfaceName = this->NextLabel();
  }
  else if (word == "TIMES")
  {
    const auto times = this->NextNumbers(2, "times");
    index_.Times = {times[0], times[1]};
  }
  else if (word == "ALBEDO")
  {
    index_.Albedo = this->NextNumbers(1, "albedo")[0];
  }
  else if (word == "HRRPUV_MINMAX" || word == "TEMP_MINMAX")
  {
    const auto range = this->NextNumbers(2, "scale");
    (word == "TEMP_MINMAX" ? index_.TemperatureRange : index_.HeatReleaseRange) = {
      range[0], range[1]};
  }
  else if (word == "CSVF")
  {
    std::string type = this->NextText();
    index_.Tables.emplace_back(std::move(type), this->NextText());
  }
  else if (word == "SURFACE")
  {
    this->ParseSurface();
  }
  else if (word == "GRID")
  {
    this->ParseGrid(rest);
  }
  else if (const auto axis = std::find(nodes.begin(), nodes.end(), word); axis != nodes.end())
  {
    this->ParseNodes(static_cast<int>(axis - nodes.begin()));
  }
  else if (word == "OBST")
  {
    this->ParseObstructions();
  }
  else if (word == "VENT" || word == "CVENT")
  {
    this->ParseVents(word == "CVENT");
  }
  else if (word == "SLCF" || word == "SLCC")
  {
    this->ParseSlice(rest, word == "SLCC");
  }
  else if (word == "SMOKF3D" || word == "SMOKG3D" || word == "SMOKE3D")
  {
    this->ParseSmoke3D(rest);
  }
  else if (word == "PL3D")
  {
    this->ParsePlot3D(rest);
  }
  else if (word == "BNDF" || word == "BNDC")
  {
    this->ParseBoundary(rest, word == "BNDC");
  }
  else if (word == "GEOM" || word == "BGEOM" || word == "CGEOM")
  {
    // Lines about the single bodies follow the file, indented.
    index_.Geometries.push_back({word == "CGEOM", this->NextText()});
  }
  else if (word == "DEVICE")
  {
    this->ParseDevice();
  }
  else if (word == "HIDE_OBST" || word == "SHOW_OBST")
  {
    this->ParseEvent(rest, true, word == "SHOW_OBST");
  }
  else if (word == "OPEN_VENT" || word == "CLOSE_VENT")
  {
    this->ParseEvent(rest, false, word == "OPEN_VENT");
  }
}

//------------------------------------------------------------------------------------------------
void SmvParser::Check()
{
  if (strangeChanges_ > 0)
  {
    const std::string more =
      strangeChanges_ > 1 ? " (and " + std::to_string(strangeChanges_ - 1) + " more like it)" : "";
    index_.Warnings.push_back(
      strangeChange_ + more + ". What it shows, hides, opens or closes stays as it is.");
  }
  if (index_.Meshes.empty())
  {
    throw Error(index_.Path, "the file names no mesh (no GRID entry)",
      "Choose the .smv file that FDS wrote beside its results");
  }
  const int surfaces = static_cast<int>(index_.Surfaces.size());
  for (SmvMesh& mesh : index_.Meshes)
  {
    for (const std::vector<double>& coordinates : mesh.Nodes)
    {
      if (coordinates.size() < 2)
      {
        throw Error(index_.Path, "mesh '" + mesh.Name + "' has no TRNX, TRNY or TRNZ entry",
          "Wait until the run has written its meshes, or run FDS again");
      }
    }
    const auto checkSurface = [&](int surface)
    {
      if (surface < 0 || surface >= surfaces)
      {
        throw Error(index_.Path,
          "an obstruction or vent of mesh '" + mesh.Name + "' has surface number " +
            std::to_string(surface) + " of " + std::to_string(surfaces),
          "The index is damaged: run FDS again");
      }
    };
    for (const SmvObstruction& obstruction : mesh.Obstructions)
    {
      std::for_each(obstruction.Surfaces.begin(), obstruction.Surfaces.end(), checkSurface);
    }
    for (const SmvVent& vent : mesh.Vents)
    {
      checkSurface(vent.Surface);
    }
  }
  if (index_.Surfaces.empty())
  {
    index_.Surfaces.emplace_back().Name = "INERT";
  }
}

//------------------------------------------------------------------------------------------------
void SmvParser::Fail(const std::string& what) const
{
  // The last line of a file being written may be cut short.
  if (line_ == lines_.size() && !text_.ends_with('\n'))
  {
    throw EndOfIndex();
  }
  throw Error(index_.Path + ", line " + std::to_string(line_), what,
    "The index is damaged or from an FDS version that is not known here");
}

//------------------------------------------------------------------------------------------------
std::string_view SmvParser::Next()
{
  if (line_ >= lines_.size())
  {
    throw EndOfIndex();
  }
  return lines_[line_++];
}

//------------------------------------------------------------------------------------------------
std::string SmvParser::NextText()
{
  return std::string(Trim(this->Next()));
}

//------------------------------------------------------------------------------------------------
std::string SmvParser::NextLabel()
{
  return Printable(Trim(this->Next()));
}

//------------------------------------------------------------------------------------------------
std::vector<double> SmvParser::NextNumbers(std::size_t atLeast, const char* what)
{
  std::vector<double> numbers = SplitNumbers(this->Next());
  if (numbers.size() < atLeast)
  {
    this->Fail("expected " + std::to_string(atLeast) + " numbers (" + what + ")");
  }
  return numbers;
}

//------------------------------------------------------------------------------------------------
int SmvParser::NextCount(const char* what, std::size_t linesEach)
{
  const double count = this->NextNumbers(1, what)[0];
  if (count < 0 || count != std::floor(count))
  {
    this->Fail(std::string("the number of ") + what + " is not a count");
  }
  if (count * static_cast<double>(linesEach) > static_cast<double>(lines_.size() - line_))
  {
    throw EndOfIndex();
  }
  return static_cast<int>(count);
}

//------------------------------------------------------------------------------------------------
int SmvParser::MeshNumber(int oneBased, const char* what) const
{
  if (oneBased < 1 || oneBased > static_cast<int>(index_.Meshes.size()))
  {
    this->Fail(std::string(what) + " names mesh " + std::to_string(oneBased) + " of " +
               std::to_string(index_.Meshes.size()));
  }
  return oneBased - 1;
}

//------------------------------------------------------------------------------------------------
SmvQuantity SmvParser::NextQuantity()
{
  SmvQuantity quantity;
  quantity.LongLabel = this->NextLabel();
  quantity.ShortLabel = this->NextLabel();
  quantity.Unit = this->NextLabel();
  return quantity;
}

} // namespace smokevis
