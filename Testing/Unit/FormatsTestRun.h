// A small FDS run, written by a test into a folder of its own.
#pragma once

#include "ExtinctionSource.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <unistd.h>
#include <vector>

namespace smokevis::test
{

/// A folder that vanishes with the test.
class Folder
{
public:
  explicit Folder(const std::string& name)
      : path_(Base() / ("smokevis-" + name + "-" + std::to_string(::getpid())))
  {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string Path(const std::string& name) const { return (path_ / name).string(); }

  std::string Write(const std::string& name, const std::string& bytes) const
  {
    const std::string path = this->Path(name);
    std::filesystem::create_directories(std::filesystem::path(path).parent_path());
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }

private:
  // In memory where there is such a place: some tests write thousands of files.
  static std::filesystem::path Base()
  {
    std::error_code none;
    const std::filesystem::path memory = "/dev/shm";
    return std::filesystem::is_directory(memory, none) && ::access("/dev/shm", W_OK) == 0
             ? memory
             : std::filesystem::temp_directory_path();
  }

  std::filesystem::path path_;
};

/// Fortran records, in the other byte order if asked.
class Records
{
public:
  explicit Records(bool swapped = false) : swapped_(swapped) {}

  template <class T> Records& Add(const std::vector<T>& values)
  {
    const auto bytes = static_cast<std::uint32_t>(values.size() * sizeof(T));
    this->Put(bytes);
    for (const T& value : values)
    {
      this->Put(value);
    }
    this->Put(bytes);
    return *this;
  }

  Records& AddLabel(std::string label)
  {
    label.resize(30, ' ');
    return this->Add(std::vector<char>(label.begin(), label.end()));
  }

  const std::string& Bytes() const { return bytes_; }

private:
  template <class T> void Put(const T& value)
  {
    std::string raw(reinterpret_cast<const char*>(&value), sizeof(T));
    bytes_ += swapped_ ? std::string(raw.rbegin(), raw.rend()) : raw;
  }

  bool swapped_;
  std::string bytes_;
};

/// Extinction of a mesh of two cells (or another number).
struct Cells
{
  std::vector<float> Values;
  double Time = 0.0;
};

inline Cells ReadCells(ExtinctionSource&& source, int mesh, double time,
  const std::vector<unsigned char>& solid, std::size_t count = 2)
{
  Cells cells;
  cells.Values.resize(count, -1.0F);
  cells.Time = source.Read(mesh, time, TimeInterpolation::Nearest, solid, cells.Values);
  return cells;
}

inline Cells ReadCells(ExtinctionSource& source, int mesh, double time,
  const std::vector<unsigned char>& solid, std::size_t count = 2)
{
  return ReadCells(std::move(source), mesh, time, solid, count);
}

/// A slice file: labels, index range, and for each frame a time and its values as stored.
inline std::string SliceBytes(const std::string& label, const std::vector<int>& range,
  const std::vector<std::pair<float, std::vector<float>>>& frames, bool swapped = false)
{
  Records records(swapped);
  records.AddLabel(label).AddLabel("short").AddLabel("1/m").Add(range);
  for (const auto& [time, values] : frames)
  {
    records.Add(std::vector<float>{time}).Add(values);
  }
  return records.Bytes();
}

/// The text of an index. Indices of obstructions and vents are nodes of the mesh added last.
class Index
{
public:
  Index()
  {
    text_ << "TITLE\n A test\n\nFDSVERSION\n FDS-6.10.1\n\nCHID\n test\n\nSURFDEF\n WALL\n\n";
    this->Surface("INERT", "1.0 0.8 0.4 1.0").Surface("WALL", "0.5 0.5 0.5 1.0");
    this->Surface("OPEN", "1.0 0.0 1.0 1.0").Surface("GLASS", "0.4 0.7 0.8 0.4");
    this->Surface("MIRROR", "1.0 0.8 0.4 1.0").Surface("PAINT", "1.0 0.0 0.0 1.0");
  }
  // Positions of the surfaces above.
  enum
  {
    Inert,
    Wall,
    Open,
    Glass,
    Mirror,
    Paint
  };

