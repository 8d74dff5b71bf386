/**
 * @class   vtkFloorMapWriter
 * @brief   writes the floor maps of all time steps to one NetCDF file, for evacuation models
 *
 * Input: a vtkFloorMapOfVisibility, with its time steps where it has them. The writer walks through
 * them, one map in memory at a time. The file has the classic format with 64-bit offsets and
 * follows the CF conventions (1.8):
 * - dimensions `time` (it may grow), `sign`, `y`, `x`;
 * - `time` [s], `y`, `x` [m], `z` [m] (the height of the eye), `sign` (the ids), `sign_name`;
 * - `perceived_contrast`, `contrast`, `sign_luminance` [cd m-2], `visible_fraction`: (time, sign,
 * y, x);
 * - `visibility`, `visibility_error`, `visible_probability`, `best_sign`, `status`: (time, y, x);
 * - the attribute `contrast_threshold`.
 * Times are the simulation's seconds; as the conventions want a date, 2000-01-01 stands for 0 s.
 * With Table a table of the quantities of the signs goes into a file of the same name that ends in
 * .csv, a row a time, place and sign. Where something fails no file is left. In a parallel run the
 * first process writes.
 */
#ifndef vtkFloorMapWriter_h
#define vtkFloorMapWriter_h

#include "SmokeFiltersModule.h"
#include <vtkWriter.h>

class SMOKEFILTERS_EXPORT vtkFloorMapWriter : public vtkWriter
{
public:
  static vtkFloorMapWriter* New();
  vtkTypeMacro(vtkFloorMapWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * File to write. Default: none.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /**
   * First and last time of interest [s]; the steps between them are written. With the first above
   * the last: all steps. Default: (1, -1).
   */
  vtkSetVector2Macro(TimeRange, double);
  vtkGetVector2Macro(TimeRange, double);
  ///@}

  ///@{
  /**
   * Every how many-th step is written, from 1; the last one always is. Default: 1.
   */
  vtkSetMacro(Stride, int);
  vtkGetMacro(Stride, int);
  ///@}

  ///@{
  /**
   * Whether a table of comma-separated values is written beside the file. Default: 0.
   */
  vtkSetMacro(Table, bool);
  vtkGetMacro(Table, bool);
  vtkBooleanMacro(Table, bool);
  ///@}

protected:
  vtkFloorMapWriter() = default;
  ~vtkFloorMapWriter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void WriteData() override;

private:
  vtkFloorMapWriter(const vtkFloorMapWriter&) = delete;
  void operator=(const vtkFloorMapWriter&) = delete;

  void WriteSteps(vtkInformationVector* input);

  char* FileName = nullptr;
  double TimeRange[2] = {1.0, -1.0};
  int Stride = 1;
  bool Table = false;
};

#endif
