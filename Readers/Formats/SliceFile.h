// Slice files (.sf): one quantity over an index range of one mesh, frame after frame.
#pragma once

#include "FortranRecords.h"
#include "FrameFile.h"
#include "SmvFile.h"

#include <array>
#include <string>
#include <vector>

namespace smokevis
{

/// An open slice file. Opening reads the header and the time of every frame, nothing else; a frame
/// is read by seeking to it.
class SliceFile : public FrameFile
{
public:
  /// @param what what it is called in messages
  /// Opens @p path, a node-centred (SLCF) or cell-centred (SLCC) slice. Throws Error when it is
  /// missing, empty, not a slice file, or holds no whole frame.
  SliceFile(const std::string& path, bool cellCentred, const std::string& what = "slice");

  const std::string& Path() const override { return records_.Path(); }
  const SmvQuantity& Quantity() const { return quantity_; }
  /// Node index range that the slice covers.
  const IndexRange& Range() const { return range_; }

  /// Number of values along x, y, z: cells of a cell-centred slice, nodes of a node-centred one.
  const std::array<int, 3>& Dimensions() const override { return dimensions_; }

  const std::vector<double>& FrameTimes() const override { return times_; }

  const std::string& Damage() const override { return damage_; }
  std::uint64_t BytesRead() const override { return records_.BytesRead(); }

  void ReadFrame(std::size_t frame, std::vector<float>& values) override;
  const std::array<int, 3>& StoredDimensions() const override { return stored_; }
  void ReadStored(std::size_t frame, std::vector<float>& values) override;
  bool ReadsParts() const override { return true; }
  void ReadPart(std::size_t frame, std::size_t first, std::span<float> values) override;
  void CloseParts() override { records_.Close(); }

private:
  void IndexFrames();

  FortranRecords records_;
  bool cellCentred_;
  SmvQuantity quantity_;
  IndexRange range_{};
  std::array<int, 3> stored_{};
  std::array<int, 3> dimensions_{};
  std::uint64_t firstFrame_ = 0;
  std::uint32_t valueBytes_ = 0;
  std::vector<double> times_;
  std::string damage_;
};

} // namespace smokevis
