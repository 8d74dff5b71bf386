#include "LineSweep.h"

#include "DirectField.h"
#include "LineChoice.h"
#include "LinePieces.h"
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
/// Share of the lines that a thin sweep has at least, of those that a small tolerance needs.
constexpr double ThinShare = 0.25;
/// Mean reflectance of all surfaces, and of those in the smoke, up to which light that they send
/// back is not much of what smoke does.
constexpr double MostReflectance = 0.1;
/// Steps of a cell's light are as large as its own noise lets them be, or larger by this: light
/// that comes from its neighbours is smoother.
constexpr float BoldSteps = 4.0F / 3.0F;

/// Hits that sides need in a thin sweep, over the square of their reflectance: of the variance that
/// a sweep sends on, its share would otherwise come close to 1, and grow from sweep to sweep.
constexpr double HitsASquare = 2.0;
/// Lines that must meet a side in a sweep for it to send on all of what that sweep found.
constexpr float FewestHits = 0.25F;

/// Radiance of a line's two directions together over the fluence, where light is isotropic.
constexpr float BothWays = static_cast<float>(0.5 / glm::pi<double>());

/// Mean reflectance of what light meets of the surfaces and plates.
double MeanReflectance(const Scene& scene, int band)
{
  double area = 0.0;
  double reflects = 0.0;
  for (std::size_t patch = 0; patch < scene.Patches(); ++patch)
  {
    const double exposed = scene.ExposedArea(patch, 0) + scene.ExposedArea(patch, 1);
    area += exposed;
    reflects += exposed * scene.PatchReflectance(patch)[band];
  }
  return area > 0.0 ? reflects / area : 0.0;
}

} // namespace

struct LineSweep::Buffers
{
  std::vector<Crossing> Crossings;
  std::vector<Segment> Segments;
  /// Of each piece of the line: cell, length, tau = its optical depth, mean source luminance and
  /// its change from the piece's beginning to its end, exp(-tau), (1 - exp(-tau)) / tau, and the
  /// luminance that it adds: (1 - exp(-tau)) times the source, and what the change adds along the
  /// line and takes away against it.
  std::vector<std::int64_t> Cell;
  std::vector<float> Length, Depth, Source, Change, Transmittance, Escape, Added, Tilt;
  /// First piece behind each crossing, and the end.
  std::vector<std::size_t> First;
  /// By how much the radiances of both directions together, where they come in, exceed the source.
  std::vector<float> Excess;
  /// Radiance that comes to each crossing, along the line and against it; of watched surfaces only.
  std::array<std::vector<float>, 2> Arriving;
};

LineSweep::LineSweep(const Scene& scene, const LightField& field, const DirectField& direct,
  int band, double tolerance, const Progress& progress)
    : Scene_(scene), Direct_(direct),
      DirectFluence_(field.DirectFluence.data() + field.CellIndex(band, 0)),
      DirectIlluminance_(field.DirectIlluminance.data() + field.PatchIndex(band, 0, 0)),
      Band_(band), Scatter_(static_cast<float>(scene.Albedo() / (4.0 * glm::pi<double>()))),
      Albedo_(static_cast<float>(scene.Albedo())), Latest_(std::pow(Albedo_, 4.0F)),
      Lines_(ChooseLines(scene, band, tolerance)), ThinLines_(Lines_)
{
  const bool often = ScattersOften(scene, band);
  this->Latest_ = often ? 1.0F : this->Latest_;
  const double share = often ? 1.0 : std::clamp(CoarseTolerance / tolerance, FewestShare, 1.0);
  this->Lines_ = this->Lines_.Thinned(share);
  const Medium& smoke = scene.Smoke();
  const std::size_t cells = smoke.Cells();
  this->InverseVolume_.resize(cells);
  this->Extinction_.resize(cells);
  for (std::size_t cell = 0; cell < cells; ++cell)
  {
    const double own = smoke.OwnVolume(static_cast<std::int64_t>(cell));
    this->InverseVolume_[cell] = own > 0.0 ? static_cast<float>(1.0 / own) : 0.0F;
    this->Extinction_[cell] =
      static_cast<float>(smoke.Extinction(cell) * scene.ExtinctionScale(band));
  }
  if (smoke.Emits())
  {
    this->Emission_.resize(cells);
    for (std::size_t cell = 0; cell < cells; ++cell)
    {
      this->Emission_[cell] =
        static_cast<float>((1.0 - scene.Albedo()) * smoke.EmittedLuminance(cell));
    }
  }
  this->Thick_ = ThickCells(scene, this->Extinction_, this->Lines_, progress);
  this->Shape_ = SourceShape(scene, field, direct, band, this->Extinction_);
  this->CellCrossings_.resize(cells);
  for (std::size_t cell = 0; cell < cells; ++cell)
  {
    this->CellCrossings_[cell] = static_cast<float>(
      this->Lines_.Meetings(BoxSurface(smoke.CellSize(static_cast<std::int64_t>(cell))), true));
  }
  const std::vector<bool> inside =
    PatchesIn(scene, this->Lines_.Inner().value_or(this->Lines_.Outer()));
  this->SideHits_.resize(2 * scene.Patches());
  for (std::size_t side = 0; side < this->SideHits_.size(); ++side)
  {
    this->SideHits_[side] = static_cast<float>(
      this->Lines_.Meetings(2.0 * scene.ExposedArea(side / 2, side % 2), inside[side / 2]));
  }
  this->Groups_ = PatchGroups(scene, band, this->SideHits_);
  this->ThinLines_ =
    this->ThinLines_.Thinned(std::min(share, std::max(ThinShare, share * this->HitsShare())));
  this->MeanPace_ = this->FindPace();
  // What thick cells send to themselves is summed up for them alone.
  if (often && this->Thick_.Count() == 0 && MeanReflectance(scene, band) <= MostReflectance)
  {
    this->Blocks_.emplace(scene, band, this->Extinction_);
    if (this->Blocks_->Reflectance() > MostReflectance)
    {
      this->Blocks_.reset();
    }
  }
}

