#include "Smoke3DFile.h"

#include "TextFields.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace smokevis
{

namespace
{

constexpr std::uint32_t HeaderBytes = 8 * sizeof(int);
constexpr int NewestVersion = 1;
constexpr double GreatestByte = 254.0;
constexpr unsigned char RunMark = 255;

// The file called as another with an ending, which is in capital letters where the other's name
// was written so on its way; with the small ending where there is none.
std::string Companion(const std::string& path, const char* ending, const char* capitals)
{
  std::error_code problem;
  const bool capital = !std::filesystem::exists(path + ending, problem) &&
                       std::filesystem::exists(path + capitals, problem);
  return path + (capital ? capitals : ending);
}

std::string TwinOrSelf(const std::string& path)
{
  std::error_code problem;
  const std::string twin = Companion(path, "d", "D");
  return std::filesystem::exists(twin, problem) ? twin : path;
}

} // namespace

//------------------------------------------------------------------------------------------------
bool DecodeRuns(std::span<const unsigned char> coded, std::span<unsigned char> bytes)
{
  const unsigned char* from = coded.data();
  const unsigned char* const end = from + coded.size();
  unsigned char* to = bytes.data();
  std::size_t left = bytes.size();
  while (from != end)
  {
    if (*from == RunMark)
    {
      if (end - from < 3 || from[2] > left)
      {
        return false;
      }
      std::memset(to, from[1], from[2]);
      to += from[2];
      left -= from[2];
      from += 3;
      continue;
    }
    // Most bytes between two runs stand for few cells: looking ahead pays from a handful on.
    const auto* mark = from + 1;
    while (mark != end && *mark != RunMark && mark - from < 16)
    {
      ++mark;
    }
    if (mark != end && *mark != RunMark)
    {
      const void* next = std::memchr(mark, RunMark, static_cast<std::size_t>(end - mark));
      mark = next ? static_cast<const unsigned char*>(next) : end;
    }
    const auto length = static_cast<std::size_t>(mark - from);
    if (length > left)
    {
      return false;
    }
    std::memcpy(to, from, length);
    to += length;
    left -= length;
    from = mark;
  }
  return left == 0;
}

//------------------------------------------------------------------------------------------------
Smoke3DFile::Smoke3DFile(const std::string& path, const std::array<int, 3>& nodes, double firstCell,
  const std::string& what)
    : records_(TwinOrSelf(path), HeaderBytes, what), nodes_(nodes), firstCell_(firstCell),
      scale_(records_.Path() != path ? Scale::Density : Scale::Opacity)
{
  this->Open();
  if (scale_ == Scale::Density)
  {
    this->ReadGreatestDensities(Companion(path, ".sz", ".SZ"));
  }
  if (times_.empty())
  {
    throw Error(records_.Path(), "the " + what + " holds no whole frame: " + damage_,
      "Wait until the run has written one, or run FDS again");
  }
}

//------------------------------------------------------------------------------------------------
Smoke3DFile::Smoke3DFile(const std::string& path, const std::array<int, 3>& nodes,
  const std::array<double, 2>& range, const std::string& what)
    : records_(path, HeaderBytes, what), nodes_(nodes), range_(range), scale_(Scale::Range)
{
  this->Open();
}

//------------------------------------------------------------------------------------------------
void Smoke3DFile::Open()
{
  this->ReadHeader();
  this->IndexFrames();
  records_.Close();
  if (times_.empty())
  {
    throw Error(records_.At(HeaderBytes + FortranRecords::MarkerBytes),
      "the " + records_.What() + " holds no whole frame" + (damage_.empty() ? "" : ": " + damage_),
      "Wait until the run has written one, or run FDS again");
  }
}

//------------------------------------------------------------------------------------------------
bool Smoke3DFile::HoldsDensity(const std::string& path)
{
  try
  {
    std::array<int, 8> header{};
    FortranRecords(TwinOrSelf(path), HeaderBytes, "3-D smoke").Read(0, std::span<int>(header));
    return TwinOrSelf(path) != path || header[1] == 1;
  }
  catch (const Error&)
  {
    return false; // opening it, if it comes to that, says what is wrong
  }
}

//------------------------------------------------------------------------------------------------
void Smoke3DFile::ReadHeader()
{
  // 1, VERSION, 0, IBAR, 0, JBAR, 0, KBAR
  std::array<int, 8> header{};
  records_.Read(0, std::span<int>(header));
  if (header[1] < 0 || header[1] > NewestVersion)
  {
    throw Error(records_.At(0),
      "3-D smoke of version " + std::to_string(header[1]) + " is not known here",
      "Write a 3-D slice of EXTINCTION COEFFICIENT instead");
  }
  if (scale_ == Scale::Opacity && header[1] == 1)
  {
    scale_ = Scale::Density;
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    if (header[2 + 2 * axis] != 0 || header[3 + 2 * axis] != nodes_[axis] - 1)
    {
      throw Error(records_.At(0),
        "the index range of the " + records_.What() + " is not that of the mesh in the index",
        "The two are of different runs: copy both from the same one");
    }
  }
}

//------------------------------------------------------------------------------------------------
void Smoke3DFile::IndexFrames()
{
  const std::int64_t values = static_cast<std::int64_t>(nodes_[0]) * nodes_[1] * nodes_[2];
  std::uint64_t offset = HeaderBytes + FortranRecords::MarkerBytes;
  while (offset < records_.Size())
  {
    const std::string place =
      "frame " + std::to_string(frames_.size() + 1) + " at byte " + std::to_string(offset);
    std::array<float, 1> time{};
    std::array<int, 2> sizes{};
    const std::uint64_t sizesAt = offset + sizeof(float) + FortranRecords::MarkerBytes;
    const std::uint64_t bytesAt = sizesAt + sizeof(sizes) + FortranRecords::MarkerBytes;
    if (!records_.Holds(offset, sizeof(float)) || !records_.Holds(sizesAt, sizeof(sizes)))
    {
      damage_ = place + " is cut short";
      return;
    }
    if (!records_.HasRecord(offset, sizeof(float)) || !records_.HasRecord(sizesAt, sizeof(sizes)))
    {
      damage_ = place + " is damaged";
      return;
    }
    records_.Read(offset, std::span<float>(time));
    records_.Read(sizesAt, std::span<int>(sizes));
    if (!std::isfinite(time[0]) || sizes[0] != values || sizes[1] < 0)
    {
      damage_ = place + " is damaged";
      return;
    }
    const auto bytes = static_cast<std::uint32_t>(sizes[1]);
    if (!records_.HasRecord(bytesAt, bytes))
    {
      damage_ = place + (records_.Holds(bytesAt, bytes) ? " is damaged" : " is cut short");
      return;
    }
    frames_.push_back({bytesAt, bytes, 0.0});
    times_.push_back(time[0]);
    offset = bytesAt + bytes + FortranRecords::MarkerBytes;
  }
}

//------------------------------------------------------------------------------------------------
void Smoke3DFile::ReadGreatestDensities(const std::string& path)
{
  // A pipe or a device in its place might never end.
  std::error_code problem;
  std::ifstream stream;
  if (std::filesystem::is_regular_file(path, problem))
  {
    stream.open(path);
  }
  std::string line;
  // The first line is the version; then one line a frame.
  if (!stream.is_open() || !std::getline(stream, line))
  {
    throw Error(path,
      "the text file with the greatest densities of " + records_.Path() + " cannot be read",
      "Copy it beside the index, or run FDS again");
  }
  std::size_t frame = 0;
  while (frame < frames_.size() && std::getline(stream, line))
  {
    const std::vector<double> numbers = SplitNumbers(line);
    if (numbers.size() < 4 || !(numbers.back() >= 0.0) ||
        std::abs(numbers[0] - times_[frame]) > 1e-4 * std::max(1.0, std::abs(times_[frame])))
    {
      break;
    }
    frames_[frame++].Greatest = numbers.back();
  }
  if (frame < frames_.size())
  {
    damage_ = path + " has no greatest density for frame " + std::to_string(frame + 1);
    frames_.resize(frame);
    times_.resize(frame);
  }
}

//------------------------------------------------------------------------------------------------
std::array<float, 256> Smoke3DFile::Values(const Frame& frame) const
{
  std::array<float, 256> values{};
  for (std::size_t b = 0; b < values.size(); ++b)
  {
    const double part = std::min(static_cast<double>(b) / GreatestByte, 1.0);
    // Smoke is rounded to the nearest byte, other quantities downwards: the middle of what a byte
    // stands for is taken, except for the ends.
    const bool end = b == 0 || static_cast<double>(b) >= GreatestByte;
    const double middle = end ? part : (static_cast<double>(b) + 0.5) / GreatestByte;
    // Full opacity, which no K gives, stands for anything that rounds to it.
    const double opacity = std::min(part, 1.0 - 0.5 / GreatestByte);
    const double value = scale_ == Scale::Density   ? part * frame.Greatest
                         : scale_ == Scale::Opacity ? -std::log1p(-opacity) / firstCell_
                                                    : range_[0] + middle * (range_[1] - range_[0]);
    values[b] = static_cast<float>(value);
  }
  return values;
}

//------------------------------------------------------------------------------------------------
void Smoke3DFile::ReadFrame(std::size_t frame, std::vector<float>& values)
{
  const Frame& place = frames_[frame];
  coded_.resize(place.Bytes);
  records_.Read(place.Offset, std::span<unsigned char>(coded_));
  records_.Close();
  const std::size_t count = static_cast<std::size_t>(nodes_[0]) * nodes_[1] * nodes_[2];
  // A run of three bytes stands for 255 values at the most.
  const bool possible = count <= static_cast<std::size_t>(place.Bytes) * 255;
  bytes_.resize(possible ? count : 0);
  if (!possible || !DecodeRuns(coded_, bytes_))
  {
    throw Error(records_.At(place.Offset),
      "a compressed frame of the " + records_.What() + " does not unpack to " +
        std::to_string(count) + " values",
      "The file is damaged: read another time, or run FDS again");
  }
  const std::array<float, 256> meaning = this->Values(place);
  values.resize(count);
  std::transform(
    bytes_.begin(), bytes_.end(), values.begin(), [&](unsigned char b) { return meaning[b]; });
}

} // namespace smokevis
