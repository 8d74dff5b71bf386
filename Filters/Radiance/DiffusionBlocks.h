// What light that is scattered on and on still lacks, by the diffusion equation.
#pragma once

#include "BatchState.h"
#include "DiffusionSides.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/SparseCore>

namespace smokevis
{

class Scene;

/// Diffusion synthetic acceleration of sweeps (Kopp 1963, Alcouffe 1977; Adams and Larsen, Progress
/// in Nuclear Energy 40, 2002): what a sweep changes of the fluence, here over blocks of cells
/// about a mean free path wide, is the source of what sweeps without end would add to it, which in
/// smoke that scatters often obeys the diffusion equation. Light that is not off is not changed, so
/// that how good that equation is decides how fast sweeps converge, not what to. Clear air beside
/// smoke is part of it: there light mixes.
class DiffusionBlocks
{
public:
  /// @param extinction of each cell in the band [1/m]
  DiffusionBlocks(const Scene& scene, int band, const std::vector<float>& extinction);

  std::size_t Count() const { return this->Capture_.size(); }
  /// Whether light is lost anywhere: else there is nothing that it would come to.
  bool Lose() const { return this->Loss_ > 0.0; }

  /// Adds what a sweep would change of a cell's fluence [lx] to the residual of its block [lm].
  void AddResidual(std::size_t cell, double change, std::vector<double>& residual) const
  {
    if (this->Block_[cell] >= 0)
    {
      residual[this->Block_[cell]] += this->Scattering_[cell] * change;
    }
  }
  const DiffusionSides& Sides() const { return *this->Sides_; }
  /// Of the residuals of all blocks and, after them, all sides.
  std::size_t Residuals() const { return this->Count() + this->Sides_->Count(); }
  /// Adds to the sums of a batch, and to its Lacking, what its sweeps lack by its residual, and
  /// empties that.
  /// @param step share of that
  void CompleteSums(double step, BatchState& batch) const;

  /// What batches lack of the fluence in the mean over all of their sweeps.
  struct Lack
  {
    /// Of each block, and of the illuminance of each side that its blocks do not tell [lx].
    std::vector<double> Fluence, Illuminance;
    /// Root mean square over the smoke, and its standard error, over the mean fluence.
    double Size = 0.0, Error = 0.0;

    /// Whether it stands out of noise, which would be completed else, and grow.
    bool IsClear() const { return this->Size > Deviations * this->Error; }
    static constexpr double Deviations = 3.0;
  };
  /// @param sweeps that the batches' Lacking adds up
  Lack LackOf(int sweeps, const std::vector<BatchState>& batches) const;
  /// Adds it to the latest light of the batches, whose Lacking it empties.
  void Complete(const Lack& lack, std::vector<BatchState>& batches) const;

private:
  /// Sums over the cells of a block, and over what bounds it.
  struct Sums;
  struct Outside;
  /// Between pairs of blocks [m2].
  using Areas = std::map<std::pair<std::int32_t, std::int32_t>, double>;

  std::vector<Sums> FormBlocks(const Scene& scene, const std::vector<float>& extinction);
  Areas FindFaces(const Scene& scene) const;
  void FindSides(
    const Scene& scene, int band, const std::vector<Sums>& blocks, const Outside& outside);
  void FormOperator(
    double albedo, const std::vector<Sums>& blocks, const Areas& between, const Outside& outside);

  /// Block of each cell, or -1 inside of walls, and scattering coefficient times volume [m2].
  std::vector<std::int32_t> Block_;
  std::vector<float> Scattering_;
  std::optional<DiffusionSides> Sides_;
  /// Extinction coefficient times volume of each block [m2].
  std::vector<double> Capture_;
  /// Power that leaves each block, less what its sides absorb of it, over its fluence [m2]: over
  /// all blocks what leaves the scene.
  std::vector<double> Escape_;
  /// Power that is absorbed or leaves the scene, over a fluence that is the same everywhere [m2].
  double Loss_ = 0.0;
  /// Whether the light of each block can get nowhere where any is lost. No fluence balances what
  /// comes in there, so that it is not completed.
  std::vector<bool> Sealed_;
  /// Power that leaves the blocks or is absorbed in them, by the fluence [m2].
  Eigen::SparseMatrix<double> Operator_;
};

} // namespace smokevis
