// The walls of an FDS run at a time, as polydata.
#ifndef vtkFDSWalls_h
#define vtkFDSWalls_h

#include <string>
#include <vector>

class vtkPolyData;

namespace smokevis
{

class SmvFile;

/// What was met when walls were built.
struct WallReport
{
  /// MIRROR boundaries, which become diffuse.
  bool Mirrors = false;
  /// Complex geometry that changes in time.
  bool Moves = false;
  /// Files that are missing or damaged.
  std::vector<std::string> Warnings;
};

/// Fills @p output with the walls at @p time [s]: rectangles of obstructions and boundaries, and
/// triangles of complex geometry (GEOM; where none of its files is there, the cut faces of CGEOM),
/// with the cell arrays Reflectance and SurfaceName. What is less opaque than @p leastOpacity is
/// left out. A surface with a texture has the mean of that image, which must lie beside the index.
WallReport BuildWalls(const SmvFile& index, double time, double leastOpacity, vtkPolyData* output);

} // namespace smokevis

#endif
