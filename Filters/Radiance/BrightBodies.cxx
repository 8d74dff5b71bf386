#include "BrightBodies.h"

#include "CellLoops.h"
#include "FirstSource.h"
#include "Scene.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace smokevis
{

namespace
{

constexpr double BrightShare = 0.7;
/// Of light that flames send out: what is left comes from cells around, which may be where it gets
/// farthest, as below a layer of smoke.
constexpr double GlowingShare = 0.9;
/// Roundings must not decide whether a cell more is needed for the share.
constexpr double RoundingShare = 1.0 - 1e-6;
constexpr std::size_t MostBodies = 8;
/// Before those that fit into one box are joined: flames lie about in pieces.
constexpr std::size_t MostParts = 64;
/// Bodies that are about as strong as one left out are left out: roundings must not choose.
constexpr double AboutAsStrong = 0.999;
/// How much darker a cell is than the brightest is told in eighths of halvings, up to 128 of these.
constexpr double StepsAHalving = 8.0;
constexpr std::uint16_t MostSteps = 1024;
/// Of cells without a source, and of those that are not bright.
constexpr std::uint16_t Dark = MostSteps + 1;

/// For each cell by how many steps it is darker than the brightest.
std::vector<std::uint16_t> StepsOf(const FirstSource& source, std::size_t cells)
{
  const double brightest = ReduceCells(
    cells, 0.0,
    [&](double& most, std::int64_t cell) { most = std::max(most, source.PerVolume(cell)); },
    [](double a, double b) { return std::max(a, b); });
  std::vector<std::uint16_t> steps(cells, Dark);
  if (!(brightest > 0.0) || !std::isfinite(brightest))
  {
    return steps;
  }
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cells, 65536),
    [&](const tbb::blocked_range<std::size_t>& range)
    {
      for (std::size_t cell = range.begin(); cell < range.end(); ++cell)
      {
        const double own = source.PerVolume(static_cast<std::int64_t>(cell));
        const double darker = StepsAHalving * std::log2(brightest / own);
        if (own > 0.0 && darker < MostSteps)
        {
          steps[cell] = static_cast<std::uint16_t>(std::lround(darker));
        }
      }
    });
  return steps;
}

/// Leaves steps only to the brightest cells that together make a share of the light.
void KeepBright(const FirstSource& source, double share, std::vector<std::uint16_t>& steps)
{
  const std::vector<double> powers = ReduceCells(
    steps.size(), std::vector<double>(MostSteps + 1, 0.0),
    [&](std::vector<double>& sums, std::int64_t cell)
    {
      if (steps[cell] != Dark)
      {
        sums[steps[cell]] += source.OfCell(cell);
      }
    },
    [](std::vector<double> a, const std::vector<double>& b)
    {
      std::transform(a.begin(), a.end(), b.begin(), a.begin(), std::plus<>());
      return a;
    });
  const double wanted = share * RoundingShare * std::accumulate(powers.begin(), powers.end(), 0.0);
  std::uint16_t most = 0;
  for (double sum = powers[0]; sum < wanted && most < MostSteps; sum += powers[most])
  {
    ++most;
  }
  for (std::uint16_t& step : steps)
  {
    step = step > most ? Dark : step;
  }
}

/// Leaves the strongest, so many at most, in the order that they are in.
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
  const auto next = shares.begin() + static_cast<std::ptrdiff_t>(count);
  std::nth_element(shares.begin(), next, shares.end(), std::greater<>());
  std::erase_if(
    bodies, [most = *next / AboutAsStrong](const BrightBody& body) { return body.Share <= most; });
}

/// Bright cells that lie side by side, body by body, with their power as share.
std::vector<BrightBody> Connected(
  const Medium& smoke, const FirstSource& source, std::vector<std::uint16_t> steps)
{
  std::vector<BrightBody> bodies;
  std::vector<std::int64_t> next;
  for (std::size_t first = 0; first < steps.size(); ++first)
  {
    BrightBody body;
    const auto take = [&](std::int64_t cell)
    {
      if (cell >= 0 && steps[cell] != Dark)
      {
        body.Bounds.Add(smoke.CellBounds(cell));
        body.Share += source.OfCell(cell);
        steps[cell] = Dark;
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

/// @param share of the source's light that the bodies make together
/// @param whole what their own is a share of [lm]
std::vector<BrightBody> BodiesOf(
  const Scene& scene, const FirstSource& source, double share, double whole)
{
  if (!(whole > 0.0) || !std::isfinite(whole))
  {
    return {};
  }
  std::vector<std::uint16_t> steps = StepsOf(source, scene.Smoke().Cells());
  KeepBright(source, share, steps);
  std::vector<BrightBody> bodies = Connected(scene.Smoke(), source, std::move(steps));
  KeepStrongest(bodies, MostParts);
  JoinWhereSmaller(
    bodies, [](const BrightBody& body) -> const Box& { return body.Bounds; },
    [](BrightBody& body, const BrightBody& other)
    {
      body.Bounds.Add(other.Bounds);
      body.Share += other.Share;
    });
  KeepStrongest(bodies, MostBodies);
  for (BrightBody& body : bodies)
  {
    body.Share /= whole;
  }
  return bodies;
}

} // namespace

std::vector<BrightBody> BrightBodies(
  const Scene& scene, const LightField& field, int band, const Box& outer)
{
  const FirstSource source(scene, field, band);
  return BodiesOf(scene, source, BrightShare, source.Whole(outer));
}

std::vector<BrightBody> GlowingBodies(
  const Scene& scene, const LightField& field, int band, const Box& outer)
{
  if (!scene.Smoke().Emits())
  {
    return {};
  }
  const FirstSource source(scene, field, band);
  return BodiesOf(scene, source.WithoutScattering(), GlowingShare, source.Whole(outer));
}

} // namespace smokevis
