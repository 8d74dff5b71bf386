// LineSweep's part that carries light along one line.
#include "LineSweep.h"

#include "DirectField.h"
#include "ExponentialSource.h"
#include "LineBuffers.h"
#include "LinePieces.h"

#include <cmath>
#include <iterator>

#include <glm/gtc/constants.hpp>

namespace smokevis
{

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

float LineSweep::EvenSource(std::int64_t cell, bool directVaries) const
{
  return (this->Emission_.empty() ? 0.0F : this->Emission_[cell]) +
         (directVaries ? this->Scatter_ * this->DirectFluence_[cell] : 0.0F);
}

void LineSweep::TraceLine(const BatchState& state, const GlobalLines::Line& line,
  LineTallies& tallies, LineBuffers& buffers) const
{
  const Vec3& origin = line.Origin;
  const Vec3& direction = line.Direction;
  const double length = line.Length;
  const auto weight = static_cast<float>(line.Weight);
  const Medium& smoke = this->Scene_.Smoke();
  this->Scene_.Shapes().Cross(origin, direction, 0.0, length, buffers.Crossings);
  const std::size_t crossings = buffers.Crossings.size();
  buffers.Pieces.clear();
  buffers.First.assign(1, 0);
  smoke.Walk(origin, direction, 0.0, length, buffers.Segments);
  // Cells lie far apart: they are fetched at once, not one after another as they are needed.
  for (const Segment& segment : buffers.Segments)
  {
    __builtin_prefetch(&tallies.Cells[segment.Cell], 1);
    if (this->FetchesDirect_)
    {
      this->Direct_.Fetch(segment.Cell, this->Band_);
      __builtin_prefetch(&this->DirectFluence_[segment.Cell]);
    }
  }
  const bool flat = this->Shape_.Flat();
  const Vec3 start = origin - smoke.Lower();
  const std::array<float, 3> along = {static_cast<float>(direction.x),
    static_cast<float>(direction.y), static_cast<float>(direction.z)};
  const auto add = [&](std::int64_t cell, double begin, double end)
  {
    const LineTallies::Cell& own = tallies.Cells[cell];
    const float slope = own.Slope[0] * along[0] + own.Slope[1] * along[1] + own.Slope[2] * along[2];
    const bool steep = this->Shape_.Steep(cell);
    const float rest = steep ? own.Source - this->EvenSource(cell, own.DirectVaries()) : 0.0F;
    double at = begin;
    const auto addPart = [&](double part, float source)
    {
      const auto size = static_cast<float>(part);
      const float depth = own.Extinction() * size;
      if (depth == 0.0F)
      {
        // Clear air.
        buffers.Pieces.push_back({cell, size, source, 1.0F, 1.0F, 0.0F, 0.0F, 0.0F});
        at += part;
        return;
      }
      const float transmittance = std::exp(-depth);
      const float escape =
        depth < 0.01F ? 1.0F - depth * (0.5F - depth * (1.0F / 6.0F - depth * (1.0F / 24.0F)))
                      : (1.0F - transmittance) / depth;
      float shape = 0.0F;
      if (!flat)
      {
        const Vec3 middle = start + (at + 0.5 * part) * direction;
        shape = own.Offset + own.Slope[0] * static_cast<float>(middle.x) +
                own.Slope[1] * static_cast<float>(middle.y) +
                own.Slope[2] * static_cast<float>(middle.z);
        at += part;
      }
      if (steep)
      {
        const float even = source - rest;
        const float held = rest * std::exp(shape);
        const ExponentialSource sent(depth, transmittance, escape, slope * size);
        buffers.Pieces.push_back({cell, size, even + held * sent.Inside, transmittance, escape,
          depth * escape * even + 0.5F * held * (sent.Ahead + sent.Back),
          0.5F * held * (sent.Ahead - sent.Back), 0.0F});
        return;
      }
      source += shape;
      const float tilt = flat ? 0.0F : slope * size * SourceShape::Tilt(depth, escape);
      // Where the depth is next to nothing, 1 - exp(-tau) would round to 0.
      buffers.Pieces.push_back(
        {cell, size, source, transmittance, escape, depth * escape * source, tilt, 0.0F});
    };
    if (!own.DirectVaries())
    {
      addPart(end - begin, own.Source);
      return;
    }
    const float mean = this->DirectFluence_[cell];
    const double depth = static_cast<double>(own.Extinction()) * (end - begin);
    this->Direct_.ForEachPart(cell, origin, direction, begin, end, depth, line.Random, this->Band_,
      [&](double part, double direct)
      { addPart(part, own.Source + this->Scatter_ * (static_cast<float>(direct) - mean)); });
  };
  ForEachPiece(
    buffers.Crossings, buffers.Segments,
    [&](std::size_t) { buffers.First.push_back(buffers.Pieces.size()); }, add);
  buffers.First.push_back(buffers.Pieces.size());

  for (std::vector<float>& arriving : buffers.Arriving)
  {
    arriving.resize(this->Watches() ? crossings : 0);
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
      LineBuffers::Piece& piece = buffers.Pieces[i];
      piece.Excess = radiance - piece.Source;
      radiance = radiance * piece.Transmittance + (piece.Added + piece.Tilt);
    }
    if (part < crossings)
    {
      arrive(buffers.Crossings[part].Arrive, radiance);
      if (this->Watches())
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
      LineBuffers::Piece& piece = buffers.Pieces[i];
      piece.Excess += radiance - piece.Source;
      radiance = radiance * piece.Transmittance + (piece.Added - piece.Tilt);
    }
    if (part > 0)
    {
      arrive(buffers.Crossings[part - 1].Leave, radiance);
      if (this->Watches())
      {
        buffers.Arriving[1][part - 1] = radiance;
      }
      radiance = this->Outgoing(state, buffers.Crossings[part - 1].Arrive, direction);
    }
  }
  tallies.Escaped += weight * radiance;
  for (const LineBuffers::Piece& piece : buffers.Pieces)
  {
    LineTallies::Cell& cell = tallies.Cells[piece.Cell];
    cell.Fluence += weight * piece.Brought(cell.Expected);
  }
  if (this->Watches())
  {
    this->TallyWatched(state, line.Weight, buffers, tallies);
  }
}

