#include "BatchSweeps.h"

#include "LightField.h"
#include "Sampler.h"
#include "Team.h"

#include <cmath>

#include <tbb/parallel_for.h>

namespace smokevis
{

namespace
{

/// Share of what is left of the progress bar that a sweep takes.
constexpr double ProgressRate = 0.02;
/// Lines of a batch that are surveyed, about.
constexpr std::size_t SurveyedLines = 4096;

} // namespace

BatchSweeps::BatchSweeps(const LightField& field, LineSweep& sweep, std::uint64_t key, Team& team,
  tbb::task_arena& arena, Progress& progress, const ProgressSpan& span)
    : Sweep_(sweep), Key_(key), Team_(team), Arena_(arena), Progress_(progress), Span_(span),
      States_(Batches)
{
  // To come by their memory takes as long as a sweep through it.
  this->Arena_.execute(
    [&]
    {
      tbb::parallel_for(std::size_t{0}, this->States_.size(),
        [&](std::size_t batch)
        { this->States_[batch] = BatchState(field.Cells, 2 * field.Patches); });
    });
  if (sweep.Blocks())
  {
    this->Completion_.emplace(*sweep.Blocks(), this->States_);
  }
}

void BatchSweeps::Draw(
  int sweeps, const LineSweep::Choice& choice, std::vector<LineSurvey>* surveys)
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
              Mix(this->Key_ + this->Done_) + batch, choice, this->Progress_,
              surveys ? &(*surveys)[batch] : nullptr);
          });
      });
    this->Progress_.ThrowIfStopped("light field");
    this->LinesABatch_ += choice.Lines.Count();
    ++this->Done_;
    this->Progress_.Report(this->Reached());
  }
  if (this->Completion_)
  {
    this->Arena_.execute(
      [&]
      {
        tbb::parallel_for(std::size_t{0}, this->Team_.OwnCount(this->States_.size()),
          [&](std::size_t i)
          { this->Completion_->CompleteSums(this->States_[this->Team_.OwnItem(i)]); });
      });
  }
  this->ShareSums();
  if (this->Completion_)
  {
    this->Arena_.execute([&] { this->Completion_->CompleteLatest(sweeps, this->States_); });
  }
}

std::size_t BatchSweeps::Aim(const std::vector<float>& weights)
{
  const std::size_t count = this->Sweep_.Lines();
  const std::size_t every = 1 + count / SurveyedLines;
  std::vector<LineSurvey> surveys(Batches, LineSurvey{weights, every, {}});
  this->Draw(1, this->Sweep_.Whole(), &surveys);
  std::vector<Team::Part> parts;
  std::vector<SurveyedLine> lines;
  for (std::size_t batch = 0; batch < surveys.size(); ++batch)
  {
    surveys[batch].Lines.resize((count + every - 1) / every);
    parts.push_back(Team::PartOf(
      this->Team_.OwnerOf(batch), surveys[batch].Lines.data(), surveys[batch].Lines.size()));
  }
  this->Team_.Share(parts);
  for (const LineSurvey& survey : surveys)
  {
    lines.insert(lines.end(), survey.Lines.begin(), survey.Lines.end());
  }
  const std::vector<NoisyBox> boxes = FindNoisyBoxes(lines, this->Sweep_.Outer(), count);
  for (const NoisyBox& box : boxes)
  {
    this->Sweep_.AddLines(box);
  }
  return boxes.size();
}

double BatchSweeps::Reached() const
{
  return this->Span_.To -
         (this->Span_.To - this->Span_.From) * std::exp(-ProgressRate * this->Done_);
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
    for (std::vector<MetLight>* values : {&state.AtSides, &state.AtCells})
    {
      parts.push_back(Team::PartOf(owner, values->data(), values->size()));
    }
  }
  this->Team_.Share(parts);
}

} // namespace smokevis
