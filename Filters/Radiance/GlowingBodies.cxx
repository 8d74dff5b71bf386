#include "GlowingBodies.h"

#include "Scene.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>

#include <glm/gtc/constants.hpp>

namespace smokevis
{

namespace
{

constexpr double BrightShare = 0.9;
constexpr std::size_t MostBodies = 8;

/// A cell that shines, and its power and that per volume, over what is the same for all.
struct BrightCell
{
  std::int64_t Index;
  double Power, PerVolume;
};

std::vector<BrightCell> ShiningCells(const Medium& smoke)
{
  std::vector<BrightCell> cells;
  for (std::size_t i = 0; i < smoke.Cells(); ++i)
  {
    const auto cell = static_cast<std::int64_t>(i);
    const double perVolume =
      static_cast<double>(smoke.Extinction(cell)) * smoke.EmittedLuminance(cell);
    const double power = perVolume * smoke.OwnVolume(cell);
    if (power > 0.0)
    {
      cells.push_back({cell, power, perVolume});
    }
  }
  return cells;
}

double PowerOf(const std::vector<BrightCell>& cells)
{
  return std::accumulate(cells.begin(), cells.end(), 0.0,
    [](double sum, const BrightCell& cell) { return sum + cell.Power; });
}

/// Leaves the brightest cells that together send out BrightShare of the power of all.
void KeepBrightest(std::vector<BrightCell>& cells)
{
  const double wanted = BrightShare * PowerOf(cells);
  std::sort(cells.begin(), cells.end(),
    [](const BrightCell& a, const BrightCell& b)
    { return a.PerVolume != b.PerVolume ? a.PerVolume > b.PerVolume : a.Index < b.Index; });
  double sum = 0.0;
  const auto end = std::find_if(cells.begin(), cells.end(),
    [&](const BrightCell& cell)
    {
      const bool enough = sum >= wanted;
      sum += cell.Power;
      return enough;
    });
  cells.erase(end, cells.end());
}

/// Cells that touch each other, body by body.
/// @param whole power that shares are of
std::vector<GlowingBody> Connected(
  const Medium& smoke, const std::vector<BrightCell>& cells, double whole)
{
  std::vector<double> left(smoke.Cells(), 0.0);
  for (const BrightCell& cell : cells)
  {
    left[cell.Index] = cell.Power;
  }
  std::vector<GlowingBody> bodies;
  std::vector<std::int64_t> next;
  for (const BrightCell& first : cells)
  {
    GlowingBody body;
    const auto take = [&](std::int64_t cell)
    {
      if (cell >= 0 && left[cell] > 0.0)
      {
        const Vec3 half = 0.5 * smoke.CellSize(cell);
        body.Bounds.Add({smoke.CellCentre(cell) - half, smoke.CellCentre(cell) + half});
        body.Share += left[cell] / whole;
        left[cell] = 0.0;
        next.push_back(cell);
      }
    };
    take(first.Index);
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

/// Puts bodies together that need not be met more often in one box than in two.
void MergeWhereSmaller(std::vector<GlowingBody>& bodies)
{
  for (std::size_t one = 0; one < bodies.size(); ++one)
  {
    for (std::size_t other = 0; other < one; ++other)
    {
      Box both = bodies[one].Bounds;
      both.Add(bodies[other].Bounds);
      if (both.Surface() <= bodies[one].Bounds.Surface() + bodies[other].Bounds.Surface())
      {
        bodies[other] = {both, bodies[one].Share + bodies[other].Share};
        bodies.erase(bodies.begin() + static_cast<std::ptrdiff_t>(one));
        // Others may fit now.
        one = 0;
        break;
      }
    }
  }
}

} // namespace

std::vector<GlowingBody> GlowingBodies(const Scene& scene, int band)
{
  const Medium& smoke = scene.Smoke();
  const double emits =
    4.0 * glm::pi<double>() * (1.0 - scene.Albedo()) * scene.ExtinctionScale(band);
  std::vector<BrightCell> cells = smoke.Emits() ? ShiningCells(smoke) : std::vector<BrightCell>();
  if (cells.empty() || !(emits > 0.0))
  {
    return {};
  }
  const double whole = PowerOf(cells) + scene.Lights().Flux(band) / emits;
  KeepBrightest(cells);
  std::vector<GlowingBody> bodies = Connected(smoke, cells, whole);
  std::stable_sort(bodies.begin(), bodies.end(),
    [](const GlowingBody& a, const GlowingBody& b) { return a.Share > b.Share; });
  bodies.resize(std::min(bodies.size(), MostBodies));
  MergeWhereSmaller(bodies);
  return bodies;
}

} // namespace smokevis