float LineSweep::PaceOf(float meetings) const
{
  // What lines would correct of a cell's own error differs from sweep to sweep by the lengths in
  // it: its mean square shrinks fastest where 1 + their variance divides the step.
  const float own = this->Latest_ * this->Albedo_;
  return std::min(1.0F, BoldSteps / (1.0F + own * own * ThickCells::LengthVariance / meetings));
}

double LineSweep::FindPace() const
{
  double weights = 0.0;
  double sum = 0.0;
  for (std::size_t cell = 0; cell < this->Extinction_.size(); ++cell)
  {
    if (this->InverseVolume_[cell] > 0.0F)
    {
      const double weight = this->Extinction_[cell] / this->InverseVolume_[cell];
      const float meetings = this->CellCrossings_[cell];
      weights += weight;
      sum += weight * (meetings >= FewestMeetings ? this->PaceOf(meetings) : 1.0F);
    }
  }
  return weights > 0.0 ? sum / weights : 1.0;
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
      sum +=
        weight * std::min(1.0, HitsASquare * reflectance * reflectance / this->SideHits_[side]);
    }
  }
  return weights > 0.0 ? sum / weights : 0.0;
}

float LineSweep::Outgoing(const BatchState& state, const Hit& hit, const Vec3& direction) const
{
  const std::size_t patch = this->Scene_.Patch(hit);
  const double reflectance = this->Scene_.PatchReflectance(patch)[this->Band_];
  const std::size_t side = 2 * patch + hit.Side;
  float radiance = static_cast<float>(reflectance / glm::pi<double>()) *
                   (this->DirectIlluminance_[side] + state.Illuminance[side]);
  if (hit.Emitter && hit.Side == 0)
  {
    const EmitterSet& lights = this->Scene_.Lights();
    const std::size_t cell = patch - this->Scene_.SurfacePatches();
    if (lights.LeftToLines(cell))
    {
      const EmitterCell& emitter = lights.Cells()[cell];
      const double along = glm::dot(direction, lights.CellNormal(cell));
      const double relative =
        lights.CellLaw(cell).Relative(along < 0.0 ? -direction : direction, std::abs(along));
      radiance += static_cast<float>(emitter.Luminance[this->Band_] * relative);
    }
  }
  return radiance;
}

