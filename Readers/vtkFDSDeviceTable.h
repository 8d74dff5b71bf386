// Reads the measurements of an FDS run's devices (CHID_devc.csv) into a table.
#ifndef vtkFDSDeviceTable_h
#define vtkFDSDeviceTable_h

#include <string>

class vtkTable;

namespace smokevis
{
class SmvFile;

/// Reads the `devc` tables that @p index names into @p table: a column `Time` [s] and one a device.
/// The table's field data hold, one value a column, the string array `Units` and, one tuple a
/// column, the positions `Position` [m] (NaN for Time). A last line that the run has not finished
/// writing is left out. Throws Error when a file is missing or not such a table; a run without
/// devices gives an empty table.
void ReadDeviceTable(const SmvFile& index, vtkTable* table);

} // namespace smokevis

#endif
