// What all files of values over time have in common.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace smokevis
{

/// One quantity on an index range of one mesh, frame after frame. Opening one reads the times of
/// its frames; a frame is read only when asked for.
class FrameFile
{
public:
  FrameFile() = default;
  FrameFile(const FrameFile&) = delete;
  FrameFile& operator=(const FrameFile&) = delete;
  virtual ~FrameFile() = default;

  virtual const std::string& Path() const = 0;

  /// Number of values along x, y, z.
  virtual const std::array<int, 3>& Dimensions() const = 0;

  /// Times of the whole frames [s], as the file has them; at least one.
  virtual const std::vector<double>& FrameTimes() const = 0;

  /// What is wrong behind the last whole frame; empty when nothing is.
  virtual const std::string& Damage() const = 0;

  /// Reads frame @p frame, x fastest, into @p values, which is resized to Dimensions().
  virtual void ReadFrame(std::size_t frame, std::vector<float>& values) = 0;

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
