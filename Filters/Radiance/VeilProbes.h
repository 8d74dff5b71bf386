// Lines of sight along which the solver watches the error of the veil that it is to deliver.
#pragma once

#include "LineSweep.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace smokevis
{

/// Lines of sight from random places to the scene's signs, or, without signs, in random directions.
/// Where nothing sends light on, fluence and illuminance are all that is not seen directly: they
/// are then watched anywhere, as if all smoke were white and all surfaces too.
class VeilProbes
{
public:
  /// Where the lines run.
  enum class Lines
  {
    /// To the signs; without signs anywhere.
    ToSigns,
    Anywhere
  };
  VeilProbes(const Scene& scene, const LightField& field, int band, std::uint64_t seed,
    Lines lines = Lines::ToSigns);

  /// Root mean square, over the probes, of the standard error of the light along a probe over that
  /// light (or over a floor where there is next to none), from the running means of the batches.
  double RelativeError(const std::vector<BatchState>& batches) const;

  /// The same of all probes together: what little light there is along one of them may be unknown.
  double WholeError(const std::vector<BatchState>& batches) const;

  /// What the square of a change of each cell's fluence alone adds to the square of the relative
  /// error, but for a factor [1/lx2]; no surface's light counts, as probes end before walls.
  std::vector<float> Weights(const std::vector<BatchState>& batches) const;

  /// The largest ratio, over the probes, of what is not direct to the direct light along a probe;
  /// no floor, since a place in the dark beside a bright one may be all that is seen.
  /// @param fluence a cell's, of what is not direct [lx]
  /// @param illuminance any surface's, of what is not direct [lx]
  double LargestShare(const std::function<double(std::int64_t)>& fluence, double illuminance) const;

private:
  struct Piece
  {
    std::int64_t Cell;
    /// Luminance at the eye over fluence in the cell.
    double Weight;
  };
  struct Probe
  {
    std::vector<Piece> Pieces;
    /// What arrives without multiply scattered light [cd/m2].
    double Direct = 0.0;
    /// Side of the patch that ends the line, and luminance at the eye over its illuminance.
    std::size_t Side = 0;
    double SurfaceWeight = 0.0;
  };

  /// The light along each probe by each batch [cd/m2].
  std::vector<Lanes> LightOf(const std::vector<BatchState>& batches) const;
  /// What errors are compared with: means of these, and the floor [cd/m2].
  std::vector<double> Compared(const std::vector<Lanes>& lights) const;
  /// Sky that shows is left out: it is exact, and would outshine what is not.
  void Add(const Scene& scene, const LightField& field, int band, const Vec3& eye,
    const Vec3& direction, double reach);

  std::vector<Probe> Probes_;
  /// Whether neither smoke nor any surface sends light on.
  bool Black_;
  /// Added to the light that errors are compared with [cd/m2].
  double Floor_ = 0.0;
  /// Share of the probes' mean light that is added as well: random lines also look where it is
  /// dark.
  double MeanShare_ = 0.0;
};

} // namespace smokevis
