// How fast FDS runs are read: an index with 200 meshes, frames of a run with 10 million cells
// against copying their bytes out of the page cache, and 8-bit smoke.
//
// Usage: ReadersBenchmark DATA_FOLDER [WORK_FOLDER]
// Prints a table; fails when a promise is broken by more than a busy machine explains.
#include "ExtinctionSource.h"
#include "FortranRecords.h"
#include "Smoke3DFile.h"
#include "SmvFile.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <sys/resource.h>
#include <unistd.h>
#include <vector>

namespace
{

using smokevis::ExtinctionSource;
using smokevis::SmvFile;
using smokevis::TimeInterpolation;

constexpr int Meshes = 25;
constexpr std::array<int, 3> Cells{100, 80, 50};
constexpr int Frames = 3; // of 10 million cells each
constexpr std::size_t MeshCells = std::size_t{100} * 80 * 50;

// Seconds that this thread computed, in the kernel or not: what a busy machine changes least.
double Computed()
{
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double Passed()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// The best of several runs [s] by a clock: what the code needs when nobody else wants the machine.
double Best(int runs, const std::function<void()>& work, double (*clock)() = Computed)
{
  double best = 1e30;
  for (int i = 0; i < runs; ++i)
  {
    const double begin = clock();
    work();
    best = std::min(best, clock() - begin);
  }
  return best;
}

// How two works compare that are done in turn: what disturbs one disturbs the other.
struct Comparison
{
  // The least time that each took [s].
  double One = 1e30;
  double Other = 1e30;
  // One's time over the other's, turn by turn: the median, and what a tenth of the turns are below
  // and above.
  double Median = 0.0;
  double Low = 0.0;
  double High = 0.0;
};

Comparison InTurn(int turns, const std::function<void()>& one, const std::function<void()>& other,
  double (*clock)() = Computed)
{
  Comparison result;
  std::vector<double> ratios;
  for (int i = 0; i < turns; ++i)
  {
    const double first = Best(1, one, clock);
    const double second = Best(1, other, clock);
    result.One = std::min(result.One, first);
    result.Other = std::min(result.Other, second);
    ratios.push_back(first / second);
  }
  std::sort(ratios.begin(), ratios.end());
  result.Low = ratios[ratios.size() / 10];
  result.Median = ratios[ratios.size() / 2];
  result.High = ratios[ratios.size() - 1 - ratios.size() / 10];
  return result;
}

void PutRecord(std::ostream& stream, const void* data, std::size_t size)
{
  const auto bytes = static_cast<std::uint32_t>(size);
  stream.write(reinterpret_cast<const char*>(&bytes), sizeof(bytes));
  stream.write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
  stream.write(reinterpret_cast<const char*>(&bytes), sizeof(bytes));
}

std::string MeshText(int number, const std::array<int, 3>& cells, int obstructions)
{
  std::ostringstream text;
  text << "GRID   m" << number << "\n";
  for (const int n : cells)
  {
    text << " " << n;
  }
  text << "\n\n";
  for (int axis = 0; axis < 3; ++axis)
  {
    text << "TRN"
         << "XYZ"[axis] << "\n    0\n";
    const double low = axis == 0 ? number * cells[0] * 0.1 : 0.0;
    for (int i = 0; i <= cells[axis]; ++i)
    {
      std::array<char, 40> line{};
      std::snprintf(line.data(), line.size(), "%5d%14.5f\n", i, low + 0.1 * i);
      text << line.data();
    }
    text << "\n";
  }
  text << "OBST\n" << obstructions << "\n";
  for (int i = 0; i < obstructions; ++i)
  {
    text
      << "       3.00000        3.20000        0.80000        1.60000        2.00000        2.40000"
         "      -1      0      0      0      0      0      0   ! partition\n";
  }
  for (int i = 0; i < obstructions; ++i)
  {
    text << "    1    2    3    4    5    6   -1   -1 ! F  1 1 0 0 1 1  1 1 1 1 1 1\n";
  }
  text << "\nVENT\n 0 0\n\n";
  return text.str();
}

std::string SliceText(int number, const std::array<int, 3>& cells, bool cellCentred)
{
  std::ostringstream text;
  text << (cellCentred ? "SLCC" : "SLCF") << "     " << number + 1 << " # STRUCTURED &     0    "
       << cells[0] << "     0    " << cells[1] << "     0    " << cells[2]
       << " !      1      1      0\n " << (cellCentred ? "c" : "n") << number
       << ".sf\n SOOT EXTINCTION COEFFICIENT\n ext_coef_C\n 1/m\n";
  return text.str();
}

const std::string Head =
  "CHID\n big\n\nSURFACE\n INERT\n 5000.00    1.00\n 0      1.00000      1.00000 "
  "     1.00000      0.80000      0.40000      1.00000\n null\n\n";

// A run of 10 million cells, cell-centred or node-centred.
std::string WriteRun(const std::filesystem::path& folder, bool cellCentred)
{
  std::string index = Head;
  std::string slices;
  std::vector<float> values(std::size_t{101} * 81 * 51);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    values[i] = static_cast<float>(i % 1000) * 1e-3F;
  }
  for (int m = 0; m < Meshes; ++m)
  {
    index += MeshText(m, Cells, 4);
    slices += SliceText(m, Cells, cellCentred);
    std::ofstream file(
      folder / ((cellCentred ? "c" : "n") + std::to_string(m) + ".sf"), std::ios::binary);
    for (std::string label : {"SOOT EXTINCTION COEFFICIENT", "ext_coef_C", "1/m"})
    {
      label.resize(30, ' ');
      PutRecord(file, label.data(), label.size());
    }
    const std::array<int, 6> range{0, Cells[0], 0, Cells[1], 0, Cells[2]};
    PutRecord(file, range.data(), sizeof(range));
    for (int f = 0; f < Frames; ++f)
    {
      const auto time = static_cast<float>(f);
      PutRecord(file, &time, sizeof(time));
      PutRecord(file, values.data(), values.size() * sizeof(float));
    }
  }
  const std::string path = (folder / (cellCentred ? "cells.smv" : "nodes.smv")).string();
  std::ofstream(path) << index << slices;
  return path;
}

bool failed = false;

void Row(const char* what, double value, const char* unit, double promise, bool atLeast)
{
  const bool kept = atLeast ? value >= promise : value <= promise;
  std::printf("%-58s %9.3f %-6s  promised %s %g: %s\n", what, value, unit,
    atLeast ? "at least" : "at most", promise, kept ? "kept" : "BROKEN");
  // A busy machine may cost a factor of two; more is a defect.
  failed = failed || (atLeast ? value < 0.5 * promise : value > 2.0 * promise);
}

void CompareRow(const char* what, const Comparison& comparison)
{
  Row(what, comparison.Median, "", 0.5, true);
  std::printf("    four turns of five between %.3f and %.3f\n", comparison.Low, comparison.High);
}

void TimeIndex(const std::filesystem::path& folder)
{
  std::string text = Head;
  std::string slices;
  for (int m = 0; m < 200; ++m)
  {
    text += MeshText(m, {40, 40, 40}, 20);
    for (int i = 0; i < 10; ++i)
    {
      slices += SliceText(m, {40, 40, 40}, true);
    }
  }
  const std::string path = (folder / "index.smv").string();
  std::ofstream(path) << text << slices;
  const double seconds = Best(5, [&] { SmvFile index(path); });
  std::printf("Index of 200 meshes with 2000 slices and 4000 obstructions: %.1f MB\n",
    static_cast<double>(std::filesystem::file_size(path)) * 1e-6);
  Row("  reading it", seconds, "s", 0.2, false);
}

// Reads the bytes of the last frame of a mesh into a buffer that was used before: a plain copy. The
// reader, too, writes to memory of the mesh's own that was used before.
void CopyFrame(
  const std::filesystem::path& folder, bool cellCentred, int mesh, std::vector<char>& buffer)
{
  const std::string path =
    (folder / ((cellCentred ? "c" : "n") + std::to_string(mesh) + ".sf")).string();
  const auto bytes = static_cast<std::uint64_t>(std::filesystem::file_size(path) - 146) / Frames;
  buffer.resize(bytes);
  const int file = ::open(path.c_str(), O_RDONLY);
  if (file < 0 || ::pread(file, buffer.data(), bytes,
                    static_cast<off_t>(146 + (Frames - 1) * bytes)) != static_cast<ssize_t>(bytes))
  {
    std::perror(path.c_str());
    std::exit(1);
  }
  ::close(file);
}

void TimeFrames(const std::filesystem::path& folder, bool cellCentred)
{
  const std::string path = WriteRun(folder, cellCentred);
  const SmvFile index(path);
  const double opening = Best(3, [&] { ExtinctionSource source(index, {}); });
  ExtinctionSource source(index, {});
  std::vector<std::vector<float>> values(Meshes, std::vector<float>(MeshCells));
  std::vector<std::vector<char>> buffers(Meshes);
  const auto read = [&](int mesh)
  { source.Read(mesh, Frames - 1, TimeInterpolation::Nearest, {}, values[mesh]); };
  const auto copy = [&](int mesh) { CopyFrame(folder, cellCentred, mesh, buffers[mesh]); };
  const auto serial = [](const auto& work)
  {
    return [&work]
    {
      for (int mesh = 0; mesh < Meshes; ++mesh)
      {
        work(mesh);
      }
    };
  };
  const auto parallel = [](const auto& work)
  { return [&work] { tbb::parallel_for(0, Meshes, work); }; };
  constexpr int turns = 100;
  const Comparison alone = InTurn(turns, serial(copy), serial(read));
  const Comparison together = InTurn(turns, parallel(copy), parallel(read), Passed);
  const double gigabytes = static_cast<double>(Meshes) * static_cast<double>(MeshCells) * 4e-9;
  std::printf("A %s-centred frame of 10 million cells in %d meshes: opened in %.1f ms\n",
    cellCentred ? "cell" : "node", Meshes, 1e3 * opening);
  std::printf("  copying its bytes: at best %.2f GB/s alone, %.2f GB/s together\n",
    gigabytes / alone.One, gigabytes / together.One);
  std::printf("  reading it:        at best %.2f GB/s alone, %.2f GB/s together\n",
    gigabytes / alone.Other, gigabytes / together.Other);
  CompareRow("  reading against copying in turn, one thread (CPU time)", alone);
  CompareRow("  reading against copying in turn, all threads", together);
}

void TimeRuns(const std::string& data)
{
  // Real smoke: the coded frames of the room, unpacked again and again.
  const std::string path = data + "/Room/fds/room_1_1.s3dd";
  smokevis::FortranRecords records(path, 32, "3-D smoke");
  std::uint64_t offset = 40;
  std::vector<std::vector<unsigned char>> frames;
  while (offset + 28 < records.Size())
  {
    std::array<int, 2> sizes{};
    offset = records.Read(offset + 12, std::span<int>(sizes));
    frames.emplace_back(static_cast<std::size_t>(sizes[1]));
    offset = records.Read(offset, std::span<unsigned char>(frames.back()));
  }
  std::vector<unsigned char> bytes(std::size_t{33} * 25 * 25);
  for (std::size_t i = 0; i < frames.size(); ++i)
  {
    constexpr int repeats = 200;
    const double seconds = Best(5,
      [&]
      {
        for (int n = 0; n < repeats; ++n)
        {
          if (!smokevis::DecodeRuns(frames[i], bytes))
          {
            std::exit(1);
          }
        }
      });
    const std::string what = "Run-length decoding, frame " + std::to_string(i) + " of the room, " +
                             std::to_string(frames[i].size()) + " to " +
                             std::to_string(bytes.size()) + " bytes";
    Row(what.c_str(), repeats * static_cast<double>(bytes.size()) / seconds * 1e-9, "GB/s", 1.0,
      true);
  }
}

} // namespace

int main(int argc, char** argv)
{
  if (argc < 2)
  {
    std::fprintf(stderr, "Usage: %s DATA_FOLDER [WORK_FOLDER]\n", argv[0]);
    return 2;
  }
  const std::filesystem::path base = argc > 2 ? argv[2] : std::filesystem::temp_directory_path();
  const std::filesystem::path folder = base / ("smokevis-readers-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  try
  {
    TimeIndex(folder);
    TimeFrames(folder, true);
    TimeFrames(folder, false);
    TimeRuns(argv[1]);
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    failed = true;
  }
  std::filesystem::remove_all(folder);
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  std::printf("Peak memory %.0f MiB\n", static_cast<double>(usage.ru_maxrss) / 1024.0);
  return failed ? 1 : 0;
}
