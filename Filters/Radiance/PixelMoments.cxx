#include "PixelMoments.h"

#include <algorithm>
#include <cmath>

namespace smokevis
{

PatternVector FactorsOf(const Coefficients& factors, int leftOut)
{
  PatternVector mean{};
  for (int batch = 0; batch < Batches; ++batch)
  {
    for (int i = 0; batch != leftOut && i < PatternValues; ++i)
    {
      mean[i] += factors[batch][i] / (leftOut < 0 ? Batches : Batches - 1);
    }
  }
  return mean;
}

double Dot(const PatternVector& a, const PatternVector& b)
{
  double sum = 0.0;
  for (int i = 0; i < PatternValues; ++i)
  {
    sum += a[i] * b[i];
  }
  return sum;
}

Moments Sums::Get() const
{
  Moments moments;
  moments.Mean = std::max(0.0, this->First / this->Weight);
  moments.Deviation =
    std::sqrt(std::max(0.0, this->Second / this->Weight - moments.Mean * moments.Mean));
  return moments;
}

void AddPixels(
  const PlatePattern& pattern, const std::vector<SeenBlock>& blocks, int leftOut, Sums& sums)
{
  std::vector<PatternVector> factors;
  for (const SeenBlock& block : blocks)
  {
    factors.push_back(FactorsOf(block.Factors, leftOut));
  }
  for (std::size_t index = 0; pattern.Fine() && index < blocks.size(); ++index)
  {
    const PatternBlock& block = pattern.Blocks()[index];
    const double density = blocks[index].Density;
    const PatternVector& factor = factors[index];
    sums.Weight += density * block.Sum[0];
    sums.First += density * Dot(factor, block.Sum);
    for (int i = 0; i < PatternValues; ++i)
    {
      sums.Second += density * factor[i] * factor[i] * block.Products[i][i];
      for (int j = 0; j < i; ++j)
      {
        sums.Second += 2.0 * density * factor[i] * factor[j] * block.Products[i][j];
      }
    }
  }
  const std::vector<PatternPiece>& pieces = pattern.Pieces();
  for (std::size_t i = 0; i < pieces.size();)
  {
    double weight = 0.0;
    double light = 0.0;
    const std::size_t pixel = pieces[i].Pixel;
    for (; i < pieces.size() && pieces[i].Pixel == pixel; ++i)
    {
      const double density = blocks[pieces[i].Block].Density;
      weight += density * pieces[i].Sum[0];
      light += density * Dot(factors[pieces[i].Block], pieces[i].Sum);
    }
    sums.Weight += weight;
    sums.First += light;
    sums.Second += weight > 0.0 ? light * light / weight : 0.0;
  }
}

void Jackknife(const Moments& whole, const std::array<Moments, Batches>& parts, double dark,
  double& value, double& error)
{
  const auto ratio = [dark](const Moments& moments)
  {
    const double below = moments.Mean + dark;
    return below > 0.0 ? moments.Deviation / below : 0.0;
  };
  double sum = 0.0;
  double squares = 0.0;
  for (const Moments& part : parts)
  {
    sum += ratio(part);
  }
  const double mean = sum / Batches;
  for (const Moments& part : parts)
  {
    squares += (ratio(part) - mean) * (ratio(part) - mean);
  }
  value = std::max(0.0, Batches * ratio(whole) - (Batches - 1.0) * mean);
  error = FewBatches * std::sqrt((Batches - 1.0) / Batches * squares);
}

} // namespace smokevis
