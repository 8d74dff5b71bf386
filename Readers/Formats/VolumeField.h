// One quantity on one mesh over time, cell by cell, whatever kind of file holds it.
#pragma once

#include "FrameTimes.h"
#include "SmokeCandidates.h"
#include "SmvFile.h"

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

  /// Reads a frame as the file has it, on its nodes or cells. Of 8-bit smoke, where FDS averaged
  /// solid cells in as clear ones, they are taken out again. @p solid marks the mesh's solid cells,
  /// empty for none.
  void ReadFrame(
    std::size_t frame, const std::vector<unsigned char>& solid, std::vector<float>& values);

  /// Calls visit(cell, i, j, k, value) for the cells of the range that are not solid, x fastest; a
  /// cell gets the mean of its eight nodes. FDS gives a node the mean over its gas cells, and 0
  /// without any; all eight nodes of a gas cell have one: the cell itself.
  template <class Visit>
  void ForEachCell(
    const std::vector<float>& values, const std::vector<unsigned char>& solid, Visit&& visit) const;

  /// Sets the cells that the field covers to its values at @p time; leaves solids and others alone.
  /// @p scratch is working space. Returns the time that the values are of.
  double ReadCells(double time, TimeInterpolation interpolation,
    const std::vector<unsigned char>& solid, std::vector<float>& scratch, std::span<float> cells);

private:
  const SmvMesh& mesh_;
  SmokeCandidate of_;
  std::unique_ptr<FrameFile> file_;
  FrameTimes times_;
};

//------------------------------------------------------------------------------------------------
template <class Visit>
void VolumeField::ForEachCell(
  const std::vector<float>& values, const std::vector<unsigned char>& solid, Visit&& visit) const
{
  const IndexRange& r = of_.Range;
  const auto nx = static_cast<std::size_t>(mesh_.Cells(0));
  const auto ny = static_cast<std::size_t>(mesh_.Cells(1));
  const auto row = static_cast<std::size_t>(file_->Dimensions()[0]);
  const std::size_t layer = row * static_cast<std::size_t>(file_->Dimensions()[1]);
  const std::array<std::size_t, 8> corners{
    0, 1, row, row + 1, layer, layer + 1, layer + row, layer + row + 1};
  for (int k = r[4]; k < r[5]; ++k)
  {
    for (int j = r[2]; j < r[3]; ++j)
    {
      const float* first = values.data() + (k - r[4]) * layer + (j - r[2]) * row;
      const std::size_t firstCell = (static_cast<std::size_t>(k) * ny + j) * nx;
      for (int i = r[0]; i < r[1]; ++i)
      {
        const std::size_t cell = firstCell + i;
        if (!solid.empty() && solid[cell] != 0)
        {
          continue;
        }
        const float* value = first + (i - r[0]);
        float mean = *value;
        if (!of_.CellCentred)
        {
          mean = 0.0F;
          for (const std::size_t corner : corners)
          {
            mean += 0.125F * value[corner];
          }
        }
        visit(cell, i, j, k, mean);
      }
    }
  }
}

} // namespace smokevis
