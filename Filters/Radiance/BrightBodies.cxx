#include "BrightBodies.h"

#include "LightField.h"
#include "Scene.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>

#include <glm/gtc/constants.hpp>

namespace smokevis
{

namespace
{

constexpr double BrightShare = 0.7;
/// With those that are about as strong as the last one: roundings must not choose among them.
constexpr std::size_t MostBodies = 8;
constexpr double AboutAsStrong = 0.999;
/// Before those that fit into one box are joined: flames lie about in pieces.
constexpr std::size_t MostParts = 64;
/// Brightness is told to an eighth of its doubling, compared with the brightest cell, so that it
/// does not hang on units.
constexpr double StepsADoubling = 8.0;

/// What smoke emits and scatters of direct light.
class FirstPower
{
public:
  FirstPower(const Scene& scene, const LightField& field, int band)
      : Smoke_(scene.Smoke()), Direct_(field.DirectFluence.data() + field.CellIndex(band, 0)),
        Scatters_(scene.Albedo() * scene.ExtinctionScale(band)),
        Emits_(4.0 * glm::pi<double>() * (1.0 - scene.Albedo()) * scene.ExtinctionScale(band))
  {
  }

  /// Of a cell [lm/m3].
  double PerVolume(std::int64_t cell) const
  {
    return this->Smoke_.Extinction(cell) * (this->Scatters_ * this->Direct_[cell] +
                                             this->Emits_ * this->Smoke_.EmittedLuminance(cell));
  }
  /// Of a cell [lm].
  double Of(std::int64_t cell) const
  {
    return this->PerVolume(cell) * this->Smoke_.OwnVolume(cell);
  }

private:
  const Medium& Smoke_;
  const float* Direct_;
  double Scatters_, Emits_;
};

/// The brightest cells that together make BrightShare of the light.
std::vector<bool> BrightCells(const FirstPower& power, std::size_t cells)
{
  double brightest = 0.0;
  double all = 0.0;
  for (std::size_t cell = 0; cell < cells; ++cell)
  {
    if (const double own = power.Of(static_cast<std::int64_t>(cell)); own > 0.0)
    {
      brightest = std::max(brightest, power.PerVolume(static_cast<std::int64_t>(cell)));
      all += own;
    }
  }
  const auto steps = [&](std::int64_t cell)
  { return std::lround(StepsADoubling * std::log2(brightest / power.PerVolume(cell))); };
  // Power by how many steps darker than the brightest cell it is.
  std::map<long, double> powers;
  for (std::size_t cell = 0; cell < cells; ++cell)
  {
    if (const double own = power.Of(static_cast<std::int64_t>(cell)); own > 0.0)
    {
      powers[steps(static_cast<std::int64_t>(cell))] += own;
    }
  }
  double sum = 0.0;
  long most = 0;
  for (auto step = powers.begin(); step != powers.end() && sum < BrightShare * all; ++step)
  {
    most = step->first;
    sum += step->second;
  }
  std::vector<bool> bright(cells, false);
  for (std::size_t i = 0; i < cells; ++i)
  {
    const auto cell = static_cast<std::int64_t>(i);
    bright[i] = power.Of(cell) > 0.0 && steps(cell) <= most;
  }
  return bright;
}

/// Leaves the strongest, so many at least, in the order that they are in.
void KeepStrongest(std::vector<BrightBody>& bodies, std::size_t count)
{
  if (bodies.size() <= count)
  {
    return;
  }
  std::vector<double> shares;
  for (const BrightBody& body : bodies)
  {
    shares.push_back(body.Share);
  }
  const auto last = shares.begin() + static_cast<std::ptrdiff_t>(count - 1);
  std::nth_element(shares.begin(), last, shares.end(), std::greater<>());
  std::erase_if(
    bodies, [least = AboutAsStrong * *last](const BrightBody& body) { return body.Share < least; });
}

/// Bright cells that touch each other, body by body, with their power as share.
std::vector<BrightBody> Connected(
  const Medium& smoke, const FirstPower& power, std::vector<bool> bright)
{
  std::vector<BrightBody> bodies;
  std::vector<std::int64_t> next;
  for (std::size_t first = 0; first < bright.size(); ++first)
  {
    BrightBody body;
    const auto take = [&](std::int64_t cell)
    {
      if (cell >= 0 && bright[cell])
      {
        const Vec3 half = 0.5 * smoke.CellSize(cell);
        body.Bounds.Add({smoke.CellCentre(cell) - half, smoke.CellCentre(cell) + half});
        body.Share += power.Of(cell);
        bright[cell] = false;
        next.push_back(cell);
      }
    };
    take(static_cast<std::int64_t>(first));
    while (!next.empty())
    {
      const std::int64_t cell = next.back();
      next.pop_back();
      for (int face = 0; face < 6; ++face)
      {
        take(smoke.Neighbour(cell, face / 2, face % 2));
      }
    }
    if (body.Share > 0.0)
    {
      bodies.push_back(body);
    }
  }
  return bodies;
}

} // namespace

std::vector<BrightBody> BrightBodies(const Scene& scene, const LightField& field, int band)
{
  const FirstPower power(scene, field, band);
  std::vector<BrightBody> bodies =
    Connected(scene.Smoke(), power, BrightCells(power, scene.Smoke().Cells()));
  KeepStrongest(bodies, MostParts);
  JoinWhereSmaller(
    bodies, [](const BrightBody& body) -> const Box& { return body.Bounds; },
    [](BrightBody& body, const BrightBody& other)
    {
      body.Bounds.Add(other.Bounds);
      body.Share += other.Share;
    });
  KeepStrongest(bodies, MostBodies);
  double whole = 0.0;
  for (std::size_t cell = 0; cell < scene.Smoke().Cells(); ++cell)
  {
    whole += power.Of(static_cast<std::int64_t>(cell));
  }
  for (std::size_t side = 0; side < 2 * scene.Patches(); ++side)
  {
    whole += scene.PatchReflectance(side / 2)[band] * scene.ExposedArea(side / 2, side % 2) *
             field.DirectIlluminance[field.PatchIndex(band, side / 2, side % 2)];
  }
  for (BrightBody& body : bodies)
  {
    body.Share /= whole;
  }
  return bodies;
}

} // namespace smokevis
