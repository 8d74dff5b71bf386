// Reading Fortran sequential unformatted records: length markers, byte order, bounds against the
// real file size.
#pragma once

#include "Errors.h"

#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <system_error>
#include <type_traits>

namespace smokevis
{

/// Reverses the bytes of a 4-byte value.
template <class T> T SwapBytes(T value)
{
  static_assert(sizeof(T) == 4 && std::is_trivially_copyable_v<T>);
  auto bits = std::bit_cast<std::uint32_t>(value);
  bits = ((bits & 0x000000ffU) << 24) | ((bits & 0x0000ff00U) << 8) | ((bits & 0x00ff0000U) >> 8) |
         ((bits & 0xff000000U) >> 24);
  return std::bit_cast<T>(bits);
}

/// A file of Fortran sequential records with 4-byte length markers. The first marker, whose value
/// the caller knows, tells the byte order; nothing is read past the file's real end.
class FortranRecords
{
public:
  /// Bytes that the two length markers add to a record.
  static constexpr std::uint64_t MarkerBytes = 8;

  /// Opens @p path, whose first record must be @p firstRecordBytes long in either byte order.
  /// @param what what the file is in messages, e.g. "slice of TEMPERATURE"
  FortranRecords(std::string path, std::uint32_t firstRecordBytes, std::string what)
      : path_(std::move(path)), what_(std::move(what))
  {
    std::error_code problem;
    size_ = std::filesystem::file_size(path_, problem);
    if (problem)
    {
      throw Error(path_, "the " + what_ + " cannot be opened (" + problem.message() + ")",
        "Copy the file that the index names beside the index, or run FDS again");
    }
    if (size_ < sizeof(std::uint32_t))
    {
      throw Error(this->At(0), "the " + what_ + " is empty",
        "The run may not have written it yet: wait for it, or run FDS again");
    }
    std::uint32_t marker = 0;
    this->ReadRaw(0, &marker, sizeof(marker));
    swapped_ = marker != firstRecordBytes;
    if (swapped_ && SwapBytes(marker) != firstRecordBytes)
    {
      throw Error(this->At(0),
        "the first record of the " + what_ + " is not " + std::to_string(firstRecordBytes) +
          " bytes long in either byte order",
        "This is not the kind of FDS file that the index says it is");
    }
  }

  const std::string& Path() const { return path_; }
  const std::string& What() const { return what_; }
  std::uint64_t Size() const { return size_; }
  /// Bytes that were read so far.
  std::uint64_t BytesRead() const { return bytesRead_; }

  /// "path, byte N", the place of a fault for messages.
  std::string At(std::uint64_t offset) const { return path_ + ", byte " + std::to_string(offset); }

  /// Whether a record of @p bytes at @p offset ends inside the file.
  bool Holds(std::uint64_t offset, std::uint64_t bytes) const
  {
    return offset <= size_ && bytes <= size_ && bytes + MarkerBytes <= size_ - offset;
  }

  /// Whether both markers of the record at @p offset say @p bytes.
  bool HasRecord(std::uint64_t offset, std::uint32_t bytes)
  {
    return this->Holds(offset, bytes) && this->Word(offset) == bytes &&
           this->Word(offset + 4 + bytes) == bytes;
  }

  /// Reads the record at @p offset, which must be as long as @p values, and returns the offset
  /// behind it. 4-byte values are put into this machine's byte order, characters left alone.
  template <class T> std::uint64_t Read(std::uint64_t offset, std::span<T> values)
  {
    const std::uint64_t bytes = values.size_bytes();
    if (!this->Holds(offset, bytes))
    {
      throw Error(this->At(offset),
        "the " + what_ + " ends inside a record of " + std::to_string(bytes) + " bytes",
        "The run may have been stopped while it wrote: read an earlier time");
    }
    if (this->Word(offset) != bytes || this->Word(offset + 4 + bytes) != bytes)
    {
      throw Error(this->At(offset),
        "the length markers of a record of the " + what_ + " do not say " + std::to_string(bytes) +
          " bytes",
        "The file is damaged or does not belong to this index");
    }
    this->ReadInside(offset + 4, values);
    return offset + bytes + MarkerBytes;
  }

  /// Reads a part of a record whose length was checked: @p offset is that of the first value.
  template <class T> void ReadInside(std::uint64_t offset, std::span<T> values)
  {
    this->ReadRaw(offset, values.data(), values.size_bytes());
    if constexpr (sizeof(T) == 4)
    {
      if (swapped_)
      {
        for (T& value : values)
        {
          value = SwapBytes(value);
        }
      }
    }
  }

  /// The record length that the marker at @p offset announces.
  std::uint32_t Word(std::uint64_t offset)
  {
    std::uint32_t word = 0;
    this->ReadRaw(offset, &word, sizeof(word));
    return swapped_ ? SwapBytes(word) : word;
  }

  /// Gives the file handle back (runs with thousands of files have more than a process may hold);
  /// the next read takes a new one.
  void Close() { stream_.close(); }

private:
  void ReadRaw(std::uint64_t offset, void* target, std::uint64_t bytes)
  {
    stream_.clear();
    if (!stream_.is_open())
    {
      // Reads are few words here and whole frames there: a buffer would only fetch what is not
      // wanted.
      stream_.rdbuf()->pubsetbuf(nullptr, 0);
      stream_.open(path_, std::ios::binary);
      if (!stream_)
      {
        throw Error(
          path_, "the " + what_ + " cannot be opened for reading", "Check its permissions");
      }
    }
    stream_.seekg(static_cast<std::streamoff>(offset));
    stream_.read(static_cast<char*>(target), static_cast<std::streamsize>(bytes));
    if (!stream_)
    {
      throw Error(this->At(offset),
        "reading " + std::to_string(bytes) + " bytes of the " + what_ + " failed",
        "Check the disk, or whether the file is being rewritten");
    }
    bytesRead_ += bytes;
  }

  std::string path_;
  std::string what_;
  std::ifstream stream_;
  std::uint64_t size_ = 0;
  std::uint64_t bytesRead_ = 0;
  bool swapped_ = false;
};

} // namespace smokevis
