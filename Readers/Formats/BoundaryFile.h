// Boundary files (.bf): one quantity on the walls of one mesh, frame after frame.
#pragma once

#include "FortranRecords.h"
#include "SmvFile.h"
#include "TimedFile.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace smokevis
{

/// A rectangle of a wall, on a grid plane of the mesh.
struct BoundaryPatch
{
  /// Nodes; two indices of one axis are equal.
  IndexRange Range{};
  /// The axis that it is normal to, 0 to 2.
  int Axis = 0;
  /// The obstruction that it belongs to, a position in SmvMesh::Obstructions; -1 for the mesh's own
  /// boundary.
  int Obstruction = -1;

  /// Number of nodes, the values that the file has, whatever they are centred on.
  std::size_t Nodes() const;
};

/// An open boundary file. Opening reads the patches and the time of every frame; a frame is read by
/// seeking to it.
class BoundaryFile : public TimedFile
{
public:
  /// Throws Error when @p path is missing, no boundary file of @p mesh, or holds no whole frame.
  /// @param what what it is called in messages
  BoundaryFile(
    const std::string& path, const SmvMesh& mesh, const std::string& what = "boundary file");

  const std::string& Path() const override { return records_.Path(); }
  const std::vector<BoundaryPatch>& Patches() const { return patches_; }
  const std::vector<double>& FrameTimes() const override { return times_; }
  const std::string& Damage() const override { return damage_; }
  std::uint64_t BytesRead() const override { return records_.BytesRead(); }

  /// Reads frame @p frame: the values of all patches, one patch after the other, on each along the
  /// first axis fastest, a value a node. Of cell-centred data the last along each axis is surplus.
  void ReadFrame(std::size_t frame, std::vector<float>& values) override;

private:
  void ReadPatches(std::uint64_t& offset, const SmvMesh& mesh);
  void IndexFrames(std::uint64_t offset);

  FortranRecords records_;
  std::vector<BoundaryPatch> patches_;
  std::vector<double> times_;
  std::uint64_t firstFrame_ = 0;
  std::uint64_t frameBytes_ = 0;
  std::string damage_;
};

} // namespace smokevis
