// Draws sweeps until the orders of scattering have built up.
#pragma once

#include "BlockMeans.h"
#include "PowerBalance.h"

#include <optional>

#include <tbb/task_arena.h>

namespace smokevis
{

class BatchSweeps;
class Scene;
class VeilProbes;
struct LightField;

/// Light that is sent on again and again takes sweeps to build up. First come thin sweeps, until
/// next to nothing is sent on so often; then windows of whole ones, twice as many each time, until
/// no drift from one to the next stands out any more that the tolerance would not allow. Windows
/// that are all settled are merged, unless these lack more than the error that they are known to.
class Settling
{
public:
  /// @param tolerance that is asked for
  /// @param arena whose threads work; all must outlive this
  Settling(const Scene& scene, const LightField& field, int band, double tolerance,
    const PowerBalance& balance, const VeilProbes& probes, tbb::task_arena& arena,
    BatchSweeps& sweeps);

  /// Leaves sums in the batches that all count, unless what completes them diverges. Throws Error
  /// where light never settles. Returns whether it is known to have settled.
  bool Run();

  /// Sweeps that may be drawn in all, for whatever reason.
  static constexpr int MostSweeps = 768;

private:
  /// What is known of the sweeps that the sums hold.
  struct Window
  {
    /// Sweeps since the last window, and those before the sums.
    int Sweeps = 1, Before = 0;
    /// Share of the light that is sent on again.
    double Sent = 0.0;
    /// Whether the sweeps before have left so little light that a drift would be over.
    bool Over = false;
    /// Whether they have not where light lasts much longer than all together: it may be a small
    /// part of that, of whose drift none is seen.
    bool Lacks = false;
  };
  /// What a drift says of them.
  struct Verdict
  {
    /// Whether it stands out of the noise, for so long that light may grow by itself, is small
    /// enough, and hides in an error that is known.
    bool Drifts = true, Grows = false, Tolerable = false, Settled = false;
    /// Whether the sums begin too early for a veil that is known so well: new ones lack less.
    bool Early = false;
  };

  /// Largest share of light that anything in the scene sends on.
  double LargestSent() const;
  /// Share of what light lacks that it still lacks a sweep later.
  /// @param sent share of the light that is sent on again
  double Kept(double sent) const;
  /// Share of the light that is sent on again by what diffusion does not complete.
  double SentOf(const std::vector<PowerBalance::Powers>& powers) const;
  /// Share of the light, where it is darkest, that is sent on more often than so many times.
  double Lacking(double sent, int sweeps) const;
  /// Share of the light, where it lasts longest, that is sent on more often than so many times.
  double LackingWhereItLasts(int sweeps) const;
  /// Finds how long light lasts in the parts of the scene that the first sweep lit.
  /// @param share of a whole sweep's lines that it had
  void FindPersistence(double share);
  void BuildUp();
  /// Scales the latest light to be in balance, where diffusion does not complete it.
  void Scale(const std::vector<PowerBalance::Powers>& powers);
  /// Draws sweeps until what diffusion completes is known well enough.
  void Complete();
  Verdict Judge(const BlockMeans::Drift& drift, const Window& window) const;
  /// Throws Error where a drift stands out of noise even now.
  void ExpectSmall(const BlockMeans::Drift& drift, const Window& window) const;

  const Scene& Scene_;
  const LightField& Field_;
  int Band_;
  double Tolerance_;
  /// Drift that is allowed.
  double Limit_;
  /// Share of the light that may be sent on once more than sweeps count.
  double Uncounted_;
  /// Light where it is darkest over the mean.
  double Darkest_ = 1.0;
  /// Share of the light that is there a sweep later where it lasts longest, and whether that was
  /// balanced by itself.
  double Lasting_ = 0.0;
  bool Balanced_ = false;
  const PowerBalance& Balance_;
  /// LargestSent().
  double LargestSent_;
  const VeilProbes& Probes_;
  tbb::task_arena& Arena_;
  BatchSweeps& Sweeps_;
};

} // namespace smokevis
