#include "LightField.h"

#include "DirectField.h"
#include "DirectSolve.h"
#include "Errors.h"
#include "LineSweep.h"
#include "PlateGather.h"
#include "PowerBalance.h"
#include "Sampler.h"
#include "ScatterBound.h"
#include "Settling.h"
#include "SlowLight.h"
#include "Team.h"
#include "VeilProbes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <tuple>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace smokevis
{

namespace
{

/// Thin sweeps with which the orders of scattering build up, at most, and the share of the
/// tolerance that the light may be of which they know nothing yet.
constexpr int MostThinSweeps = 32;
constexpr double UncountedShare = 0.5;
/// Sweeps that may be drawn in all.
constexpr int MostSweeps = 768;
/// Share of the tolerance that the standard error of the veil is brought down to, and share that
/// the drift from window to window is.
constexpr double ErrorShare = 0.5;
/// Share of the tolerance that light may be of which a bound shows that it is no more.
constexpr double NegligibleShare = 0.25;
constexpr double DriftShare = 0.7;
/// Share of that which noise may hide where next to no light is sent on any more that could drift:
/// the mean over two windows has half the noise of their difference.
constexpr double HiddenShare = 2.0;
/// A window shows of what has yet to settle the share that its sweeps do not send on any more.
/// Where that is less than this, a drift counts for more than is seen of it.
constexpr double ShownShare = 0.3;
/// Of how little of a drift is seen at least: what thick cells send to themselves is sent on, too,
/// but waits for no sweeps.
constexpr double LeastShown = 0.2;
/// Standard errors of the veil that the same drift may be. All batches drift alike, so that error
/// bars, which tell their spread, do not tell it; what is left to drift is a small part of what has
/// been, and over 200 seeds the bars hold with this.
constexpr double DriftErrors = 2.0;
/// Standard errors of the veil that the light may be that has yet to build up, by how much is sent
/// on. All values lack it, also those that are known best.
constexpr double LackingErrors = 0.25;
/// Share of the tolerance below which that error need not be: probes may see next to nothing but
/// direct light.
constexpr double LeastErrorShare = 0.05;
/// Sweeps of a window after which light that still grows is not left to itself.
constexpr int SlowWindow = 8;
/// Shares of the progress bar.
constexpr double DirectShare = 0.4;
constexpr double SettleShare = 0.2;

/// The work that one solve goes through, with what its steps share.
class Solver
{
public:
  Solver(const Scene& scene, const LightFieldOptions& options, Progress& progress)
      : Scene_(scene), Options_(options), Team_(options.Colleagues ? *options.Colleagues : Alone_),
        Progress_(progress),
        Arena_(options.Threads > 0 ? options.Threads : tbb::task_arena::automatic)
  {
  }

  LightField Run();

private:
  void SolveMultiple(int band);
  /// Bound of the share of the direct light along lines of sight that all other light is.
  /// @param toSigns lines of sight to signs, or anywhere where there are none
  double LargestMultipleShare(int band, const VeilProbes& toSigns) const;
  int Settle(LineSweep& sweep, int band, const VeilProbes& probes, std::vector<BatchState>& batches,
    std::uint64_t key);
  /// One sweep of this process's batches.
  /// @param meets whether all processes have the sums of all batches afterwards
  void Sweep(const LineSweep& sweep, std::vector<BatchState>& batches, std::uint64_t key, bool thin,
    bool meets);
  void ShareSums(std::vector<BatchState>& batches);
  /// Lets the next sweep's sources vary inside the cells as the light does that all processes know.
  void Follow(LineSweep& sweep, const std::vector<BatchState>& batches);
  bool BandsEqual(int a, int b) const;
  const DirectField& Inside();
  void CheckStop() const
  {
    if (this->Progress_.ShouldStop())
    {
      throw Error("light field", "the work was stopped");
    }
  }
  void Say(const std::string& what, double count, const std::string& why)
  {
    this->Field_.Report.push_back({what, count, why});
  }

  const Scene& Scene_;
  const LightFieldOptions& Options_;
  Team Alone_;
  Team& Team_;
  Progress& Progress_;
  tbb::task_arena Arena_;
  tbb::enumerable_thread_specific<LineTallies> Tallies_;
  LightField Field_;
  /// Lines of the present band that were traced for each batch.
  std::size_t LinesABatch_ = 0;
  /// Made when a band needs it, once the direct fluence is known.
  std::unique_ptr<DirectField> Inside_;
};

void Solver::Sweep(const LineSweep& sweep, std::vector<BatchState>& batches, std::uint64_t key,
  bool thin, bool meets)
{
  // A batch is worked on by one thread, line after line: the sums do not depend on the threads.
  this->Arena_.execute(
    [&]
    {
      tbb::parallel_for(std::size_t{0}, this->Team_.OwnCount(batches.size()),
        [&](std::size_t i)
        {
          const std::size_t batch = this->Team_.OwnItem(i);
          sweep.Run(
            batches[batch], this->Tallies_.local(), Mix(key) + batch, thin, this->Progress_);
        });
    });
  this->CheckStop();
  this->LinesABatch_ += thin ? sweep.ThinLines() : sweep.Lines();
  if (meets)
  {
    this->ShareSums(batches);
  }
}

void Solver::Follow(LineSweep& sweep, const std::vector<BatchState>& batches)
{
  this->Arena_.execute([&] { sweep.Follow(batches); });
}

void Solver::ShareSums(std::vector<BatchState>& batches)
{
  // 64 bytes for each cell and each side of a patch, which is little against a sweep's work. The
  // latest estimates stay with their owners: nobody else goes on from them.
  std::vector<Team::Part> parts;
  for (std::size_t i = 0; i < batches.size(); ++i)
  {
    BatchState& batch = batches[i];
    const int owner = this->Team_.OwnerOf(i);
    parts.push_back(Team::PartOf(owner, batch.FluenceSum.data(), batch.FluenceSum.size()));
    parts.push_back(Team::PartOf(owner, batch.IlluminanceSum.data(), batch.IlluminanceSum.size()));
    parts.push_back(Team::PartOf(owner, &batch.EscapedSum, 1));
    parts.push_back(Team::PartOf(owner, &batch.Counted, 1));
    parts.push_back(Team::PartOf(owner, &batch.Watched, 1));
  }
  this->Team_.Share(parts);
}

int Solver::Settle(LineSweep& sweep, int band, const VeilProbes& probes,
  std::vector<BatchState>& batches, std::uint64_t key)
{
  const PowerBalance balance(this->Scene_, sweep, band, this->Arena_);
  const auto restart = [&batches]
  { std::for_each(batches.begin(), batches.end(), [](BatchState& batch) { batch.Restart(); }); };
  const double limit = DriftShare * this->Options_.Tolerance;
  int done = 0;
  for (double left = 1.0; done < MostThinSweeps && left > UncountedShare * limit;)
  {
    // The first sweeps differ much: each is balanced by its own loss.
    restart();
    this->Sweep(sweep, batches, key + done, true, true);
    left = std::pow(balance.SentAgain(batches), ++done);
    balance.ScaleLatest(batches);
    this->Follow(sweep, batches);
    this->Progress_.Report(DirectShare + SettleShare * (1.0 - std::exp(-0.02 * done)));
  }
  restart();
  SlowLight slow(this->Scene_, sweep, band);
  std::optional<BlockMeans> earlier;
  // Sweeps before those that the sums hold, and whether they have left so little light that a drift
  // would be over.
  int before = done;
  bool summed = false;
  for (int window = 1;;)
  {
    const int end = done + window;
    while (done < end)
    {
      this->Sweep(sweep, batches, key + done, false, done + 1 == end);
      ++done;
      this->Progress_.Report(DirectShare + SettleShare * (1.0 - std::exp(-0.02 * done)));
    }
    this->Follow(sweep, batches);
    BlockMeans now(batches, this->Scene_, this->Field_, band, this->Arena_);
    const double sent = balance.SentAgain(batches);
    const bool over = std::pow(sent, before) < UncountedShare * limit;
    const double shown = std::clamp((1.0 - std::pow(sent, window)) / ShownShare, LeastShown, 1.0);
    bool tolerable = false;
    bool drifts = true;
    bool grows = false;
    if (earlier)
    {
      const BlockMeans::Drift drift =
        (summed ? now.Since(*earlier) : now).DriftSince(*earlier, this->Options_.Tolerance);
      drifts = drift.LowerBound > 0.0;
      grows = drift.LowerBound > limit && window >= SlowWindow;
      tolerable =
        drift.UpperBound < limit * (over ? 1.0 : shown) ||
        (over && !drifts && drift.Estimate < limit && drift.UpperBound < HiddenShare * limit);
      const double error =
        std::max(probes.RelativeError(batches), LeastErrorShare * this->Options_.Tolerance);
      // Sweeps without end would be needed to tell that noise is no drift: there the share does
      // that the sums lack of what is sent on.
      const double lacking =
        std::pow(sent, before) / std::max(1.0, (1.0 - sent) * batches.front().Counted);
      if (tolerable && (drift.Estimate <= DriftErrors * error ||
                         (drift.IsNoise() && lacking <= LackingErrors * error)))
      {
        return done;
      }
      // Noise may hide a small drift to the end, or feign one; only a drift that stands out of it
      // is refused.
      if (done + 2 * window > MostSweeps)
      {
        if (drift.LowerBound < limit)
        {
          return done;
        }
        throw Error("light field",
          "the light did not settle in " + std::to_string(done) + " sweeps",
          "Give a larger tolerance, or check for an albedo and reflectances so close to 1 that "
          "light is hardly ever lost");
      }
    }
    summed = over && !(earlier && drifts);
    earlier = std::move(now);
    if (summed)
    {
      // What noise hides is told from more sweeps, all of which count.
      window = done - before;
      continue;
    }
    if (slow.Balance(batches))
    {
      // What was seen before does not compare with that.
      earlier.reset();
      slow.Watch(batches, false);
    }
    else
    {
      balance.ScaleLatest(batches);
      if (2 * window >= SlowWindow && (grows || sweep.Watched().empty()))
      {
        slow.Watch(batches, grows);
      }
      window = tolerable ? window : 2 * window;
    }
    restart();
    before = done;
  }
}

const DirectField& Solver::Inside()
{
  if (!this->Inside_)
  {
    this->Arena_.execute(
      [this] { this->Inside_ = std::make_unique<DirectField>(this->Scene_, this->Field_); });
  }
  return *this->Inside_;
}

double Solver::LargestMultipleShare(int band, const VeilProbes& toSigns) const
{
  const auto bound = ScatterBound::Of(this->Scene_, band);
  if (!bound)
  {
    return std::numeric_limits<double>::infinity();
  }
  const auto fluence = [&bound](std::int64_t cell) { return bound->Fluence(cell); };
  const double share = toSigns.LargestShare(fluence, bound->Illuminance());
  if (this->Scene_.Lights().Signs().empty())
  {
    return share;
  }
  // Views may look elsewhere than to signs, into places where no sign is seen from.
  const VeilProbes anywhere(
    this->Scene_, this->Field_, band, this->Options_.Seed, VeilProbes::Lines::Anywhere);
  return std::max(share, anywhere.LargestShare(fluence, bound->Illuminance()));
}

void Solver::SolveMultiple(int band)
{
  const Medium& smoke = this->Scene_.Smoke();
  const EmitterSet& lights = this->Scene_.Lights();
  const bool scatters = this->Scene_.Albedo() > 0.0 && smoke.MaximumExtinction() > 0.0F &&
                        this->Scene_.ExtinctionScale(band) > 0.0;
  bool reflects = false;
  for (std::size_t patch = 0; patch < this->Field_.Patches && !reflects; ++patch)
  {
    reflects = this->Scene_.PatchReflectance(patch)[band] > 0.0;
  }
  bool carried = this->Scene_.Sky() > 0.0;
  for (std::size_t cell = 0; cell < lights.Cells().size() && !carried; ++cell)
  {
    carried = lights.LeftToLines(cell);
  }
  const std::string name = "band " + std::to_string(band) + ": ";
  if (!scatters && !reflects && !carried && !smoke.Emits())
  {
    this->Say(name + "multiple scattering skipped", static_cast<double>(this->Field_.Cells),
      "albedo or extinction is 0 and no surface reflects");
    return;
  }
  const VeilProbes probes(this->Scene_, this->Field_, band, this->Options_.Seed);
  if (this->Options_.Skips)
  {
    const double share = this->LargestMultipleShare(band, probes);
    if (share <= NegligibleShare * this->Options_.Tolerance)
    {
      this->Say(name + "multiple scattering skipped", static_cast<double>(this->Field_.Cells),
        "a bound shows that it adds at most " + std::to_string(100.0 * share) +
          " % to the direct light along lines of sight");
      return;
    }
  }
  const DirectField& inside = this->Inside();
  std::optional<LineSweep> made;
  this->Arena_.execute(
    [&]
    {
      made.emplace(
        this->Scene_, this->Field_, inside, band, this->Options_.Tolerance, this->Progress_);
    });
  this->CheckStop();
  LineSweep& sweep = *made;
  if (!(sweep.FirstSource() > 0.0))
  {
    this->Say(name + "multiple scattering skipped", static_cast<double>(this->Field_.Cells),
      "no light reaches anything that could send it on");
    return;
  }
  std::vector<BatchState> batches(
    Batches, BatchState(this->Field_.Cells, 2 * this->Field_.Patches));
  const std::uint64_t key = Mix(this->Options_.Seed) + 0x100000ULL * (band + 1);
  this->LinesABatch_ = 0;
  int done = this->Settle(sweep, band, probes, batches, key);
  sweep.Watch({});
  const int settling = done - batches.front().Counted;
  double error = probes.RelativeError(batches);
  while (error > ErrorShare * this->Options_.Tolerance && done < MostSweeps)
  {
    // The error falls with the root of the sweeps: as many as seem to be missing, at most twice as
    // many again.
    const double share = error / (ErrorShare * this->Options_.Tolerance);
    const int counted = batches.front().Counted;
    const int wanted = static_cast<int>(std::ceil(counted * std::min(2.0, share * share)));
    const int until = std::min(MostSweeps, done + std::max(1, wanted - counted));
    for (; done < until; ++done)
    {
      this->Sweep(sweep, batches, key + done, false, done + 1 == until);
      this->Progress_.Report(
        DirectShare + SettleShare +
        (0.95 - DirectShare - SettleShare) * (1.0 - std::exp(-0.02 * (done - settling))));
    }
    error = probes.RelativeError(batches);
  }
  PowerBalance(this->Scene_, sweep, band, this->Arena_).ScaleSums(batches);
  error = probes.RelativeError(batches);
  const int counted = batches.front().Counted;
  const auto keep = [&](std::vector<float> BatchState::*sums, std::size_t count, Lanes* lanes)
  {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 1024),
      [&](const tbb::blocked_range<std::size_t>& range)
      {
        for (int batch = 0; batch < Batches; ++batch)
        {
          const float* const sum = (batches[batch].*sums).data();
          for (std::size_t i = range.begin(); i < range.end(); ++i)
          {
            lanes[i][batch] = sum[i] / static_cast<float>(counted);
          }
        }
      });
  };
  this->Arena_.execute(
    [&]
    {
      keep(&BatchState::FluenceSum, this->Field_.Cells,
        this->Field_.MultipleFluence.data() + this->Field_.CellIndex(band, 0));
      keep(&BatchState::IlluminanceSum, 2 * this->Field_.Patches,
        this->Field_.MultipleIlluminance.data() + this->Field_.PatchIndex(band, 0, 0));
    });
  std::size_t plates = 0;
  std::size_t rays = 0;
  this->Arena_.execute(
    [&]
    {
      std::tie(plates, rays) =
        PlateGather(this->Scene_, this->Options_, this->Inside(), sweep.Shape(), this->Field_, band)
          .Run(this->Team_, this->Progress_);
    });
  this->Say(name + "settling sweeps", settling,
    "orders of scattering had to build up, first with fewer lines");
  this->Say(name + "counted sweeps", counted,
    "until the standard error of the veil along lines of sight met the tolerance");
  this->Say(name + "lines a sweep and batch", static_cast<double>(sweep.Lines()),
    "each cell is crossed about 1.5 times, less often above a tolerance of 0.03");
  this->Say(name + "lines of a batch in all", static_cast<double>(this->LinesABatch_),
    "of whole sweeps and of thin ones");
  for (int rank = 0; rank < this->Team_.Size() && this->Team_.Size() > 1; ++rank)
  {
    const std::size_t own = this->Team_.OwnCount(batches.size(), rank);
    this->Say(name + "lines of process " + std::to_string(rank),
      static_cast<double>(this->LinesABatch_ * own),
      "it sweeps " + std::to_string(own) + " of " + std::to_string(Batches) + " batches");
  }
  if (const std::size_t thick = sweep.Thick().Count(); thick > 0)
  {
    this->Say(name + "thick cells", static_cast<double>(thick),
      "what they scatter to themselves is summed up, not swept");
  }
  if (plates > 0)
  {
    this->Say(name + "rays gathered by signs", static_cast<double>(rays),
      std::to_string(plates) + " plates reflect light that lines would rarely bring");
  }
  this->Say(name + "relative standard error of the veil", error,
    error <= ErrorShare * this->Options_.Tolerance ? "tolerance met" : "most sweeps reached");
}

