#include "Settling.h"

#include "BatchSweeps.h"
#include "Errors.h"
#include "Persistence.h"
#include "Scene.h"
#include "SlowLight.h"
#include "VeilProbes.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace smokevis
{

namespace
{

/// Thin sweeps with which the orders of scattering build up, at most, and the share of the
/// tolerance that the light may be of which they know nothing yet.
constexpr int MostThinSweeps = 32;
constexpr double UncountedShare = 0.5;
/// Share of a whole sweep's lines that a thin one has at most, if these are enough.
constexpr double ThinShare = 0.25;
/// Shares of the mean illuminance below which a side is dark, so that it does not matter how long
/// light would last there: of all, and of what comes straight from a light in the same room.
constexpr double LeastLight = 1e-3;
constexpr double LeastDirect = 1e-5;
/// What is lost of the light where it lasts longest over what is lost of all, below which it is not
/// balanced with the rest.
constexpr double ShorterShare = 0.5;
/// What places lose that were balanced by themselves, over what is lost where light lasts longest,
/// below which they are those.
constexpr double SlowestLoss = 3.0;
/// Light that was sent on so often is taken to lie evenly all over the scene.
constexpr double EvenOrders = 4.0;
/// Share of the tolerance that the drift from window to window may be.
constexpr double DriftShare = 0.7;
/// Share of that which noise may hide where next to no light is sent on any more that could drift:
/// the mean over two windows has half the noise of their difference.
constexpr double HiddenShare = 2.0;
/// Standard errors that a drift must be above 0 to be taken for one: window after window is asked,
/// so that one would be too few; and above its limit, where it should be over, to be taken for a
/// light that never settles.
constexpr double Deviations = 2.5;
constexpr double CertainDeviations = 5.0;
/// A window shows of what has yet to settle the share that its sweeps do not send on any more, or
/// this at least: what thick cells send to themselves is sent on, too, but waits for no sweeps.
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
/// Sweeps after which what is completed is taken as it is.
constexpr int CompletedSweeps = 512;
/// Sweeps of a window after which light that still grows is not left to itself.
constexpr int SlowWindow = 8;

} // namespace

Settling::Settling(const Scene& scene, const LightField& field, int band, double tolerance,
  const PowerBalance& balance, const VeilProbes& probes, tbb::task_arena& arena,
  BatchSweeps& sweeps)
    : Scene_(scene), Field_(field), Band_(band), Tolerance_(tolerance),
      Limit_(DriftShare * tolerance), Uncounted_(UncountedShare * Limit_), Balance_(balance),
      LargestSent_(LargestSent()), Probes_(probes), Arena_(arena), Sweeps_(sweeps)
{
}

double Settling::LargestSent() const
{
  double largest = this->Scene_.Smoke().Empty() ? 0.0 : this->Scene_.Albedo();
  for (std::size_t patch = 0; patch < this->Field_.Patches; ++patch)
  {
    largest = std::max(largest, this->Scene_.PatchReflectance(patch)[this->Band_]);
  }
  return largest;
}

double Settling::Kept(double sent) const
{
  return this->Sweeps_.Diffusion() ? std::max(this->Sweeps_.Diffusion()->Left(), sent)
                                   : 1.0 - this->Sweeps_.Sweep().MeanStep() * (1.0 - sent);
}

double Settling::SentOf(const std::vector<PowerBalance::Powers>& powers) const
{
  return this->Balance_.SentAgain(powers, this->Sweeps_.Diffusion()
                                            ? &PowerBalance::Powers::Reflected
                                            : &PowerBalance::Powers::SentAgain);
}

double Settling::Lacking(double sent, int sweeps) const
{
  const double even = std::pow(sent, EvenOrders);
  return std::pow(this->Kept(sent), sweeps) * (1.0 + even * (1.0 / this->Darkest_ - 1.0));
}

double Settling::LackingWhereItLasts(int sweeps) const
{
  return this->Lasting_ > 0.0 ? std::pow(this->Kept(this->Lasting_), sweeps) : 0.0;
}

void Settling::FindPersistence(double share)
{
  const std::vector<BatchState>& states = this->Sweeps_.States();
  const float* const direct =
    this->Field_.DirectIlluminance.data() + this->Field_.PatchIndex(this->Band_, 0, 0);
  const LineSweep& sweep = this->Sweeps_.Sweep();
  std::vector<double> scattered(2 * this->Field_.Patches);
  double power = 0.0;
  double area = 0.0;
  for (std::size_t side = 0; side < scattered.size(); ++side)
  {
    const Lanes own = MeansOf(states, &BatchState::IlluminanceSum, side);
    // A line that slips in where two boxes meet lights nothing to speak of: of the batches whose
    // lines met a side, half have to find light there.
    const auto found = std::count_if(
      std::begin(own.Value), std::end(own.Value), [](float value) { return value > 0.0F; });
    const double met = Batches * -std::expm1(-share * sweep.SideHits(side));
    scattered[side] = found > 1 && static_cast<double>(found) > 0.5 * met ? Mean(own) : 0.0;
    const double exposed = this->Scene_.ExposedArea(side / 2, side % 2);
    power += exposed * (direct[side] + scattered[side]);
    area += exposed;
  }
  std::vector<bool> lit(scattered.size());
  for (std::size_t side = 0; side < lit.size(); ++side)
  {
    lit[side] = direct[side] * area > LeastDirect * power ||
                (direct[side] + scattered[side]) * area > LeastLight * power;
  }
  this->Arena_.execute(
    [&] { this->Lasting_ = LongestPersistence(this->Scene_, sweep.AllLines(), this->Band_, lit); });
}

void Settling::BuildUp()
{
  // Light that is sent on again, once its orders before have been counted, and the share of its
  // noise that the sweeps to come leave of that of the next.
  double left = 1.0;
  double noise = 1.0;
  while (this->Sweeps_.Done() < MostThinSweeps && left > this->Uncounted_)
  {
    // The first sweeps differ much: each is balanced by its own loss.
    this->Sweeps_.Restart();
    double share = 1.0;
    if (this->Sweeps_.Diffusion())
    {
      this->Sweeps_.Draw(1);
    }
    else
    {
      share = this->Sweeps_.DrawThin(ThinShare * noise);
    }
    if (this->Sweeps_.Diverges())
    {
      return;
    }
    const std::vector<BatchState>& states = this->Sweeps_.States();
    const std::vector<PowerBalance::Powers> powers = this->Balance_.Of(states);
    const double sent = this->SentOf(powers);
    if (this->Sweeps_.Done() == 1 && !this->Sweeps_.Diffusion())
    {
      this->FindPersistence(share);
    }
    if (std::pow(this->Kept(sent), this->Sweeps_.Done()) <= this->Uncounted_ ||
        this->Sweeps_.Done() == MostThinSweeps)
    {
      this->Darkest_ =
        BlockMeans(states, this->Scene_, this->Field_, this->Band_, this->Arena_).DarkestShare();
    }
    left = this->Lacking(sent, this->Sweeps_.Done());
    const double kept = this->Kept(sent);
    noise = std::min(1.0, std::max(this->Uncounted_ / (kept * left),
                            std::pow(kept, MostThinSweeps - this->Sweeps_.Done() - 1)));
    this->Scale(powers);
    this->Sweeps_.Follow();
  }
  this->Sweeps_.Restart();
}

void Settling::Scale(const std::vector<PowerBalance::Powers>& powers)
{
  this->Balance_.ExpectLoss(powers);
  if (!this->Sweeps_.Diffusion())
  {
    this->Balance_.ScaleLatest(powers, this->Sweeps_.States());
  }
}

void Settling::Complete()
{
  for (int window = 1;
       this->Sweeps_.Diffusion() && this->Sweeps_.Diffusion()->MayLack() > this->Limit_ &&
       !this->Sweeps_.Diverges() && this->Sweeps_.Done() + window <= CompletedSweeps;
       window *= 2)
  {
    this->Sweeps_.Draw(window);
    this->Sweeps_.Follow();
    this->Sweeps_.Restart();
  }
}

Settling::Verdict Settling::Judge(const BlockMeans::Drift& drift, const Window& window) const
{
  if (this->LargestSent_ < this->Uncounted_ * this->Darkest_)
  {
    // All that is sent on at all is too little: noise alone differs, however much.
    return {.Drifts = false, .Tolerable = true, .Settled = true};
  }
  Verdict verdict;
  const double shown = std::max(LeastShown, 1.0 - std::pow(this->Kept(window.Sent), window.Sweeps));
  verdict.Drifts = drift.Exceeds(0.0, Deviations);
  verdict.Tolerable = drift.UpperBound < this->Limit_ * shown ||
                      (window.Over && !verdict.Drifts && drift.Estimate < this->Limit_ * shown &&
                        drift.UpperBound < HiddenShare * this->Limit_);
  const double error = std::max(
    this->Probes_.RelativeError(this->Sweeps_.States()), LeastErrorShare * this->Tolerance_);
  // Sweeps without end would be needed to tell that noise is no drift: there the share does that
  // the sums lack of what is sent on.
  const double lacking = this->Lacking(window.Sent, window.Before) /
                         std::max(1.0, (1.0 - this->Kept(window.Sent)) * this->Sweeps_.Counted());
  const bool late = lacking <= LackingErrors * error;
  verdict.Settled = verdict.Tolerable && !window.Lacks &&
                    (drift.Estimate <= DriftErrors * error || (drift.IsNoise() && late));
  verdict.Early = verdict.Tolerable && !verdict.Drifts && !verdict.Settled && !late;
  verdict.Grows =
    (verdict.Drifts || window.Lacks) && !verdict.Settled && window.Sweeps >= SlowWindow;
  return verdict;
}

void Settling::ExpectSmall(const BlockMeans::Drift& drift, const Window& window) const
{
  if (drift.Exceeds(this->Limit_, window.Over ? CertainDeviations : Deviations))
  {
    throw Error("light field",
      "the light did not settle in " + std::to_string(this->Sweeps_.Done()) + " sweeps",
      "Give a larger tolerance, or check for an albedo and reflectances so close to 1 that "
      "light is hardly ever lost");
  }
}

bool Settling::Run()
{
  this->BuildUp();
  this->Complete();
  SlowLight slow(this->Scene_, this->Sweeps_.Sweep(), this->Band_);
  std::optional<BlockMeans> earlier;
  bool summed = false;
  for (Window window{1, this->Sweeps_.Done()};;)
  {
    std::vector<BatchState>& states = this->Sweeps_.States();
    this->Sweeps_.Draw(window.Sweeps);
    if (this->Sweeps_.Diverges())
    {
      return false;
    }
    this->Sweeps_.Follow();
    BlockMeans now(states, this->Scene_, this->Field_, this->Band_, this->Arena_);
    const std::vector<PowerBalance::Powers> powers = this->Balance_.Of(states);
    window.Sent = this->SentOf(powers);
    window.Lacks = !this->Balanced_ && 1.0 - this->Lasting_ < ShorterShare * (1.0 - window.Sent) &&
                   this->LackingWhereItLasts(window.Before) > this->Uncounted_;
    window.Over = !window.Lacks && this->Lacking(window.Sent, window.Before) < this->Uncounted_;
    Verdict verdict;
    if (earlier)
    {
      const BlockMeans::Drift drift =
        (summed ? now.Since(*earlier) : now).DriftSince(*earlier, this->Tolerance_);
      verdict = this->Judge(drift, window);
      const bool most = this->Sweeps_.Done() + 2 * window.Sweeps > MostSweeps;
      if (most && !verdict.Settled)
      {
        // Noise may hide a small drift to the end, or feign one.
        this->ExpectSmall(drift, window);
      }
      if (most || verdict.Settled)
      {
        this->Balance_.ExpectBalance(powers);
        slow.Stop(states);
        return verdict.Settled;
      }
    }
    summed = window.Over && !(earlier && verdict.Drifts) && !verdict.Early;
    earlier = std::move(now);
    if (summed)
    {
      // What noise hides is told from more sweeps, all of which count.
      window.Sweeps = this->Sweeps_.Done() - window.Before;
      continue;
    }
    if (slow.Refine(states))
    {
      this->Scale(powers);
    }
    else if (const SlowLight::Outcome outcome = slow.Balance(states);
             outcome != SlowLight::Outcome::Unknown)
    {
      // What was seen before does not compare with that.
      this->Balanced_ =
        this->Balanced_ || (outcome == SlowLight::Outcome::Balanced &&
                             slow.LossShare() < SlowestLoss * (1.0 - this->Lasting_));
      earlier.reset();
    }
    else
    {
      this->Scale(powers);
      if (2 * window.Sweeps >= SlowWindow && (verdict.Grows || !this->Sweeps_.Sweep().Watches()))
      {
        this->Arena_.execute([&] { slow.Watch(states, verdict.Grows); });
      }
      window.Sweeps *= verdict.Tolerable && !window.Lacks ? 1 : 2;
    }
    this->Sweeps_.Restart();
    window.Before = this->Sweeps_.Done();
  }
}

} // namespace smokevis
