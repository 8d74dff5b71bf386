// Holds a light field to the conservation of power: what is lost must be what is emitted.
#pragma once

#include "BatchState.h"
#include "Box.h"

#include <vector>

#include <tbb/task_arena.h>

namespace smokevis
{

class Scene;
struct LightField;

/// Scales light to be in balance as a whole, which sums the series of reflections of its slowest
/// mode at once. All batches are scaled alike, by the mean of what they lose; what one lost more or
/// less than that is taken from it, or given to it, in the shape of the mean of all. So each is in
/// balance, their spread tells the error of the ratio that their mean is, and that has next to no
/// bias: were each scaled for itself, what is far from where most is lost would come out too bright
/// by the square of a batch's noise. Where light leaves the scene, its loss may be known less well
/// than the light itself. With a sky nothing is scaled: light that goes straight out again tells
/// nothing about the rest.
class PowerBalance
{
public:
  /// @param field holds the direct light of all cells and patches
  /// @param outer box through whose surface the sky's light comes in
  /// @param arena whose threads work on the batches; must outlive this
  PowerBalance(const Scene& scene, const LightField& field, int band, const Box& outer,
    tbb::task_arena& arena);

  /// Power that lines carry before any of it was tallied [lm]: what surfaces and smoke send out
  /// again of direct light, and what flames, large lights and the sky emit.
  double Source() const { return this->Source_; }

  /// What becomes of the light of a batch, means over the sweeps that count [lm].
  struct Powers
  {
    /// What surfaces and smoke send out again, and of that the surfaces; what they absorb or leaves
    /// the scene, and of that the latter.
    double SentAgain = 0.0, Reflected = 0.0, Lost = 0.0, Escaped = 0.0;
  };
  std::vector<Powers> Of(const std::vector<BatchState>& batches) const;

  /// Share of the light that smoke and surfaces take up or let go which they send on again: its
  /// power to n is about the share that is sent on more than n times.
  /// @param by what sends it: SentAgain, or Reflected where only surfaces count
  double SentAgain(
    const std::vector<Powers>& powers, double Powers::*by = &Powers::SentAgain) const;
  /// Throws Error where hardly any light is ever lost.
  void ExpectLoss(const std::vector<Powers>& powers) const;
  /// Whether what is lost is about what is emitted; true under a sky, of which that is not known.
  bool RoughlyBalanced(const std::vector<Powers>& powers) const;
  /// Throws Error where what is lost is far from what is emitted: light that does not settle.
  void ExpectBalance(const std::vector<Powers>& powers) const;
  /// Scales the latest estimates by the means of the sweeps that count. Slow light stays for long
  /// at what it is scaled to, and all batches would be off alike: so each is brought into balance.
  void ScaleLatest(const std::vector<Powers>& powers, std::vector<BatchState>& batches) const;
  /// Scales the sums where the batches then agree better, and where no light leaves the scene: then
  /// all of it is known to be lost there.
  void ScaleSums(const std::vector<Powers>& powers, std::vector<BatchState>& batches) const;
  /// Scales sums that diffusion completes where the batches then agree much better: else that would
  /// bring the noise of the balance along; and where what they lose is clearly not what is emitted,
  /// or no light leaves the scene.
  void ScaleCompleted(const std::vector<Powers>& powers, std::vector<BatchState>& batches) const;

  /// What surfaces take up and absorb of the light that is kept in a field, which is not direct, a
  /// value a batch [lm].
  DoubleLanes TakenBySurfaces(const LightField& field, int band) const;
  /// Scales all that is kept so that as much is lost as was before that changed, on surfaces, in
  /// smoke or out of the scene.
  /// @param powers of the sums that were kept
  /// @param more lost than then [lm]
  void Restore(
    const std::vector<Powers>& powers, const DoubleLanes& more, LightField& field, int band) const;

private:
  struct Scales
  {
    /// Of all batches, and its relative standard error.
    double Common = 1.0, CommonError = 0.0;
    /// What each batch lost less than all in the mean, over that.
    DoubleLanes Missing{};
    /// Relative standard error of what the batches send on, and of the same when they have got what
    /// they miss.
    double Spread = 0.0, BalancedSpread = 0.0;
  };

  /// Whether no light leaves the scene, but for what rounding lets through corners.
  static bool Closed(const std::vector<Powers>& powers);
  /// Whether what the batches lose is what is emitted, and known, to a share of that.
  bool Balanced(const DoubleLanes& losses, double imbalance) const;
  Scales ScalesOf(const std::vector<Powers>& powers) const;
  /// @param share of the spread of the batches that must be left at most
  /// @param always or else whatever is left
  void ScaleSumsBy(
    const Scales& scales, double share, bool always, std::vector<BatchState>& batches) const;
  /// Scales values of the batches that have the shape of these sums, or are these.
  void Scale(const Scales& scales, std::vector<float> BatchState::*values,
    std::vector<float> BatchState::*sums, std::vector<BatchState>& batches) const;
  /// Runs body(i) for each of a count.
  template <class Body> void ForEach(std::size_t count, Body&& body) const;

  const Scene& Scene_;
  tbb::task_arena& Arena_;
  /// Extinction coefficient times volume of each cell [m2], and of each side of a patch the area
  /// that light comes to [m2] and the reflectance, which may be close to 1.
  std::vector<float> Capture_, Area_;
  std::vector<double> Reflectance_;
  double Source_;
  bool Sky_;
  /// Whether neither smoke nor surfaces take light away; it may still leave the scene.
  bool HardlyLoses_;
};

} // namespace smokevis
