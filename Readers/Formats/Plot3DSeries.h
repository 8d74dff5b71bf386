// Plot3D files (.q): five quantities on all nodes of a mesh, one file a time.
#pragma once

#include "FrameFile.h"

#include <utility>

namespace smokevis
{

/// One of the five quantities over the times for which a run wrote Plot3D files.
class Plot3DSeries : public FrameFile
{
public:
  /// @param files     time [s] and path of each file; ones that are missing are left out
  /// @param component which of the five quantities, 0 to 4
  /// @param what      what it is called in messages
  /// @param nodes     number of nodes of the mesh along x, y, z
  Plot3DSeries(const std::vector<std::pair<double, std::string>>& files, int component,
    const std::array<int, 3>& nodes, const std::string& what = "quantity");

  const std::string& Path() const override { return paths_.front(); }
  const std::array<int, 3>& Dimensions() const override { return nodes_; }
  const std::vector<double>& FrameTimes() const override { return times_; }
  const std::string& Damage() const override { return damage_; }
  std::uint64_t BytesRead() const override { return bytesRead_; }
  void ReadFrame(std::size_t frame, std::vector<float>& values) override;

private:
  std::array<int, 3> nodes_;
  int component_;
  std::string what_;
  std::vector<std::string> paths_;
  std::vector<double> times_;
  std::string damage_;
  std::uint64_t bytesRead_ = 0;
};

} // namespace smokevis
