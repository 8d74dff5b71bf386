/**
 * @class   vtkLuminaireSource
 * @brief   plane lamps, one or a grid of them
 *
 * Makes rectangular lamps that shine evenly (Lambertian), or as a photometric file says, from their
 * front, the right-hand side of their quads. The output has a quad a lamp, with the cell arrays
 * `Luminance` [cd/m2], `SignId` (-1: a lamp, not a sign) and `Reflectance`.
 *
 * With a photometric file a lamp that shines up as well as down has a second quad, back to back
 * with the first at the height of the luminous opening, 1 mm at least. `Luminance` is then flux /
 * (pi area), and each cell has the number i of its table, which is made from the table's values, in
 * `PhotometryIndex`, and the direction of horizontal angle 0 in `PhotometryAxis`; the tables are
 * the field data `Photometry<i>Polar` and `Photometry<i>Azimuth` [degrees] and
 * `Photometry<i>Intensity` [cd]. The field data `LampFlux` [lm] is the flux of one lamp, the
 * integral of its intensities, and `RatedFlux` [lm] that of its bare light source as the file gives
 * it, -1 where it does not. A lamp that sends out more than its light source makes the source warn.
 */
#ifndef vtkLuminaireSource_h
#define vtkLuminaireSource_h

#include "SmokeFiltersModule.h"
#include <vtkPolyDataAlgorithm.h>

class SMOKEFILTERS_EXPORT vtkLuminaireSource : public vtkPolyDataAlgorithm
{
public:
  static vtkLuminaireSource* New();
  vtkTypeMacro(vtkLuminaireSource, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Centre of the lamp, or of the grid of lamps [m]. Default: (0, 0, 0).
   */
  vtkSetVector3Macro(Center, double);
  vtkGetVector3Macro(Center, double);
  ///@}

  ///@{
  /**
   * Direction that the lamps shine to, of any length but 0. Default: (0, 0, -1), downwards.
   */
  vtkSetVector3Macro(Normal, double);
  vtkGetVector3Macro(Normal, double);
  ///@}

  ///@{
  /**
   * Direction of the lamps' height and of the grid's second axis; its part along the normal does
   * not matter. Where it is parallel to the normal, y (or else x) takes its place. Default: (0, 1,
   * 0).
   */
  vtkSetVector3Macro(Up, double);
  vtkGetVector3Macro(Up, double);
  ///@}

  ///@{
  /**
   * Width of a lamp [m], above 0. Default: 0.6.
   */
  vtkSetMacro(Width, double);
  vtkGetMacro(Width, double);
  ///@}

  ///@{
  /**
   * Height of a lamp [m], above 0. Default: 0.6.
   */
  vtkSetMacro(Height, double);
  vtkGetMacro(Height, double);
  ///@}

  ///@{
  /**
   * Photometric luminance of the lamps [cd/m2], from 0; counts while LuminousFlux is 0. Default:
   * 3000.
   */
  vtkSetMacro(Luminance, double);
  vtkGetMacro(Luminance, double);
  ///@}

  ///@{
  /**
   * Luminous flux of each lamp [lm], from 0. Above 0 it sets the luminance, flux / (pi area), or
   * scales the intensities of the photometric file. Default: 0.
   */
  vtkSetMacro(LuminousFlux, double);
  vtkGetMacro(LuminousFlux, double);
  ///@}

  ///@{
  /**
   * File of IES LM-63, type C, with the luminous intensities of a real fitting. They are kept in
   * candela where LuminousFlux is 0; Luminance does not count. Vertical angle 0 is Normal,
   * horizontal angle 0 is Up, and 90 degrees counter-clockwise from above for a lamp that shines
   * down. Default: none, a lamp with the same luminance in all directions.
   */
  vtkSetFilePathMacro(PhotometricFile);
  vtkGetFilePathMacro(PhotometricFile);
  ///@}

  ///@{
  /**
   * Whether the size of the luminous opening in the photometric file, where it has one, replaces
   * Width (horizontal angles 90 to 270) and Height (0 to 180). Default: on.
   */
  vtkSetMacro(SizeFromFile, vtkTypeBool);
  vtkGetMacro(SizeFromFile, vtkTypeBool);
  vtkBooleanMacro(SizeFromFile, vtkTypeBool);
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
   * Diffuse reflectance of the lamps, 0 to 1. Default: 0.
   */
  vtkSetMacro(Reflectance, double);
  vtkGetMacro(Reflectance, double);
  ///@}

  ///@{
  /**
   * Lamps along the grid's first axis (the lamps' width) and its second (their height), 1 to 10000
   * each and at most a million together. Default: (1, 1).
   */
  vtkSetVector2Macro(Count, int);
  vtkGetVector2Macro(Count, int);
  ///@}

  ///@{
  /**
   * Distance between the centres of neighbouring lamps along the two axes [m], at least the lamps'
   * width and height. Default: (3, 3).
   */
  vtkSetVector2Macro(Spacing, double);
  vtkGetVector2Macro(Spacing, double);
  ///@}

protected:
  vtkLuminaireSource();
  ~vtkLuminaireSource() override;

  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkLuminaireSource(const vtkLuminaireSource&) = delete;
  void operator=(const vtkLuminaireSource&) = delete;

  /// Throws where lamps of a size cannot be made as the properties say.
  void CheckProperties(double width, double height) const;

  double Center[3] = {0.0, 0.0, 0.0};
  double Normal[3] = {0.0, 0.0, -1.0};
  double Up[3] = {0.0, 1.0, 0.0};
  double Width = 0.6;
  double Height = 0.6;
  double Luminance = 3000.0;
  double LuminousFlux = 0.0;
  char* PhotometricFile = nullptr;
  vtkTypeBool SizeFromFile = 1;
  double Color[3] = {1.0, 1.0, 1.0};
  double Reflectance = 0.0;
  int Count[2] = {1, 1};
  double Spacing[2] = {3.0, 3.0};
};

#endif
