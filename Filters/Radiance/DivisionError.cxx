#include "DivisionError.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace smokevis
{

namespace
{

/// What a block shows, and what its zone's errors change of that: the veil, then its own light.
struct Light
{
  PatternVector All{};
  std::array<PatternVector, 2> Changes{};
};

Light LightOf(const SeenBlock& block, const ZoneError& zone)
{
  Light light{MeanFactors(block.Factors), {}};
  light.Changes[0][0] = zone.Veil;
  for (int i = 1; i < PatternValues; ++i)
  {
    light.Changes[1][i] = zone.Depth * light.All[i];
  }
  return light;
}

/// Twice the sum over a block's pixels of what they show times a change of it, times their area.
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
  const std::vector<std::size_t>& zoneOf, const std::vector<ZoneError>& zones)
{
  const std::size_t first = this->Changes_.size();
  this->Changes_.resize(first + 2 * zones.size());
  std::vector<Light> lights;
  lights.reserve(blocks.size());
  for (std::size_t i = 0; i < blocks.size(); ++i)
  {
    lights.push_back(blocks[i].Density > 0.0 ? LightOf(blocks[i], zones[zoneOf[i]]) : Light{});
  }
  const auto changeOf = [&](std::size_t block, int part) -> Change&
  { return this->Changes_[first + 2 * zoneOf[block] + static_cast<std::size_t>(part)]; };
  for (std::size_t i = 0; i < blocks.size() && pattern.Fine(); ++i)
  {
    const PatternBlock& block = pattern.Blocks()[i];
    for (int part = 0; part < 2; ++part)
    {
      Change& change = changeOf(i, part);
      change.First += blocks[i].Density * Dot(lights[i].Changes[part], block.Sum);
      change.Second +=
        blocks[i].Density * TwiceProduct(block, lights[i].All, lights[i].Changes[part]);
    }
  }
  const std::vector<PatternPiece>& pieces = pattern.Pieces();
  for (std::size_t begin = 0, end = 0; begin < pieces.size(); begin = end)
  {
    double weight = 0.0;
    double light = 0.0;
    for (; end < pieces.size() && pieces[end].Pixel == pieces[begin].Pixel; ++end)
    {
      const PatternPiece& piece = pieces[end];
      weight += blocks[piece.Block].Density * piece.Sum[0];
      light += blocks[piece.Block].Density * Dot(lights[piece.Block].All, piece.Sum);
    }
    for (std::size_t i = begin; i < end && weight > 0.0; ++i)
    {
      const PatternPiece& piece = pieces[i];
      for (int part = 0; part < 2; ++part)
      {
        const double changed =
          blocks[piece.Block].Density * Dot(lights[piece.Block].Changes[part], piece.Sum);
        Change& change = changeOf(piece.Block, part);
        change.First += changed;
        change.Second += 2.0 * changed * light / weight;
      }
    }
  }
}

double DivisionError::OfRatio(const Moments& moments, double seen, double dark) const
{
  // What a change makes of half the variance.
  const auto ofVariance = [&](const Change& change)
  { return (0.5 * change.Second - moments.Mean * change.First) / seen; };
  double variance = 0.0;
  for (const Change& change : this->Changes_)
  {
    const double own = ofVariance(change);
    variance += own * own;
  }
  variance = std::sqrt(variance);
  const double below = moments.Mean + dark;
  // A plate that is even by chance has no derivative.
  const double deviation = std::max(moments.Deviation, std::sqrt(variance));
  if (!(below > 0.0) || !(deviation > 0.0))
  {
    return 0.0;
  }
  double error = 0.0;
  for (const Change& change : this->Changes_)
  {
    const double mean = change.First / seen;
    const double own = ofVariance(change) / deviation - moments.Deviation * mean / below;
    error += own * own;
  }
  return std::sqrt(error) / below;
}

} // namespace smokevis
