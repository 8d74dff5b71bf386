/**
 * @class   vtkRouteVisibility
 * @brief   what somebody who walks a way sees of the exit signs
 *
 * Inputs:
 * - port 0, LightField: the output of vtkSmokeLightField, with its time steps where it has them;
 * - port 1, Route: polydata, each line of which is a route on the floor, walked from its first
 * point on; or a table with the columns `x`, `y` [m] and, where they are known, `z` [m, else 0],
 * `time` (or `t`) [s] and `route` (or `person`, `id`), the number of the route. Polydata with a
 * point array `Time` [s], and tables with times, are trajectories: their times count, not StartTime
 * and speeds.
 *
 * The filter walks through the light field's time steps, two of them in memory at a time, and from
 * place to place, at most SampleSpacing apart. Extinction and the contrasts of the signs, measured
 * from the very places, are linear in time between steps; before the first and after the last step
 * that one counts (`BeyondTimes`).
 *
 * Output: polydata, a line a route, with the point arrays
 * - `Time` [s], `Distance` from the start [m], `Speed` towards the next place [m/s], double;
 *   `Extinction` at the eye [1/m], double;
 * - `Visibility`, float, the largest perceived contrast of all signs, `BestSign`, int, the id of
 * that sign, -1: none is in view; `PerceivedContrast`, float, a component a sign, named after it;
 * - `Status`, int, as in vtkFloorMapOfVisibility; `BeyondTimes`, int, 0 or 1.
 *
 * Field data, a tuple a route, double: `RouteLength` [m], `RouteTime` [s]; `InvisibleTime` [s] and
 * `InvisibleDistance` [m], time and way without a visible sign; `LongestInvisibleTime` [s], without
 * a break; `FirstLossTime` [s], `FirstLossDistance` [m] and `FirstLossPlace` [m, 3 components],
 * when and where no sign is visible for the first time, NaN where one always is; `LeastVisibility`.
 * Between places contrasts are linear, and the threshold is crossed where that line does. Also
 * `SignIds`, `SignNames`, `ContrastThreshold`, and `TimeStepsUsed` [s].
 */
#ifndef vtkRouteVisibility_h
#define vtkRouteVisibility_h

#include "SmokeFiltersModule.h"
#include <vtkPolyDataAlgorithm.h>

#include <memory>

class SMOKEFILTERS_EXPORT vtkRouteVisibility : public vtkPolyDataAlgorithm
{
public:
  static vtkRouteVisibility* New();
  vtkTypeMacro(vtkRouteVisibility, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum SpeedLaws
  {
    CONSTANT = 0,
    FRANTZICH_NILSSON = 1,
    FRIDOLF = 2
  };

  ///@{
  /**
   * When a route without times begins [s]. Default: 0.
   */
  vtkSetMacro(StartTime, double);
  vtkGetMacro(StartTime, double);
  ///@}

  ///@{
  /**
   * Walking speed in clear air [m/s], above 0. Default: 1.19, on level floors without a crowd (SFPE
   * Handbook, 5th edition, chapter 59).
   */
  vtkSetMacro(WalkingSpeed, double);
  vtkGetMacro(WalkingSpeed, double);
  ///@}

  ///@{
  /**
   * How smoke of the extinction K at the eye slows walkers down: not at all; by Frantzich and
   * Nilsson (Lund report 3126, 2003, eq. 3), to 1 - 0.057 K / 0.706 of the speed in clear air, not
   * less than a tenth, as FDS+Evac has it; or by Fridolf and others (Tunnelling and Underground
   * Space Technology, 2019, eq. 7), by 0.34 m/s for each metre that the visibility
   * SpeedVisibilityFactor / K falls short of 3 m, not below 0.2 m/s. Default: CONSTANT.
   */
  vtkSetClampMacro(SpeedLaw, int, CONSTANT, FRIDOLF);
  vtkGetMacro(SpeedLaw, int);
  ///@}

  ///@{
  /**
   * Product of visibility and extinction in the law of Fridolf and others [1], above 0: 2 for what
   * reflects light, 8 for what emits it. Default: 2.
   */
  vtkSetMacro(SpeedVisibilityFactor, double);
  vtkGetMacro(SpeedVisibilityFactor, double);
  ///@}

  ///@{
  /**
   * Height of the eyes above the route [m], from 0. Default: 1.7.
   */
  vtkSetMacro(EyeHeight, double);
  vtkGetMacro(EyeHeight, double);
  ///@}

  ///@{
  /**
   * Largest distance between places of a route [m], above 0. Default: 0.5.
   */
  vtkSetMacro(SampleSpacing, double);
  vtkGetMacro(SampleSpacing, double);
  ///@}

  ///@{
  /**
   * Longest time between places of a trajectory, where it is slow or stands still [s], above 0.
   * Default: 5.
   */
  vtkSetMacro(SampleInterval, double);
  vtkGetMacro(SampleInterval, double);
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
   * Equivalent luminance of the observer's own noise [cd/m2], 0 to 1e12. Default: 0.1.
   */
  vtkSetMacro(DarkLuminance, double);
  vtkGetMacro(DarkLuminance, double);
  ///@}

  ///@{
  /**
   * Smallest angle that the observer resolves [minutes of arc], 0 to 10800. Default: 1.
   */
  vtkSetMacro(Acuity, double);
  vtkGetMacro(Acuity, double);
  ///@}

  ///@{
  /**
   * Luminance that the eye is adapted to where the route begins, such as that of a lit room
   * [cd/m2], 0 to 1e12; the eye adapts to the dark on the way, as in vtkFloorMapOfVisibility.
   * Default: 0.
   */
  vtkSetMacro(AdaptationLuminance, double);
  vtkGetMacro(AdaptationLuminance, double);
  ///@}

protected:
  vtkRouteVisibility();
  ~vtkRouteVisibility() override;

  int ComputePipelineMTime(vtkInformation*, vtkInformationVector**, vtkInformationVector*, int,
    vtkMTimeType* mtime) override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkRouteVisibility(const vtkRouteVisibility&) = delete;
  void operator=(const vtkRouteVisibility&) = delete;

  void CheckProperties() const;
  void Compute(vtkInformationVector* lightField, vtkDataObject* routes, vtkPolyData* output);

  double StartTime = 0.0;
  double WalkingSpeed = 1.19;
  int SpeedLaw = CONSTANT;
  double SpeedVisibilityFactor = 2.0;
  double EyeHeight = 1.7;
  double SampleSpacing = 0.5;
  double SampleInterval = 5.0;
  double ContrastThreshold = 0.2;
  double DarkLuminance = 0.1;
  double Acuity = 1.0;
  double AdaptationLuminance = 0.0;

  struct Internals;
  std::unique_ptr<Internals> Implementation;
};

#endif
