// The surfaces that bound the gas: faces of obstructions and of the outer mesh boundary.
#pragma once

#include "SmvFile.h"

#include <array>
#include <string>
#include <vector>

namespace smokevis
{

/// A rectangle normal to an axis. Its outward side faces the gas.
struct WallQuad
{
  /// 0, 1, 2: normal to x, y, z.
  int Axis = 0;
  /// Normal towards +axis (else -axis).
  bool Positive = true;
  /// Corners with the least and greatest coordinates [m]; equal along Axis.
  std::array<double, 3> Low{};
  std::array<double, 3> High{};
  /// Position in WallBuilder::Materials().
  int Material = 0;

  /// The four corners, counter-clockwise seen from the gas.
  std::array<std::array<double, 3>, 4> Corners() const;
};

/// What a wall looks like.
struct WallMaterial
{
  int Surface = 0;
  /// sRGB, 0 to 1.
  std::array<double, 3> Color{};

  bool operator==(const WallMaterial&) const = default;
};

/// Builds the walls at one time. Visibility of a face is decided at the resolution of the mesh
/// cells, from a mask of solid cells: a face is a wall where one side is gas and the other solid,
/// where a plate of zero thickness lies in it (one quad, two-sided), or on the outer boundary where
/// neither another mesh continues nor an OPEN vent covers it. Where meshes meet, each point belongs
/// to the mesh with the smallest cells. Faces of equal material then merge into rectangles.
///
/// Meshes may overlap if the boundary of the finer one lies on grid planes of the coarser one.
class WallBuilder
{
public:
  /// @param index        the run; must outlive this object
  /// @param time         [s]: obstructions and openings as they are then
  /// @param leastOpacity obstructions less opaque (0 to 1) let light through and are left out
  WallBuilder(const SmvFile& index, double time, double leastOpacity);

  /// Does the work.
  std::vector<WallQuad> Build();

  const std::vector<WallMaterial>& Materials() const { return materials_; }

  /// Whether a MIRROR vent was met, which becomes a diffuse wall.
  bool FoundMirror() const { return foundMirror_; }

private:
  /// A mesh with what is solid in it now.
  struct Block
  {
    const SmvMesh* Mesh = nullptr;
    std::vector<int> Obstructions;
    std::vector<unsigned char> Solid;
    double CellVolume = 0.0;
    double Tolerance = 0.0;
  };
  /// One grid plane of a mesh with its faces, refined where other meshes touch it.
  struct Plane;
  /// What lies on one side of a face.
  struct Side;

  void AddPlane(int block, int axis, int k, std::vector<WallQuad>& quads);
  std::vector<int> Neighbours(int block, int axis, int k) const;
  bool NeedsPlane(int block, int axis, int k, const std::vector<int>& neighbours) const;
  void Refine(Plane& plane, const std::vector<int>& neighbours) const;
  void PaintObstructions(Plane& plane) const;
  void PaintVents(Plane& plane);
  Side Look(
    const Plane& plane, int b, int d, bool positive, const std::vector<int>& neighbours) const;
  void AddFace(Plane& plane, int b, int d, const std::vector<int>& neighbours);
  int FaceMaterial(const Plane& plane, std::size_t face, bool positive, const Side& behind);
  int MaterialOf(int surface, const std::array<double, 4>* own);
  int MaterialOf(const SmvObstruction& obstruction, int axis, bool positive);
  static void Merge(const Plane& plane, bool positive, std::vector<WallQuad>& quads);

  const SmvFile& index_;
  double time_;
  std::vector<Block> blocks_;
  std::vector<WallMaterial> materials_;
  bool foundMirror_ = false;
};

} // namespace smokevis
