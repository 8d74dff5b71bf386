/**
 * @class   vtkEXRWriter
 * @brief   writes images of luminance as OpenEXR files
 *
 * Input: a vtkImageData with a single layer of points. Every numeric point array becomes float
 * channels of a scanline file, without any scaling. `Luminance` is channel Y, `LuminanceRGB` R, G,
 * B, `DirectLuminance` Direct, `VeilLuminance` Veil, `LuminanceError` Error, `SignMask` Mask,
 * `SignIds` SignId; other arrays keep their names, with a dot and the name or number of the
 * component where there are several. Numbers of the field data become header entries of type double
 * (a dot and an index where there are several), texts of type string. The entry `Units` names the
 * units. In a parallel run the first process writes the file, and all tell of an error.
 */
#ifndef vtkEXRWriter_h
#define vtkEXRWriter_h

#include "SmokeFiltersModule.h"
#include <vtkWriter.h>

class SMOKEFILTERS_EXPORT vtkEXRWriter : public vtkWriter
{
public:
  static vtkEXRWriter* New();
  vtkTypeMacro(vtkEXRWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * File to write. Default: none.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

protected:
  vtkEXRWriter() = default;
  ~vtkEXRWriter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void WriteData() override;

private:
  vtkEXRWriter(const vtkEXRWriter&) = delete;
  void operator=(const vtkEXRWriter&) = delete;

  char* FileName = nullptr;
};

#endif
