// Cells so thick and so white that nearly all they send on comes back to themselves.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace smokevis
{

class GlobalLines;
class Progress;
class Scene;

/// Light stays in a thick white cell for so many orders of scattering that sweeps would not see the
/// end of them: the share of its power that a cell gives to others in one sweep is small, but known
/// beforehand. Divided by it, what comes in and goes out in a sweep tells where the cell's own
/// orders end (Jacobi's iteration on the cells, instead of Picard's).
class ThickCells
{
public:
  /// Variance of the length of all lines in a cell that one of them would meet, over its square.
  static constexpr float LengthVariance = 1.5F;

  ThickCells() = default;
  /// @param extinction of each cell in the band [1/m]
  /// @param lines of a whole sweep
  /// @param progress tells when to stop; what was found by then is of no use
  ThickCells(const Scene& scene, const std::vector<float>& extinction, const GlobalLines& lines,
    const Progress& progress);

  bool Any() const { return !this->Orders_.empty(); }
  bool IsThick(std::size_t cell) const { return this->Any() && this->Orders_[cell] > 0.0F; }
  /// How many times what a sweep would change of a thick cell's fluence it is to change.
  /// @param meetings how many lines of the sweep are expected to meet the cell
  float Gain(std::size_t cell, float meetings) const
  {
    // Where few lines meet a cell, their lengths differ more than what they bring.
    return meetings / (meetings + LengthVariance) * this->Orders_[cell];
  }
  /// How many of them there are.
  std::size_t Count() const;

private:
  /// Share of what is scattered in each cell that leaves it or meets a surface before it is
  /// scattered there again, 0 where lines tell nothing.
  static std::vector<double> Escapes(const Scene& scene, const std::vector<float>& extinction,
    const GlobalLines& lines, const Progress& progress);

  /// Orders of scattering that light stays in a thick cell, 0 in others.
  std::vector<float> Orders_;
};

} // namespace smokevis