void LineSweep::TraceLine(const BatchState& state, const GlobalLines::Line& line,
  LineTallies& tallies, Buffers& buffers) const
{
  const Vec3& origin = line.Origin;
  const Vec3& direction = line.Direction;
  const double length = line.Length;
  const auto weight = static_cast<float>(line.Weight);
  const Medium& smoke = this->Scene_.Smoke();
  this->Scene_.Shapes().Cross(origin, direction, 0.0, length, buffers.Crossings);
  const std::size_t crossings = buffers.Crossings.size();
  buffers.Cell.clear();
  buffers.Length.clear();
  buffers.Depth.clear();
  buffers.Source.clear();
  buffers.Change.clear();
  buffers.First.assign(1, 0);
  smoke.Walk(origin, direction, 0.0, length, buffers.Segments);
  const bool flat = this->Shape_.Flat();
  const Vec3 start = origin - smoke.Lower();
  const std::array<float, 3> along = {static_cast<float>(direction.x),
    static_cast<float>(direction.y), static_cast<float>(direction.z)};
  const auto add = [&](std::int64_t cell, double begin, double end)
  {
    const LineTallies::Cell& own = tallies.Cells[cell];
    const float slope = own.Slope[0] * along[0] + own.Slope[1] * along[1] + own.Slope[2] * along[2];
    double at = begin;
    const auto addPart = [&](double part, float source)
    {
      const auto size = static_cast<float>(part);
      buffers.Cell.push_back(cell);
      buffers.Length.push_back(size);
      buffers.Depth.push_back(own.Extinction * size);
      if (!flat)
      {
        const Vec3 middle = start + (at + 0.5 * part) * direction;
        source += own.Offset + own.Slope[0] * static_cast<float>(middle.x) +
                  own.Slope[1] * static_cast<float>(middle.y) +
                  own.Slope[2] * static_cast<float>(middle.z);
        at += part;
        buffers.Change.push_back(slope * size);
      }
      buffers.Source.push_back(source);
    };
    if (!this->Direct_.Varies(cell, this->Band_))
    {
      addPart(end - begin, own.Source);
      return;
    }
    const float mean = this->DirectFluence_[cell];
    this->Direct_.ForEachPart(cell, origin, direction, begin, end, line.Random, this->Band_,
      [&](double part, double direct)
      { addPart(part, own.Source + this->Scatter_ * (static_cast<float>(direct) - mean)); });
  };
  ForEachPiece(
    buffers.Crossings, buffers.Segments,
    [&](std::size_t) { buffers.First.push_back(buffers.Cell.size()); }, add);
  const std::size_t pieces = buffers.Cell.size();
  buffers.First.push_back(pieces);

  buffers.Transmittance.resize(pieces);
  buffers.Escape.resize(pieces);
  buffers.Added.resize(pieces);
  buffers.Tilt.assign(pieces, 0.0F);
  buffers.Excess.resize(pieces);
  for (std::size_t i = 0; i < pieces; ++i)
  {
    const float depth = buffers.Depth[i];
    const float transmittance = std::exp(-depth);
    buffers.Transmittance[i] = transmittance;
    buffers.Escape[i] = depth < 0.01F
                          ? 1.0F - depth * (0.5F - depth * (1.0F / 6.0F - depth * (1.0F / 24.0F)))
                          : (1.0F - transmittance) / depth;
    // Where the depth is next to nothing, 1 - exp(-tau) would round to 0.
    buffers.Added[i] = depth * buffers.Escape[i] * buffers.Source[i];
    if (!flat)
    {
      buffers.Tilt[i] = buffers.Change[i] * SourceShape::Tilt(depth, buffers.Escape[i]);
    }
  }

  for (std::vector<float>& arriving : buffers.Arriving)
  {
    arriving.resize(this->Watched_.empty() ? 0 : crossings);
  }
  const auto arrive = [&](const Hit& hit, float radiance)
  {
    const std::size_t side = 2 * this->Scene_.Patch(hit) + hit.Side;
    tallies.Illuminance[side] +=
      weight * (radiance - static_cast<float>(glm::one_over_pi<double>()) *
                             tallies.ExpectedIlluminance[side]);
  };
  const auto sky = static_cast<float>(this->Scene_.Sky());
  float radiance = sky;
  for (std::size_t part = 0; part <= crossings; ++part)
  {
    for (std::size_t i = buffers.First[part]; i < buffers.First[part + 1]; ++i)
    {
      buffers.Excess[i] = radiance - buffers.Source[i];
      radiance = radiance * buffers.Transmittance[i] + (buffers.Added[i] + buffers.Tilt[i]);
    }
    if (part < crossings)
    {
      arrive(buffers.Crossings[part].Arrive, radiance);
      if (!this->Watched_.empty())
      {
        buffers.Arriving[0][part] = radiance;
      }
      radiance = this->Outgoing(state, buffers.Crossings[part].Leave, direction);
    }
  }
  tallies.Escaped += weight * radiance;
  radiance = sky;
  for (std::size_t part = crossings + 1; part-- > 0;)
  {
    for (std::size_t i = buffers.First[part + 1]; i-- > buffers.First[part];)
    {
      buffers.Excess[i] += radiance - buffers.Source[i];
      radiance = radiance * buffers.Transmittance[i] + (buffers.Added[i] - buffers.Tilt[i]);
    }
    if (part > 0)
    {
      arrive(buffers.Crossings[part - 1].Leave, radiance);
      if (!this->Watched_.empty())
      {
        buffers.Arriving[1][part - 1] = radiance;
      }
      radiance = this->Outgoing(state, buffers.Crossings[part - 1].Arrive, direction);
    }
  }
  tallies.Escaped += weight * radiance;
  for (std::size_t i = 0; i < pieces; ++i)
  {
    LineTallies::Cell& cell = tallies.Cells[buffers.Cell[i]];
    cell.Fluence +=
      weight * buffers.Length[i] *
      (buffers.Excess[i] * buffers.Escape[i] + (2.0F * buffers.Source[i] - cell.Expected));
  }
  if (!this->Watched_.empty())
  {
    this->TallyWatched(state, line.Weight, buffers, tallies);
  }
}

