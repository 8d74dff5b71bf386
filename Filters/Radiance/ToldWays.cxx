#include "ToldWays.h"

#include "BlockCorners.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace smokevis
{

namespace
{

constexpr double Unknown = std::numeric_limits<double>::quiet_NaN();

} // namespace

ToldWays::ToldWays(const Medium& smoke, const LightWays& ways, const Medium::Block& block)
    : Smoke_(smoke), Ways_(ways), Block_(block), Extinction_(block.Cells(), Unknown)
{
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
      this->Smoke_.Extinction(this->Smoke_.Cell(this->Block_, CornerOf(this->Block_, index)));
    serves = this->Own_[index] > 0.0 || this->Smoke_.MaximumExtinction() == 0.0F;
    this->Corners_[index] = serves ? this->Walk(CornerOf(this->Block_, index)) : 0.0;
  }
  return serves;
}

bool ToldWays::CornersTell(double allowed)
{
  bool told = true;
  for (int i = 0; i < this->Block_.LongestEdge() && told; ++i)
  {
    const std::array<int, 3> place = PlaceOnDiagonal(this->Block_, i);
    const double interpolated = BetweenCorners(this->Corners_, this->Block_, place);
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
      const double own = BetweenCorners(this->Own_, this->Block_, place);
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
      extinction = BetweenCorners(this->Corners_, this->Block_, place);
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
