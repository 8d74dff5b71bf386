// How neighbouring cells tell the slope of a field inside a cell.
#pragma once

#include <array>
#include <cstdint>

namespace smokevis
{

class Scene;

/// The logarithm of a field of light has a slope in a cell that is not the mean of what the cells
/// on both sides tell, where these are much thicker or thinner: light falls off by the more the
/// thicker the smoke. The slope is taken to be a + b K with the extinction coefficient K of each
/// cell, where a and b are as neither the means of the cells nor what is likely from the start say
/// they are not (a linear estimate of least variance). In even smoke both sides count alike.
class SlopeWeights
{
public:
  explicit SlopeWeights(const Scene& scene);

  /// Factors of the rise of the logarithm from the cell on the low side to the cell and from the
  /// cell to that on the high side, whose sum is the slope [1/m].
  /// @param beside the two cells; one below 0 tells nothing
  std::array<double, 2> Of(
    std::int64_t cell, int axis, const std::array<std::int64_t, 2>& beside) const;

private:
  const Scene& Scene_;
  /// Square of a's standard deviation from the start, where that of b is 1 [1/m2].
  double Geometric_;
};

} // namespace smokevis
