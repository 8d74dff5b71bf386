#include "PlateEdges.h"

#include <algorithm>
#include <cmath>

namespace smokevis
{

namespace
{

constexpr double SmallestBlock = 1.0 / 512.0;
constexpr std::size_t MostBlocks = 1024;
/// How far inside the plate its ends are looked at.
constexpr double Inside = 1e-3;
/// Places that are looked at all over, and steps from row to row of the raster that they are in:
/// about the golden section of their number, and prime to it.
constexpr int Looks = 128;
constexpr int RowStep = 79;
constexpr std::size_t MostOdd = 6;
/// Places along each edge of a block that what hides the plate begins in.
constexpr int PlacesInBlock = 4;

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

/// Halves marked blocks that are not the smallest yet.
std::vector<double> Halved(const std::vector<bool>& marked, const std::vector<double>& ends)
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
  return halved;
}

/// Gives a place a narrow block of its own, with the place in the middle.
void AddBlock(std::vector<double>& ends, double place)
{
  const std::vector<double> before = ends;
  for (const double end : {place - 0.25 / Looks, place + 0.25 / Looks})
  {
    const bool near = std::any_of(before.begin(), before.end(),
      [end](double other) { return std::abs(other - end) < 0.5 * SmallestBlock; });
    if (!near && end > 0.0 && end < 1.0)
    {
      ends.insert(std::upper_bound(ends.begin(), ends.end(), end), end);
    }
  }
}

std::size_t Blocks(const PlateBorders& borders)
{
  return (borders[0].size() - 1) * (borders[1].size() - 1);
}

/// Blocks along an edge between whose middles what hides the plate begins, and how often it does.
struct Marks
{
  std::vector<bool> Blocks;
  std::size_t Count = 0;
};

std::array<Marks, 2> MarkEdges(const PlateBorders& borders, const PlateLook& look)
{
  const std::array<std::vector<double>, 2> places = {Places(borders[0]), Places(borders[1])};
  const std::size_t columns = places[0].size();
  const std::size_t rows = places[1].size();
  std::vector<PlateSight> sights(columns * rows);
  for (std::size_t place = 0; place < sights.size(); ++place)
  {
    sights[place] = look({places[0][place % columns], places[1][place / columns]});
  }
  std::array<Marks, 2> marks = {
    Marks{std::vector<bool>(columns - 2, false)}, Marks{std::vector<bool>(rows - 2, false)}};
  const auto compare = [](Marks& own, std::size_t index, PlateSight a, PlateSight b)
  {
    if (a != b && a != PlateSight::Nothing && b != PlateSight::Nothing)
    {
      own.Blocks[index == 0 ? 0 : index - 1] = true;
      own.Blocks[std::min(index, own.Blocks.size() - 1)] = true;
      ++own.Count;
    }
  };
  for (std::size_t place = 0; place < sights.size(); ++place)
  {
    const std::size_t column = place % columns;
    const std::size_t row = place / columns;
    if (column + 1 < columns)
    {
      compare(marks[0], column, sights[place], sights[place + 1]);
    }
    if (row + 1 < rows)
    {
      compare(marks[1], row, sights[place], sights[place + columns]);
    }
  }
  return marks;
}

} // namespace

std::vector<glm::dvec2> OddPlaces(const PlateLook& look)
{
  std::vector<glm::dvec2> seen;
  std::vector<glm::dvec2> hidden;
  std::vector<glm::dvec2> places = {
    {Inside, Inside}, {1.0 - Inside, Inside}, {1.0 - Inside, 1.0 - Inside}, {Inside, 1.0 - Inside}};
  for (int i = 0; i < Looks; ++i)
  {
    places.emplace_back((i + 0.5) / Looks, (i * RowStep % Looks + 0.5) / Looks);
  }
  for (const glm::dvec2& place : places)
  {
    const PlateSight sight = look(place);
    if (sight != PlateSight::Nothing)
    {
      (sight == PlateSight::Seen ? seen : hidden).push_back(place);
    }
  }
  std::vector<glm::dvec2>& odd = seen.size() < hidden.size() ? seen : hidden;
  odd.resize(std::min(odd.size(), MostOdd));
  return odd;
}

void HalveAtEdges(PlateBorders& borders, const std::vector<glm::dvec2>& odd, const PlateLook& look)
{
  for (const glm::dvec2& place : odd)
  {
    AddBlock(borders[0], place.x);
    AddBlock(borders[1], place.y);
  }
  for (bool any = true; any;)
  {
    const std::array<Marks, 2> marks = MarkEdges(borders, look);
    const PlateBorders both = {
      Halved(marks[0].Blocks, borders[0]), Halved(marks[1].Blocks, borders[1])};
    const PlateBorders columns = {both[0], borders[1]};
    const PlateBorders rows = {borders[0], both[1]};
    // An edge is met across, not along it.
    const PlateBorders& one = marks[0].Count > marks[1].Count ? columns : rows;
    any = false;
    for (const PlateBorders* const finer : {&both, &one})
    {
      if (Blocks(*finer) > Blocks(borders) && Blocks(*finer) <= MostBlocks)
      {
        borders = PlateBorders(*finer);
        any = true;
        break;
      }
    }
  }
}

std::vector<double> SeenShares(const PlateBorders& borders, const PlateLook& look)
{
  const std::size_t columns = borders[0].size() - 1;
  const std::size_t rows = borders[1].size() - 1;
  std::vector<PlateSight> sights(columns * rows);
  for (std::size_t block = 0; block < sights.size(); ++block)
  {
    sights[block] =
      look({Middle(borders[0], block % columns), Middle(borders[1], block / columns)});
  }
  const auto alike = [&](std::size_t block)
  {
    const std::size_t column = block % columns;
    const std::size_t row = block / columns;
    for (std::size_t j = row > 0 ? row - 1 : 0; j < std::min(rows, row + 2); ++j)
    {
      for (std::size_t i = column > 0 ? column - 1 : 0; i < std::min(columns, column + 2); ++i)
      {
        if (sights[i + j * columns] != sights[block])
        {
          return false;
        }
      }
    }
    return sights[block] != PlateSight::Nothing;
  };
  std::vector<double> shares;
  for (std::size_t block = 0; block < sights.size(); ++block)
  {
    if (alike(block))
    {
      shares.push_back(sights[block] == PlateSight::Seen ? 1.0 : 0.0);
      continue;
    }
    const std::array<std::size_t, 2> at = {block % columns, block / columns};
    const auto place = [&](int axis, int index)
    {
      const double low = borders[axis][at[axis]];
      return low + (index + 0.5) / PlacesInBlock * (borders[axis][at[axis] + 1] - low);
    };
    double seen = 0.0;
    double all = 0.0;
    for (int i = 0; i < PlacesInBlock * PlacesInBlock; ++i)
    {
      const PlateSight sight = look({place(0, i % PlacesInBlock), place(1, i / PlacesInBlock)});
      seen += sight == PlateSight::Seen ? 1.0 : 0.0;
      all += sight == PlateSight::Nothing ? 0.0 : 1.0;
    }
    shares.push_back(all > 0.0 ? seen / all : 0.0);
  }
  return shares;
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
