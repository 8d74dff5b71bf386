#include "ShapeNoise.h"

#include "OpenFaces.h"
#include "Scene.h"

#include <algorithm>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

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

/// Mean of a cell's batches, and the relative variance of that.
struct Known
{
  float Mean = 0.0F, Variance = 0.0F;
};

/// Cells that the slope along an axis comes from, and how far apart their centres are.
struct Ends
{
  std::array<std::int64_t, 2> Cell;
  double Distance;
};

Ends EndsOf(const Scene& scene, const OpenFaces& open, const std::vector<Known>& known,
  std::int64_t cell, int axis)
{
  Ends ends{{cell, cell}, 0.0};
  for (int side = 0; side < 2; ++side)
  {
    const std::int64_t other = open.Neighbour(cell, axis, side);
    ends.Cell[side] = other >= 0 && known[other].Mean > 0.0F ? other : cell;
  }
  const Medium& smoke = scene.Smoke();
  ends.Distance = smoke.CellCentre(ends.Cell[1])[axis] - smoke.CellCentre(ends.Cell[0])[axis];
  return ends;
}

} // namespace

//--------------------------------------------------------------------------------------------------
ShapeNoise::ShapeNoise(const Scene& scene, const Lanes* lanes, const CellShape& shape)
{
  const OpenFaces& open = scene.Open();
  const Medium& smoke = scene.Smoke();
  const std::size_t cells = smoke.Cells();
  std::vector<Known> known(cells);
  const auto forAll = [cells](auto&& body)
  {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cells, 1024),
      [&](const tbb::blocked_range<std::size_t>& range)
      {
        for (std::size_t cell = range.begin(); cell < range.end(); ++cell)
        {
          body(cell);
        }
      });
  };
  forAll(
    [&](std::size_t cell)
    {
      const double mean = Mean(lanes[cell]);
      const double error = mean > 0.0 ? StandardError(lanes[cell]) / mean : 0.0;
      known[cell] = {static_cast<float>(mean), static_cast<float>(std::min(1.0, error * error))};
    });
  std::vector<char> uneven(cells, 0);
  forAll(
    [&](std::size_t i)
    {
      const auto cell = static_cast<std::int64_t>(i);
      if (!(smoke.Extinction(cell) > 0.0F) || !(known[i].Mean > 0.0F))
      {
        return;
      }
      const Vec3 half = 0.5 * smoke.CellSize(cell);
      double sum = 0.0;
      for (int axis = 0; axis < 3; ++axis)
      {
        const Ends ends = EndsOf(scene, open, known, cell, axis);
        const double share = ends.Distance > 0.0 ? half[axis] / ends.Distance : 0.0;
        sum += share * share * (known[ends.Cell[0]].Variance + known[ends.Cell[1]].Variance);
      }
      uneven[i] = sum > CoveredVariance * known[i].Variance + NegligibleError * NegligibleError;
    });
  for (std::size_t i = 0; i < cells; ++i)
  {
    if (uneven[i] != 0)
    {
      this->Places_.resize(cells, -1);
      this->Places_[i] = static_cast<std::int32_t>(this->Cells_.size());
      const auto cell = static_cast<std::int64_t>(i);
      const Vec3 half = 0.5 * smoke.CellSize(cell);
      Cell own{smoke.CellCentre(cell), {}};
      for (int axis = 0; axis < 3; ++axis)
      {
        const Ends ends = EndsOf(scene, open, known, cell, axis);
        own.Centre[axis] += half[axis] * MeanSlope(half[axis] * shape.LogarithmSlope(cell, axis));
        for (int batch = 0; batch < Batches && ends.Distance > 0.0; ++batch)
        {
          const auto change = [&](int side)
          {
            const std::int64_t there = ends.Cell[side];
            return std::clamp(lanes[there][batch] / known[there].Mean - 1.0F, -1.0F, 1.0F);
          };
          own.Slope[axis][batch] = static_cast<float>((change(1) - change(0)) / ends.Distance);
        }
      }
      this->Cells_.push_back(own);
    }
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
