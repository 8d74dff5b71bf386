// The batches of one band, swept side by side.
#pragma once

#include "BatchState.h"
#include "Completion.h"
#include "LineSweep.h"
#include "Progress.h"

#include <cstdint>
#include <optional>
#include <vector>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/task_arena.h>

namespace smokevis
{

class Team;
struct LightField;

/// Draws sweeps for all batches, this process those of its own. Each batch has random numbers of
/// its own, so that their spread tells the error of their mean.
class BatchSweeps
{
public:
  /// Shares of the progress bar where the sweeps begin and where they end, however many they are.
  struct ProgressSpan
  {
    double From = 0.0, To = 1.0;
  };

  /// @param sweep that all batches go through
  /// @param key of the random numbers
  BatchSweeps(const LightField& field, LineSweep& sweep, std::uint64_t key, Team& team,
    tbb::task_arena& arena, Progress& progress, const ProgressSpan& span);

  /// Draws so many whole sweeps more, after which all processes have the sums of all batches.
  /// Throws Error when the work is stopped.
  void Draw(int sweeps) { this->Draw(sweeps, this->Sweep_.Whole(), nullptr); }
  /// Draws one more that a share of the lines is enough for.
  /// @return what share it had
  double DrawThin(double share)
  {
    const LineSweep::Choice choice = this->Sweep_.Thin(share);
    this->Draw(1, choice, nullptr);
    return choice.Share;
  }
  /// Draws a whole sweep, of which further ones learn: they get more lines through boxes where
  /// lines bring most of the noise.
  /// @param weights as in LineSurvey
  /// @return how many boxes
  std::size_t Aim(const std::vector<float>& weights);
  /// Forgets the sums, not the latest estimates.
  void Restart();
  /// Lets the sources of the next sweeps vary inside the cells as the light does that the sums
  /// hold.
  void Follow();

  std::vector<BatchState>& States() { return this->States_; }
  const std::vector<BatchState>& States() const { return this->States_; }
  LineSweep& Sweep() { return this->Sweep_; }
  /// Sweeps drawn in all, and those that the sums hold.
  int Done() const { return this->Done_; }
  int Counted() const { return this->States_.front().Counted; }
  /// Where they have brought the progress bar.
  double Reached() const;
  /// What completes them where smoke scatters often; else none.
  const std::optional<Completion>& Diffusion() const { return this->Completion_; }
  /// Whether that leads nowhere.
  bool Diverges() const { return this->Completion_ && this->Completion_->Diverges(); }
  /// Lines that were traced for each batch.
  std::size_t LinesABatch() const { return this->LinesABatch_; }

private:
  /// @param surveys one a batch, or none
  void Draw(int sweeps, const LineSweep::Choice& choice, std::vector<LineSurvey>* surveys);
  void ShareSums();

  LineSweep& Sweep_;
  std::uint64_t Key_;
  Team& Team_;
  tbb::task_arena& Arena_;
  Progress& Progress_;
  ProgressSpan Span_;
  std::vector<BatchState> States_;
  std::optional<Completion> Completion_;
  tbb::enumerable_thread_specific<LineTallies> Tallies_;
  int Done_ = 0;
  std::size_t LinesABatch_ = 0;
};

} // namespace smokevis
