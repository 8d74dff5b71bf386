// The 2-D slices of an FDS run, each a flat grid at its right place.
#ifndef vtkFDSPlaneSlices_h
#define vtkFDSPlaneSlices_h

#include "vtkFDSFileBlocks.h"

namespace smokevis
{

/// All 2-D slices of a run. A block is a grid one node or cell thick: point data named after the
/// quantity of a node-centred slice, cell data of a cell-centred one, which lies half a cell below
/// the node that it is named by.
class FDSPlaneSlices : public FDSFileBlocks
{
public:
  /// @param index must outlive this object
  explicit FDSPlaneSlices(const SmvFile& index);

protected:
  std::unique_ptr<TimedFile> OpenFile(const Part& part) const override;
  vtkSmartPointer<vtkDataSet> Build(
    const Part& part, std::span<const float> values, double time) const override;

private:
  double Position(const SmvSlice& slice, int axis) const;
};

} // namespace smokevis

#endif