bool Solver::BandsEqual(int a, int b) const
{
  if (this->Scene_.ExtinctionScale(a) != this->Scene_.ExtinctionScale(b))
  {
    return false;
  }
  for (std::size_t patch = 0; patch < this->Field_.Patches; ++patch)
  {
    const Spectrum& reflectance = this->Scene_.PatchReflectance(patch);
    if (reflectance[a] != reflectance[b])
    {
      return false;
    }
  }
  const auto& cells = this->Scene_.Lights().Cells();
  return std::all_of(cells.begin(), cells.end(),
    [a, b](const EmitterCell& cell) { return cell.Luminance[a] == cell.Luminance[b]; });
}

LightField Solver::Run()
{
  this->Field_.Bands = this->Scene_.Bands();
  this->Field_.Cells = this->Scene_.Smoke().Cells();
  this->Field_.Patches = this->Scene_.Patches();
  const std::size_t bands = this->Field_.Bands;
  this->Field_.DirectFluence.assign(bands * this->Field_.Cells, 0.0F);
  this->Field_.MultipleFluence.assign(bands * this->Field_.Cells, Lanes());
  this->Field_.DirectIlluminance.assign(bands * this->Field_.Patches * 2, 0.0F);
  this->Field_.MultipleIlluminance.assign(bands * this->Field_.Patches * 2, Lanes());
  const std::vector<EmitterCell>& cells = this->Scene_.Lights().Cells();
  const bool shines =
    this->Scene_.Sky() > 0.0 ||
    std::any_of(cells.begin(), cells.end(),
      [this](const EmitterCell& cell)
      {
        return std::any_of(cell.Luminance.begin(), cell.Luminance.begin() + this->Field_.Bands,
          [](double luminance) { return luminance > 0.0; });
      });
  if (!shines && !this->Scene_.Smoke().Emits())
  {
    throw Error("light field", "nothing emits light", "Add a sign, a lamp, a flame or the sky");
  }
  if (!(this->Options_.Tolerance > 0.0))
  {
    throw Error("light field", "the tolerance is not positive", "Give for example 0.01");
  }
  this->Arena_.execute([this] { this->Scene_.Near(); });
  DirectSolve direct(this->Scene_, this->Options_, this->Team_, this->Progress_, this->Arena_,
    DirectShare, this->Field_);
  direct.Cells();
  direct.Patches();
  this->Field_.Report.push_back(LeaptAir(this->Scene_.Smoke()));
  for (int band = 0; band < this->Field_.Bands; ++band)
  {
    int same = 0;
    while (same < band && !(this->Options_.Skips && this->BandsEqual(same, band)))
    {
      ++same;
    }
    if (same == band)
    {
      this->SolveMultiple(band);
      continue;
    }
    std::copy_n(this->Field_.MultipleFluence.begin() + this->Field_.CellIndex(same, 0),
      this->Field_.Cells, this->Field_.MultipleFluence.begin() + this->Field_.CellIndex(band, 0));
    std::copy_n(this->Field_.MultipleIlluminance.begin() + this->Field_.PatchIndex(same, 0, 0),
      2 * this->Field_.Patches,
      this->Field_.MultipleIlluminance.begin() + this->Field_.PatchIndex(band, 0, 0));
    this->Say("band " + std::to_string(band) + " skipped", 1.0,
      "it is equal to band " + std::to_string(same));
  }
  this->Progress_.Report(1.0);
  return std::move(this->Field_);
}

} // namespace

WorkItem LeaptAir(const Medium& smoke)
{
  const std::int64_t cells = smoke.LeaptCells();
  return {"clear smoke cells leapt over by rays", static_cast<double>(cells),
    cells > 0
      ? "they lie outside the box around a grid's smoke or in bricks of 8 x 8 x 8 without any"
      : "no grid has many that lie outside the box around its smoke or in bricks without any"};
}

LightField SolveLightField(const Scene& scene, const LightFieldOptions& options, Progress& progress)
{
  return Solver(scene, options, progress).Run();
}

} // namespace smokevis
