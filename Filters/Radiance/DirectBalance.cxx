#include "DirectBalance.h"

#include "NearLights.h"
#include "Sampler.h"
#include "Scene.h"
#include "Team.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace smokevis
{

namespace
{

/// Rays from a light.
constexpr std::size_t Rays = 1024;
/// What all lights add everywhere is kept in so much memory at most [bytes].
constexpr std::size_t MostMemory = std::size_t{1} << 28;
/// Most of a light's power that is made up for, and most that light is scaled by: what is off by
/// more has another reason, such as a lamp of which few cells know, and is left.
constexpr double MostLack = 0.04;
constexpr double MostChange = 0.1;
/// How many times the error of light that is known from close by, as a share, that of the rest is
/// taken to be.
constexpr double ErrorRatio = 6.0;

} // namespace

DirectBalance::DirectBalance(
  const Scene& scene, const LightField& field, std::size_t blocks, std::size_t parts)
    : Scene_(scene), Near_(scene.Near(field.Tolerance)), Cells_(field.Cells), Blocks_(blocks),
      Parts_(parts), Patches_(field.Patches), Watched_(scene.Lights().Lights().size())
{
  const std::size_t sides = 2 * this->Patches_;
  const std::size_t items = blocks + parts + this->Patches_;
  const std::size_t values = (this->Cells_ + sides) * scene.Bands();
  if (this->Watched_.size() * (values * sizeof(float) + items * sizeof(Power)) > MostMemory)
  {
    return;
  }
  bool any = false;
  for (std::size_t light = 0; light < this->Watched_.size(); ++light)
  {
    if (this->Closed(light))
    {
      any = true;
      // One more cell: without smoke there are none.
      this->Watched_[light].Cells.resize((this->Cells_ + 1) * scene.Bands());
      this->Watched_[light].Sides.resize(sides * scene.Bands());
    }
  }
  this->Powers_.resize(any ? items * this->Watched_.size() : 0);
}

bool DirectBalance::Closed(std::size_t light) const
{
  const Geometry& shapes = this->Scene_.Shapes();
  const LightGroup& root = this->Scene_.Lights().Root(light);
  const Vec3 along = glm::normalize(root.Corners[1] - root.Corners[0]);
  const Vec3 lift = 10.0 * shapes.Tolerance() * root.Normal;
  if (root.Law.Measured())
  {
    return false;
  }
  const EvenPoints points(1);
  for (std::size_t i = 0; i < Rays; ++i)
  {
    const auto random = points.Point(i);
    // As often as the light sends them out, which goes as a power of the cosine.
    const double square = 1.0 - std::pow(random[2], 2.0 / (2.0 + root.Law.Exponent()));
    const Hit hit = shapes.Intersect(root.At(random[0], random[1]) + lift,
      LambertianDirection(root.Normal, along, square, random[3]), 0.0,
      std::numeric_limits<double>::infinity());
    // Of what is dark, since it lies in a solid, nothing is known.
    if (!hit.Found() || this->Scene_.ExposedArea(this->Scene_.Patch(hit), hit.Side) == 0.0)
    {
      return false;
    }
  }
  return true;
}

Spectrum DirectBalance::TakenIn(std::int64_t cell, const Spectrum& fluence) const
{
  const Medium& smoke = this->Scene_.Smoke();
  const double capture = smoke.Extinction(cell) * smoke.OwnVolume(cell);
  Spectrum taken{};
  for (int band = 0; band < this->Scene_.Bands(); ++band)
  {
    taken[band] = capture * this->Scene_.ExtinctionScale(band) * fluence[band];
  }
  return taken;
}

void DirectBalance::AddToCell(
  std::size_t block, std::size_t light, std::int64_t cell, const Spectrum& fluence)
{
  Power& power = this->PowerOf(block, light);
  const int place = this->Near_.Place(cell);
  if (const int own = place < 0 ? -1 : this->Near_.Find(place, light); own >= 0)
  {
    const bool exact = this->Near_.Cells()[place].Lights[own].Deposits;
    Accumulate(exact ? power.Exact : power.Known, this->TakenIn(cell, fluence));
    return;
  }
  Accumulate(power.Scaled, this->TakenIn(cell, fluence));
  for (int band = 0; band < this->Scene_.Bands(); ++band)
  {
    this->Watched_[light].Cells[band * this->Cells_ + cell] = static_cast<float>(fluence[band]);
  }
}

void DirectBalance::AddToPart(
  std::size_t part, std::size_t light, std::int64_t cell, const Spectrum& fluence)
{
  Accumulate(this->PowerOf(this->Blocks_ + part, light).Known, this->TakenIn(cell, fluence));
}

void DirectBalance::AddToPatch(
  std::size_t patch, int side, std::size_t light, const Spectrum& illuminance)
{
  Power& power = this->PowerOf(this->Blocks_ + this->Parts_ + patch, light);
  const double area = this->Scene_.ExposedArea(patch, side);
  for (int band = 0; band < this->Scene_.Bands(); ++band)
  {
    power.Scaled[band] += area * illuminance[band];
    this->Watched_[light].Sides[2 * (band * this->Patches_ + patch) + side] =
      static_cast<float>(illuminance[band]);
  }
}

void DirectBalance::Complete(Team& team)
{
  const auto complete = [&](std::size_t first, std::size_t count)
  {
    team.Complete<Power>(count,
      [&](std::size_t item, auto&& take)
      {
        for (std::size_t light = 0; light < this->Watched_.size(); ++light)
        {
          take(this->PowerOf(first + item, light));
        }
      });
  };
  complete(0, this->Blocks_);
  complete(this->Blocks_, this->Parts_);
  complete(this->Blocks_ + this->Parts_, this->Patches_);
}

std::vector<WorkItem> DirectBalance::MakeUp(
  Team& team, std::vector<Spectrum>& cells, std::vector<std::array<Spectrum, 2>>& patches)
{
  std::vector<WorkItem> done;
  if (this->Powers_.empty())
  {
    return done;
  }
  this->Complete(team);
  for (int band = 0; band < this->Scene_.Bands(); ++band)
  {
    double scaled = 0.0;
    double made = 0.0;
    double all = 0.0;
    for (std::size_t light = 0; light < this->Watched_.size(); ++light)
    {
      const LightGroup& root = this->Scene_.Lights().Root(light);
      const double emitted = root.Law.UnitFlux() * root.Intensity[band];
      all += emitted;
      double exact = 0.0;
      double known = 0.0;
      double rest = 0.0;
      for (std::size_t item = 0; item < this->Blocks_ + this->Parts_ + this->Patches_; ++item)
      {
        const Power& power = this->PowerOf(item, light);
        exact += power.Exact[band];
        known += power.Known[band];
        rest += power.Scaled[band];
      }
      const double lack = emitted - exact - known - rest;
      if (!this->Watches(light) || !(rest > 0.0) || !(std::abs(lack) < MostLack * emitted))
      {
        continue;
      }
      // As errors go with what they are of, most of the lack is the rest's.
      const double ratio = known / (ErrorRatio * rest);
      const double change =
        std::clamp(lack / (rest * (1.0 + ratio * ratio)), -MostChange, MostChange);
      scaled += 1.0;
      made += change * rest;
      const Watched& own = this->Watched_[light];
      for (std::size_t cell = 0; cell < this->Cells_; ++cell)
      {
        cells[cell][band] += change * own.Cells[band * this->Cells_ + cell];
      }
      for (std::size_t side = 0; side < 2 * this->Patches_; ++side)
      {
        patches[side / 2][side % 2][band] += change * own.Sides[2 * band * this->Patches_ + side];
      }
    }
    if (scaled > 0.0)
    {
      const std::string name = "band " + std::to_string(band) + ": ";
      done.push_back({name + "lights held to their power", scaled,
        "none of their light leaves the scene: smoke and surfaces take up what they send out"});
      done.push_back({name + "direct light made up for", made / all,
        "share of what lights send out; negative: too much was taken up"});
    }
  }
  return done;
}

} // namespace smokevis