float LineSweep::WatchedOutgoing(const BatchState& state, const Hit& hit) const
{
  const std::size_t patch = this->Scene_.Patch(hit);
  const std::size_t side = 2 * patch + hit.Side;
  return this->Watched_.Sides[side]
           ? static_cast<float>(
               this->Scene_.PatchReflectance(patch)[this->Band_] / glm::pi<double>()) *
               state.Illuminance[side]
           : 0.0F;
}

void LineSweep::TallyWatched(
  const BatchState& state, double weight, const LineBuffers& buffers, LineTallies& tallies) const
{
  // What else takes up of their light is lost, and what meets them of all other light gained.
  const auto add = [&](MetLight& sums, float own, float all)
  {
    sums.Watched += static_cast<float>(weight) * own;
    sums.All += static_cast<float>(weight) * all;
  };
  const auto meet = [&](const Hit& hit, float own, float all)
  {
    const std::size_t side = 2 * this->Scene_.Patch(hit) + hit.Side;
    add(tallies.AtSides[side], own, all);
    const bool watched = this->Watched_.Sides[side];
    tallies.WatchedLost += watched ? 0.0 : weight * own;
    tallies.WatchedGained += watched ? weight * (all - own) : 0.0;
  };
  const auto cross = [&](const LineBuffers::Piece& piece, float& own)
  {
    const float depth = tallies.Cells[piece.Cell].Extinction() * piece.Length;
    const float opacity = depth * piece.Escape;
    const bool watched = this->Watched_.Cells[piece.Cell];
    const float source = watched ? this->Scatter_ * state.Fluence[piece.Cell] : 0.0F;
    const float met = opacity * own + (depth - opacity) * source;
    // Half of what both directions bring together.
    const float all = 0.5F * opacity * piece.Excess + depth * piece.Source;
    const std::int64_t place = piece.Cell - state.FirstCell;
    if (place >= 0 && place < std::ssize(tallies.AtCells))
    {
      add(tallies.AtCells[place], met, all);
    }
    tallies.WatchedLost += watched ? 0.0 : weight * met;
    tallies.WatchedGained += watched ? weight * (all - met) : 0.0;
    own += opacity * (source - own);
  };
  const std::size_t crossings = buffers.Crossings.size();
  float own = 0.0F;
  for (std::size_t part = 0; part <= crossings; ++part)
  {
    for (std::size_t i = buffers.First[part]; i < buffers.First[part + 1]; ++i)
    {
      cross(buffers.Pieces[i], own);
    }
    if (part < crossings)
    {
      meet(buffers.Crossings[part].Arrive, own, buffers.Arriving[0][part]);
      own = this->WatchedOutgoing(state, buffers.Crossings[part].Leave);
    }
  }
  tallies.WatchedLost += weight * own;
  own = 0.0F;
  for (std::size_t part = crossings + 1; part-- > 0;)
  {
    for (std::size_t i = buffers.First[part + 1]; i-- > buffers.First[part];)
    {
      cross(buffers.Pieces[i], own);
    }
    if (part > 0)
    {
      meet(buffers.Crossings[part - 1].Leave, own, buffers.Arriving[1][part - 1]);
      own = this->WatchedOutgoing(state, buffers.Crossings[part - 1].Arrive);
    }
  }
  tallies.WatchedLost += weight * own;
}

} // namespace smokevis
