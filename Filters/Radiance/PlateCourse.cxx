#include "PlateCourse.h"

#include "PlateColumns.h"
#include "Triangle.h"

#include <algorithm>
#include <cmath>

namespace smokevis
{

namespace
{

/// So many times the variance of its noise must light vary by.
constexpr double NoiseLeftOut = 2.0;

double Weight(std::size_t place)
{
  return Weights3[place % Weights3.size()] * Weights3[place / Weights3.size()];
}

/// Weights of the places in the mean over a polygon.
std::array<double, PlateCourse::Places> WeightsIn(
  const std::vector<Vec3>& polygon, const Sign& sign)
{
  std::array<double, PlateCourse::Places> weights{};
  double area = 0.0;
  for (std::size_t corner = 1; corner + 1 < polygon.size(); ++corner)
  {
    const Triangle part = {polygon[0], polygon[corner], polygon[corner + 1]};
    area += AreaOf(part);
    // The middles of its edges stand for a triangle: exact for polynomials of degree 2.
    for (std::size_t edge = 0; edge < part.size(); ++edge)
    {
      const glm::dvec2 middle =
        PlaceOnPlate(sign, 0.5 * (part[edge] + part[(edge + 1) % part.size()]));
      const auto across = QuadraticWeights(middle.x);
      const auto up = QuadraticWeights(middle.y);
      for (std::size_t place = 0; place < weights.size(); ++place)
      {
        weights[place] +=
          AreaOf(part) / 3.0 * across[place % across.size()] * up[place / across.size()];
      }
    }
  }
  for (double& weight : weights)
  {
    // Of a polygon that is none nothing is known.
    weight = area > 0.0 ? weight / area : 0.0;
  }
  return weights;
}

} // namespace

Vec3 PlateCourse::Place(const Sign& sign, std::size_t place)
{
  return OnPlate(sign, Nodes3[place % Nodes3.size()], Nodes3[place / Nodes3.size()]);
}

PlateCourse::PlateCourse(const std::array<DoubleLanes, Places>& light)
{
  for (int batch = 0; batch < Batches; ++batch)
  {
    double mean = 0.0;
    for (std::size_t place = 0; place < Places; ++place)
    {
      mean += Weight(place) * light[place][batch];
    }
    for (std::size_t place = 0; place < Places && mean > 0.0; ++place)
    {
      this->Excess_[place][batch] = light[place][batch] / mean - 1.0;
    }
  }
  double variance = 0.0;
  double noise = 0.0;
  for (std::size_t place = 0; place < Places; ++place)
  {
    variance += Weight(place) * std::pow(Mean(this->Excess_[place]), 2);
    noise += Weight(place) * std::pow(StandardError(this->Excess_[place]), 2);
  }
  const double kept = variance > 0.0 ? std::max(0.0, 1.0 - NoiseLeftOut * noise / variance) : 0.0;
  for (DoubleLanes& excess : this->Excess_)
  {
    for (double& value : excess)
    {
      value *= kept;
    }
  }
}

std::vector<PlateCourse::CellLight> PlateCourse::Cells(
  const EmitterSet& lights, const Sign& sign) const
{
  std::vector<CellLight> cells;
  DoubleLanes whole{};
  for (const std::size_t cell : sign.Cells)
  {
    const auto weights = WeightsIn(lights.Cells()[cell].Vertices, sign);
    DoubleLanes& share = cells.emplace_back().Share;
    for (int batch = 0; batch < Batches; ++batch)
    {
      share[batch] = 1.0;
      for (std::size_t place = 0; place < Places; ++place)
      {
        share[batch] += weights[place] * this->Excess_[place][batch];
      }
      // Towards the edges a quadratic goes on beyond its places.
      share[batch] = std::max(0.0, share[batch]);
      whole[batch] += lights.CellArea(cell) * share[batch];
    }
    if (const double mean = Mean(share); mean > 0.0)
    {
      cells.back().Gradient = this->GradientAt(lights.CellCentre(cell), sign) / mean;
    }
  }
  double area = 0.0;
  for (const std::size_t cell : sign.Cells)
  {
    area += lights.CellArea(cell);
  }
  for (CellLight& cell : cells)
  {
    for (int batch = 0; batch < Batches; ++batch)
    {
      cell.Share[batch] = whole[batch] > 0.0 ? cell.Share[batch] * area / whole[batch] : 1.0;
    }
  }
  return cells;
}

Vec3 PlateCourse::GradientAt(const Vec3& point, const Sign& sign) const
{
  const glm::dvec2 at = PlaceOnPlate(sign, point);
  const auto across = QuadraticWeights(at.x);
  const auto up = QuadraticWeights(at.y);
  const auto acrossSlopes = QuadraticSlopes(at.x);
  const auto upSlopes = QuadraticSlopes(at.y);
  // Of the shares of both edges.
  const Vec3 along = sign.Corners[1] - sign.Corners[0];
  const Vec3 upwards = sign.Corners[3] - sign.Corners[0];
  const Vec3 perAlong = along / glm::dot(along, along);
  const Vec3 perUp = upwards / glm::dot(upwards, upwards);
  Vec3 gradient(0.0);
  for (std::size_t place = 0; place < Places; ++place)
  {
    const std::size_t column = place % across.size();
    const std::size_t row = place / across.size();
    gradient += Mean(this->Excess_[place]) * (acrossSlopes[column] * up[row] * perAlong +
                                               across[column] * upSlopes[row] * perUp);
  }
  return gradient;
}

} // namespace smokevis
