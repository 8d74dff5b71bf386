#include "DivisionError.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace smokevis
{

namespace
{

/// Twice the mean over a block's pixels of all that they show times a share of it, times their
/// weight.
double TwiceProduct(const PatternBlock& block, const PatternVector& all, const PatternVector& share)
{
  double sum = 0.0;
  for (int i = 0; i < PatternValues; ++i)
  {
    sum += 2.0 * all[i] * share[i] * block.Products[i][i];
    for (int j = 0; j < i; ++j)
    {
      sum += 2.0 * (all[i] * share[j] + all[j] * share[i]) * block.Products[i][j];
    }
  }
  return sum;
}

} // namespace

void DivisionError::Add(const PlatePattern& pattern, const std::vector<SeenBlock>& blocks,
  const std::vector<std::size_t>& zoneOf, const std::vector<double>& unevenness)
{
  // The veil of each zone, then its own light.
  const std::size_t first = this->Changes_.size();
  this->Changes_.resize(first + 2 * unevenness.size());
  for (std::size_t i = 0; i < blocks.size(); ++i)
  {
    const PatternBlock& block = pattern.Blocks()[i];
    const double weight = blocks[i].Density * unevenness[zoneOf[i]];
    if (!(weight > 0.0))
    {
      continue;
    }
    const PatternVector all = MeanFactors(blocks[i].Factors);
    std::array<PatternVector, 2> shares = {PatternVector{}, all};
    std::swap(shares[0][0], shares[1][0]);
    for (std::size_t share = 0; share < shares.size(); ++share)
    {
      Change& change = this->Changes_[first + 2 * zoneOf[i] + share];
      const double light = Dot(shares[share], block.Sum);
      change.First += weight * light;
      // Pixels that are not fine average blocks.
      change.Second += weight * (pattern.Fine() ? TwiceProduct(block, all, shares[share])
                                                : 2.0 * light * Dot(all, block.Sum) / block.Sum[0]);
    }
  }
}

double DivisionError::OfRatio(const Moments& moments, double seen, double dark) const
{
  const double below = moments.Mean + dark;
  double variance = 0.0;
  for (const Change& change : this->Changes_)
  {
    const double own = 0.5 * change.Second / seen - moments.Mean * change.First / seen;
    variance += own * own;
  }
  // A plate that is even by chance has no derivative.
  const double deviation = std::max(moments.Deviation, std::sqrt(std::sqrt(variance)));
  if (!(below > 0.0) || !(deviation > 0.0))
  {
    return 0.0;
  }
  double sum = 0.0;
  for (const Change& change : this->Changes_)
  {
    const double own = 0.5 * change.Second / seen - moments.Mean * change.First / seen;
    const double ratio = own / deviation - moments.Deviation * change.First / seen / below;
    sum += ratio * ratio;
  }
  return std::sqrt(sum) / below;
}

} // namespace smokevis
