#include "ThickCells.h"

#include "CellLoops.h"
#include "ExponentialMean.h"
#include "GlobalLines.h"
#include "LineChoice.h"
#include "LinePieces.h"
#include "Progress.h"
#include "Scene.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

namespace smokevis
{

namespace
{

/// A cell is worth it where this share of what it sends on comes back, and a whole sweep's change
/// would be multiplied by so much.
constexpr double ThickShare = 0.5;
constexpr float SmallestGain = 1.5F;
/// Sweeps whose lines measure the cells, and how much larger than measured the share may be that
/// leaves a cell: too large a gain would not converge.
constexpr std::uint64_t Sweeps = 8;
constexpr double Caution = 1.25;
/// Key of the lines that measure.
constexpr std::uint64_t Key = 0x7c3119;

/// Mean of (1 - exp(-x)) / x over the isotropic chords of a convex body, weighted by their lengths,
/// from their mean depth: by Jensen's inequality none is larger.
double LargestEscape(double depth)
{
  return MeanOfExponential(depth);
}

} // namespace

ThickCells::ThickCells(const Scene& scene, const std::vector<float>& extinction,
  const GlobalLines& lines, const Progress& progress)
{
  const Medium& smoke = scene.Smoke();
  const auto returned = [&](double escape) { return scene.Albedo() * (1.0 - escape); };
  std::vector<double> escapes(extinction.size());
  ForEachCell(extinction.size(), [&](std::int64_t cell)
    { escapes[cell] = LargestEscape(extinction[cell] * smoke.MeanChord(cell)); });
  if (std::none_of(escapes.begin(), escapes.end(),
        [&](double escape) { return returned(escape) > ThickShare; }))
  {
    return;
  }
  const std::vector<double> measured = Escapes(scene, extinction, lines, progress);
  this->Orders_.assign(extinction.size(), 0.0F);
  for (std::size_t i = 0; i < extinction.size(); ++i)
  {
    const auto cell = static_cast<std::int64_t>(i);
    const double escape = std::min(1.0, std::max(escapes[i], Caution * measured[i]));
    if (!(returned(escape) > ThickShare) || smoke.Covered(cell))
    {
      continue;
    }
    this->Orders_[i] = static_cast<float>(1.0 / (1.0 - returned(escape)));
    const auto meetings = static_cast<float>(CellMeetings(lines, smoke, cell));
    this->Orders_[i] = this->Gain(i, meetings) < SmallestGain ? 0.0F : this->Orders_[i];
  }
}

std::vector<double> ThickCells::Escapes(const Scene& scene, const std::vector<float>& extinction,
  const GlobalLines& lines, const Progress& progress)
{
  const std::size_t cells = extinction.size();
  // A part of the lines each, summed up in their order: threads do not matter.
  std::vector<std::vector<float>> lengths(Sweeps, std::vector<float>(cells, 0.0F));
  std::vector<std::vector<float>> escaped = lengths;
  tbb::parallel_for(std::uint64_t{0}, Sweeps,
    [&](std::uint64_t sweep)
    {
      const GlobalLines::Draw draw(lines, Mix(Key) + sweep);
      std::vector<Crossing> crossings;
      std::vector<Segment> segments;
      for (std::size_t i = 0; i < lines.Count(); ++i)
      {
        if (i % 256 == 0 && progress.ShouldStop())
        {
          return;
        }
        const GlobalLines::Line line = draw.Get(i);
        scene.Shapes().Cross(line.Origin, line.Direction, 0.0, line.Length, crossings);
        scene.Smoke().Walk(line.Origin, line.Direction, 0.0, line.Length, segments);
        ForEachPiece(
          crossings, segments, [](std::size_t) {},
          [&](std::int64_t cell, double begin, double end)
          {
            const double length = end - begin;
            lengths[sweep][cell] += static_cast<float>(line.Weight * length);
            escaped[sweep][cell] +=
              static_cast<float>(line.Weight * length * LargestEscape(extinction[cell] * length));
          });
      }
    });
  std::vector<double> escapes(cells, 0.0);
  for (std::size_t cell = 0; cell < cells; ++cell)
  {
    double length = 0.0;
    double escape = 0.0;
    for (std::uint64_t sweep = 0; sweep < Sweeps; ++sweep)
    {
      length += lengths[sweep][cell];
      escape += escaped[sweep][cell];
    }
    escapes[cell] = length > 0.0 ? escape / length : 0.0;
  }
  return escapes;
}

std::size_t ThickCells::Count() const
{
  return this->Orders_.size() - std::count(this->Orders_.begin(), this->Orders_.end(), 0.0F);
}

} // namespace smokevis
