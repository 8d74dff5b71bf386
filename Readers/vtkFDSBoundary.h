// The boundary files of an FDS run: quantities on the walls, such as their temperature.
#ifndef vtkFDSBoundary_h
#define vtkFDSBoundary_h

#include "vtkFDSFileBlocks.h"

namespace smokevis
{

/// All boundary files of a run. A block is the walls of one mesh as quadrilaterals, without those
/// of obstructions that are not there at the time: point data named after the quantity, cell data
/// where FDS wrote cells.
class FDSBoundary : public FDSFileBlocks
{
public:
  /// @param index must outlive this object
  explicit FDSBoundary(const SmvFile& index);

protected:
  std::unique_ptr<TimedFile> OpenFile(const Part& part) const override;
  vtkSmartPointer<vtkDataSet> Build(
    const Part& part, std::span<const float> values, double time) const override;
};

} // namespace smokevis

#endif
