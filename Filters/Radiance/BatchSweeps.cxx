#include "BatchSweeps.h"

#include "LightField.h"
#include "Sampler.h"
#include "Team.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

namespace smokevis
{

namespace
{

/// Share of what is left of the progress bar that a sweep takes.
constexpr double ProgressRate = 0.02;
/// Share of what is completed that may still be lacking then.
constexpr double LackingShare = 0.3;
/// Share of what was completed that may come back before the next is completed by half as much.
constexpr double MostReturned = 0.5;

} // namespace

BatchSweeps::BatchSweeps(const LightField& field, LineSweep& sweep, std::uint64_t key, Team& team,
  tbb::task_arena& arena, Progress& progress, const ProgressSpan& span)
    : Sweep_(sweep), Key_(key), Team_(team), Arena_(arena), Progress_(progress), Span_(span),
      States_(Batches, BatchState(field.Cells, 2 * field.Patches))
{
  if (const DiffusionBlocks* const blocks = sweep.Blocks())
  {
    for (BatchState& state : this->States_)
    {
      state.Residual.assign(blocks->Count(), 0.0);
      state.Lacking = state.Residual;
    }
  }
}

void BatchSweeps::Draw(int sweeps, bool thin)
{
  for (const int end = this->Done_ + sweeps; this->Done_ < end;)
  {
    // A batch is worked on by one thread, line after line: the sums do not depend on the threads.
    this->Arena_.execute(
      [&]
      {
        tbb::parallel_for(std::size_t{0}, this->Team_.OwnCount(this->States_.size()),
          [&](std::size_t i)
          {
            const std::size_t batch = this->Team_.OwnItem(i);
            this->Sweep_.Run(this->States_[batch], this->Tallies_.local(),
              Mix(this->Key_ + this->Done_) + batch, thin, this->Progress_);
          });
      });
    this->Progress_.ThrowIfStopped("light field");
    this->LinesABatch_ += thin ? this->Sweep_.ThinLines() : this->Sweep_.Lines();
    ++this->Done_;
    this->Progress_.Report(
      this->Span_.To - (this->Span_.To - this->Span_.From) * std::exp(-ProgressRate * this->Done_));
  }
  const DiffusionBlocks* const blocks = this->Sweep_.Blocks();
  if (blocks != nullptr)
  {
    this->Arena_.execute(
      [&]
      {
        tbb::parallel_for(std::size_t{0}, this->Team_.OwnCount(this->States_.size()),
          [&](std::size_t i)
          { blocks->CompleteSums(this->Step_, this->States_[this->Team_.OwnItem(i)]); });
      });
  }
  this->ShareSums();
  if (blocks != nullptr)
  {
    this->Lacking_ += sweeps;
    this->Arena_.execute([&] { this->CompleteLatest(*blocks); });
  }
}

void BatchSweeps::CompleteLatest(const DiffusionBlocks& blocks)
{
  DiffusionBlocks::Lack lack = blocks.LackOf(this->Lacking_, this->States_);
  this->MayLack_ = std::max(lack.Error, lack.IsClear() ? LackingShare * lack.Size : 0.0);
  if (!lack.IsClear())
  {
    return;
  }
  double forth = 0.0;
  double before = 0.0;
  for (std::size_t block = 0; block < this->Completed_.size(); ++block)
  {
    forth += lack.Fluence[block] * this->Completed_[block];
    before += this->Completed_[block] * this->Completed_[block];
  }
  // What comes back with the other sign was completed by too much.
  if (forth < -MostReturned * before)
  {
    this->Step_ *= 0.5;
    for (double& fluence : lack.Fluence)
    {
      fluence *= 0.5;
    }
  }
  blocks.Complete(lack, this->States_);
  this->Completed_ = lack.Fluence;
  this->Lacking_ = 0;
}

void BatchSweeps::Restart()
{
  for (BatchState& state : this->States_)
  {
    state.Restart();
  }
}

void BatchSweeps::Follow()
{
  this->Arena_.execute([this] { this->Sweep_.Follow(this->States_); });
}

void BatchSweeps::ShareSums()
{
  // 64 bytes for each cell and each side of a patch, which is little against a sweep's work. The
  // latest estimates stay with their owners: nobody else goes on from them.
  std::vector<Team::Part> parts;
  for (std::size_t i = 0; i < this->States_.size(); ++i)
  {
    BatchState& state = this->States_[i];
    const int owner = this->Team_.OwnerOf(i);
    parts.push_back(Team::PartOf(owner, state.FluenceSum.data(), state.FluenceSum.size()));
    parts.push_back(Team::PartOf(owner, state.IlluminanceSum.data(), state.IlluminanceSum.size()));
    parts.push_back(Team::PartOf(owner, state.Lacking.data(), state.Lacking.size()));
    parts.push_back(Team::PartOf(owner, &state.EscapedSum, 1));
    parts.push_back(Team::PartOf(owner, &state.Counted, 1));
    parts.push_back(Team::PartOf(owner, &state.Watched, 1));
  }
  this->Team_.Share(parts);
}

} // namespace smokevis
