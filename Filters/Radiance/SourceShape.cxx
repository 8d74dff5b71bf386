#include "SourceShape.h"

#include "CellLoops.h"
#include "CellShape.h"
#include "DirectField.h"
#include "ExponentialMean.h"
#include "LargePages.h"
#include "LineSweep.h"
#include "OpenFaces.h"
#include "OwnGlow.h"
#include "SlopeWeights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace smokevis
{

namespace
{

/// Optical depth of scattering across a cell below which a flat source errs by a thousandth at
/// most.
constexpr double ThinnestDepth = 0.05;
/// Soot of a lower albedo is looked at as if it had this one: what little it sends on is the veil.
constexpr double LeastAlbedo = 0.5;
/// Change of a source from the middle of a cell to its corner, over its mean, above which it is
/// taken to be exponential. A linear one would be below 0 somewhere above 1.
constexpr float SteepChange = 0.5F;
/// Optical depth across a cell below which linear sources do, and that along its longest edge above
/// which its shape is hardly known along others.
constexpr double ThinnestSteep = 0.5;
constexpr double LongestSteep = 6.0;

/// Of light that is scattered many times, as it falls off by exp(-x) over an optical depth, to the
/// first two orders in what is absorbed (Case and Zweifel, Linear Transport Theory, 1967).
double DecayOf(double albedo)
{
  constexpr double Least = 1e-4;
  const double absorbed = std::max(Least, 1.0 - albedo);
  return std::min(1.0, std::sqrt(3.0 * absorbed) * (1.0 - 0.4 * absorbed));
}

/// Most that the logarithm of such light falls by over an optical depth: where nothing comes from
/// beyond, it is a hyperbolic sine that ends 0.71 mean free paths behind (Milne's problem). In
/// white smoke that is much less than the way to the light deepens by.
double MostFall(double decay, double depth)
{
  constexpr double End = 0.7104;
  const double fall = std::log(std::sinh(decay * (depth + End)) / std::sinh(decay * End));
  return std::min(CellShape::SteepestChange, fall);
}

/// By how much the logarithm of a field rises; the quotient of what is next to nothing and of much
/// need not fit single precision.
float Rise(float from, float to)
{
  return std::log(
    std::clamp(to / from, std::numeric_limits<float>::min(), std::numeric_limits<float>::max()));
}

} // namespace

SourceShape::SourceShape(const Scene& scene, const LightField& field, const DirectField& direct,
  int band, const std::vector<float>& extinction)
    : Smoke_(&scene.Smoke()), Open_(&scene.Open()),
      DirectFluence_(field.DirectFluence.data() + field.CellIndex(band, 0)),
      Scale_(scene.ExtinctionScale(band)), Decay_(DecayOf(scene.Albedo()))
{
  const Medium& smoke = scene.Smoke();
  const double albedo = scene.Albedo() > 0.0 ? std::max(LeastAlbedo, scene.Albedo()) : 0.0;
  // Whether each cell's source varies; bits would share bytes between threads.
  std::vector<char> shapes(extinction.size());
  ForEachCell(extinction.size(),
    [&](std::int64_t cell)
    {
      const double depth = extinction[cell] * smoke.MeanChord(cell);
      shapes[cell] =
        albedo * depth > ThinnestDepth && depth < ThickestDepth && !smoke.Covered(cell) ? 1 : 0;
    });
  std::vector<std::int64_t> shaped;
  for (std::size_t cell = 0; cell < shapes.size(); ++cell)
  {
    if (shapes[cell] != 0)
    {
      shaped.push_back(static_cast<std::int64_t>(cell));
    }
  }
  const SlopeWeights weights(scene);
  const OwnGlow glow(scene, band);
  ReserveInLargePages(shaped.size(), this->Cells_);
  this->Cells_.resize(shaped.size());
  ReserveInLargePages(shaped.size(), this->Measures_);
  this->Measures_.resize(shaped.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, this->Cells_.size(), 1024),
    [&](const tbb::blocked_range<std::size_t>& range)
    {
      for (std::size_t i = range.begin(); i < range.end(); ++i)
      {
        const std::int64_t cell = shaped[i];
        this->Cells_[i] = {
          cell, smoke.CellCentre(cell) - smoke.Lower(), direct.Varies(cell, band), Slope{}};
        const Vec3 half = 0.5 * smoke.CellSize(cell);
        Measures& own = this->Measures_[i];
        // Only over a whole box the mean of an exponential is known.
        own.MayBeSteep = extinction[cell] * smoke.MeanChord(cell) > ThinnestSteep &&
                         extinction[cell] * LargestEdge(smoke.CellSize(cell)) < LongestSteep &&
                         !smoke.Parts().Find(cell);
        own.Glow = static_cast<float>(glow.Fluence(cell));
        for (int axis = 0; axis < 3; ++axis)
        {
          std::array<std::int64_t, 2> beside{};
          for (const int side : {0, 1})
          {
            const std::int64_t other = this->Beside(cell, axis, side);
            beside[side] = other == cell ? -1 : other;
          }
          const auto factors = weights.Of(cell, axis, beside);
          std::copy(factors.begin(), factors.end(), own.Factors[axis].begin());
          own.Half[axis] = static_cast<float>(half[axis]);
        }
      }
    });
}

