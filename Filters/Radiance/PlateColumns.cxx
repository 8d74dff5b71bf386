#include "PlateColumns.h"

#include "GaussNodes.h"

#include <algorithm>

namespace smokevis
{

namespace
{

/// Columns of a sign's pattern that are told apart; a finer pattern glows as one.
constexpr std::size_t MostColumns = 16;

std::vector<double> BordersOf(const EmitterSet& lights, const Sign& sign, int edge)
{
  std::vector<double> borders;
  for (const std::size_t cell : sign.Cells)
  {
    for (const Vec3& vertex : lights.Cells()[cell].Vertices)
    {
      borders.push_back(PlaceOnPlate(sign, vertex)[edge]);
    }
  }
  return borders;
}

} // namespace

PlateColumns::PlateColumns(std::vector<double> borders)
{
  std::sort(borders.begin(), borders.end());
  for (const double border : borders)
  {
    if (this->Ends.empty() || border - this->Ends.back() > 1e-6)
    {
      this->Ends.push_back(border);
    }
  }
  if (this->Ends.size() > MostColumns + 1)
  {
    this->Ends = {0.0, 1.0};
  }
  this->Widest = 0.0;
  for (std::size_t i = 1; i < this->Ends.size(); ++i)
  {
    this->Widest = std::max(this->Widest, this->Ends[i] - this->Ends[i - 1]);
  }
}

PlateColumns::PlateColumns(const EmitterSet& lights, const Sign& sign, int edge)
    : PlateColumns(BordersOf(lights, sign, edge))
{
}

std::size_t PlateColumns::Of(double t) const
{
  return std::upper_bound(this->Ends.begin() + 1, this->Ends.end() - 1, t) -
         (this->Ends.begin() + 1);
}

double PlateColumns::Node(std::size_t column, int index) const
{
  const double width = this->Ends[column + 1] - this->Ends[column];
  return this->Ends[column] + width * Nodes2[index];
}

double PlateColumns::Between(std::size_t column, double t) const
{
  const double first = this->Node(column, 0);
  return (t - first) / (this->Node(column, 1) - first);
}

PlateColumns PlateColumns::DividedAt(const std::vector<double>& borders) const
{
  PlateColumns divided = *this;
  divided.Ends.insert(divided.Ends.end(), borders.begin(), borders.end());
  std::sort(divided.Ends.begin(), divided.Ends.end());
  return divided;
}

PlateColumns PlateColumns::Halved() const
{
  std::vector<double> middles;
  for (std::size_t i = 1; i < this->Ends.size(); ++i)
  {
    middles.push_back(0.5 * (this->Ends[i - 1] + this->Ends[i]));
  }
  return this->DividedAt(middles);
}

std::vector<PlateColumns::Piece> PlateColumns::PiecesOf(double middle, double length) const
{
  const double begin = middle - 0.5 * length;
  const double end = middle + 0.5 * length;
  std::vector<Piece> pieces;
  for (std::size_t column = this->Of(begin); column < this->Count(); ++column)
  {
    const double first = pieces.empty() ? begin : this->Ends[column];
    const double last = column + 1 < this->Count() ? std::min(end, this->Ends[column + 1]) : end;
    if (last > first || pieces.empty())
    {
      pieces.push_back({column, length > 0.0 ? (last - first) / length : 1.0, first, last});
    }
    if (!(end > last))
    {
      break;
    }
  }
  return pieces;
}

Vec3 OnPlate(const Sign& sign, double u, double v)
{
  return sign.Corners[0] + u * (sign.Corners[1] - sign.Corners[0]) +
         v * (sign.Corners[3] - sign.Corners[0]);
}

glm::dvec2 PlaceOnPlate(const Sign& sign, const Vec3& point)
{
  const Vec3 u = sign.Corners[1] - sign.Corners[0];
  const Vec3 v = sign.Corners[3] - sign.Corners[0];
  const Vec3 from = point - sign.Corners[0];
  return {glm::dot(from, u) / glm::dot(u, u), glm::dot(from, v) / glm::dot(v, v)};
}

} // namespace smokevis
