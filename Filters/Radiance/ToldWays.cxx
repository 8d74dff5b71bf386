#include "ToldWays.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace smokevis
{

namespace
{

constexpr double Unknown = std::numeric_limits<double>::quiet_NaN();
/// Where ways are looked at: along a diagonal that winds around the block, and so passes through
/// each layer of cells across each axis: a gap between layers of smoke may be one cell thick. Where
/// it begins, as shares of the block's edges, and which way it runs.
constexpr std::array<double, 3> DiagonalBegin = {0.5, 0.25, 0.75};
constexpr std::array<int, 3> DiagonalStep = {1, 1, -1};

/// The cell of a block so many steps along the diagonal.
std::array<int, 3> PlaceOnDiagonal(const Medium::Block& block, int steps)
{
  std::array<int, 3> place;
  for (int axis = 0; axis < 3; ++axis)
  {
    const int size = block.Size[axis];
    const int begin = static_cast<int>(DiagonalBegin[axis] * size);
    place[axis] = ((begin + DiagonalStep[axis] * steps) % size + size) % size;
  }
  return place;
}

/// Value at a place of a block between those at its corners, first axis fastest.
double Trilinear(
  const std::array<double, 8>& corners, const Medium::Block& block, const std::array<int, 3>& place)
{
  Vec3 share(0.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    share[axis] =
      block.Size[axis] > 1 ? static_cast<double>(place[axis]) / (block.Size[axis] - 1) : 0.0;
  }
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner)
  {
    sum += corners[corner] * (corner & 1 ? share.x : 1.0 - share.x) *
           (corner & 2 ? share.y : 1.0 - share.y) * (corner & 4 ? share.z : 1.0 - share.z);
  }
  return sum;
}

} // namespace

ToldWays::ToldWays(const Medium& smoke, const LightWays& ways, const Medium::Block& block)
    : Smoke_(smoke), Ways_(ways), Block_(block), Extinction_(block.Cells(), Unknown)
{
}

std::array<int, 3> ToldWays::Corner(int index) const
{
  const std::array<int, 3>& size = this->Block_.Size;
  return {index & 1 ? size[0] - 1 : 0, index & 2 ? size[1] - 1 : 0, index & 4 ? size[2] - 1 : 0};
}

double ToldWays::Walk(const std::array<int, 3>& place)
{
  double& extinction = this->Extinction_[this->Block_.Number(place)];
  if (std::isnan(extinction))
  {
    extinction = this->Ways_.Extinction(this->Block_, place);
  }
  return extinction;
}

double ToldWays::Depth(double extinction, double distance) const
{
  return std::abs(extinction) * distance * this->Ways_.Scale();
}

bool ToldWays::WalkCorners()
{
  bool serves = this->Block_.LongestEdge() >= SmallestBlock;
  for (int index = 0; index < 8 && serves; ++index)
  {
    this->Own_[index] =
      this->Smoke_.Extinction(this->Smoke_.Cell(this->Block_, this->Corner(index)));
    serves = this->Own_[index] > 0.0 || this->Smoke_.MaximumExtinction() == 0.0F;
    this->Corners_[index] = serves ? this->Walk(this->Corner(index)) : 0.0;
  }
  return serves;
}

bool ToldWays::CornersTell(double allowed)
{
  bool told = true;
  for (int i = 0; i < this->Block_.LongestEdge() && told; ++i)
  {
    const std::array<int, 3> place = PlaceOnDiagonal(this->Block_, i);
    const double interpolated = Trilinear(this->Corners_, this->Block_, place);
    const std::int64_t cell = this->Smoke_.Cell(this->Block_, place);
    const double way = glm::length(this->Ways_.Light().Centre - this->Smoke_.CellCentre(cell));
    told = this->Depth(interpolated - this->Walk(place), way) <= allowed;
  }
  return told;
}

bool ToldWays::TellRest(const std::vector<bool>& asked, double odd)
{
  const double edge =
    LargestEdge(this->Smoke_.CellSize(this->Smoke_.Cell(this->Block_, {0, 0, 0})));
  bool any = false;
  this->Block_.ForEachCell(
    [&](const std::array<int, 3>& place)
    {
      const std::int64_t cell = this->Smoke_.Cell(this->Block_, place);
      const std::size_t number = this->Block_.Number(place);
      const double own = Trilinear(this->Own_, this->Block_, place);
      if (this->Depth(this->Smoke_.Extinction(cell) - own, edge) > odd)
      {
        if (asked[number])
        {
          this->Walk(place);
          any = true;
        }
        return;
      }
      double& extinction = this->Extinction_[number];
      const bool told = asked[number] && std::isnan(extinction);
      this->Told_ += told && !this->Smoke_.Parts().Find(cell) ? 1 : 0;
      extinction = Trilinear(this->Corners_, this->Block_, place);
    });
  return any;
}

void ToldWays::Walk(const std::vector<bool>& asked)
{
  this->Block_.ForEachCell(
    [&](const std::array<int, 3>& place)
    {
      if (asked[this->Block_.Number(place)])
      {
        this->Walk(place);
      }
    });
}

double ToldWays::Least() const
{
  // NaN is less than nothing.
  return std::accumulate(this->Extinction_.begin(), this->Extinction_.end(),
    std::numeric_limits<double>::infinity(),
    [](double least, double value) { return value < least ? value : least; });
}

} // namespace smokevis