std::int64_t SourceShape::Beside(std::int64_t cell, int axis, int side) const
{
  const std::int64_t other = this->Open_->Neighbour(cell, axis, side);
  return other < 0 || this->Smoke_->Covered(other) ? cell : other;
}

void SourceShape::Follow(const std::vector<BatchState>& batches)
{
  if (this->Flat())
  {
    return;
  }
  const std::size_t cells = batches.front().FluenceSum.size();
  std::vector<float> means(cells);
  std::vector<char> steep(cells);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cells, 4096),
    [&](const tbb::blocked_range<std::size_t>& range)
    {
      for (const BatchState& batch : batches)
      {
        const float weight =
          1.0F / static_cast<float>(std::max(1, batch.Counted) * static_cast<int>(batches.size()));
        for (std::size_t cell = range.begin(); cell < range.end(); ++cell)
        {
          means[cell] += weight * batch.FluenceSum[cell];
        }
      }
    });
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, this->Cells_.size(), 1024),
    [&](const tbb::blocked_range<std::size_t>& range)
    {
      for (std::size_t i = range.begin(); i < range.end(); ++i)
      {
        const Measures& own = this->Measures_[i];
        const std::int64_t cell = this->Cells_[i].Index;
        const bool varies = this->Cells_[i].DirectVaries;
        const auto value = [&](std::int64_t there)
        { return means[there] + (varies ? 0.0F : this->DirectFluence_[there]); };
        const float here = value(cell);
        const auto share = static_cast<float>(OwnGlow::ShareBeside(own.Glow, here));
        Slope slope{};
        float change = 0.0F;
        for (int axis = 0; axis < 3; ++axis)
        {
          const float low = value(this->Beside(cell, axis, 0));
          const float high = value(this->Beside(cell, axis, 1));
          // Light falls off exponentially.
          slope[axis] = low > 0.0F && here > 0.0F && high > 0.0F
                          ? share * (Rise(low, here) * own.Factors[axis][0] +
                                      Rise(here, high) * own.Factors[axis][1])
                          : 0.0F;
          change += std::abs(slope[axis]) * own.Half[axis];
        }
        Shaped& shaped = this->Cells_[i];
        shaped.Middle = 0.0F;
        if (change > SteepChange && own.MayBeSteep)
        {
          steep[cell] = 1;
          for (int axis = 0; axis < 3; ++axis)
          {
            const double depth =
              2.0 * own.Half[axis] * this->Scale_ * this->Smoke_->Extinction(cell);
            const float most =
              static_cast<float>(0.5 * MostFall(this->Decay_, depth)) / own.Half[axis];
            slope[axis] = std::clamp(slope[axis], -most, most);
            shaped.Middle -= static_cast<float>(LogarithmOfMean(slope[axis] * own.Half[axis]));
          }
        }
        else
        {
          const float scale = change > 1.0F ? 1.0F / change : 1.0F;
          slope = {scale * slope[0], scale * slope[1], scale * slope[2]};
        }
        shaped.Change = slope;
      }
    });
  const bool any = std::find(steep.begin(), steep.end(), 1) != steep.end();
  this->Steep_ = any ? std::move(steep) : std::vector<char>();
}

} // namespace smokevis
