/**
 * @class   vtkJinVisibility
 * @brief   what today's practice says of a floor map's places, and where the map differs from it
 *
 * Inputs:
 * - port 0, LightField: the output of vtkSmokeLightField;
 * - port 1, FloorMap: a vtkFloorMapOfVisibility of that light field, whose points and `Status`
 * count;
 * - port 2, Slices (optional): the 2-D slices of an FDS run, as vtkFDSSmokeReader gives them.
 *
 * From the eye at each place to the centre of each sign a straight line is drawn. A sign is in view
 * where the eye is before its front and nothing opaque lies between. The optical depth of the line,
 * the integral of the extinction K at 633 nm along it, is exact; over the length d of the line it
 * is the arithmetic mean of K along the line. Then
 * - Jin's law: V = C / mean K, and the sign is seen where d <= V, that is where the optical depth
 * is at most C (T. Jin 1978). C / mean K is the harmonic mean of the local visibilities C/K;
 * - Bouguer, Lambert, Beer: the sign's contrast arrives as C0 exp(-optical depth), and it is seen
 *   where that is at least the liminal contrast (Koschmieder's 0.02);
 * - FDS: the sign is seen where d is at most the VISIBILITY that a horizontal slice near the eye
 * has at the place, whatever lies on the way. At its cap, MaximumVisibility, FDS does not say how
 * far.
 *
 * Output: an image with the map's points and the point arrays
 * - `InView`, int, `SightDistance` d [m], `MeanExtinction` [1/m] and `JinVisibility` V [m], at most
 *   MaximumVisibility, float, a component a sign, named after it; 0 where the sign is not in view;
 * - `OpticalDepth`, float, the smallest of all signs in view, NaN where none is; `JinSign`, int,
 * the id of that sign, -1: none; `BeerLambertContrast`, float, the contrast that arrives of it;
 * - `FDSVisibility`, float [m], NaN where no slice tells;
 * - `JinDifference`, `BeerLambertDifference`, `FDSDifference`, int: the practice against the map:
 *   SEEN_BY_BOTH, PRACTICE_ONLY (the practice sees a sign, the map none), MAP_ONLY,
 * SEEN_BY_NEITHER, NO_SIGN_IN_VIEW, INSIDE_SOLID, NOT_KNOWN (no slice tells).
 *
 * Field data: the map's `SignIds` and `SignNames`, `VisibilityFactor`, `DifferenceNames` and, in
 * their order, the numbers of places `JinDifferenceCount`, `BeerLambertDifferenceCount` and
 * `FDSDifferenceCount`.
 */
#ifndef vtkJinVisibility_h
#define vtkJinVisibility_h

#include "SmokeFiltersModule.h"
#include <vtkImageAlgorithm.h>

#include <memory>

class SMOKEFILTERS_EXPORT vtkJinVisibility : public vtkImageAlgorithm
{
public:
  static vtkJinVisibility* New();
  vtkTypeMacro(vtkJinVisibility, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum DifferenceCategory
  {
    SEEN_BY_BOTH = 0,
    PRACTICE_ONLY = 1,
    MAP_ONLY = 2,
    SEEN_BY_NEITHER = 3,
    NO_SIGN_IN_VIEW = 4,
    INSIDE_SOLID = 5,
    NOT_KNOWN = 6
  };

  /**
   * Disconnects the slices.
   */
  void RemoveSlices() { this->SetInputConnection(2, nullptr); }

  ///@{
  /**
   * Jin's product C of visibility and extinction [1], above 0: 3 for signs that reflect light, 8
   * for signs that emit it. Default: 3.
   */
  vtkSetMacro(VisibilityFactor, double);
  vtkGetMacro(VisibilityFactor, double);
  ///@}

  ///@{
  /**
   * Contrast of a sign in clear air, for the law of Beer and Lambert [1], above 0. Default: 1.
   */
  vtkSetMacro(InherentContrast, double);
  vtkGetMacro(InherentContrast, double);
  ///@}

  ///@{
  /**
   * Contrast that can just be seen, for the law of Beer and Lambert [1], above 0. Default: 0.02
   * (Koschmieder 1924).
   */
  vtkSetMacro(LiminalContrast, double);
  vtkGetMacro(LiminalContrast, double);
  ///@}

  ///@{
  /**
   * Largest visibility that is given [m], above 0: FDS's own cap. Default: 30.
   */
  vtkSetMacro(MaximumVisibility, double);
  vtkGetMacro(MaximumVisibility, double);
  ///@}

  ///@{
  /**
   * How far above or below the eye a slice of VISIBILITY may lie [m], from 0. Default: 0.3.
   */
  vtkSetMacro(SliceTolerance, double);
  vtkGetMacro(SliceTolerance, double);
  ///@}

protected:
  vtkJinVisibility();
  ~vtkJinVisibility() override;

  int ComputePipelineMTime(vtkInformation*, vtkInformationVector**, vtkInformationVector*, int,
    vtkMTimeType* mtime) override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkJinVisibility(const vtkJinVisibility&) = delete;
  void operator=(const vtkJinVisibility&) = delete;

  void CheckProperties() const;
  void Compute(
    vtkDataObject* lightField, vtkImageData* map, vtkDataObject* slices, vtkImageData* output);

  double VisibilityFactor = 3.0;
  double InherentContrast = 1.0;
  double LiminalContrast = 0.02;
  double MaximumVisibility = 30.0;
  double SliceTolerance = 0.3;

  struct Internals;
  std::unique_ptr<Internals> Implementation;
};

#endif
