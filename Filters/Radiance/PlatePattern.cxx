#include "PlatePattern.h"

#include "PolygonClip.h"

#include <algorithm>
#include <cmath>

namespace smokevis
{

namespace
{

constexpr std::size_t MostPlaces = 4;

/// Pieces of an axis that an interval touches.
std::pair<std::size_t, std::size_t> Range(const std::vector<double>& ends, double low, double high)
{
  const auto first = std::upper_bound(ends.begin() + 1, ends.end() - 1, low);
  const auto last = std::lower_bound(first, ends.end() - 1, high);
  return {first - ends.begin() - 1, last - ends.begin()};
}

void AddTo(PatternVector& sum, const PatternVector& value, double weight)
{
  for (int i = 0; i < PatternValues; ++i)
  {
    sum[i] += weight * value[i];
  }
}

} // namespace

PatternAxis::PatternAxis(const std::vector<double>& borders, int pixels)
{
  const std::size_t blocks = borders.size() - 1;
  if (pixels == 0)
  {
    this->Ends = borders;
    for (std::size_t i = 0; i < blocks; ++i)
    {
      this->Block.push_back(i);
      this->Pixel.push_back(0);
    }
  }
  else if (static_cast<std::size_t>(pixels) >= 2 * blocks)
  {
    // Whole pixels to each block.
    this->Ends.push_back(0.0);
    for (std::size_t block = 0; block < blocks; ++block)
    {
      const auto last = static_cast<int>(std::lround(borders[block + 1] * pixels));
      for (int pixel = static_cast<int>(this->Pixel.size()); pixel < last; ++pixel)
      {
        this->Ends.push_back((pixel + 1.0) / pixels);
        this->Block.push_back(block);
        this->Pixel.push_back(pixel);
      }
    }
  }
  else
  {
    // Whole blocks to each pixel, no wider than they were.
    this->Fine = false;
    const auto parts = static_cast<int>((blocks + pixels - 1) / pixels);
    this->Ends.push_back(0.0);
    for (int block = 0; block < parts * pixels; ++block)
    {
      this->Ends.push_back((block + 1.0) / (parts * pixels));
      this->Block.push_back(block);
      this->Pixel.push_back(block / parts);
    }
  }
  this->Blocks = this->Block.back() + 1;
  this->Pixels = std::max(1, pixels);
}

std::vector<double> PatternAxis::Borders() const
{
  std::vector<double> borders(this->Blocks + 1, this->Ends.front());
  for (std::size_t piece = 0; piece < this->Block.size(); ++piece)
  {
    std::fill(borders.begin() + static_cast<std::ptrdiff_t>(this->Block[piece]) + 1, borders.end(),
      this->Ends[piece + 1]);
  }
  return borders;
}

PlatePattern::PlatePattern(
  const std::vector<PatternCell>& cells, const PatternAxis& across, const PatternAxis& up)
    : Fine_(across.Fine && up.Fine), Blocks_(across.Blocks * up.Blocks)
{
  // Where places are told apart one by one, the cells are the pixels.
  const bool places = across.Pixels == 1 && up.Pixels == 1 && this->Fine_;
  const std::size_t columns = across.Block.size();
  const std::size_t rows = up.Block.size();
  std::vector<PatternVector> sums(places ? 0 : columns * rows);
  FlatPolygon strip, piece;
  // The part of one cell in each block: its area, and its centre times that.
  std::vector<double> areas(this->Blocks_.size(), 0.0);
  std::vector<glm::dvec2> centres(this->Blocks_.size());
  std::vector<std::size_t> touched;
  for (std::size_t number = 0; number < cells.size(); ++number)
  {
    const PatternCell& cell = cells[number];
    touched.clear();
    glm::dvec2 low = cell.Corners[0];
    glm::dvec2 high = cell.Corners[0];
    for (const glm::dvec2& corner : cell.Corners)
    {
      low = glm::min(low, corner);
      high = glm::max(high, corner);
    }
    const auto [firstRow, lastRow] = Range(up.Ends, low.y, high.y);
    for (std::size_t row = firstRow; row < lastRow; ++row)
    {
      KeepStrip(cell.Corners, 1, up.Ends[row], up.Ends[row + 1], strip);
      if (strip.size() < 3)
      {
        continue;
      }
      double left = strip[0].x;
      double right = strip[0].x;
      for (const glm::dvec2& corner : strip)
      {
        left = std::min(left, corner.x);
        right = std::max(right, corner.x);
      }
      const auto [firstColumn, lastColumn] = Range(across.Ends, left, right);
      for (std::size_t column = firstColumn; column < lastColumn; ++column)
      {
        KeepStrip(strip, 0, across.Ends[column], across.Ends[column + 1], piece);
        const double area = AreaOf(piece);
        if (!(area > 0.0))
        {
          continue;
        }
        const std::size_t index = across.Block[column] + up.Block[row] * across.Blocks;
        PatternBlock& block = this->Blocks_[index];
        AddTo(block.Sum, cell.Value, area);
        AddTo(block.LitSum, cell.Value, cell.Lit ? area : 0.0);
        if (areas[index] == 0.0)
        {
          touched.push_back(index);
          centres[index] = glm::dvec2(0.0);
        }
        areas[index] += area;
        centres[index] += area * MiddleOf(piece);
        if (places)
        {
          PatternVector sum{};
          AddTo(sum, cell.Value, area);
          this->AddProducts(index, sum);
        }
        else
        {
          AddTo(sums[column + row * columns], cell.Value, area);
        }
      }
    }
    for (const std::size_t index : touched)
    {
      this->AddPlace(index, {centres[index] / areas[index], areas[index], number});
      areas[index] = 0.0;
    }
  }
  for (std::size_t row = 0; row < rows && !places; ++row)
  {
    for (std::size_t column = 0; column < columns; ++column)
    {
      const PatternVector& sum = sums[column + row * columns];
      if (!(sum[0] > 0.0))
      {
        continue;
      }
      const std::size_t block = across.Block[column] + up.Block[row] * across.Blocks;
      if (this->Fine_)
      {
        this->AddProducts(block, sum);
      }
      else
      {
        this->Pieces_.push_back({block, across.Pixel[column] + up.Pixel[row] * across.Pixels, sum});
      }
    }
  }
  std::stable_sort(this->Pieces_.begin(), this->Pieces_.end(),
    [](const PatternPiece& a, const PatternPiece& b) { return a.Pixel < b.Pixel; });
}

void PlatePattern::AddPlace(std::size_t block, const PatternPlace& place)
{
  std::vector<PatternPlace>& places = this->Blocks_[block].Places;
  const auto before = std::find_if(places.begin(), places.end(),
    [&place](const PatternPlace& other) { return other.Area < place.Area; });
  places.insert(before, place);
  if (places.size() > MostPlaces)
  {
    places.pop_back();
  }
}

void PlatePattern::AddProducts(std::size_t block, const PatternVector& sum)
{
  auto& products = this->Blocks_[block].Products;
  for (int i = 0; i < PatternValues; ++i)
  {
    for (int j = 0; j <= i; ++j)
    {
      products[i][j] += sum[i] * sum[j] / sum[0];
    }
  }
}

} // namespace smokevis
