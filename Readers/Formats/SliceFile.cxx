#include "SliceFile.h"

#include "TextFields.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace smokevis
{

namespace
{
constexpr std::uint32_t LabelBytes = 30;
constexpr std::uint64_t TimeRecordBytes = sizeof(float) + FortranRecords::MarkerBytes;
// gfortran splits longer records; FDS meshes stay far below.
constexpr std::uint64_t LongestRecord = 2147483639;
} // namespace

//------------------------------------------------------------------------------------------------
SliceFile::SliceFile(const std::string& path, bool cellCentred, const std::string& what)
    : records_(path, LabelBytes, what), cellCentred_(cellCentred)
{
  std::uint64_t offset = 0;
  for (std::string* label : {&quantity_.LongLabel, &quantity_.ShortLabel, &quantity_.Unit})
  {
    std::array<char, LabelBytes> text{};
    offset = records_.Read(offset, std::span<char>(text));
    *label = std::string(Trim(std::string_view(text.data(), text.size())));
  }
  const std::uint64_t rangeOffset = offset;
  firstFrame_ = records_.Read(offset, std::span<int>(range_));
  std::uint64_t values = 1;
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::int64_t low = range_[2 * axis];
    const std::int64_t high = range_[2 * axis + 1];
    if (low < 0 || high < low)
    {
      throw Error(records_.At(rangeOffset),
        "the index range of the " + what + " is reversed or negative",
        "The file is damaged: run FDS again");
    }
    stored_[axis] = static_cast<int>(std::min<std::int64_t>(high - low + 1, LongestRecord));
    // A plane of cells is stored as one layer; along other axes the low layer is a ghost.
    dimensions_[axis] = cellCentred_ && high > low ? stored_[axis] - 1 : stored_[axis];
    // Each factor is below 2^31 and the product is stopped there, so it cannot overflow.
    values *= static_cast<std::uint64_t>(stored_[axis]);
    if (values * sizeof(float) > LongestRecord)
    {
      throw Error(records_.At(rangeOffset),
        "the index range of the " + what + " is too large for one record",
        "The file is damaged: run FDS again");
    }
  }
  valueBytes_ = static_cast<std::uint32_t>(values * sizeof(float));
  this->IndexFrames();
  records_.Close();
  if (times_.empty())
  {
    throw Error(records_.At(firstFrame_),
      "the " + what + " holds no whole frame" + (damage_.empty() ? "" : ": " + damage_),
      "Wait until the run has written one, or run FDS again");
  }
}

//------------------------------------------------------------------------------------------------
void SliceFile::IndexFrames()
{
  const std::uint64_t frameBytes = TimeRecordBytes + valueBytes_ + FortranRecords::MarkerBytes;
  const std::uint64_t frames = (records_.Size() - firstFrame_) / frameBytes;
  times_.reserve(frames);
  for (std::uint64_t frame = 0; frame < frames; ++frame)
  {
    const std::uint64_t offset = firstFrame_ + frame * frameBytes;
    std::array<float, 1> time{};
    if (!records_.HasRecord(offset, sizeof(float)) ||
        !records_.HasRecord(offset + TimeRecordBytes, valueBytes_))
    {
      damage_ =
        "frame " + std::to_string(frame + 1) + " at byte " + std::to_string(offset) + " is damaged";
      return;
    }
    records_.Read(offset, std::span<float>(time));
    if (!std::isfinite(time[0]))
    {
      damage_ = "the time of frame " + std::to_string(frame + 1) + " at byte " +
                std::to_string(offset) + " is not a number";
      return;
    }
    times_.push_back(time[0]);
  }
  if (firstFrame_ + frames * frameBytes != records_.Size())
  {
    damage_ = "frame " + std::to_string(frames + 1) + " at byte " +
              std::to_string(firstFrame_ + frames * frameBytes) + " is cut short";
  }
}

//------------------------------------------------------------------------------------------------
void SliceFile::ReadPart(std::size_t frame, std::size_t first, std::span<float> values)
{
  // The frame's markers were checked when the file was opened.
  const std::uint64_t frameBytes = TimeRecordBytes + valueBytes_ + FortranRecords::MarkerBytes;
  const std::uint64_t begin =
    firstFrame_ + frame * frameBytes + TimeRecordBytes + sizeof(std::uint32_t);
  records_.ReadInside(begin + first * sizeof(float), values);
}

//------------------------------------------------------------------------------------------------
void SliceFile::ReadStored(std::size_t frame, std::vector<float>& values)
{
  const std::uint64_t frameBytes = TimeRecordBytes + valueBytes_ + FortranRecords::MarkerBytes;
  const std::uint64_t offset = firstFrame_ + frame * frameBytes + TimeRecordBytes;
  values.resize(valueBytes_ / sizeof(float));
  records_.Read(offset, std::span<float>(values));
  records_.Close();
}

//------------------------------------------------------------------------------------------------
void SliceFile::ReadFrame(std::size_t frame, std::vector<float>& values)
{
  this->ReadStored(frame, values);
  if (dimensions_ == stored_)
  {
    return;
  }
  // Drop the ghost layers at the low ends in place: every row moves towards the front.
  const std::array<int, 3> ghosts{
    stored_[0] - dimensions_[0], stored_[1] - dimensions_[1], stored_[2] - dimensions_[2]};
  float* target = values.data();
  for (int k = ghosts[2]; k < stored_[2]; ++k)
  {
    for (int j = ghosts[1]; j < stored_[1]; ++j)
    {
      const std::size_t row =
        (static_cast<std::size_t>(k) * stored_[1] + j) * stored_[0] + ghosts[0];
      target = std::copy_n(values.data() + row, dimensions_[0], target);
    }
  }
  values.resize(static_cast<std::size_t>(target - values.data()));
}

} // namespace smokevis
