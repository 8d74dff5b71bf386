// How far a sweep takes the light of cells, and what it expects of them.
#pragma once

#include "ThickCells.h"

#include <algorithm>
#include <vector>

namespace smokevis
{

class Scene;

/// Lines meet a cell by chance, as often and as far as it comes. In white smoke that must not be
/// multiplied by a light that is off in a whole region: what a sweep expects of a cell there is its
/// latest light, which lines carry on nearly all of, so that they tell by how much more comes in
/// than goes out, and sums over cells in a row cancel. The cell's own noise would then grow: it
/// takes on a part of what the sweep finds.
class CellSteps
{
public:
  CellSteps() = default;
  /// @param extinction of each cell in the band [1/m]
  /// @param meetings of each cell with lines of a whole sweep
  /// @param often whether the smoke as a whole sends nearly all on (ScattersOften)
  CellSteps(const Scene& scene, const std::vector<float>& extinction,
    const std::vector<float>& meetings, bool often);

  /// Times that lines must have met a cell or patch for its light to be expected there.
  static constexpr float FewestMeetings = 1.0F;

  /// Fluence that is expected of a cell.
  /// @param meetings of the sweep that its latest light comes from
  /// @param mean of its sweeps
  float Expected(float meetings, float latest, float mean) const
  {
    return IsFresh(meetings) ? mean + this->Latest_ * (this->Albedo_ * latest - mean) : mean;
  }
  /// Share of what a sweep would change of a cell's fluence that it does change.
  /// @param before meetings of the sweep that its latest light comes from, @param now of this one
  float Step(float before, float now) const { return IsFresh(before) ? this->StepOf(now) : 1.0F; }
  /// Of whole sweeps, in the mean over what cells scatter.
  double MeanStep() const { return this->MeanStep_; }

private:
  /// Steps of a cell's light are as large as its own noise lets them be, or larger by this: light
  /// that comes from its neighbours is smoother.
  static constexpr float BoldSteps = 4.0F / 3.0F;

  static bool IsFresh(float meetings) { return meetings >= FewestMeetings; }
  float StepOf(float meetings) const
  {
    // What lines would correct of a cell's own error differs from sweep to sweep by the lengths in
    // it: its mean square shrinks fastest where 1 + their variance divides the step.
    const float own = this->Latest_ * this->Albedo_;
    return std::min(
      1.0F, BoldSteps * meetings / (meetings + own * own * ThickCells::LengthVariance));
  }

  float Albedo_ = 0.0F;
  /// Weight of the latest light, not its mean.
  float Latest_ = 0.0F;
  double MeanStep_ = 1.0;
};

} // namespace smokevis
