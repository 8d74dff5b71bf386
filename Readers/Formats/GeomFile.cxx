#include "GeomFile.h"

#include <algorithm>
#include <cmath>

namespace smokevis
{

namespace
{
constexpr int Version = 2;
} // namespace

//------------------------------------------------------------------------------------------------
GeomFile::GeomFile(const std::string& path, bool cutFaces)
    : records_(path, sizeof(int), "geometry"), cutFaces_(cutFaces)
{
  std::array<int, 1> word{};
  std::uint64_t offset = records_.Read(0, std::span<int>(word));
  const std::uint64_t versionAt = offset;
  offset = records_.Read(offset, std::span<int>(word));
  if (word[0] != Version)
  {
    throw Error(records_.At(versionAt),
      "geometry of version " + std::to_string(word[0]) + " is not known here",
      "Export the geometry to STL or OBJ and read that with CADReader");
  }
  std::array<int, 3> header{};
  const std::uint64_t headerAt = offset;
  offset = records_.Read(offset, std::span<int>(header));
  fixed_ = header[2] != 0;
  for (const int count : {header[0], header[1]})
  {
    const std::uint64_t bytes = 4 * static_cast<std::uint64_t>(std::max(count, 0));
    if (count < 0 || (count > 0 && !records_.HasRecord(offset, static_cast<std::uint32_t>(bytes))))
    {
      throw Error(records_.At(headerAt), "the geometry's header is damaged", "Run FDS again");
    }
    offset += count > 0 ? bytes + FortranRecords::MarkerBytes : 0;
  }
  while (offset < records_.Size())
  {
    const std::uint64_t begin = offset;
    if (!this->FindFrame(offset))
    {
      damage_ = "frame " + std::to_string(frames_.size() + 1) + " of the geometry at byte " +
                std::to_string(begin) + " is cut short or damaged";
      break;
    }
  }
  records_.Close();
  if (frames_.empty())
  {
    throw Error(path,
      "the geometry file holds no whole frame" + (damage_.empty() ? "" : ": " + damage_),
      "Wait until the run has written one, or run FDS again");
  }
}

//------------------------------------------------------------------------------------------------
bool GeomFile::FindFrame(std::uint64_t& offset)
{
  constexpr std::uint64_t markers = FortranRecords::MarkerBytes;
  std::array<float, 1> time{};
  std::array<int, 3> counts{};
  if (!records_.HasRecord(offset, sizeof(time)) ||
      !records_.HasRecord(offset + sizeof(time) + markers, sizeof(counts)))
  {
    return false;
  }
  offset = records_.Read(offset, std::span<float>(time));
  offset = records_.Read(offset, std::span<int>(counts));
  if (!std::isfinite(time[0]) ||
      std::any_of(counts.begin(), counts.end(), [](int n) { return n < 0; }))
  {
    return false;
  }
  const Frame frame{
    time[0], offset, static_cast<std::uint32_t>(counts[0]), static_cast<std::uint32_t>(counts[1])};
  // Words of each record that follows.
  std::vector<std::uint64_t> words;
  const std::uint64_t points = frame.Points;
  const std::uint64_t triangles = frame.Triangles;
  const auto tetrahedra = static_cast<std::uint64_t>(counts[2]);
  if (points > 0)
  {
    words.push_back(3 * points);
  }
  if (triangles > 0 && cutFaces_)
  {
    words.insert(words.end(), {3 * triangles, triangles, triangles, triangles});
  }
  else if (triangles > 0)
  {
    words.insert(words.end(), {3 * triangles, triangles, 6 * triangles});
  }
  if (tetrahedra > 0)
  {
    words.insert(words.end(), {4 * tetrahedra, tetrahedra});
  }
  for (const std::uint64_t count : words)
  {
    const std::uint64_t bytes = 4 * count;
    // HasRecord() takes lengths of 32 bits; the file's size bounds them first.
    if (!records_.Holds(offset, bytes) || bytes > UINT32_MAX ||
        !records_.HasRecord(offset, static_cast<std::uint32_t>(bytes)))
    {
      return false;
    }
    offset += bytes + markers;
  }
  frames_.push_back(frame);
  return true;
}

//------------------------------------------------------------------------------------------------
GeomTriangles GeomFile::Read(double time)
{
  GeomTriangles triangles;
  if (fixed_)
  {
    this->Append(frames_.front(), triangles);
  }
  if (this->Moves())
  {
    auto frame = frames_.begin() + (fixed_ ? 1 : 0);
    while (frame + 1 != frames_.end() && (frame + 1)->Time <= time)
    {
      ++frame;
    }
    this->Append(*frame, triangles);
  }
  records_.Close();
  return triangles;
}

//------------------------------------------------------------------------------------------------
void GeomFile::Append(const Frame& frame, GeomTriangles& triangles)
{
  std::uint64_t offset = frame.Offset;
  std::vector<float> coordinates(3 * static_cast<std::size_t>(frame.Points));
  if (frame.Points > 0)
  {
    offset = records_.Read(offset, std::span<float>(coordinates));
  }
  if (frame.Triangles == 0)
  {
    return;
  }
  const std::uint64_t cornersAt = offset;
  std::vector<int> corners(3 * static_cast<std::size_t>(frame.Triangles));
  std::vector<int> surfaces(frame.Triangles);
  offset = records_.Read(offset, std::span<int>(corners));
  if (cutFaces_)
  {
    offset = records_.Read(offset, std::span<int>(surfaces)); // locations, not used
  }
  records_.Read(offset, std::span<int>(surfaces));
  const auto first = static_cast<int>(triangles.Points.size());
  for (std::size_t i = 0; i < coordinates.size(); i += 3)
  {
    if (!std::isfinite(coordinates[i] + coordinates[i + 1] + coordinates[i + 2]))
    {
      throw Error(records_.At(frame.Offset),
        "point " + std::to_string(i / 3 + 1) + " of the geometry is not finite",
        "The file is damaged: run FDS again");
    }
    triangles.Points.push_back({coordinates[i], coordinates[i + 1], coordinates[i + 2]});
  }
  for (std::size_t i = 0; i < corners.size(); i += 3)
  {
    std::array<int, 3> triangle{};
    for (std::size_t corner = 0; corner < 3; ++corner)
    {
      const int point = corners[i + corner];
      if (point < 1 || static_cast<std::uint32_t>(point) > frame.Points)
      {
        throw Error(records_.At(cornersAt),
          "triangle " + std::to_string(i / 3 + 1) + " of the geometry has point " +
            std::to_string(point) + " of " + std::to_string(frame.Points),
          "The file is damaged: run FDS again");
      }
      triangle[corner] = first + point - 1;
    }
    triangles.Triangles.push_back(triangle);
  }
  triangles.Surfaces.insert(triangles.Surfaces.end(), surfaces.begin(), surfaces.end());
}

} // namespace smokevis
