// The 2-D slices of an FDS run, each a flat grid at its right place.
#ifndef vtkFDSPlaneSlices_h
#define vtkFDSPlaneSlices_h

#include "FrameTimes.h"
#include "SliceFile.h"
#include "SmvFile.h"

#include "vtkRectilinearGrid.h"
#include "vtkSmartPointer.h"

#include <memory>
#include <string>
#include <vector>

namespace smokevis
{

/// All 2-D slices of a run. Files are opened when first read.
class FDSPlaneSlices
{
public:
  /// @param index must outlive this object
  explicit FDSPlaneSlices(const SmvFile& index);

  /// One plane of one mesh.
  struct Plane
  {
    const SmvSlice* Slice = nullptr;
    /// Quantity, mesh and position, e.g. "TEMPERATURE fine y=1.2".
    std::string Name;
    std::unique_ptr<SliceFile> File;
    std::unique_ptr<FrameTimes> Times;
  };
  std::vector<Plane>& Planes() { return planes_; }

  /// The plane at a time as a grid one node or cell thick: point data named after the quantity of a
  /// node-centred slice, cell data of a cell-centred one, which lies half a cell below the node
  /// that it is named by. Its field data are Quantity, Unit, File and Time, that of the values [s].
  vtkSmartPointer<vtkRectilinearGrid> Read(
    Plane& plane, double time, TimeInterpolation interpolation) const;

private:
  double Position(const SmvSlice& slice, int axis) const;

  const SmvFile& index_;
  std::vector<Plane> planes_;
};

} // namespace smokevis

#endif
