#include "LineSweep.h"

#include "CellLoops.h"
#include "DirectField.h"
#include "LargePages.h"
#include "LineBuffers.h"
#include "LineChoice.h"
#include "Sampler.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/constants.hpp>

namespace smokevis
{

namespace
{

/// Above a tolerance fewer lines do: a few sweeps there must be for the light to settle, which
/// would bring less noise than is asked for.
constexpr double CoarseTolerance = 0.03;
constexpr double FewestShare = 0.25;
/// So they do where there are more than these, since millions of cells each are to be crossed: rays
/// through many of them see the light of many lines.
constexpr double PlentyOfLines = 40000.0;
/// Lines that a thin sweep has at least, if there are so many.
constexpr double FewestLines = 128.0;
/// Hits that sides need in a sweep, over the square of their reflectance: of the variance that a
/// sweep sends on, its share would otherwise come close to 1, and grow from sweep to sweep.
constexpr double HitsASquare = 2.0;
/// Hits that dark ones need to send on all of what a sweep found.
constexpr double FewestHits = 0.25;

/// Where more than one cell in so many has direct light that varies inside it, all are fetched.
constexpr std::size_t MuchVarying = 4;

/// Radiance of a line's two directions together over the fluence, where light is isotropic.
constexpr float BothWays = static_cast<float>(0.5 / glm::pi<double>());
constexpr float FromBothWays = static_cast<float>(2.0 * glm::pi<double>());

} // namespace

LineSweep::LineSweep(const Scene& scene, const LightField& field, const DirectField& direct,
  int band, double tolerance, const Progress& progress)
    : Scene_(scene), Direct_(direct),
      DirectFluence_(field.DirectFluence.data() + field.CellIndex(band, 0)),
      DirectIlluminance_(field.DirectIlluminance.data() + field.PatchIndex(band, 0, 0)),
      Band_(band), Scatter_(static_cast<float>(scene.Albedo() / (4.0 * glm::pi<double>()))),
      Lines_(ChooseLines(scene, field, band, tolerance)), PlainLines_(Lines_)
{
  const bool often = ScattersOften(scene, band);
  if (!often)
  {
    const double plenty = PlentyOfLines / static_cast<double>(this->Lines());
    this->Lines_ = this->Lines_.Thinned(
      std::clamp(std::min(CoarseTolerance / tolerance, plenty), FewestShare, 1.0));
  }
  const Medium& smoke = scene.Smoke();
  const std::size_t cells = smoke.Cells();
  this->InverseVolume_.resize(cells);
  std::vector<float> extinction(cells);
  ForEachCell(cells,
    [&](std::int64_t cell)
    {
      const double own = smoke.OwnVolume(cell);
      this->InverseVolume_[cell] = own > 0.0 ? static_cast<float>(1.0 / own) : 0.0F;
      extinction[cell] = static_cast<float>(smoke.Extinction(cell) * scene.ExtinctionScale(band));
    });
  if (smoke.Emits())
  {
    this->Emission_.resize(cells);
    ForEachCell(cells,
      [&](std::int64_t cell)
      {
        this->Emission_[cell] =
          static_cast<float>((1.0 - scene.Albedo()) * smoke.EmittedLuminance(cell));
      });
  }
  const std::size_t varying =
    CountCells(cells, [&](std::int64_t cell) { return direct.Varies(cell, band); });
  this->FetchesDirect_ = MuchVarying * varying > cells;
  this->Thick_ = ThickCells(scene, extinction, this->Lines_, progress);
  this->Shape_ = SourceShape(scene, field, direct, band, extinction);
  this->CellCrossings_.resize(cells);
  ForEachCell(cells, [&](std::int64_t cell)
    { this->CellCrossings_[cell] = static_cast<float>(CellMeetings(this->Lines_, smoke, cell)); });
  const std::vector<Box> bounds = PatchBounds(scene);
  this->SideHits_.resize(2 * scene.Patches());
  for (std::size_t side = 0; side < this->SideHits_.size(); ++side)
  {
    this->SideHits_[side] = static_cast<float>(
      this->Lines_.Meetings(2.0 * scene.ExposedArea(side / 2, side % 2), bounds[side / 2]));
  }
  this->Groups_ = PatchGroups(scene, band, this->SideHits_);
  this->PlainLines_ = this->Lines_;
  this->FewestShare_ =
    std::min(1.0, std::max(this->HitsShare(), FewestLines / static_cast<double>(this->Lines())));
  this->Steps_ = CellSteps(scene, extinction, this->CellCrossings_, often);
  if (often)
  {
    this->Blocks_.emplace(scene, band, extinction);
    if (!this->Blocks_->Lose())
    {
      this->Blocks_.reset();
    }
  }
  this->SignedExtinction_ = std::move(extinction);
  ForEachCell(cells,
    [&](std::int64_t cell)
    {
      float& own = this->SignedExtinction_[cell];
      own = direct.Varies(cell, band) ? -own : own;
    });
}

LineSweep::Choice LineSweep::Thin(double share) const
{
  GlobalLines lines = this->PlainLines_.Thinned(std::max(share, this->FewestShare_));
  const auto count = static_cast<float>(lines.Count());
  return {std::move(lines), count / static_cast<float>(this->PlainLines_.Count())};
}

double LineSweep::HitsShare() const
{
  double weights = 0.0;
  double sum = 0.0;
  for (std::size_t side = 0; side < this->SideHits_.size(); ++side)
  {
    const double reflectance = this->Scene_.PatchReflectance(side / 2)[this->Band_];
    const double weight = reflectance * this->Scene_.ExposedArea(side / 2, side % 2);
    if (weight > 0.0)
    {
      weights += weight;
      sum += weight * std::min(1.0F, this->HitsForWholeStep(side) / this->SideHits_[side]);
    }
  }
  return weights > 0.0 ? sum / weights : 0.0;
}

float LineSweep::HitsForWholeStep(std::size_t side) const
{
  const double reflectance = this->Scene_.PatchReflectance(side / 2)[this->Band_];
  return static_cast<float>(std::max(FewestHits, HitsASquare * reflectance * reflectance));
}

void LineSweep::Prepare(const BatchState& state, LineTallies& tallies) const
{
  // The tallies measure by how much the radiance differs from that of an expected field: lengths
  // and hits have known expectations, so this leaves the mean as it is and takes their scatter
  // away. What is expected must not know of this sweep's lines, and must have been met by lines
  // itself: its noise would come back larger.
  const bool counted = state.Counted > 0;
  const float scale = counted ? 1.0F / static_cast<float>(state.Counted) : 1.0F;
  const float sweeps = counted ? static_cast<float>(state.Counted) : state.Share;
  const std::vector<float>& fluence = counted ? state.FluenceSum : state.Fluence;
  ReserveInLargePages(fluence.size(), tallies.Cells);
  tallies.Cells.resize(fluence.size());
  for (std::size_t cell = 0; cell < fluence.size(); ++cell)
  {
    const float latest = state.Fluence[cell];
    const float source = this->Scatter_ * (this->DirectFluence_[cell] + latest);
    const float meetings = this->CellCrossings_[cell];
    const float expected =
      BothWays * this->Steps_.Expected(state.Share * meetings, latest, scale * fluence[cell]);
    tallies.Cells[cell] = {source, this->SignedExtinction_[cell],
      sweeps * meetings >= CellSteps::FewestMeetings ? expected : 0.0F, 0.0F, {}, 0.0F};
  }
  for (std::size_t cell = 0; cell < this->Emission_.size(); ++cell)
  {
    tallies.Cells[cell].Source += this->Emission_[cell];
  }
  if (this->Thick_.Any())
  {
    for (std::size_t cell = 0; cell < fluence.size(); ++cell)
    {
      // There is little but what it sends on.
      LineTallies::Cell& own = tallies.Cells[cell];
      own.Expected = this->Thick_.IsThick(cell) ? 2.0F * own.Source : own.Expected;
    }
  }
  this->ShapeSources(state, tallies);
  const std::vector<float>& illuminance = counted ? state.IlluminanceSum : state.Illuminance;
  tallies.ExpectedIlluminance.resize(illuminance.size());
  for (std::size_t side = 0; side < illuminance.size(); ++side)
  {
    tallies.ExpectedIlluminance[side] = sweeps * this->SideHits_[side] >= CellSteps::FewestMeetings
                                          ? scale * illuminance[side]
                                          : 0.0F;
  }
  tallies.Illuminance.assign(illuminance.size(), 0.0F);
  tallies.Escaped = 0.0;
  tallies.WatchedLost = 0.0;
  tallies.WatchedGained = 0.0;
  tallies.AtSides.assign(state.AtSides.size(), {});
  tallies.AtCells.assign(state.AtCells.size(), {});
}

void LineSweep::ShapeSources(const BatchState& state, LineTallies& tallies) const
{
  for (const SourceShape::Shaped& shaped : this->Shape_.Cells())
  {
    LineTallies::Cell& cell = tallies.Cells[shaped.Index];
    const bool steep = this->Shape_.Steep(shaped.Index);
    const float scale =
      steep ? 1.0F
            : this->Scatter_ * (state.Fluence[shaped.Index] +
                                 (shaped.DirectVaries ? 0.0F : this->DirectFluence_[shaped.Index]));
    double offset = shaped.Middle;
    for (int axis = 0; axis < 3; ++axis)
    {
      cell.Slope[axis] = scale * shaped.Change[axis];
      offset -= cell.Slope[axis] * shaped.Place[axis];
    }
    cell.Offset = static_cast<float>(offset);
  }
}

void LineSweep::TakeFluence(const LineTallies& tallies, float share, BatchState& state) const
{
  constexpr float isotropic = static_cast<float>(4.0 * glm::pi<double>());
  const auto albedo = static_cast<float>(this->Scene_.Albedo());
  const auto loss = static_cast<float>(1.0 - this->Scene_.Albedo());
  for (std::size_t cell = 0; cell < state.Fluence.size(); ++cell)
  {
    const LineTallies::Cell& tally = tallies.Cells[cell];
    const float before = state.Fluence[cell];
    const float change = this->InverseVolume_[cell] * tally.Fluence;
    float residual;
    if (this->Thick_.IsThick(cell))
    {
      // Expected was what the cell sends out, less than single precision from what it holds.
      const float emission = this->Emission_.empty() ? 0.0F : isotropic * this->Emission_[cell];
      residual = albedo * this->DirectFluence_[cell] + emission - loss * before + change;
      state.FluenceSum[cell] += before + residual;
      state.Fluence[cell] += this->Thick_.Gain(cell, share * this->CellCrossings_[cell]) * residual;
    }
    else
    {
      const float estimate = FromBothWays * tally.Expected + change;
      residual = estimate - before;
      const float crossings = this->CellCrossings_[cell];
      const float step = this->Steps_.Step(state.Share * crossings, share * crossings);
      // std::lerp takes many times as long.
      state.Fluence[cell] = (1.0F - step) * before + step * estimate;
      state.FluenceSum[cell] += estimate;
    }
    if (this->Blocks_)
    {
      this->Blocks_->AddResidual(cell, residual, state.Residual);
    }
  }
}

LineSweep::Holding LineSweep::HeldByWatched(const BatchState& state) const
{
  Holding held;
  const auto add = [&](double power, double sentOn)
  {
    held.Power += power;
    held.TakenUp += (1.0 - sentOn) * power;
  };
  for (std::size_t side = 0; side < this->Watched_.Sides.size(); ++side)
  {
    if (this->Watched_.Sides[side])
    {
      add(this->Scene_.ExposedArea(side / 2, side % 2) * state.Illuminance[side],
        this->Scene_.PatchReflectance(side / 2)[this->Band_]);
    }
  }
  for (std::size_t cell = 0; cell < this->Watched_.Cells.size(); ++cell)
  {
    if (this->Watched_.Cells[cell])
    {
      add(std::abs(this->SignedExtinction_[cell]) * this->Scene_.Smoke().OwnVolume(cell) *
            state.Fluence[cell],
        this->Scene_.Albedo());
    }
  }
  return held;
}

float LineSweep::SquareOf(const GlobalLines::Line& line, const LineTallies& tallies,
  const LineBuffers& buffers, const std::vector<float>& weights) const
{
  float sum = 0.0F;
  for (const LineBuffers::Piece& piece : buffers.Pieces)
  {
    const float change = static_cast<float>(line.Weight) * this->InverseVolume_[piece.Cell] *
                         piece.Brought(tallies.Cells[piece.Cell].Expected);
    sum += weights[piece.Cell] * change * change;
  }
  return sum;
}

void LineSweep::Run(BatchState& state, LineTallies& tallies, std::uint64_t key,
  const Choice& choice, const Progress& progress, LineSurvey* survey) const
{
  this->Prepare(state, tallies);
  const GlobalLines::Draw draw(choice.Lines, key);
  LineBuffers buffers;
  for (std::size_t line = 0; line < choice.Lines.Count(); ++line)
  {
    if (line % 256 == 0 && progress.ShouldStop())
    {
      return;
    }
    const GlobalLines::Line drawn = draw.Get(line);
    this->TraceLine(state, drawn, tallies, buffers);
    if (survey && line % survey->Every == 0)
    {
      survey->Lines.push_back(
        {drawn.Origin - this->Outer().Lower, drawn.Direction, static_cast<float>(drawn.Density()),
          this->SquareOf(drawn, tallies, buffers, survey->Weights)});
    }
  }

  const Holding held = this->HeldByWatched(state);
  state.Watched.Held += held.Power;
  state.Watched.Lost += held.TakenUp + tallies.WatchedLost;
  state.Watched.Gained += tallies.WatchedGained;
  ++state.Watched.Sweeps;
  const auto accumulate = [](const std::vector<MetLight>& values, std::vector<MetLight>& sums)
  {
    for (std::size_t place = 0; place < values.size(); ++place)
    {
      sums[place].Watched += values[place].Watched;
      sums[place].All += values[place].All;
    }
  };
  accumulate(tallies.AtSides, state.AtSides);
  accumulate(tallies.AtCells, state.AtCells);
  this->TakeFluence(tallies, choice.Share, state);
  state.Swept += choice.Share;
  const float least = choice.Share / state.Swept;
  std::vector<float>& estimates = tallies.ExpectedIlluminance;
  for (std::size_t side = 0; side < state.Illuminance.size(); ++side)
  {
    const double area = this->Scene_.ExposedArea(side / 2, side % 2);
    estimates[side] += area > 0.0 ? tallies.Illuminance[side] / static_cast<float>(area) : 0.0F;
  }
  this->Groups_.Average(estimates);
  for (std::size_t side = 0; side < state.Illuminance.size(); ++side)
  {
    const float estimate = estimates[side];
    if (this->Blocks_)
    {
      this->Blocks_->Sides().AddResidual(side, estimate - state.Illuminance[side], state.Residual);
    }
    // What few lines meet sends on a mean of sweeps: a light that is large as rarely as it is found
    // would come back larger.
    const float share =
      std::clamp(choice.Share * this->SideHits_[side] / this->HitsForWholeStep(side), least, 1.0F);
    state.Illuminance[side] += share * (estimate - state.Illuminance[side]);
    state.IlluminanceSum[side] += estimate;
  }
  state.Share = choice.Share;
  state.EscapedSum += tallies.Escaped;
  ++state.Counted;
}

} // namespace smokevis
