/**
 * @class   vtkExitSignSource
 * @brief   plates of exit signs
 *
 * Makes one exit sign, or as many as a table holds, as plane plates that are cut into convex cells.
 * The front of a plate is the right-hand side of its cells. A sign that only reflects has a
 * luminance of 0 and reflectances for its parts. Cell arrays of the output:
 *
 * - `Luminance`, double, 1 or 3 components: emitted luminance of the front [cd/m2]; three
 * components (linear red, green, blue) where the colour is not white;
 * - `SignId`, int: the same for all cells of a sign, lit and unlit;
 * - `SignPart`, int: 1 for the parts that are to be bright ("lit"), 0 for the others;
 * - `Reflectance`, double, 1 or 3 components: diffuse reflectance, both sides;
 * - `EmissionExponent`, double, where it is not 0 for all;
 * - `SignName`, string: the name from the table, else "Sign <id>".
 *
 * The cells of a plate neither overlap nor leave a gap. The field data `PresetSource` say where the
 * numbers of a preset are from.
 *
 * @par Sign table
 * A CSV file whose first line names the columns, in any order: `cx`, `cy`, `cz` (the centre [m],
 * needed), `id`, `name`, `nx`, `ny`, `nz` (normal), `ux`, `uy`, `uz` (up), `width`, `height` [m],
 * `preset` (EN1838, EN1838Smoke, ISO3864, UL924Stencil, UL924Panel), `pattern` (Square, Barcode,
 * Image, Text, RunningMan), `design` (Stencil, Panel), `bars`, `bar_fraction`, `square_fraction`,
 * `pattern_file` (relative to the table), `text`, `figure_height` [m], `luminance`,
 * `unlit_luminance` [cd/m2], `uniformity`, `exponent`, `red`, `green`, `blue`, `unlit_red`,
 * `unlit_green`, `unlit_blue`, `reflectance`, `unlit_reflectance`. What a column or field does not
 * say comes from the row's preset, or else from the properties of this source; ids then count on
 * from SignId.
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
    IMAGE = 2,
    TEXT = 3,
    RUNNING_MAN = 4
  };

  enum Designs
  {
    STENCIL = 0,
    PANEL = 1
  };

  enum Presets
  {
    CUSTOM = 0,
    EN_1838 = 1,
    EN_1838_SMOKE = 2,
    ISO_3864 = 3,
    UL_924_STENCIL = 4,
    UL_924_PANEL = 5
  };

  ///@{
  /**
   * A look that a standard asks for, which replaces pattern, design, luminances, uniformity,
   * exponent, colours and reflectances below; place and size stay. EN_1838: a running man, white 10
   * and green 2 cd/m2 (EN 1838:2013: at least 2 cd/m2 in the safety colour, white at least 5 times
   * that). EN_1838_SMOKE: five times as bright, as asked for where smoke can arise. ISO_3864: the
   * same sign without light of its own, white reflecting 0.75 and green 0.12 (ISO 3864-4).
   * UL_924_STENCIL: EXIT in red letters of 0.205 cd/m2, 0.06 footlambert, on a dark ground.
   * UL_924_PANEL: EXIT in red letters of 0.205 cd/m2 on white twice as bright (UL 924: contrast of
   * at least 0.5). Default: CUSTOM, as the properties below say.
   */
  vtkSetClampMacro(Preset, int, CUSTOM, UL_924_PANEL);
  vtkGetMacro(Preset, int);
  ///@}

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
   * The figure on the plate: SQUARE, one square in its middle; BARCODE, every second of a number
   * of upright bars; IMAGE, the grey levels of an image file; TEXT, a word in block letters;
   * RUNNING_MAN, a man who runs through a door, in the spirit of ISO 7010, E001. Default: BARCODE.
   */
  vtkSetClampMacro(Pattern, int, SQUARE, RUNNING_MAN);
  vtkGetMacro(Pattern, int);
  ///@}

  ///@{
  /**
   * STENCIL: a lit figure on an unlit ground. PANEL: an unlit figure on a lit ground. Default:
   * STENCIL.
   */
  vtkSetClampMacro(Design, int, STENCIL, PANEL);
  vtkGetMacro(Design, int);
  ///@}

  ///@{
  /**
   * Number of bars and gaps of the barcode, 1 to 9999; the first, third, ... are bars. Default: 9,
   * 5 bars and 4 gaps.
   */
  vtkSetMacro(Bars, int);
  vtkGetMacro(Bars, int);
  ///@}

  ///@{
  /**
   * Width of a bar over that of a bar and a gap, above 0, below 1. Default: 0.5.
   */
  vtkSetMacro(BarFraction, double);
  vtkGetMacro(BarFraction, double);
  ///@}

  ///@{
  /**
   * Side of the square over the shorter side of the plate, above 0, at most 1. Default: 0.5.
   */
  vtkSetMacro(SquareFraction, double);
  vtkGetMacro(SquareFraction, double);
  ///@}

  ///@{
  /**
   * PNG file of the pattern IMAGE, with at most 250000 pixels. The luminance of a pixel, with its
   * sRGB values (or those of the gamma that the file states) made linear first, leads from ground
   * (0) to figure (1): grey 128 is 0.22, pure red 0.21, what is transparent 0. Rectangles of one
   * level become cells. Default: none.
   */
  vtkSetFilePathMacro(PatternFile);
  vtkGetFilePathMacro(PatternFile);
  ///@}

  ///@{
  /**
   * Word of the pattern TEXT: A to Z, 0 to 9, blanks and - . / & ! ' +. Strokes are an eighth of
   * the letters' height. Default: EXIT.
   */
  vtkSetStringMacro(Text);
  vtkGetStringMacro(Text);
  ///@}

  ///@{
  /**
   * Height of letters or of the running man [m], from 0; 0: as large as fits with a margin, at most
   * 0.7 of the plate's height and 0.9 of its width. Default: 0.
   */
  vtkSetMacro(FigureHeight, double);
  vtkGetMacro(FigureHeight, double);
  ///@}

  ///@{
  /**
   * Photometric luminance of the lit parts along their normal, on average over the plate [cd/m2],
   * from 0. Default: 300.
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
   * Least over greatest luminance within the lit or the unlit parts, above 0, at most 1: it falls
   * evenly from the upper to the lower edge of the plate. EN 1838 allows 0.1. Default: 1.
   */
  vtkSetMacro(Uniformity, double);
  vtkGetMacro(Uniformity, double);
  ///@}

  ///@{
  /**
   * Luminance goes with this power of the cosine of the angle to the normal, from 0. Default: 0,
   * the same in all directions.
   */
  vtkSetMacro(EmissionExponent, double);
  vtkGetMacro(EmissionExponent, double);
  ///@}

  ///@{
  /**
   * Colour of the lit parts' light and reflectance, linear red, green and blue from 0 to 1. Only
   * the ratios count: the bands are scaled so that 0.2126 R + 0.7152 G + 0.0722 B is the luminance.
   * Default: white, (1, 1, 1).
   */
  vtkSetVector3Macro(Color, double);
  vtkGetVector3Macro(Color, double);
  ///@}

  ///@{
  /**
   * The same for the unlit parts. Default: black, (0, 0, 0), which stands for Color.
   */
  vtkSetVector3Macro(UnlitColor, double);
  vtkGetVector3Macro(UnlitColor, double);
  ///@}

  ///@{
  /**
   * Diffuse reflectance of the lit parts, 0 to 1. Default: 0.
   */
  vtkSetMacro(Reflectance, double);
  vtkGetMacro(Reflectance, double);
  ///@}

  ///@{
  /**
   * Diffuse reflectance of the unlit parts, 0 to 1; below 0: that of the lit parts. Default: -1.
   */
  vtkSetMacro(UnlitReflectance, double);
  vtkGetMacro(UnlitReflectance, double);
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

  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkExitSignSource(const vtkExitSignSource&) = delete;
  void operator=(const vtkExitSignSource&) = delete;

  double Center[3] = {0.0, 0.0, 0.0};
  double Normal[3] = {1.0, 0.0, 0.0};
  double Up[3] = {0.0, 0.0, 1.0};
  double Width = 0.6;
  double Height = 0.3;
  int Preset = CUSTOM;
  int Pattern = BARCODE;
  int Design = STENCIL;
  int Bars = 9;
  double BarFraction = 0.5;
  double SquareFraction = 0.5;
  char* PatternFile = nullptr;
  char* Text = nullptr;
  double FigureHeight = 0.0;
  double Luminance = 300.0;
  double UnlitLuminance = 0.0;
  double Uniformity = 1.0;
  double EmissionExponent = 0.0;
  double Color[3] = {1.0, 1.0, 1.0};
  double UnlitColor[3] = {0.0, 0.0, 0.0};
  double Reflectance = 0.0;
  double UnlitReflectance = -1.0;
  int SignId = 0;
  char* SignTable = nullptr;
};

#endif
