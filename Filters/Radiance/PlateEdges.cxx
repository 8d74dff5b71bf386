#include "PlateEdges.h"

#include <algorithm>

namespace smokevis
{

namespace
{

constexpr double SmallestBlock = 1.0 / 512.0;
constexpr std::size_t MostBlocks = 1024;
/// How far inside the plate its ends are looked at.
constexpr double Inside = 1e-3;

double Middle(const std::vector<double>& ends, std::size_t block)
{
  return 0.5 * (ends[block] + ends[block + 1]);
}

/// Where blocks are looked at: near the plate's end, in their middles and near the other end.
std::vector<double> Places(const std::vector<double>& ends)
{
  std::vector<double> places = {Inside};
  for (std::size_t block = 0; block + 1 < ends.size(); ++block)
  {
    places.push_back(Middle(ends, block));
  }
  places.push_back(1.0 - Inside);
  return places;
}

/// Halves marked blocks that are not the smallest yet; returns whether there are any.
bool Halve(const std::vector<bool>& marked, std::vector<double>& ends)
{
  std::vector<double> halved = {ends.front()};
  for (std::size_t block = 0; block + 1 < ends.size(); ++block)
  {
    if (marked[block] && ends[block + 1] - ends[block] > SmallestBlock)
    {
      halved.push_back(Middle(ends, block));
    }
    halved.push_back(ends[block + 1]);
  }
  const bool any = halved.size() > ends.size();
  ends = std::move(halved);
  return any;
}

} // namespace

void HalveAtEdges(PlateBorders& borders, const std::function<bool(const glm::dvec2&)>& shows)
{
  for (bool any = true; any;)
  {
    const std::array<std::vector<double>, 2> places = {Places(borders[0]), Places(borders[1])};
    const std::size_t columns = places[0].size();
    const std::size_t rows = places[1].size();
    std::vector<bool> shown(columns * rows);
    for (std::size_t place = 0; place < shown.size(); ++place)
    {
      shown[place] = shows({places[0][place % columns], places[1][place / columns]});
    }
    std::array<std::vector<bool>, 2> marked = {
      std::vector<bool>(columns - 2, false), std::vector<bool>(rows - 2, false)};
    const auto mark = [&](int axis, std::size_t first)
    {
      std::vector<bool>& blocks = marked[axis];
      blocks[first == 0 ? 0 : first - 1] = true;
      blocks[std::min(first, blocks.size() - 1)] = true;
    };
    for (std::size_t place = 0; place < shown.size(); ++place)
    {
      const std::size_t column = place % columns;
      const std::size_t row = place / columns;
      if (column + 1 < columns && shown[place] != shown[place + 1])
      {
        mark(0, column);
      }
      if (row + 1 < rows && shown[place] != shown[place + columns])
      {
        mark(1, row);
      }
    }
    PlateBorders halved = borders;
    const bool columnsHalved = Halve(marked[0], halved[0]);
    const bool rowsHalved = Halve(marked[1], halved[1]);
    any = (columnsHalved || rowsHalved) &&
          (halved[0].size() - 1) * (halved[1].size() - 1) <= MostBlocks;
    if (any)
    {
      borders = std::move(halved);
    }
  }
}

std::vector<std::size_t> BlocksBefore(
  const std::vector<double>& before, const std::vector<double>& halved)
{
  std::vector<std::size_t> blocks;
  for (std::size_t block = 0; block + 1 < halved.size(); ++block)
  {
    blocks.push_back(static_cast<std::size_t>(
      std::upper_bound(before.begin() + 1, before.end() - 1, Middle(halved, block)) -
      (before.begin() + 1)));
  }
  return blocks;
}

} // namespace smokevis
