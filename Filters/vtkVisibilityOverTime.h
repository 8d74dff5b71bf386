/**
 * @class   vtkVisibilityOverTime
 * @brief   how long signs can be seen from each place of a floor map
 *
 * Input: a vtkFloorMapOfVisibility that has time steps, or its maps read from files. The filter
 * walks through the steps, one map in memory at a time, and gives an image with the map's points
 * and no time steps of its own. A sign is visible where the map's `Visibility` is at least the
 * threshold; between two steps `Visibility` is taken as linear in time, 0 where no sign is in view,
 * and a crossing of the threshold lies where that line crosses it. Point arrays:
 * - `AvailableTime`, double [s]: the first time at which no sign is visible, the available safe
 *   egress time by visibility. The time of the first step where none is visible then; that of the
 *   last one (a lower bound) where a sign is visible all the time;
 * - `AvailableTimeInterval`, double [s]: the time between the two steps that AvailableTime lies
 *   between, which bounds its error; 0 where it is that of the first or last step;
 * - `FinalLossTime`, double [s]: the time from which on no sign is visible until the last step;
 *   that of the last step where one is visible then;
 * - `InvisibleTime`, double [s]: the time without a visible sign, all together;
 * - `FirstSign`, `LastSign`, int: the id of the best sign in the first and in the last step at
 * which one is visible, -1: none ever is;
 * - `LeastVisibility`, float: the smallest `Visibility`;
 * - `Outcome`, int: KEPT, LOST (visible at some time, not at the end), INTERRUPTED (visible at the
 *   end, not at some time before), NEVER_VISIBLE (in view, but below the threshold),
 *   NO_SIGN_IN_VIEW, INSIDE_SOLID.
 * - `SignAvailableTime`, double [s], a component a sign, named after it: AvailableTime of that sign
 *   alone; NaN where it is not in view at any time.
 * The times are NaN where no sign is in view at any time.
 *
 * Field data: the map's `SignIds` and `SignNames`; `TimeRange` [s], the first and the last step
 * that were used, `TimeSteps`, their number, `ContrastThreshold`, and `OutcomeNames`.
 */
#ifndef vtkVisibilityOverTime_h
#define vtkVisibilityOverTime_h

#include "SmokeFiltersModule.h"
#include <vtkImageAlgorithm.h>

#include <memory>
#include <vector>

class SMOKEFILTERS_EXPORT vtkVisibilityOverTime : public vtkImageAlgorithm
{
public:
  static vtkVisibilityOverTime* New();
  vtkTypeMacro(vtkVisibilityOverTime, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum PlaceOutcome
  {
    KEPT = 0,
    LOST = 1,
    INTERRUPTED = 2,
    NEVER_VISIBLE = 3,
    NO_SIGN_IN_VIEW = 4,
    INSIDE_SOLID = 5
  };

  ///@{
  /**
   * First and last time of interest [s]; the steps between them are used. With the first above the
   * last: all steps. Default: (1, -1).
   */
  vtkSetVector2Macro(TimeRange, double);
  vtkGetVector2Macro(TimeRange, double);
  ///@}

  ///@{
  /**
   * Every how many-th step is used, from 1; the last one always is. Default: 1.
   */
  vtkSetMacro(Stride, int);
  vtkGetMacro(Stride, int);
  ///@}

  ///@{
  /**
   * Perceived contrast below which a sign counts as invisible, from 0; below 0: that of the map,
   * else 0.2. Default: -1.
   */
  vtkSetMacro(ContrastThreshold, double);
  vtkGetMacro(ContrastThreshold, double);
  ///@}

protected:
  vtkVisibilityOverTime();
  ~vtkVisibilityOverTime() override;

  int ComputePipelineMTime(vtkInformation*, vtkInformationVector**, vtkInformationVector*, int,
    vtkMTimeType* mtime) override;

  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkVisibilityOverTime(const vtkVisibilityOverTime&) = delete;
  void operator=(const vtkVisibilityOverTime&) = delete;

  std::vector<double> Steps(vtkInformationVector* input) const;
  double Threshold(vtkImageData* map) const;
  void Compute(vtkInformationVector* input, vtkImageData* output);

  double TimeRange[2] = {1.0, -1.0};
  int Stride = 1;
  double ContrastThreshold = -1.0;

  struct Internals;
  std::unique_ptr<Internals> Implementation;
};

#endif
