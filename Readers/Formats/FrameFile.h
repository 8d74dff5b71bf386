// What all files of values on a grid over time have in common.
#pragma once

#include "TimedFile.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace smokevis
{

/// One quantity on an index range of one mesh, frame after frame; ReadFrame() gives the values x
/// fastest.
class FrameFile : public TimedFile
{
public:
  /// Number of values along x, y, z.
  virtual const std::array<int, 3>& Dimensions() const = 0;

  /// Number of values along x, y, z as they are stored: Dimensions() and, at the low ends, what is
  /// to be left out.
  virtual const std::array<int, 3>& StoredDimensions() const { return this->Dimensions(); }

  /// Reads a frame as it is stored, for those who leave the surplus out themselves and save a copy.
  virtual void ReadStored(std::size_t frame, std::vector<float>& values)
  {
    this->ReadFrame(frame, values);
  }

  /// Whether ReadPart() works: parts that fit into a processor's cache are handled faster.
  virtual bool ReadsParts() const { return false; }

  /// Reads stored values from position @p first on. CloseParts() ends a series of parts.
  virtual void ReadPart(std::size_t frame, std::size_t first, std::span<float> values)
  {
    std::vector<float> all;
    this->ReadStored(frame, all);
    std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(first), values.size(), values.begin());
  }
  virtual void CloseParts() {}
};

} // namespace smokevis
