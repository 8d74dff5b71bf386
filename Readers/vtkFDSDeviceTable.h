// Reads the measurements of an FDS run's devices (CHID_devc.csv) into a table.
#ifndef vtkFDSDeviceTable_h
#define vtkFDSDeviceTable_h

#include <string>
#include <vector>

class vtkTable;

namespace smokevis
{
class SmvFile;

/// Reads the `devc` tables that @p index names into @p table: a column `Time` [s] and one a device.
/// The table's field data hold, one value a column, the string array `Units` and, one tuple a
/// column, the positions `Position` [m] (NaN for Time). A last line that the run has not finished
/// writing is left out. Returns warnings of files that are missing: ParaView updates all outputs of
/// a reader, so that is no error to those who want its smoke only. Throws Error when a file is no
/// such table; a run without devices gives an empty table.
std::vector<std::string> ReadDeviceTable(const SmvFile& index, vtkTable* table);

/// Tables that end inside a line, a line each.
std::vector<std::string> DeviceTableDamages(const SmvFile& index);

} // namespace smokevis

#endif