  Index& Surface(const std::string& name, const std::string& color)
  {
    text_ << "SURFACE\n " << name << "\n 5000.00 1.00\n 0 1.0 1.0 " << color << "\n null\n\n";
    return *this;
  }

  /// A mesh of equal cells from @p low to @p high.
  Index& Mesh(const std::string& name, const std::array<int, 3>& cells,
    const std::array<double, 3>& low, const std::array<double, 3>& high)
  {
    this->Flush();
    ++meshes_;
    text_ << "OFFSET\n 0.0 0.0 0.0\n\nGRID   " << name << "\n";
    for (const int n : cells)
    {
      text_ << " " << n;
    }
    text_ << " 0 0 0 0 0 0\n\nPDIM\n 0.0 1.0 0.0 1.0 0.0 1.0 0.0 0.0 0.0\n\n";
    for (int axis = 0; axis < 3; ++axis)
    {
      text_ << "TRN"
            << "XYZ"[axis] << "\n 0\n";
      for (int i = 0; i <= cells[axis]; ++i)
      {
        text_ << " " << i << " " << low[axis] + (high[axis] - low[axis]) * i / cells[axis] << "\n";
      }
      text_ << "\n";
    }
    return *this;
  }

  Index& Obstruction(
    const std::array<int, 6>& range, int surface, const std::string& color = "-1 -1")
  {
    bounds_.push_back("0. 1. 0. 1. 0. 1. 1" + this->Six(surface) + " ! block");
    indices_.push_back(this->Join(range) + " " + color + " ! F 1 1 1 1 1 1");
    return *this;
  }

  Index& Vent(const std::array<int, 6>& range, int surface, int orientation)
  {
    ventBounds_.push_back("0. 1. 0. 1. 0. 1. 1 " + std::to_string(surface) + " -999. -999. -999.");
    ventIndices_.push_back(this->Join(range) + " 99 0 ! " + std::to_string(orientation));
    return *this;
  }

  Index& CircularVent(const std::array<int, 6>& range, int surface, const std::string& circle)
  {
    this->Flush();
    text_ << "CVENT\n 1\n 0. 1. 0. 1. 0. 1. 1 " << surface << " -999. -999. -999. % " << circle
          << "\n " << this->Join(range) << " 99 0\n\n";
    return *this;
  }

  Index& Slice(bool cellCentred, int mesh, const std::array<int, 6>& range, const std::string& file,
    const std::string& label)
  {
    this->Flush();
    text_ << (cellCentred ? "SLCC" : "SLCF") << "     " << mesh << " # STRUCTURED &"
          << this->Join(range) << " !      1      1      0\n " << file << "\n " << label
          << "\n short\n 1/m\n";
    return *this;
  }

  Index& Text(const std::string& lines)
  {
    this->Flush();
    text_ << lines;
    return *this;
  }

  std::string Bytes()
  {
    this->Flush();
    return text_.str();
  }

private:
  static std::string Six(int value)
  {
    std::string text;
    for (int i = 0; i < 6; ++i)
    {
      text += ' ';
      text += std::to_string(value);
    }
    return text;
  }

  static std::string Join(const std::array<int, 6>& values)
  {
    std::string text;
    for (const int value : values)
    {
      text += ' ';
      text += std::to_string(value);
    }
    return text;
  }

  // Obstructions and vents follow their mesh as one entry each.
  void Flush()
  {
    if (meshes_ == 0 || meshes_ == flushed_)
    {
      return;
    }
    flushed_ = meshes_;
    this->Entry("OBST", "", bounds_, indices_);
    this->Entry("VENT", " 0", ventBounds_, ventIndices_);
  }

  void Entry(const std::string& keyword, const std::string& second, std::vector<std::string>& first,
    std::vector<std::string>& then)
  {
    text_ << keyword << "\n " << first.size() << second << "\n";
    for (std::vector<std::string>* lines : {&first, &then})
    {
      for (const std::string& line : *lines)
      {
        text_ << " " << line << "\n";
      }
      lines->clear();
    }
    text_ << "\n";
  }

  std::ostringstream text_;
  int meshes_ = 0;
  int flushed_ = 0;
  std::vector<std::string> bounds_, indices_, ventBounds_, ventIndices_;
};

} // namespace smokevis::test
