// What all files that a run wrote frame after frame have in common.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace smokevis
{

/// Values at several times. Opening one reads the times of its frames; a frame is read only when
/// asked for. One thread at a time may read it.
class TimedFile
{
public:
  TimedFile() = default;
  TimedFile(const TimedFile&) = delete;
  TimedFile& operator=(const TimedFile&) = delete;
  virtual ~TimedFile() = default;

  virtual const std::string& Path() const = 0;

  /// Times of the whole frames [s], as the file has them; at least one.
  virtual const std::vector<double>& FrameTimes() const = 0;

  /// What is wrong behind the last whole frame; empty when nothing is.
  virtual const std::string& Damage() const = 0;

  /// Reads the values of frame @p frame into @p values, which is resized to their number.
  virtual void ReadFrame(std::size_t frame, std::vector<float>& values) = 0;

  /// Adds Damage() to @p lines, with the file's name, where there is any.
  /// @param quantity that the file holds
  void NoteDamage(const std::string& quantity, std::vector<std::string>& lines) const
  {
    if (!this->Damage().empty())
    {
      lines.push_back(this->Path() + ": " + this->Damage() + " (" + quantity + ")");
    }
  }

  /// Bytes that were fetched from the disk or its cache so far, those of opening it included.
  virtual std::uint64_t BytesRead() const = 0;
};

} // namespace smokevis