float LineSweep::WatchedOutgoing(const BatchState& state, const Hit& hit) const
{
  const std::size_t patch = this->Scene_.Patch(hit);
  const std::size_t side = 2 * patch + hit.Side;
  return this->Watched_[side]
           ? static_cast<float>(
               this->Scene_.PatchReflectance(patch)[this->Band_] / glm::pi<double>()) *
               state.Illuminance[side]
           : 0.0F;
}

void LineSweep::TallyWatched(
  const BatchState& state, double weight, const Buffers& buffers, LineTallies& tallies) const
{
  const auto take = [&](const Hit& hit, float sent, float left, float all)
  {
    const bool watched = this->Watched_[2 * this->Scene_.Patch(hit) + hit.Side];
    tallies.WatchedLost += weight * (watched ? sent - left : sent);
    tallies.WatchedGained += watched ? weight * (all - left) : 0.0;
  };
  const std::size_t crossings = buffers.Crossings.size();
  float first = 0.0F;
  for (std::size_t part = 0; part <= crossings; ++part)
  {
    float through = 1.0F;
    for (std::size_t i = buffers.First[part]; i < buffers.First[part + 1]; ++i)
    {
      through *= buffers.Transmittance[i];
    }
    float last = 0.0F;
    if (part < crossings)
    {
      take(buffers.Crossings[part].Arrive, first, through * first, buffers.Arriving[0][part]);
      last = this->WatchedOutgoing(state, buffers.Crossings[part].Arrive);
    }
    else
    {
      tallies.WatchedLost += weight * first;
    }
    if (part > 0)
    {
      take(buffers.Crossings[part - 1].Leave, last, through * last, buffers.Arriving[1][part - 1]);
    }
    else
    {
      tallies.WatchedLost += weight * last;
    }
    first = part < crossings ? this->WatchedOutgoing(state, buffers.Crossings[part].Leave) : 0.0F;
  }
}

void LineSweep::Prepare(const BatchState& state, LineTallies& tallies) const
{
  // The tallies measure by how much the radiance differs from that of an expected field: lengths
  // and hits have known expectations, so this leaves the mean as it is and takes their scatter
  // away. What is expected must not know of this sweep's lines, and must have been met by lines
  // itself: its noise would come back larger. In white smoke it is the latest light, which lines
  // carry on nearly all of: what they then tell of a cell is by how much more comes in than goes
  // out, which sums up to nothing over cells in a row. With the mean, a state that is off in a
  // whole region would be multiplied by how many lines happen to cross that, sweep after sweep.
  const bool counted = state.Counted > 0;
  const float scale = counted ? 1.0F / static_cast<float>(state.Counted) : 1.0F;
  const float sweeps = counted ? static_cast<float>(state.Counted) : state.Share;
  const std::vector<float>& fluence = counted ? state.FluenceSum : state.Fluence;
  tallies.Cells.resize(fluence.size());
  for (std::size_t cell = 0; cell < fluence.size(); ++cell)
  {
    const float emission = this->Emission_.empty() ? 0.0F : this->Emission_[cell];
    const float source =
      this->Scatter_ * (this->DirectFluence_[cell] + state.Fluence[cell]) + emission;
    const bool known = sweeps * this->CellCrossings_[cell] >= FewestMeetings;
    // In a thick cell there is little but what it sends on.
    tallies.Cells[cell] = {source, this->Extinction_[cell],
      this->Thick_.IsThick(cell) ? 2.0F * source
      : known ? BothWays * this->ExpectedFluence(state, cell, scale * fluence[cell])
              : 0.0F,
      0.0F, {}, 0.0F};
  }
  this->ShapeSources(state, tallies);
  const std::vector<float>& illuminance = counted ? state.IlluminanceSum : state.Illuminance;
  tallies.ExpectedIlluminance.resize(illuminance.size());
  for (std::size_t side = 0; side < illuminance.size(); ++side)
  {
    tallies.ExpectedIlluminance[side] =
      sweeps * this->SideHits_[side] >= FewestMeetings ? scale * illuminance[side] : 0.0F;
  }
  tallies.Illuminance.assign(illuminance.size(), 0.0F);
  tallies.Escaped = 0.0;
  tallies.WatchedLost = 0.0;
  tallies.WatchedGained = 0.0;
}

