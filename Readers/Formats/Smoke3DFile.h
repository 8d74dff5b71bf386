// 3-D smoke files (.s3d, .s3dd): one byte a node, run-length coded, decoded into extinction.
#pragma once

#include "FortranRecords.h"
#include "FrameFile.h"

#include <cstdint>

namespace smokevis
{

/// Extinction K [1/m] on the nodes of a mesh from FDS's 3-D smoke of a soot species. FDS averaged
/// solid cells, which hold none, into the nodes beside them.
///
/// A byte b means one of two things: in version 1 files (FDS 6.11) and in the .s3dd twin that FDS
/// 6.10 writes, density, b = 254 rho / rho_max with rho_max of each frame in the last column of the
/// text file CHID.s3d.sz; else opacity over the mesh's first cell in x, K = -ln(1 - b/254) / (X1 -
/// X0).
class Smoke3DFile : public FrameFile
{
public:
  /// @param path           the .s3d file; its .s3dd twin is taken where there is one
  /// @param nodes          number of nodes of the mesh along x, y, z
  /// @param firstCell      width of the mesh's first cell in x [m]
  /// @param massExtinction Km [m2/kg]
  Smoke3DFile(const std::string& path, const std::array<int, 3>& nodes, double firstCell,
    double massExtinction);

  const std::string& Path() const override { return records_.Path(); }
  const std::array<int, 3>& Dimensions() const override { return nodes_; }
  const std::vector<double>& FrameTimes() const override { return times_; }
  const std::string& Damage() const override { return damage_; }
  void ReadFrame(std::size_t frame, std::vector<float>& values) override;

  /// Whether what would be read for @p path is density rather than the coarser opacity; false too
  /// when it cannot be read. Looks at the header only.
  static bool HoldsDensity(const std::string& path);

private:
  struct Frame
  {
    std::uint64_t Offset = 0;
    std::uint32_t Bytes = 0;
    double GreatestDensity = 0.0;
  };

  void ReadHeader();
  void IndexFrames();
  void ReadGreatestDensities(const std::string& path);

  FortranRecords records_;
  std::array<int, 3> nodes_;
  double firstCell_;
  double massExtinction_;
  bool holdsDensity_ = false;
  std::vector<Frame> frames_;
  std::vector<double> times_;
  std::string damage_;
};

} // namespace smokevis
