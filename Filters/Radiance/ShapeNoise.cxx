#include "ShapeNoise.h"

#include "OpenFaces.h"
#include "Scene.h"

#include <algorithm>
#include <cmath>

namespace smokevis
{

namespace
{

/// How many times the variance of a cell's own mean that of its shape may be at the cell's corners.
/// Where all cells are known alike it is less than that, even at walls.
constexpr double CoveredVariance = 2.0;
/// Relative error that needs no telling.
constexpr double NegligibleError = 1e-4;

/// Derivative by h of log(sinh(h) / h), by which a slope raises the mean.
double MeanSlope(double h)
{
  return std::abs(h) < 1e-2 ? h / 3.0 : 1.0 / std::tanh(h) - 1.0 / h;
}

} // namespace

//--------------------------------------------------------------------------------------------------
ShapeNoise::ShapeNoise(const Scene& scene, const Lanes* lanes, const CellShape& shape)
{
  const OpenFaces& open = scene.Open();
  const Medium& smoke = scene.Smoke();
  const std::size_t cells = smoke.Cells();
  std::vector<float> variance(cells, 0.0F);
  for (std::size_t cell = 0; cell < cells; ++cell)
  {
    const double mean = Mean(lanes[cell]);
    const double error = mean > 0.0 ? StandardError(lanes[cell]) / mean : 0.0;
    variance[cell] = static_cast<float>(std::min(1.0, error * error));
  }
  /// Cells that the slope along an axis comes from, and over which distance.
  struct Ends
  {
    std::array<std::int64_t, 2> Cell;
    double Distance;
  };
  const auto endsOf = [&](std::int64_t cell, int axis)
  {
    Ends ends{{cell, cell}, 0.0};
    for (int side = 0; side < 2; ++side)
    {
      const std::int64_t other = open.Neighbour(cell, axis, side);
      ends.Cell[side] = other >= 0 && Mean(lanes[other]) > 0.0 ? other : cell;
    }
    ends.Distance = smoke.CellCentre(ends.Cell[1])[axis] - smoke.CellCentre(ends.Cell[0])[axis];
    return ends;
  };
  for (std::size_t i = 0; i < cells; ++i)
  {
    const auto here = static_cast<std::int64_t>(i);
    if (!(smoke.Extinction(here) > 0.0F) || !(Mean(lanes[i]) > 0.0))
    {
      continue;
    }
    const Vec3 size = smoke.CellSize(here);
    std::array<Ends, 3> ends;
    double sum = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      ends[axis] = endsOf(here, axis);
      const double share = ends[axis].Distance > 0.0 ? 0.5 * size[axis] / ends[axis].Distance : 0.0;
      sum += share * share * (variance[ends[axis].Cell[0]] + variance[ends[axis].Cell[1]]);
    }
    if (sum < CoveredVariance * variance[i] + NegligibleError * NegligibleError)
    {
      continue;
    }
    Cell cell{smoke.CellCentre(here), {}};
    for (int axis = 0; axis < 3; ++axis)
    {
      if (!(ends[axis].Distance > 0.0))
      {
        continue;
      }
      cell.Centre[axis] +=
        0.5 * size[axis] * MeanSlope(0.5 * size[axis] * shape.LogarithmSlope(here, axis));
      for (int side = 0; side < 2; ++side)
      {
        const Lanes& there = lanes[ends[axis].Cell[side]];
        const double mean = Mean(there);
        const double sign = side == 0 ? -1.0 : 1.0;
        for (int batch = 0; batch < Batches; ++batch)
        {
          const double change = std::clamp(there[batch] / mean - 1.0, -1.0, 1.0);
          cell.Slope[axis][batch] += static_cast<float>(sign * change / ends[axis].Distance);
        }
      }
    }
    if (this->Places_.empty())
    {
      this->Places_.assign(cells, -1);
    }
    this->Places_[i] = static_cast<std::int32_t>(this->Cells_.size());
    this->Cells_.push_back(cell);
  }
}

//--------------------------------------------------------------------------------------------------
void ShapeNoise::AddOf(const Cell& cell, const Vec3& point, double weight, Lanes& sum)
{
  const Vec3 from = weight * (point - cell.Centre);
  for (int batch = 0; batch < Batches; ++batch)
  {
    sum[batch] += static_cast<float>(from.x * cell.Slope[0][batch] + from.y * cell.Slope[1][batch] +
                                     from.z * cell.Slope[2][batch]);
  }
}

} // namespace smokevis
