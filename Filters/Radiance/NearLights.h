// Which lights are near to which smoke cells, and their fluence there.
#pragma once

#include "DirectLight.h"
#include "NearField.h"

#include <atomic>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include <tbb/collaborative_call_once.h>

namespace smokevis
{

/// A light within a few cell edges of a cell counts as near to it: its fluence is too steep there
/// to be interpolated between cells.
class NearLights
{
public:
  /// @param coarse whether it will do to know their fluences to two percent
  NearLights(const Scene& scene, bool coarse);

  struct Light
  {
    std::uint32_t Index = 0;
    /// Whether the whole cell sees it unhidden, as some ways tell.
    bool Clear = false;
    /// The same, or nothing at all hides it from what lies before its plate of the cell.
    bool ClearBefore = false;
    /// Whether it is so close that its fluence varies much inside the cell.
    bool Close = false;
    /// Whether the light itself tells what it leaves there, for its plate touches the cell, or
    /// the smoke around it is uneven.
    bool Deposits = false;
  };
  struct Cell
  {
    std::int64_t Index = 0;
    std::vector<Light> Lights;
    /// Whether any of them is close.
    bool Close = false;
  };
  /// Cells that lights are near to.
  const std::vector<Cell>& Cells() const { return this->Cells_; }
  /// Place of a smoke cell among them, or -1.
  int Place(std::int64_t cell) const { return this->Places_.empty() ? -1 : this->Places_[cell]; }
  /// The lattices of a light that is near to some cell; none where it changes too quickly with the
  /// angle, as measured light may.
  const NearField* Field(std::size_t light) const { return this->Fields_[light].get(); }
  /// Mean fluence over a cell of one of the lights near to it [lx]; computed when it is first asked
  /// for.
  /// @param cell place of the cell among those that lights are near to
  /// @param light place of the light among the cell's
  double Mean(std::size_t cell, std::size_t light, int band) const
  {
    const std::atomic<float>& kept = this->Means_[this->MeanIndex(cell, light) + band];
    const float known = kept.load(std::memory_order_relaxed);
    return std::isnan(known) ? this->FindMean(cell, light, band) : known;
  }

  /// Place of a light among those near to a cell, or -1.
  int Find(std::size_t cell, std::size_t light) const;
  /// Finds the means of a light over the cells of which it tells itself, once.
  void Deposit(std::size_t light) const;
  /// Calls take(mean) for all means over a cell as they are kept, NaN where they are not computed
  /// yet, and keeps what it makes of them.
  template <class Take> void ForEachMean(std::size_t cell, Take&& take) const
  {
    const std::size_t first = this->MeanIndex(cell, 0);
    for (std::size_t i = 0; i < this->Cells_[cell].Lights.size() * this->Bands_; ++i)
    {
      float mean = this->Means_[first + i].load(std::memory_order_relaxed);
      take(mean);
      this->Means_[first + i].store(mean, std::memory_order_relaxed);
    }
  }

private:
  std::size_t MeanIndex(std::size_t cell, std::size_t light) const
  {
    return (this->FirstMean_[cell] + light) * this->Bands_;
  }
  double FindMean(std::size_t cell, std::size_t light, int band) const;
  void Keep(std::size_t index, const Spectrum& mean) const;
  /// The cells near to a light.
  struct Surroundings
  {
    /// How far from the light they reach [m].
    double Reach = 0.0;
    /// By how much the optical depth of a cell is off the mean of its neighbours' along an axis, in
    /// the mean square.
    double Unevenness = 0.0;
  };
  Surroundings FindCells(std::size_t light);

  const Scene& Scene_;
  bool Coarse_;
  DirectLight Direct_;
  std::vector<Cell> Cells_;
  std::vector<std::int32_t> Places_;
  std::vector<std::unique_ptr<NearField>> Fields_;
  /// Cells of which each light itself tells what it leaves there, as places among the cells.
  std::vector<std::vector<std::size_t>> DepositsIn_;
  mutable std::vector<tbb::collaborative_once_flag> Deposited_;
  std::size_t Bands_;
  /// Lights of all cells before each.
  std::vector<std::size_t> FirstMean_;
  /// [cell][light][band]; NaN: not computed yet. They depend on the scene alone, so that it does
  /// not matter which thread computes them.
  mutable std::vector<std::atomic<float>> Means_;
};

} // namespace smokevis
