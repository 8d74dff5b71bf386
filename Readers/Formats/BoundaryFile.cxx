#include "BoundaryFile.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <span>

namespace smokevis
{

namespace
{
constexpr std::uint32_t LabelBytes = 30;
constexpr std::uint64_t TimeRecordBytes = sizeof(float) + FortranRecords::MarkerBytes;
// i1 i2 j1 j2 k1 k2, direction into the gas, obstruction, mesh.
using PatchRecord = std::array<int, 9>;
} // namespace

//------------------------------------------------------------------------------------------------
std::size_t BoundaryPatch::Nodes() const
{
  std::size_t nodes = 1;
  for (int axis = 0; axis < 3; ++axis)
  {
    nodes *= static_cast<std::size_t>(Range[2 * axis + 1] - Range[2 * axis] + 1);
  }
  return nodes;
}

//------------------------------------------------------------------------------------------------
BoundaryFile::BoundaryFile(const std::string& path, const SmvMesh& mesh, const std::string& what)
    : records_(path, LabelBytes, what)
{
  std::uint64_t offset = 0;
  for (int label = 0; label < 3; ++label)
  {
    std::array<char, LabelBytes> text{};
    offset = records_.Read(offset, std::span<char>(text));
  }
  this->ReadPatches(offset, mesh);
  this->IndexFrames(offset);
  records_.Close();
  if (times_.empty())
  {
    throw Error(records_.At(firstFrame_),
      "the " + what + " holds no whole frame" + (damage_.empty() ? "" : ": " + damage_),
      "Wait until the run has written one, or run FDS again");
  }
}

//------------------------------------------------------------------------------------------------
void BoundaryFile::ReadPatches(std::uint64_t& offset, const SmvMesh& mesh)
{
  std::array<int, 1> count{};
  const std::uint64_t countAt = offset;
  offset = records_.Read(offset, std::span<int>(count));
  constexpr std::uint64_t patchBytes = sizeof(PatchRecord) + FortranRecords::MarkerBytes;
  if (count[0] < 1 || static_cast<std::uint64_t>(count[0]) > records_.Size() / patchBytes)
  {
    throw Error(records_.At(countAt),
      "the " + records_.What() + " claims " + std::to_string(count[0]) + " patches",
      "The file is damaged: run FDS again");
  }
  frameBytes_ = TimeRecordBytes;
  for (int i = 0; i < count[0]; ++i)
  {
    PatchRecord record{};
    const std::uint64_t recordAt = offset;
    offset = records_.Read(offset, std::span<int>(record));
    BoundaryPatch patch;
    std::copy_n(record.begin(), 6, patch.Range.begin());
    // The least integer has no absolute value.
    patch.Axis = record[6] < -3 || record[6] > 3 ? -1 : std::abs(record[6]) - 1;
    patch.Obstruction = record[7] > 0 ? record[7] - 1 : -1;
    bool good = patch.Axis >= 0 && patch.Range[2 * patch.Axis] == patch.Range[2 * patch.Axis + 1];
    for (int axis = 0; axis < 3; ++axis)
    {
      const int low = patch.Range[2 * axis];
      const int high = patch.Range[2 * axis + 1];
      good = good && low >= 0 && low <= high && high <= mesh.Cells(axis);
    }
    if (!good)
    {
      throw Error(records_.At(recordAt),
        "patch " + std::to_string(i + 1) + " of the " + records_.What() +
          " is no rectangle on a grid plane of mesh '" + mesh.Name + "'",
        "The file is damaged, or of another run: copy both from the same one");
    }
    frameBytes_ += patch.Nodes() * sizeof(float) + FortranRecords::MarkerBytes;
    patches_.push_back(patch);
  }
}

//------------------------------------------------------------------------------------------------
void BoundaryFile::IndexFrames(std::uint64_t offset)
{
  firstFrame_ = offset;
  const std::uint64_t frames = (records_.Size() - firstFrame_) / frameBytes_;
  const auto bytes = [](const BoundaryPatch& patch)
  { return static_cast<std::uint32_t>(patch.Nodes() * sizeof(float)); };
  for (std::uint64_t frame = 0; frame < frames; ++frame)
  {
    const std::uint64_t begin = firstFrame_ + frame * frameBytes_;
    const std::uint64_t last =
      begin + frameBytes_ - bytes(patches_.back()) - FortranRecords::MarkerBytes;
    std::array<float, 1> time{};
    const std::string place =
      "frame " + std::to_string(frame + 1) + " at byte " + std::to_string(begin);
    if (!records_.HasRecord(begin, sizeof(float)) ||
        !records_.HasRecord(begin + TimeRecordBytes, bytes(patches_.front())) ||
        !records_.HasRecord(last, bytes(patches_.back())))
    {
      damage_ = place + " is damaged";
      return;
    }
    records_.Read(begin, std::span<float>(time));
    if (!std::isfinite(time[0]))
    {
      damage_ = "the time of " + place + " is not a number";
      return;
    }
    times_.push_back(time[0]);
  }
  const std::uint64_t end = firstFrame_ + frames * frameBytes_;
  if (end != records_.Size())
  {
    damage_ =
      "frame " + std::to_string(frames + 1) + " at byte " + std::to_string(end) + " is cut short";
  }
}

//------------------------------------------------------------------------------------------------
void BoundaryFile::ReadFrame(std::size_t frame, std::vector<float>& values)
{
  std::uint64_t offset = firstFrame_ + frame * frameBytes_ + TimeRecordBytes;
  const std::uint64_t patches = patches_.size();
  values.resize(
    (frameBytes_ - TimeRecordBytes - patches * FortranRecords::MarkerBytes) / sizeof(float));
  std::span<float> rest(values);
  for (const BoundaryPatch& patch : patches_)
  {
    offset = records_.Read(offset, rest.first(patch.Nodes()));
    rest = rest.subspan(patch.Nodes());
  }
  records_.Close();
}

} // namespace smokevis
