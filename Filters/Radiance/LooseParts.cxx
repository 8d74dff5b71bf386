#include "LooseParts.h"

#include "Sampler.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace smokevis
{

namespace
{

/// Share of a difference between parts that is left after a ray, above which they are loose.
constexpr double LooseShare = 0.9;
/// Steps by which that is found.
constexpr int Steps = 100;
/// Places with fewer are not parted: chance would do.
constexpr std::size_t FewestMembers = 16;

/// A difference between places that lives as long as any, and the share that a ray leaves of it.
std::pair<std::vector<double>, double> LongestLived(const std::vector<std::size_t>& members,
  const std::vector<std::vector<std::size_t>>& reached, const std::vector<double>& areas)
{
  std::vector<double> values(areas.size(), 0.0);
  std::vector<double> next(areas.size(), 0.0);
  for (const std::size_t place : members)
  {
    values[place] = ToUnit(Mix(place)) - 0.5;
  }
  double left = 0.0;
  for (int step = 0; step < Steps; ++step)
  {
    double sum = 0.0;
    double area = 0.0;
    for (const std::size_t place : members)
    {
      sum += areas[place] * values[place];
      area += areas[place];
    }
    double square = 0.0;
    for (const std::size_t place : members)
    {
      values[place] -= sum / area;
      square += areas[place] * values[place] * values[place];
    }
    if (!(square > 0.0))
    {
      return {values, 0.0};
    }
    double product = 0.0;
    for (const std::size_t place : members)
    {
      double mean = 0.0;
      for (const std::size_t other : reached[place])
      {
        mean += values[other] / static_cast<double>(reached[place].size());
      }
      product += areas[place] * values[place] * mean;
      // Half of the light waits, else differences that alternate would live as long.
      next[place] = 0.5 * (values[place] + mean) / std::sqrt(square);
    }
    left = product / square;
    std::swap(values, next);
  }
  return {values, left};
}

} // namespace

std::vector<std::vector<std::size_t>> LooseParts(std::vector<std::size_t> members,
  const std::vector<std::vector<std::size_t>>& reached, const std::vector<double>& areas)
{
  std::vector<std::vector<std::size_t>> parts;
  std::vector<std::vector<std::size_t>> open = {std::move(members)};
  // Rays that lead from a part count no more once it is parted.
  std::vector<std::vector<std::size_t>> within = reached;
  while (!open.empty())
  {
    std::vector<std::size_t> part = std::move(open.back());
    open.pop_back();
    if (part.size() < FewestMembers)
    {
      parts.push_back(std::move(part));
      continue;
    }
    const auto [values, left] = LongestLived(part, within, areas);
    const auto low = [&signs = values](std::size_t place) { return signs[place] < 0.0; };
    const auto middle = std::partition(part.begin(), part.end(), low);
    if (left < LooseShare || middle == part.begin() || middle == part.end())
    {
      parts.push_back(std::move(part));
      continue;
    }
    open.emplace_back(part.begin(), middle);
    open.emplace_back(middle, part.end());
    for (const std::size_t place : part)
    {
      std::erase_if(within[place], [&](std::size_t other) { return low(other) != low(place); });
    }
  }
  return parts;
}

} // namespace smokevis
