#include "MultipleSolve.h"

#include "BatchSweeps.h"
#include "CellLoops.h"
#include "DirectField.h"
#include "Errors.h"
#include "LineSweep.h"
#include "PlateGather.h"
#include "PowerBalance.h"
#include "Sampler.h"
#include "ScatterBound.h"
#include "Settling.h"
#include "Team.h"
#include "VeilProbes.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <tuple>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace smokevis
{

namespace
{

/// Share of the tolerance that the standard error of the veil is brought down to.
constexpr double ErrorShare = 0.5;
/// Lines of all batches still to be traced from which on it pays to look for where they should go.
constexpr double ManyLines = 2e6;
/// Standard error of the light as a whole over itself above which nothing is known.
constexpr double LargestError = 10.0;
/// Share of the tolerance that light may be of which a bound shows that it is no more.
constexpr double NegligibleShare = 0.25;
/// Share of a band's part of the progress bar that its sweeps take.
constexpr double SweepShare = 0.9;
/// Optical depth of scattering on the mean chord of a cell above which sources in it vary by more
/// than what is linear.
constexpr double CoarseDepth = 1.0;
/// Standard errors that noise may bring light below zero by.
constexpr double NoiseDeviations = 3.0;

/// Raises what is not direct of some light, where all of it is below zero by more than noise, to
/// where all of it is zero: the batches' spread stays. Returns whether that was done.
bool RaiseToDark(float direct, Lanes& lanes)
{
  const double light = direct + Mean(lanes);
  if (!(light < 0.0 && light < -NoiseDeviations * StandardError(lanes)))
  {
    return false;
  }
  for (float& value : lanes.Value)
  {
    value -= static_cast<float>(light);
  }
  return true;
}

std::size_t CoarseCells(const Scene& scene, int band)
{
  const Medium& smoke = scene.Smoke();
  return CountCells(smoke.Cells(),
    [&](std::int64_t cell)
    {
      const double depth =
        smoke.Extinction(cell) * scene.ExtinctionScale(band) * smoke.MeanChord(cell);
      return scene.Albedo() * depth > CoarseDepth && smoke.OwnVolume(cell) > 0.0;
    });
}

} // namespace

MultipleSolve::MultipleSolve(const Scene& scene, const LightFieldOptions& options, Team& team,
  Progress& progress, tbb::task_arena& arena, double from, LightField& field)
    : Scene_(scene), Options_(options), Team_(team), Progress_(progress), Arena_(arena),
      From_(from), Field_(field)
{
}

MultipleSolve::~MultipleSolve() = default;

std::string MultipleSolve::WhyNone(int band) const
{
  const EmitterSet& lights = this->Scene_.Lights();
  bool sent =
    this->Scene_.Sky() > 0.0 || this->Scene_.Smoke().Emits() || this->Scene_.SendsOn(band);
  for (std::size_t cell = 0; cell < lights.Cells().size() && !sent; ++cell)
  {
    sent = lights.LeftToLines(cell);
  }
  return sent ? "" : "albedo or extinction is 0 and no surface reflects";
}

double MultipleSolve::LargestShare(int band, const VeilProbes& toSigns) const
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

std::size_t MultipleSolve::Aim(
  const std::string& name, BatchSweeps& sweeps, const VeilProbes& probes)
{
  const std::size_t before = sweeps.Sweep().Lines();
  const std::size_t boxes = sweeps.Aim(probes.Weights(sweeps.States()));
  if (boxes > 0)
  {
    this->Say(name + "boxes that more lines lead through", static_cast<double>(boxes),
      "they bring most of the noise: " + std::to_string(sweeps.Sweep().Lines() - before) +
        " lines more a sweep and batch; sweeps before are left out");
  }
  return boxes;
}

void MultipleSolve::Refine(const std::string& name, BatchSweeps& sweeps, const VeilProbes& probes)
{
  const double wanted = ErrorShare * this->Options_.Tolerance;
  bool aimed = sweeps.Sweep().HasMoreLines();
  for (double error = probes.RelativeError(sweeps.States());
       error > wanted && sweeps.Done() < Settling::MostSweeps;
       error = probes.RelativeError(sweeps.States()))
  {
    // The error falls with the root of the sweeps: as many as seem to be missing, at most as many
    // again.
    const double share = error / wanted;
    const int counted = sweeps.Counted();
    const double missing = counted * (share * share - 1.0);
    double next = std::min<double>(missing, counted);
    const double lines = static_cast<double>(Batches * sweeps.Sweep().Lines());
    // As many sweeps as before must be left beside the one that tells where lines should go.
    const bool fits = sweeps.Done() + 1 + counted <= Settling::MostSweeps;
    if (!aimed && fits && missing > counted && missing * lines > ManyLines)
    {
      aimed = true;
      if (this->Aim(name, sweeps, probes) == 0)
      {
        continue;
      }
      // Sweeps before are noisier, and would count as much.
      sweeps.Restart();
      next = counted;
    }
    sweeps.Draw(
      std::clamp(static_cast<int>(std::ceil(next)), 1, Settling::MostSweeps - sweeps.Done()));
    // What few sweeps told of the shape of sources is alike in all batches: no error bar knows it.
    sweeps.Follow();
  }
}

void MultipleSolve::Keep(int band, const std::string& name, const BatchSweeps& sweeps)
{
  std::atomic<std::size_t> raised{0};
  const std::vector<BatchState>& states = sweeps.States();
  const auto counted = static_cast<float>(sweeps.Counted());
  const auto keep = [&](std::vector<float> BatchState::*sums, const std::vector<float>& direct,
                      std::size_t first, std::size_t count, std::vector<Lanes>& kept)
  {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 1024),
      [&](const tbb::blocked_range<std::size_t>& range)
      {
        for (int batch = 0; batch < Batches; ++batch)
        {
          const float* const sum = (states[batch].*sums).data();
          for (std::size_t i = range.begin(); i < range.end(); ++i)
          {
            kept[first + i][batch] = sum[i] / counted;
          }
        }
        for (std::size_t i = first + range.begin(); i < first + range.end(); ++i)
        {
          raised += RaiseToDark(direct[i], kept[i]) ? 1 : 0;
        }
      });
  };
  this->Arena_.execute(
    [&]
    {
      keep(&BatchState::FluenceSum, this->Field_.DirectFluence, this->Field_.CellIndex(band, 0),
        this->Field_.Cells, this->Field_.MultipleFluence);
      keep(&BatchState::IlluminanceSum, this->Field_.DirectIlluminance,
        this->Field_.PatchIndex(band, 0, 0), 2 * this->Field_.Patches,
        this->Field_.MultipleIlluminance);
    });
  if (raised > 0)
  {
    this->Say(name + "cells and sides of patches that are dark", static_cast<double>(raised),
      "diffusion took away more light than there was, by more than noise");
  }
}

