// Adaptive interpolation of the veil over the pixels of an image.
#include "VeilBlock.h"

#include <algorithm>
#include <cmath>

namespace smokevis
{
namespace
{

/// Pixels along the side of the largest tiles that are interpolated.
constexpr int LargestTile = 8;
/// Relative departure of the veil, and departure of the optical depth, of the middle of a tile's
/// side from the mean of its ends. The parabola through all three is several times closer than
/// that.
constexpr double Tolerance = 4e-3;
/// Relative departure from a plane, far below what the veil would notice.
constexpr double PlaneTolerance = 1e-4;

double Share(int first, int second, int value)
{
  return second == first ? 0.0 : static_cast<double>(value - first) / (second - first);
}

/// Lagrange's weights at a place of three nodes, of which neighbours may coincide.
std::array<double, 3> Parabola(int first, int middle, int last, int place)
{
  if (first == middle || middle == last)
  {
    const double share = Share(first, last, place);
    return {1.0 - share, 0.0, share};
  }
  const double x = place, a = first, b = middle, c = last;
  return {(x - b) * (x - c) / ((a - b) * (a - c)), (x - a) * (x - c) / ((b - a) * (b - c)),
    (x - a) * (x - b) / ((c - a) * (c - b))};
}

void Add(RayLight& sum, const RayLight& term, double weight)
{
  sum.VeilDirect += weight * term.VeilDirect;
  sum.OpticalDepth += weight * term.OpticalDepth;
  Add(sum.VeilMultiple, term.VeilMultiple, static_cast<float>(weight));
}

} // namespace

//------------------------------------------------------------------------------
VeilBlock::VeilBlock(const View& view, const Camera& camera, int x, int y, int columns, int rows)
    : View_(view), Camera_(camera), X_(x), Y_(y), Columns_(columns), Rows_(rows),
      Bands_(view.TheScene().Bands()), Pixels_(static_cast<std::size_t>(columns) * rows)
{
}

//------------------------------------------------------------------------------
Vec3 VeilBlock::Direction(int column, int row) const
{
  return this->Camera_.Direction(this->X_ + column + 0.5, this->Y_ + row + 0.5);
}

//------------------------------------------------------------------------------
void VeilBlock::SetDistance(int column, int row, double distance)
{
  Pixel& pixel = this->At(column, row);
  pixel.Distance = distance;
  pixel.InverseDepth =
    1.0 / (distance * glm::dot(this->Direction(column, row), this->Camera_.Forward));
}

//------------------------------------------------------------------------------
void VeilBlock::Compute()
{
  for (int bottom = 0; bottom < std::max(1, this->Rows_ - 1); bottom += LargestTile)
  {
    for (int left = 0; left < std::max(1, this->Columns_ - 1); left += LargestTile)
    {
      this->ComputeTile({left, bottom, std::min(left + LargestTile, this->Columns_ - 1),
        std::min(bottom + LargestTile, this->Rows_ - 1)});
    }
  }
}

//------------------------------------------------------------------------------
void VeilBlock::Trace(int column, int row)
{
  Pixel& pixel = this->At(column, row);
  if (pixel.Traced)
  {
    return;
  }
  const Vec3 direction = this->Direction(column, row);
  for (int band = 0; band < this->Bands_; ++band)
  {
    pixel.Veil[band] =
      this->View_.TraceVeil(this->Camera_.Position, direction, 0.0, pixel.Distance, band);
  }
  pixel.Traced = true;
}

//------------------------------------------------------------------------------
void VeilBlock::ComputeTile(const Tile& tile)
{
  const int column = (tile.Left + tile.Right) / 2;
  const int row = (tile.Bottom + tile.Top) / 2;
  for (const int i : {tile.Left, column, tile.Right})
  {
    for (const int j : {tile.Bottom, row, tile.Top})
    {
      this->Trace(i, j);
    }
  }
  if (tile.Right - tile.Left <= 2 && tile.Top - tile.Bottom <= 2)
  {
    return;
  }
  const double u = Share(tile.Left, tile.Right, column);
  const double v = Share(tile.Bottom, tile.Top, row);
  const bool smooth = this->ShowsOnePlane(tile) &&
                      this->Foretells(this->At(tile.Left, tile.Bottom),
                        this->At(tile.Right, tile.Bottom), u, this->At(column, tile.Bottom)) &&
                      this->Foretells(this->At(tile.Left, tile.Top), this->At(tile.Right, tile.Top),
                        u, this->At(column, tile.Top)) &&
                      this->Foretells(this->At(tile.Left, tile.Bottom),
                        this->At(tile.Left, tile.Top), v, this->At(tile.Left, row)) &&
                      this->Foretells(this->At(tile.Right, tile.Bottom),
                        this->At(tile.Right, tile.Top), v, this->At(tile.Right, row)) &&
                      this->Foretells(this->At(tile.Left, row), this->At(tile.Right, row), u,
                        this->At(column, row)) &&
                      this->Foretells(this->At(column, tile.Bottom), this->At(column, tile.Top), v,
                        this->At(column, row));
  if (smooth)
  {
    this->Fill(tile, column, row);
    return;
  }
  for (const Tile& quarter :
    {Tile{tile.Left, tile.Bottom, column, row}, Tile{column, tile.Bottom, tile.Right, row},
      Tile{tile.Left, row, column, tile.Top}, Tile{column, row, tile.Right, tile.Top}})
  {
    this->ComputeTile(quarter);
  }
}

//------------------------------------------------------------------------------
bool VeilBlock::ShowsOnePlane(const Tile& tile) const
{
  const auto at = [this](int column, int row)
  { return this->Pixels_[this->Index(column, row)].InverseDepth; };
  for (int row = tile.Bottom; row <= tile.Top; ++row)
  {
    const double v = Share(tile.Bottom, tile.Top, row);
    const double left = glm::mix(at(tile.Left, tile.Bottom), at(tile.Left, tile.Top), v);
    const double right = glm::mix(at(tile.Right, tile.Bottom), at(tile.Right, tile.Top), v);
    for (int column = tile.Left; column <= tile.Right; ++column)
    {
      const double expected = glm::mix(left, right, Share(tile.Left, tile.Right, column));
      if (!(std::abs(at(column, row) - expected) <= PlaneTolerance * expected))
      {
        return false;
      }
    }
  }
  return true;
}

//------------------------------------------------------------------------------
bool VeilBlock::Foretells(
  const Pixel& first, const Pixel& second, double weight, const Pixel& truth) const
{
  for (int band = 0; band < this->Bands_; ++band)
  {
    const RayLight& from = first.Veil[band];
    const RayLight& to = second.Veil[band];
    const double veil = truth.Veil[band].Veil();
    const double depth = truth.Veil[band].OpticalDepth;
    if (!(std::abs(glm::mix(from.Veil(), to.Veil(), weight) - veil) <= Tolerance * veil &&
          std::abs(glm::mix(from.OpticalDepth, to.OpticalDepth, weight) - depth) <= Tolerance))
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
void VeilBlock::Fill(const Tile& tile, int middleColumn, int middleRow)
{
  const std::array<int, 3> columns = {tile.Left, middleColumn, tile.Right};
  const std::array<int, 3> rows = {tile.Bottom, middleRow, tile.Top};
  for (int row = tile.Bottom; row <= tile.Top; ++row)
  {
    const auto v = Parabola(rows[0], rows[1], rows[2], row);
    for (int column = tile.Left; column <= tile.Right; ++column)
    {
      Pixel& pixel = this->At(column, row);
      if (pixel.Traced)
      {
        continue;
      }
      const auto u = Parabola(columns[0], columns[1], columns[2], column);
      pixel.Veil = Smoke();
      for (int node = 0; node < 9; ++node)
      {
        const Pixel& from = this->At(columns[node % 3], rows[node / 3]);
        for (int band = 0; band < this->Bands_; ++band)
        {
          Add(pixel.Veil[band], from.Veil[band], u[node % 3] * v[node / 3]);
        }
      }
    }
  }
}

} // namespace smokevis
