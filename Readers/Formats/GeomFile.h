// Complex geometry (.ge, .gcf): triangles of GEOM solids, fixed or moving.
#pragma once

#include "FortranRecords.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace smokevis
{

/// Triangles with their front, by the right-hand rule, towards the gas.
struct GeomTriangles
{
  /// [m]
  std::vector<std::array<float, 3>> Points;
  /// Positions in Points.
  std::vector<std::array<int, 3>> Triangles;
  /// Of each triangle, position in SmvFile::Surfaces.
  std::vector<int> Surfaces;
};

/// A geometry file of version 2 as FDS writes for Smokeview: one, version, (numbers of floats,
/// integers, and whether the first frame is fixed), then frames of time, (points, triangles,
/// tetrahedra), coordinates, corners counted from 1, surfaces. A file of solids (.ge) has the
/// coordinates of textures behind the surfaces; one of cut faces (.gcf) has their locations before
/// and their geometries behind. The layout of solids agrees with what Smokeview reads (ReadGeom2 of
/// its public source). Opening it finds the frames.
class GeomFile
{
public:
  /// Throws Error when the file is missing, not a geometry file, or has no whole frame.
  GeomFile(const std::string& path, bool cutFaces);

  const std::string& Path() const { return records_.Path(); }

  /// Whether the triangles change in time.
  bool Moves() const { return frames_.size() > (fixed_ ? 1U : 0U); }

  /// What is wrong behind the last whole frame; empty when nothing is.
  const std::string& Damage() const { return damage_; }

  /// The fixed triangles and those of the last frame up to @p time [s] (the first one before it).
  GeomTriangles Read(double time);

private:
  struct Frame
  {
    double Time = 0.0;
    std::uint64_t Offset = 0;
    std::uint32_t Points = 0;
    std::uint32_t Triangles = 0;
  };

  bool FindFrame(std::uint64_t& offset);
  void Append(const Frame& frame, GeomTriangles& triangles);

  FortranRecords records_;
  bool cutFaces_;
  bool fixed_ = false;
  std::vector<Frame> frames_;
  std::string damage_;
};

} // namespace smokevis