void MultipleSolve::Gather(
  int band, const std::string& name, const PowerBalance& balance, const BatchSweeps& sweeps)
{
  const DoubleLanes before = balance.TakenBySurfaces(this->Field_, band);
  std::size_t plates = 0;
  this->Arena_.execute(
    [&]
    {
      std::size_t rays = 0;
      std::tie(plates, rays) =
        PlateGather(this->Scene_, this->Options_, *this->Inside_, this->Field_, band)
          .Run(this->Team_, this->Progress_);
      if (plates > 0)
      {
        this->Say(name + "rays gathered by signs", static_cast<double>(rays),
          std::to_string(plates) + " plates reflect light that lines would rarely bring");
      }
    });
  if (plates == 0)
  {
    return;
  }
  // What plates take up beyond what lines brought them does not go elsewhere, as it does along
  // lines.
  DoubleLanes more = balance.TakenBySurfaces(this->Field_, band);
  std::transform(more.begin(), more.end(), before.begin(), more.begin(), std::minus<>());
  balance.Restore(balance.Of(sweeps.States()), more, this->Field_, band);
}

void MultipleSolve::Tell(
  const std::string& name, const BatchSweeps& sweeps, int settling, double error)
{
  const auto lines = static_cast<double>(sweeps.LinesABatch());
  this->Say(name + "settling sweeps", settling,
    "orders of scattering had to build up, first with fewer lines");
  this->Say(name + "counted sweeps", sweeps.Counted(),
    "until the standard error of the veil along lines of sight met the tolerance");
  this->Say(name + "lines of a batch in all", lines, "of whole sweeps and of thin ones");
  for (int rank = 0; rank < this->Team_.Size() && this->Team_.Size() > 1; ++rank)
  {
    const std::size_t own = this->Team_.OwnCount(Batches, rank);
    this->Say(name + "lines of process " + std::to_string(rank), lines * static_cast<double>(own),
      "it sweeps " + std::to_string(own) + " of " + std::to_string(Batches) + " batches");
  }
  this->Say(name + "relative standard error of the veil", error,
    error <= ErrorShare * this->Options_.Tolerance ? "tolerance met" : "most sweeps reached");
}

