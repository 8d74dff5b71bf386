/**
 * @class   vtkFloorMapOfVisibility
 * @brief   whether an exit sign can be seen, over a grid of standing places
 *
 * Input: the output of vtkSmokeLightField, fresh or read from a file. Output: an image whose points
 * are the centres of the floor's cells, at eye level, with the point arrays
 * - `Visibility`, float, the largest perceived contrast over all signs in view, its standard error
 * `VisibilityError` by the light field's noise, and `VisibilityDivisionError`, the one by how
 * uneven the smoke is between the places of the plate that are looked at; `BestSign`, int, the id
 * of that sign, -1: none;
 * - `Contrast` (standard deviation over mean), `PerceivedContrast`, `SignLuminance` (mean of the
 * lit cells as it arrives [cd/m2]) and `VisibleFraction`, float, a component a sign, named after
 * it;
 * - `VisibleProbability`, float, the share of observers who see the best sign, the contrast at
 * which it is lost being normally distributed over them (ContrastThreshold, ThresholdSpread); what
 * varies over a plate for another reason than its pattern, such as a lamp at its side, is contrast
 * too;
 * - `EyeLuminance`, float [cd/m2], what counts as the eye's own noise when it looks at the best
 * sign: DarkLuminance and what adaptation and glare add;
 * - `OpticalDepth` and `JinVisibility` (3 / mean extinction [m]), float, along the line to the best
 *   sign;
 * - `Status`, int: SEEN, BELOW_THRESHOLD, NO_SIGN_IN_VIEW, INSIDE_SOLID.
 *
 * Field data: `SignIds` and `SignNames` in the order of the components, `ContrastThreshold`, and
 * what was done and left out as `WorkReportWhat`, `WorkReportCount`, `WorkReportWhy`.
 */
#ifndef vtkFloorMapOfVisibility_h
#define vtkFloorMapOfVisibility_h

#include "SmokeFiltersModule.h"
#include <vtkImageAlgorithm.h>

#include <array>
#include <memory>

namespace smokevis
{
class Agreement;
struct FloorMap;
struct FloorMapOptions;
class Medium;
class View;
} // namespace smokevis

