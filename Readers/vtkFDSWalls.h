// The walls of an FDS run at a time, as polydata.
#ifndef vtkFDSWalls_h
#define vtkFDSWalls_h

class vtkPolyData;

namespace smokevis
{

class SmvFile;

/// Fills @p output with the walls at @p time [s]: rectangles with the cell arrays Reflectance and
/// SurfaceName. Obstructions less opaque than @p leastOpacity are left out. Returns whether MIRROR
/// boundaries were met, which become diffuse.
bool BuildWalls(const SmvFile& index, double time, double leastOpacity, vtkPolyData* output);

} // namespace smokevis

#endif
