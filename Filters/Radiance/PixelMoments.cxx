#include "PixelMoments.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace smokevis
{

namespace
{

/// Factors of a block, one a value of the pattern.
using ResampledFactors = std::array<Resampled, PatternValues>;

ResampledFactors Resample(const Coefficients& factors)
{
  const PatternVector mean = MeanFactors(factors);
  ResampledFactors resampled;
  for (int i = 0; i < PatternValues; ++i)
  {
    resampled[i][0] = mean[i];
    for (int batch = 0; batch < Batches; ++batch)
    {
      resampled[i][1 + batch] = (Batches * mean[i] - factors[batch][i]) / (Batches - 1);
    }
  }
  return resampled;
}

/// Adds weight times the light of what has these values. Most of them are 0.
void AddLight(
  const ResampledFactors& factors, const PatternVector& values, double weight, Resampled& light)
{
  for (int i = 0; i < PatternValues; ++i)
  {
    const double share = weight * values[i];
    if (share == 0.0)
    {
      continue;
    }
    for (std::size_t k = 0; k < light.size(); ++k)
    {
      light[k] += share * factors[i][k];
    }
  }
}

/// The same of its square.
/// @param spread of the factors (SeenBlock)
void AddSquare(const ResampledFactors& factors,
  const std::array<PatternVector, PatternValues>& products,
  const std::array<glm::dvec2, PatternValues>& spread, double weight, Resampled& square)
{
  for (int i = 0; i < PatternValues; ++i)
  {
    for (int j = 0; j <= i; ++j)
    {
      const double share =
        (i == j ? 1.0 : 2.0) * weight * (1.0 + glm::dot(spread[i], spread[j])) * products[i][j];
      if (share == 0.0)
      {
        continue;
      }
      for (std::size_t k = 0; k < square.size(); ++k)
      {
        square[k] += share * factors[i][k] * factors[j][k];
      }
    }
  }
}

} // namespace

PatternVector MeanFactors(const Coefficients& factors)
{
  PatternVector mean{};
  for (int batch = 0; batch < Batches; ++batch)
  {
    for (int i = 0; i < PatternValues; ++i)
    {
      mean[i] += factors[batch][i] / Batches;
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

ResampledMoments Sums::Get() const
{
  ResampledMoments moments;
  for (std::size_t k = 0; k < moments.size(); ++k)
  {
    moments[k].Mean = std::max(0.0, this->First[k] / this->Weight);
    moments[k].Deviation =
      std::sqrt(std::max(0.0, this->Second[k] / this->Weight - moments[k].Mean * moments[k].Mean));
  }
  return moments;
}

void AddPixels(const PlatePattern& pattern, const std::vector<SeenBlock>& blocks, Sums& sums)
{
  std::vector<ResampledFactors> factors;
  factors.reserve(blocks.size());
  for (const SeenBlock& block : blocks)
  {
    factors.push_back(Resample(block.Factors));
  }
  for (std::size_t index = 0; pattern.Fine() && index < blocks.size(); ++index)
  {
    const PatternBlock& block = pattern.Blocks()[index];
    const double density = blocks[index].Density;
    sums.Weight += density * block.Sum[0];
    AddLight(factors[index], block.Sum, density, sums.First);
    AddSquare(factors[index], block.Products, blocks[index].Spread, density, sums.Second);
  }
  const std::vector<PatternPiece>& pieces = pattern.Pieces();
  for (std::size_t i = 0; i < pieces.size();)
  {
    double weight = 0.0;
    Resampled light{};
    const std::size_t pixel = pieces[i].Pixel;
    for (; i < pieces.size() && pieces[i].Pixel == pixel; ++i)
    {
      const double density = blocks[pieces[i].Block].Density;
      weight += density * pieces[i].Sum[0];
      AddLight(factors[pieces[i].Block], pieces[i].Sum, density, light);
    }
    sums.Weight += weight;
    for (std::size_t k = 0; k < light.size(); ++k)
    {
      sums.First[k] += light[k];
      sums.Second[k] += weight > 0.0 ? light[k] * light[k] / weight : 0.0;
    }
  }
}

void Jackknife(const ResampledMoments& resampled, double dark, double& value, double& error)
{
  Resampled ratios;
  std::transform(resampled.begin(), resampled.end(), ratios.begin(),
    [dark](const Moments& moments)
    {
      const double below = moments.Mean + dark;
      return below > 0.0 ? moments.Deviation / below : 0.0;
    });
  const double mean = std::accumulate(ratios.begin() + 1, ratios.end(), 0.0) / Batches;
  const double squares = std::accumulate(ratios.begin() + 1, ratios.end(), 0.0,
    [mean](double sum, double ratio) { return sum + (ratio - mean) * (ratio - mean); });
  value = std::max(0.0, Batches * ratios[0] - (Batches - 1.0) * mean);
  error = FewBatches * std::sqrt((Batches - 1.0) / Batches * squares);
}

} // namespace smokevis