void LineSweep::ShapeSources(const BatchState& state, LineTallies& tallies) const
{
  for (const SourceShape::Shaped& shaped : this->Shape_.Cells())
  {
    LineTallies::Cell& cell = tallies.Cells[shaped.Index];
    const float source =
      this->Scatter_ * (state.Fluence[shaped.Index] +
                         (shaped.DirectVaries ? 0.0F : this->DirectFluence_[shaped.Index]));
    const Vec3 centre = shaped.Centre - this->Scene_.Smoke().Lower();
    double offset = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      cell.Slope[axis] = source * shaped.Change[axis];
      offset -= cell.Slope[axis] * centre[axis];
    }
    cell.Offset = static_cast<float>(offset);
  }
}

void LineSweep::TakeFluence(const LineTallies& tallies, float share, BatchState& state) const
{
  constexpr float isotropic = static_cast<float>(4.0 * glm::pi<double>());
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
      residual = this->Albedo_ * this->DirectFluence_[cell] + emission - loss * before + change;
      state.FluenceSum[cell] += before + residual;
      state.Fluence[cell] += this->Thick_.Gain(cell, share * this->CellCrossings_[cell]) * residual;
    }
    else
    {
      const float estimate = tally.Expected / BothWays + change;
      residual = estimate - before;
      const float pace =
        this->IsFresh(state, cell) ? this->PaceOf(share * this->CellCrossings_[cell]) : 1.0F;
      state.Fluence[cell] = std::lerp(before, estimate, pace);
      state.FluenceSum[cell] += estimate;
    }
    if (this->Blocks_)
    {
      this->Blocks_->AddResidual(cell, residual, state.Residual);
    }
  }
}

void LineSweep::Run(BatchState& state, LineTallies& tallies, std::uint64_t key, bool thin,
  const Progress& progress) const
{
  this->Prepare(state, tallies);
  const GlobalLines& lines = thin ? this->ThinLines_ : this->Lines_;
  const GlobalLines::Draw draw(lines, key);
  Buffers buffers;
  for (std::size_t line = 0; line < lines.Count(); ++line)
  {
    if (line % 256 == 0 && progress.ShouldStop())
    {
      return;
    }
    this->TraceLine(state, draw.Get(line), tallies, buffers);
  }

  for (std::size_t side = 0; side < this->Watched_.size(); ++side)
  {
    const double held = this->Watched_[side]
                          ? this->Scene_.ExposedArea(side / 2, side % 2) * state.Illuminance[side]
                          : 0.0;
    state.Watched.Held += held;
    state.Watched.Lost += (1.0 - this->Scene_.PatchReflectance(side / 2)[this->Band_]) * held;
  }
  state.Watched.Lost += tallies.WatchedLost;
  state.Watched.Gained += tallies.WatchedGained;
  ++state.Watched.Sweeps;
  this->TakeFluence(tallies, this->ShareOf(thin), state);
  ++state.Sweeps;
  const float least = 1.0F / static_cast<float>(state.Sweeps);
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
    // What few lines meet sends on a mean of sweeps: a light that is large as rarely as it is found
    // would come back larger.
    const float share =
      std::clamp(this->ShareOf(thin) * this->SideHits_[side] / FewestHits, least, 1.0F);
    state.Illuminance[side] += share * (estimate - state.Illuminance[side]);
    state.IlluminanceSum[side] += estimate;
  }
  state.Share = this->ShareOf(thin);
  state.EscapedSum += tallies.Escaped;
  ++state.Counted;
}

} // namespace smokevis