class SMOKEFILTERS_EXPORT vtkFloorMapOfVisibility : public vtkImageAlgorithm
{
public:
  static vtkFloorMapOfVisibility* New();
  vtkTypeMacro(vtkFloorMapOfVisibility, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum PlaceStatus
  {
    SEEN = 0,
    BELOW_THRESHOLD = 1,
    NO_SIGN_IN_VIEW = 2,
    INSIDE_SOLID = 3
  };

  ///@{
  /**
   * Height of the eyes above the floor [m]. Default: 1.7.
   */
  vtkSetMacro(EyeHeight, double);
  vtkGetMacro(EyeHeight, double);
  ///@}

  ///@{
  /**
   * Places along x and y, from 1, at most 100 million values (places times signs). Default: (12,
   * 8).
   */
  vtkSetVector2Macro(Resolution, int);
  vtkGetVector2Macro(Resolution, int);
  ///@}

  ///@{
  /**
   * xmin, xmax, ymin, ymax of the area, and the heights of its floor and ceiling [m]. With
   * xmin > xmax: the bounds of the smoke. Default: (1, -1, 1, -1, 1, -1).
   */
  vtkSetVector6Macro(Bounds, double);
  vtkGetVector6Macro(Bounds, double);
  ///@}

  ///@{
  /**
   * Whether the area is a box given by its lower corner and its size [m], as ParaView's panel lets
   * one draw it, and Bounds is not used. The box stands on the floor and ends at the ceiling; its
   * sizes are above 0. Default: off, position (-1, -1, -1), size (2, 2, 2).
   */
  vtkSetMacro(UseBox, bool);
  vtkGetMacro(UseBox, bool);
  vtkBooleanMacro(UseBox, bool);
  vtkSetVector3Macro(BoxPosition, double);
  vtkGetVector3Macro(BoxPosition, double);
  vtkSetVector3Macro(BoxSize, double);
  vtkGetVector3Macro(BoxSize, double);
  ///@}

  ///@{
  /**
   * Perceived contrast below which a sign counts as invisible, from 0. Default: 0.2.
   */
  vtkSetMacro(ContrastThreshold, double);
  vtkGetMacro(ContrastThreshold, double);
  ///@}

  ///@{
  /**
   * Standard deviation of that threshold over observers, from 0; 0: all have the same.
   * Default: 0.04.
   */
  vtkSetMacro(ThresholdSpread, double);
  vtkGetMacro(ThresholdSpread, double);
  ///@}

  ///@{
  /**
   * Equivalent luminance of the observer's own noise [cd/m2], 0 to 1e12; 0 for plain contrast.
   * Default: 0.1.
   */
  vtkSetMacro(DarkLuminance, double);
  vtkGetMacro(DarkLuminance, double);
  ///@}

  ///@{
  /**
   * Signs whose perceived contrast by their own light, without the smoke's, is below this are
   * measured no further and count as 0, from 0: even veils only lower it. 0: all are measured.
   * Default: 0.
   */
  vtkSetMacro(CutOff, double);
  vtkGetMacro(CutOff, double);
  ///@}

  ///@{
  /**
   * Smallest angle that the observer resolves [minutes of arc], 0 to 10800; finer detail is
   * averaged. Default: 1.
   */
  vtkSetMacro(Acuity, double);
  vtkGetMacro(Acuity, double);
  ///@}

  ///@{
  /**
   * Luminance that the eye was adapted to before it came here, such as that of a lit room [cd/m2],
   * from 0; 0: adapted to the dark. It raises the eye's own noise by 0.05 L (1.9 + t)^-1.4, the
   * adaptation curve of CIE 88, t being AdaptationTime. Default: 0.
   */
  vtkSetMacro(AdaptationLuminance, double);
  vtkGetMacro(AdaptationLuminance, double);
  ///@}

  ///@{
  /**
   * Time since the eye left the place that it was adapted to [s], from 0. Default: 0.
   */
  vtkSetMacro(AdaptationTime, double);
  vtkGetMacro(AdaptationTime, double);
  ///@}

  ///@{
  /**
   * Whether lamps, other signs and flames in open view veil the sign that the eye looks at, by the
   * general equation for disability glare of CIE 146 (2002). Default: 0.
   */
  vtkSetMacro(Glare, bool);
  vtkGetMacro(Glare, bool);
  vtkBooleanMacro(Glare, bool);
  ///@}

  ///@{
  /**
   * Age of the observer, for glare [years], from 0 to 100. Default: 35.
   */
  vtkSetMacro(ObserverAge, double);
  vtkGetMacro(ObserverAge, double);
  ///@}

protected:
  vtkFloorMapOfVisibility();
  ~vtkFloorMapOfVisibility() override;

  int ComputePipelineMTime(vtkInformation*, vtkInformationVector**, vtkInformationVector*, int,
    vtkMTimeType* mtime) override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkFloorMapOfVisibility(const vtkFloorMapOfVisibility&) = delete;
  void operator=(const vtkFloorMapOfVisibility&) = delete;

  void CheckProperties() const;
  /// xmin, xmax, ymin, ymax of the area, and the heights of its floor and ceiling.
  std::array<double, 6> Area(const smokevis::Medium& smoke) const;
  /// Checks what is asked for against the light field.
  smokevis::FloorMapOptions Prepare(const smokevis::View& view) const;
  void AddProperties(smokevis::Agreement& agreement) const;
  /// An area that was meant in other units, or in another place, shows no sign.
  void WarnOfPlacesOutside(const smokevis::FloorMap& map, const smokevis::FloorMapOptions& options,
    const smokevis::View& view);
  void Compute(vtkDataObject* input, vtkImageData* output);

  double EyeHeight = 1.7;
  int Resolution[2] = {12, 8};
  double Bounds[6] = {1.0, -1.0, 1.0, -1.0, 1.0, -1.0};
  bool UseBox = false;
  double BoxPosition[3] = {-1.0, -1.0, -1.0};
  double BoxSize[3] = {2.0, 2.0, 2.0};
  double ContrastThreshold = 0.2;
  double ThresholdSpread = 0.04;
  double DarkLuminance = 0.1;
  double CutOff = 0.0;
  double Acuity = 1.0;
  double AdaptationLuminance = 0.0;
  double AdaptationTime = 0.0;
  bool Glare = false;
  double ObserverAge = 35.0;

  struct Internals;
  std::unique_ptr<Internals> Implementation;
};

#endif
