// One quantity on one mesh over time, cell by cell, whatever kind of file holds it.
#pragma once

#include "FrameTimes.h"
#include "RowLoops.h"
#include "SmokeCandidates.h"
#include "SmvFile.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace smokevis
{

/// A row of cells along x, as it is read.
class FieldRow
{
public:
  /// Of cells.
  explicit FieldRow(std::span<const float> values) : values_(values) {}

  /// Of nodes: sums of two rows each in front and behind, of a row of nodes below and the one
  /// above.
  FieldRow(const float* before, const float* sums, std::span<float> space)
      : before_(before), sums_(sums), space_(space)
  {
  }

  std::size_t size() const { return before_ ? space_.size() : values_.size(); }

  /// A value a cell.
  std::span<const float> Values() const
  {
    if (!before_)
    {
      return values_;
    }
    MeansOfNodes(before_, sums_, space_);
    return space_;
  }

  /// CopyExtinction() of Values(), in one go.
  bool CopyTo(float* target) const
  {
    return before_ ? CopyExtinctionOfNodes(before_, sums_, space_.size(), target)
                   : CopyExtinction(values_, target);
  }

private:
  std::span<const float> values_;
  const float* before_ = nullptr;
  const float* sums_ = nullptr;
  std::span<float> space_;
};

/// A candidate with its files open. One thread at a time may read it.
class VolumeField
{
public:
  /// @param index the run; must outlive this object. Throws Error when a file is missing or
  /// damaged.
  VolumeField(const SmvFile& index, SmokeCandidate candidate);

  const SmokeCandidate& Of() const { return of_; }
  FrameFile& File() { return *file_; }
  const FrameFile& File() const { return *file_; }
  const FrameTimes& Times() const { return times_; }

  /// Reads a frame and calls visit(cell, j, k, row) for each row of cells of the range, where cell
  /// is the number of the first and row the FieldRow of all; a cell gets the mean of its eight
  /// nodes. FDS gives a node the mean over its gas cells, and 0 without any; all eight nodes of a
  /// gas cell have one: the cell itself. Of 8-bit smoke, where FDS averaged solid cells in as clear
  /// ones, they are taken out again.
  /// @param solid   marks the mesh's solid cells; empty for none
  /// @param scratch working space
  /// @param prepare prepare(values) may change the values that the file has first
  template <class Prepare, class Visit>
  void ForEachRow(std::size_t frame, const std::vector<unsigned char>& solid,
    std::vector<float>& scratch, Prepare&& prepare, Visit&& visit);

  /// Sets the cells that the field covers to its values at @p time; leaves solids and others alone.
  /// @p scratch is working space. Returns the time that the values are of.
  double ReadCells(double time, TimeInterpolation interpolation,
    const std::vector<unsigned char>& solid, std::vector<float>& scratch, std::span<float> cells);

private:
  void ReadFrame(
    std::size_t frame, const std::vector<unsigned char>& solid, std::vector<float>& values);

  /// Visits the rows of layers [begin, end); @p first is the first value of the first of them.
  template <class Visit>
  void VisitLayers(int begin, int end, const float* first, Visit&& visit) const;

  const SmvMesh& mesh_;
  SmokeCandidate of_;
  std::unique_ptr<FrameFile> file_;
  FrameTimes times_;
};

//------------------------------------------------------------------------------------------------
template <class Prepare, class Visit>
void VolumeField::ForEachRow(std::size_t frame, const std::vector<unsigned char>& solid,
  std::vector<float>& scratch, Prepare&& prepare, Visit&& visit)
{
  const IndexRange& r = of_.Range;
  const std::array<int, 3>& stored = file_->StoredDimensions();
  const std::array<int, 3>& used = file_->Dimensions();
  const auto stride = static_cast<std::size_t>(stored[0]);
  const std::size_t layer = stride * static_cast<std::size_t>(stored[1]);
  // What is stored before the first value that is used, in a layer and of layers.
  const std::size_t surplus = (stored[1] - used[1]) * stride + (stored[0] - used[0]);
  const auto ghosts = static_cast<std::size_t>(stored[2] - used[2]);
  if (!file_->ReadsParts())
  {
    this->ReadFrame(frame, solid, scratch);
    prepare(std::span<float>(scratch));
    this->VisitLayers(r[4], r[5], scratch.data() + ghosts * layer + surplus, visit);
    return;
  }
  // Cells need each layer once; of nodes, the last of a part is the first of the next again.
  const std::size_t partBytes = of_.CellCentred ? 64 << 10 : 96 << 10;
  const std::size_t shared = of_.CellCentred ? 0 : layer;
  const int layers = static_cast<int>(std::max<std::size_t>(partBytes / sizeof(float) / layer, 1));
  for (int begin = r[4]; begin < r[5]; begin += layers)
  {
    const int end = std::min(begin + layers, r[5]);
    const std::size_t kept = begin == r[4] ? 0 : shared;
    std::copy(scratch.end() - static_cast<std::ptrdiff_t>(kept), scratch.end(), scratch.begin());
    scratch.resize((end - begin) * layer + shared);
    const std::span<float> fresh = std::span<float>(scratch).subspan(kept);
    file_->ReadPart(frame, (begin - r[4] + ghosts) * layer + kept, fresh);
    prepare(fresh);
    this->VisitLayers(begin, end, scratch.data() + surplus, visit);
  }
  file_->CloseParts();
}

//------------------------------------------------------------------------------------------------
template <class Visit>
void VolumeField::VisitLayers(int begin, int end, const float* first, Visit&& visit) const
{
  const IndexRange& r = of_.Range;
  const auto nx = static_cast<std::size_t>(mesh_.Cells(0));
  const auto ny = static_cast<std::size_t>(mesh_.Cells(1));
  const auto stride = static_cast<std::size_t>(file_->StoredDimensions()[0]);
  const std::size_t layer = stride * static_cast<std::size_t>(file_->StoredDimensions()[1]);
  const auto length = static_cast<std::size_t>(r[1] - r[0]);
  // Of nodes: sums over two layers, of a row of nodes and of the next one, and the cells' means.
  std::vector<float> low(length + 1);
  std::vector<float> high(length + 1);
  std::vector<float> means(length);
  for (int k = begin; k < end; ++k)
  {
    const float* row = first + (k - begin) * layer;
    if (!of_.CellCentred)
    {
      AddRows(row, row + layer, high);
    }
    for (int j = r[2]; j < r[3]; ++j)
    {
      const std::size_t cell = (static_cast<std::size_t>(k) * ny + j) * nx + r[0];
      if (of_.CellCentred)
      {
        visit(cell, j, k, FieldRow({row, length}));
        row += stride;
        continue;
      }
      row += stride;
      low.swap(high);
      AddRows(row, row + layer, high);
      visit(cell, j, k, FieldRow(low.data(), high.data(), means));
    }
  }
}

} // namespace smokevis
