// Inside the wall builder: a grid plane of a mesh, and what lies on one side of a face.
#pragma once

#include "WallBuilder.h"

#include <string>

namespace smokevis
{

/// No obstruction, vent, mesh or material.
constexpr int None = -1;

/// Whether a vent of this surface is no wall: light leaves the domain there.
bool IsOpening(const std::string& surface);

/// The cell of increasing nodes that holds x; x beyond the ends belongs to the end cells.
int CellAt(const std::vector<double>& nodes, double x);

/// One grid plane with its faces, refined where other meshes touch it.
struct WallBuilder::Plane
{
  int Block = 0;
  int Axis = 0;
  int K = 0;
  /// The tangential axes, so that B x D = Axis.
  int B = 0;
  int D = 0;
  double Coordinate = 0.0;
  /// Grid lines across B and D, and the mesh's own cell between each two of them.
  std::array<std::vector<double>, 2> Lines;
  std::array<std::vector<int>, 2> Cells;
  /// A face of the mesh each, B fastest, for the normals along -axis [0] and +axis [1]: the
  /// obstruction and the vent that lie in it, and whether the obstruction is a plate.
  std::array<std::vector<int>, 2> Obstruction;
  std::array<std::vector<int>, 2> Vent;
  std::vector<unsigned char> Plate;
  /// A material each refined face, or None.
  std::array<std::vector<int>, 2> Material;

  std::size_t Face(int b, int d) const
  {
    return static_cast<std::size_t>(d) * (Lines[0].size() - 1) + static_cast<std::size_t>(b);
  }
};

/// What lies on one side of a face.
struct WallBuilder::Side
{
  /// The mesh that the point belongs to, or None outside of all.
  int Block = None;
  bool Solid = false;
  std::array<int, 3> Cell{};

  bool Gas() const { return Block != None && !Solid; }
};

} // namespace smokevis
