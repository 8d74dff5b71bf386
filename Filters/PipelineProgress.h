// Lets the solver report to a VTK algorithm, and learn from it that it should stop.
#pragma once

#include "Progress.h"

#include <vtkAlgorithm.h>

#include <chrono>

namespace smokevis
{

/// Maps the progress of a piece of work to a part of an algorithm's. Report runs on the pipeline
/// thread, the only one that may talk to the algorithm.
class PipelineProgress : public Progress
{
public:
  /// @param begin,end the algorithm's progress when the work begins and ends
  explicit PipelineProgress(vtkAlgorithm* algorithm, double begin = 0.0, double end = 1.0)
      : Algorithm_(algorithm), Begin_(begin), End_(end)
  {
  }

  void Report(double fraction) override
  {
    // Drawing a progress bar takes longer than the smallest pieces of work.
    const auto now = std::chrono::steady_clock::now();
    if (now - this->Last_ < std::chrono::milliseconds(50))
    {
      return;
    }
    this->Last_ = now;
    this->Algorithm_->UpdateProgress(this->Begin_ + fraction * (this->End_ - this->Begin_));
    if (this->Algorithm_->CheckAbort())
    {
      this->Stop();
    }
  }

private:
  vtkAlgorithm* Algorithm_;
  double Begin_;
  double End_;
  std::chrono::steady_clock::time_point Last_;
};

} // namespace smokevis
