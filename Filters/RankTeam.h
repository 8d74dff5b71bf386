// The processes of a parallel run as a team of the solver.
#pragma once

#include "PipelineProgress.h"
#include "Team.h"

#include <functional>
#include <memory>
#include <vector>

class vtkAlgorithm;

namespace smokevis
{

/// Processes (mpiexec pvbatch, pvserver) that do one piece of long work of an algorithm together.
/// They tell each other at once when one has failed or was stopped, also in the middle of a step,
/// so that none of them works on in vain or waits for ever. Where there is no MPI it is a team of
/// one.
class RankTeam : public Team
{
public:
  explicit RankTeam(vtkAlgorithm* algorithm);
  ~RankTeam() override;
  RankTeam(const RankTeam&) = delete;
  RankTeam& operator=(const RankTeam&) = delete;

  int Rank() const override;
  int Size() const override;

  /// Does work as RunWithProgress does, on all processes: all of them must call it. What the work
  /// throws in one process, or its abort, makes it throw in all of them; an abort makes the
  /// algorithm's outputs aborted everywhere. At most once.
  /// @param begin,end the algorithm's progress when the work begins and ends
  void Run(double begin, double end, const std::function<void(Progress&)>& work);

  /// For the work, on whichever thread it runs.
  void Share(const std::vector<Part>& parts) override;

  /// Seconds that this process has spent in Share, mostly waiting for others.
  double Waited() const { return this->Waited_; }

private:
  struct Link;

  vtkAlgorithm* Algorithm_;
  /// Null: a team of one.
  std::unique_ptr<Link> Link_;
  SharedProgress* Progress_ = nullptr;
  double Waited_ = 0.0;
};

} // namespace smokevis