void MultipleSolve::Band(int band)
{
  const std::string name = "band " + std::to_string(band) + ": ";
  const auto skip = [&](const std::string& why) {
    this->Say(name + "multiple scattering skipped", static_cast<double>(this->Field_.Cells), why);
  };
  if (const std::string why = this->WhyNone(band); !why.empty())
  {
    skip(why);
    return;
  }
  const VeilProbes probes(this->Scene_, this->Field_, band, this->Options_.Seed);
  if (this->Options_.Skips)
  {
    const double share = this->LargestShare(band, probes);
    if (share <= NegligibleShare * this->Options_.Tolerance)
    {
      skip("a bound shows that it adds at most " + std::to_string(100.0 * share) +
           " % to the direct light along lines of sight");
      return;
    }
  }
  std::optional<LineSweep> sweep;
  this->Arena_.execute(
    [&]
    {
      if (!this->Inside_)
      {
        this->Inside_ = std::make_unique<DirectField>(this->Scene_, this->Field_);
      }
      sweep.emplace(this->Scene_, this->Field_, *this->Inside_, band, this->Options_.Tolerance,
        this->Progress_);
    });
  this->Progress_.ThrowIfStopped("light field");
  const PowerBalance balance(this->Scene_, this->Field_, band, sweep->Outer(), this->Arena_);
  if (!std::isfinite(balance.Source()))
  {
    throw Error("light field", "the direct light is not a finite number",
      "Check the luminances, and the smoke's emission: their sums must be finite");
  }
  if (!(balance.Source() > 0.0))
  {
    skip("no light reaches anything that could send it on");
    return;
  }
  const double part = (1.0 - this->From_) / this->Field_.Bands;
  const double begin = this->From_ + part * band;
  const double end = begin + SweepShare * part;
  std::optional<BatchSweeps> drawn;
  int settling = 0;
  bool settled = false;
  const auto solve = [&](double from)
  {
    drawn.emplace(this->Field_, *sweep, Mix(this->Options_.Seed) + 0x100000ULL * (band + 1),
      this->Team_, this->Arena_, this->Progress_, BatchSweeps::ProgressSpan{from, end});
    settled = Settling(this->Scene_, this->Field_, band, this->Options_.Tolerance, balance, probes,
      this->Arena_, *drawn)
                .Run();
    settling = drawn->Done() - drawn->Counted();
    if (!drawn->Diverges())
    {
      this->Refine(name, *drawn, probes);
    }
  };
  solve(begin);
  if (sweep->Blocks() &&
      (drawn->Diverges() || !balance.RoughlyBalanced(balance.Of(drawn->States()))))
  {
    this->Say(name + "sweeps given up", drawn->Done(),
      "diffusion does not complete this light: sweeps alone build it up");
    sweep->LeaveOutBlocks();
    solve(drawn->Reached());
  }
  BatchSweeps& sweeps = *drawn;
  if (!(probes.WholeError(sweeps.States()) <= LargestError))
  {
    throw Error("light field",
      "scattered light is not known: its standard error is many times itself",
      "Give a larger tolerance, or smoke cells that are about as long as wide and high");
  }
  const std::vector<PowerBalance::Powers> powers = balance.Of(sweeps.States());
  balance.ExpectLoss(powers);
  if (sweep->Blocks())
  {
    balance.ScaleCompleted(powers, sweeps.States());
  }
  else
  {
    balance.ScaleSums(powers, sweeps.States());
  }
  this->Keep(band, name, sweeps);
  this->Gather(band, name, balance, sweeps);
  this->Tell(name, sweeps, settling, probes.RelativeError(sweeps.States()));
  if (!settled)
  {
    this->Say(name + "light not known to have settled", 1.0,
      "after most sweeps noise still hides whether it drifts by more than the tolerance");
  }
  this->Say(name + "lines a sweep and batch", static_cast<double>(sweep->Lines()),
    "cells of a mesh's mean size are crossed about 1.5 times or more, less often above a tolerance "
    "of 0.03");
  if (sweep->Blocks())
  {
    this->Say(name + "blocks of diffusion", static_cast<double>(sweep->Blocks()->Count()),
      "light is scattered so often that sweeps alone would take long to build it up");
  }
  if (const std::size_t thick = sweep->Thick().Count(); thick > 0)
  {
    this->Say(name + "thick cells", static_cast<double>(thick),
      "what they scatter to themselves is summed up, not swept");
  }
  const std::size_t coarse = this->Arena_.execute([&] { return CoarseCells(this->Scene_, band); });
  this->Field_.CoarseCells = std::max(this->Field_.CoarseCells, coarse);
  if (coarse > 0)
  {
    this->Say(name + "coarse cells", static_cast<double>(coarse),
      "light is scattered more than once on a mean way through them: finer ones would tell more "
      "exactly how it varies there");
  }
}

} // namespace smokevis
