// The boundary files of an FDS run: quantities on the walls, such as their temperature.
#ifndef vtkFDSBoundary_h
#define vtkFDSBoundary_h

#include "BoundaryFile.h"
#include "FrameTimes.h"
#include "SmvFile.h"

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <memory>
#include <string>
#include <vector>

namespace smokevis
{

/// All boundary files of a run. They are opened when first read.
class FDSBoundary
{
public:
  /// @param index must outlive this object
  explicit FDSBoundary(const SmvFile& index);

  /// One quantity on the walls of one mesh.
  struct Quantity
  {
    const SmvBoundary* Entry = nullptr;
    /// Quantity and mesh, e.g. "WALL TEMPERATURE fine".
    std::string Name;
    std::unique_ptr<BoundaryFile> File;
    std::unique_ptr<FrameTimes> Times;
  };
  std::vector<Quantity>& Quantities() { return quantities_; }

  /// The walls at a time as quadrilaterals, without those of obstructions that are not there then:
  /// point data named after the quantity, cell data where FDS wrote cells. Field data name
  /// Quantity, Unit and File.
  vtkSmartPointer<vtkPolyData> Read(
    Quantity& quantity, double time, TimeInterpolation interpolation) const;

private:
  const SmvFile& index_;
  std::vector<Quantity> quantities_;
};

} // namespace smokevis

#endif
