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
  /// is the number of the first and row the values of all; a cell gets the mean of its eight nodes.
  /// FDS gives a node the mean over its gas cells, and 0 without any; all eight nodes of a gas cell
  /// have one: the cell itself. Of 8-bit smoke, where FDS averaged solid cells in as clear ones,
  /// they are taken out again.
  /// @param solid   marks the mesh's solid cells; empty for none
  /// @param scratch working space
  /// @param prepare prepare(values) may change the values that the file has first
  template <class Prepare, class Visit>
  void ForEachRow(std::size_t frame, const std::vector<unsigned char>& solid,
    std::vector<float>& scratch, Prepare&& prepare, Visit&& visit);

  /// ForEachRow() and CopyExtinction() in one, for a mesh without solids: the fastest way. Returns
  /// false, with some cells not set, where a value can be no extinction coefficient.
  bool CopyFrame(std::size_t frame, std::vector<float>& scratch, std::span<float> cells);

  /// Sets the cells that the field covers to its values at @p time; leaves solids and others alone.
  /// @p scratch is working space. Returns the time that the values are of.
  double ReadCells(double time, TimeInterpolation interpolation,
    const std::vector<unsigned char>& solid, std::vector<float>& scratch, std::span<float> cells);

private:
  void ReadFrame(
    std::size_t frame, const std::vector<unsigned char>& solid, std::vector<float>& values);

  /// Reads a frame part by part and calls visit(k, rows) for each layer of cells.
  /// @param solid, scratch, prepare as for ForEachRow()
  template <class Prepare, class Visit>
  void ForEachLayer(std::size_t frame, const std::vector<unsigned char>& solid,
    std::vector<float>& scratch, Prepare&& prepare, Visit&& visit);

  /// The number of the first cell of a row of the range.
  std::size_t CellAt(int j, int k) const;

  const SmvMesh& mesh_;
  SmokeCandidate of_;
  std::unique_ptr<FrameFile> file_;
  FrameTimes times_;
};

//------------------------------------------------------------------------------------------------
template <class Prepare, class Visit>
void VolumeField::ForEachLayer(std::size_t frame, const std::vector<unsigned char>& solid,
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
  StoredRows rows;
  rows.Stride = stride;
  rows.Layer = layer;
  rows.Cells = static_cast<std::size_t>(r[1] - r[0]);
  rows.Rows = static_cast<std::size_t>(r[3] - r[2]);
  if (!file_->ReadsParts())
  {
    this->ReadFrame(frame, solid, scratch);
    prepare(std::span<float>(scratch));
    rows.First = scratch.data() + ghosts * layer + surplus;
    for (int k = r[4]; k < r[5]; ++k, rows.First += layer)
    {
      visit(k, rows);
    }
    return;
  }
  // Parts stay in a processor's own cache, which holds half a megabyte or more. Cells need each
  // layer once; of nodes, the last of a part is the first of the next again.
  constexpr std::size_t partBytes = 256 << 10;
  const std::size_t shared = of_.CellCentred ? 0 : layer;
  const int layers = static_cast<int>(std::max<std::size_t>(partBytes / sizeof(float) / layer, 1));
  scratch.resize(std::max(scratch.size(), layers * layer + shared));
  for (int begin = r[4]; begin < r[5]; begin += layers)
  {
    const int end = std::min(begin + layers, r[5]);
    const std::size_t kept = begin == r[4] ? 0 : shared;
    std::copy_n(scratch.data() + layers * layer, kept, scratch.data());
    const std::span<float> fresh(scratch.data() + kept, (end - begin) * layer + shared - kept);
    file_->ReadPart(frame, (begin - r[4] + ghosts) * layer + kept, fresh);
    prepare(fresh);
    rows.First = scratch.data() + surplus;
    for (int k = begin; k < end; ++k, rows.First += layer)
    {
      visit(k, rows);
    }
  }
  file_->CloseParts();
}

//------------------------------------------------------------------------------------------------
template <class Prepare, class Visit>
void VolumeField::ForEachRow(std::size_t frame, const std::vector<unsigned char>& solid,
  std::vector<float>& scratch, Prepare&& prepare, Visit&& visit)
{
  std::vector<float> means(of_.CellCentred ? 0 : of_.Range[1] - of_.Range[0]);
  this->ForEachLayer(frame, solid, scratch, prepare,
    [&](int k, const StoredRows& rows)
    {
      const float* row = rows.First;
      for (int j = of_.Range[2]; j < of_.Range[3]; ++j, row += rows.Stride)
      {
        if (!of_.CellCentred)
        {
          MeansOfNodes(row, rows.Stride, rows.Layer, means);
        }
        visit(this->CellAt(j, k), j, k,
          of_.CellCentred ? std::span<const float>(row, rows.Cells)
                          : std::span<const float>(means));
      }
    });
}

} // namespace smokevis
