// 3-D smoke files (.s3d, .s3dd): one byte a node, run-length coded.
#pragma once

#include "FortranRecords.h"
#include "FrameFile.h"

#include <array>
#include <cstdint>
#include <span>

namespace smokevis
{

/// Takes runs (255, value, count) out of @p coded; other bytes stand for themselves. Returns false
/// unless they fill @p bytes exactly.
bool DecodeRuns(std::span<const unsigned char> coded, std::span<unsigned char> bytes);

/// What FDS shows as 3-D smoke, on the nodes of a mesh. FDS averaged solid cells, which count as
/// clear, into the nodes beside them.
///
/// A byte b of a soot species means one of two things: in version 1 files (FDS 6.11) and in the
/// .s3dd twin that FDS 6.10 writes, density [kg/m3], b = 254 rho / rho_max with rho_max of each
/// frame in the last column of the text file CHID.s3d.sz; else opacity over the mesh's first cell
/// in x, from which the extinction coefficient is K = -ln(1 - b/254) / (X1 - X0) [1/m]. Of other
/// quantities, heat release rate and temperature, b runs from 0 to 254 over a range that the index
/// gives, rounded down.
class Smoke3DFile : public FrameFile
{
public:
  /// Soot.
  /// @param path      the .s3d file; its .s3dd twin is taken where there is one
  /// @param nodes     number of nodes of the mesh along x, y, z
  /// @param firstCell width of the mesh's first cell in x [m]
  /// @param what      what it is called in messages
  Smoke3DFile(const std::string& path, const std::array<int, 3>& nodes, double firstCell,
    const std::string& what = "3-D smoke");

  /// Another quantity, with the values that the bytes 0 and 254 stand for.
  Smoke3DFile(const std::string& path, const std::array<int, 3>& nodes,
    const std::array<double, 2>& range, const std::string& what = "3-D smoke");

  const std::string& Path() const override { return records_.Path(); }
  const std::array<int, 3>& Dimensions() const override { return nodes_; }
  const std::vector<double>& FrameTimes() const override { return times_; }
  const std::string& Damage() const override { return damage_; }
  std::uint64_t BytesRead() const override { return records_.BytesRead(); }
  void ReadFrame(std::size_t frame, std::vector<float>& values) override;

  /// Whether what would be read for @p path is density rather than the coarser opacity; false too
  /// when it cannot be read. Looks at the header only.
  static bool HoldsDensity(const std::string& path);

private:
  /// Where a frame is, and the value that byte 254 stands for in it.
  struct Frame
  {
    std::uint64_t Offset = 0;
    std::uint32_t Bytes = 0;
    double Greatest = 0.0;
  };
  enum class Scale
  {
    Opacity,
    Density,
    Range
  };

  void Open();
  std::array<float, 256> Values(const Frame& frame) const;

  void ReadHeader();
  void IndexFrames();
  void ReadGreatestDensities(const std::string& path);

  FortranRecords records_;
  std::array<int, 3> nodes_;
  double firstCell_ = 1.0;
  std::array<double, 2> range_{};
  Scale scale_ = Scale::Opacity;
  std::vector<Frame> frames_;
  std::vector<double> times_;
  std::string damage_;
  std::vector<unsigned char> coded_;
  std::vector<unsigned char> bytes_;
};

} // namespace smokevis
