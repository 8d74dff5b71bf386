/**
 * @class   vtkExitSignSource
 * @brief   plates of exit signs
 *
 * Makes one exit sign, or as many as a table holds, as plane plates that are cut into quads. The
 * front of a plate is the right-hand side of its quads. Cell arrays of the output:
 *
 * - `Luminance`, double, 1 or 3 components: emitted luminance of the front [cd/m2]; three
 * components (linear red, green, blue) where the colour is not white;
 * - `SignId`, int: the same for all cells of a sign, lit and unlit;
 * - `Reflectance`, double: diffuse reflectance, both sides;
 * - `SignName`, string: the name from the table, else "Sign <id>".
 *
 * The quads of a plate share their corners, so that they neither overlap nor leave a gap.
 *
 * @par Sign table
 * A CSV file whose first line names the columns, in any order: `cx`, `cy`, `cz` (the centre [m],
 * needed), `id`, `name`, `nx`, `ny`, `nz` (normal), `ux`, `uy`, `uz` (up), `width`, `height` [m],
 * `pattern` (Square, Barcode or Image), `bars`, `luminance` [cd/m2]. What a column or field does
 * not say comes from the properties of this source; ids then count on from SignId.
 */
#ifndef vtkExitSignSource_h
#define vtkExitSignSource_h

#include "SmokeFiltersModule.h"
#include <vtkPolyDataAlgorithm.h>

class SMOKEFILTERS_EXPORT vtkExitSignSource : public vtkPolyDataAlgorithm
{
public:
  static vtkExitSignSource* New();
  vtkTypeMacro(vtkExitSignSource, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Patterns
  {
    SQUARE = 0,
    BARCODE = 1,
    IMAGE = 2
  };

  ///@{
  /**
   * Centre of the plate [m]. Default: (0, 0, 0).
   */
  vtkSetVector3Macro(Center, double);
  vtkGetVector3Macro(Center, double);
  ///@}

  ///@{
  /**
   * Direction that the front of the plate looks to, of any length but 0. Default: (1, 0, 0).
   */
  vtkSetVector3Macro(Normal, double);
  vtkGetVector3Macro(Normal, double);
  ///@}

  ///@{
  /**
   * Direction that is up on the plate; its part along the normal does not matter. Where it is
   * parallel to the normal, y (or else x) takes its place. Default: (0, 0, 1).
   */
  vtkSetVector3Macro(Up, double);
  vtkGetVector3Macro(Up, double);
  ///@}

  ///@{
  /**
   * Width of the plate [m], above 0. Default: 0.6.
   */
  vtkSetMacro(Width, double);
  vtkGetMacro(Width, double);
  ///@}

  ///@{
  /**
   * Height of the plate [m], above 0. Default: 0.3.
   */
  vtkSetMacro(Height, double);
  vtkGetMacro(Height, double);
  ///@}

  ///@{
  /**
   * What is lit on the plate: SQUARE, one square in its middle; BARCODE, every second of a number
   * of upright bars; IMAGE, the grey levels of an image file. Default: BARCODE.
   */
  vtkSetClampMacro(Pattern, int, SQUARE, IMAGE);
  vtkGetMacro(Pattern, int);
  ///@}

  ///@{
  /**
   * Number of bars of the barcode, 1 to 9999; the first, third, ... are lit. Default: 9, 5 of them
   * lit.
   */
  vtkSetMacro(Bars, int);
  vtkGetMacro(Bars, int);
  ///@}

  ///@{
  /**
   * Side of the lit square over the shorter side of the plate, above 0, at most 1. Default: 0.5.
   */
  vtkSetMacro(SquareFraction, double);
  vtkGetMacro(SquareFraction, double);
  ///@}

  ///@{
  /**
   * PNG file of the pattern IMAGE, with at most 250000 pixels. Each pixel
   * becomes a cell; its grey level, taken as linear, leads from UnlitLuminance (black) to Luminance
   * (white). Default: none.
   */
  vtkSetFilePathMacro(PatternFile);
  vtkGetFilePathMacro(PatternFile);
  ///@}

  ///@{
  /**
   * Photometric luminance of the lit parts [cd/m2], from 0. Default: 300.
   */
  vtkSetMacro(Luminance, double);
  vtkGetMacro(Luminance, double);
  ///@}

  ///@{
  /**
   * Photometric luminance of the unlit parts [cd/m2], from 0. Default: 0.
   */
  vtkSetMacro(UnlitLuminance, double);
  vtkGetMacro(UnlitLuminance, double);
  ///@}

  ///@{
  /**
   * Colour of the light, linear red, green and blue from 0 to 1. Only the ratios count: the bands
   * are scaled so that 0.2126 R + 0.7152 G + 0.0722 B is the luminance. Default: white, (1, 1, 1).
   */
  vtkSetVector3Macro(Color, double);
  vtkGetVector3Macro(Color, double);
  ///@}

  ///@{
  /**
   * Diffuse reflectance of the plate, 0 to 1. Default: 0.
   */
  vtkSetMacro(Reflectance, double);
  vtkGetMacro(Reflectance, double);
  ///@}

  ///@{
  /**
   * Number that tells the sign from others, from 0; with a table, the number of its first row
   * unless the table says otherwise. Default: 0.
   */
  vtkSetMacro(SignId, int);
  vtkGetMacro(SignId, int);
  ///@}

  ///@{
  /**
   * CSV file with many signs, see above. Default: none, one sign is made from the properties.
   */
  vtkSetFilePathMacro(SignTable);
  vtkGetFilePathMacro(SignTable);
  ///@}

protected:
  vtkExitSignSource();
  ~vtkExitSignSource() override;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkExitSignSource(const vtkExitSignSource&) = delete;
  void operator=(const vtkExitSignSource&) = delete;

  double Center[3] = {0.0, 0.0, 0.0};
  double Normal[3] = {1.0, 0.0, 0.0};
  double Up[3] = {0.0, 0.0, 1.0};
  double Width = 0.6;
  double Height = 0.3;
  int Pattern = BARCODE;
  int Bars = 9;
  double SquareFraction = 0.5;
  char* PatternFile = nullptr;
  double Luminance = 300.0;
  double UnlitLuminance = 0.0;
  double Color[3] = {1.0, 1.0, 1.0};
  double Reflectance = 0.0;
  int SignId = 0;
  char* SignTable = nullptr;
};

#endif
