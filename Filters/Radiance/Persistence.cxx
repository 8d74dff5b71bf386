#include "Persistence.h"

#include "GlobalLines.h"
#include "Scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include <tbb/parallel_for.h>

namespace smokevis
{

namespace
{

/// Sweeps in all, and those of them after which light counts that is still there: by then it lies
/// where it lasts.
constexpr int Sweeps = 16;
constexpr int FirstSweeps = 8;
/// Cubes that the scene is parted into for its surfaces, about, and in each the ways that they may
/// face.
constexpr double Cubes = 512.0;
constexpr double MostCubesAlong = 64.0;
constexpr std::size_t Ways = 6;
constexpr std::size_t FewestLines = 4096;
/// Lines that must meet a surface: what few bring back to where it came from would seem to last.
constexpr int FewestHits = 8;
constexpr std::uint64_t DrawKey = 0x5e2d58d8b3bcdf1aULL;

/// Numbers surfaces by where they lie and which way they face.
class Numbering
{
public:
  explicit Numbering(const Box& scene) : Lower_(scene.Lower)
  {
    const Vec3 size = scene.Size();
    const double edge = std::max({std::cbrt(size.x * size.y * size.z / Cubes),
      LargestEdge(size) / MostCubesAlong, std::numeric_limits<double>::min()});
    this->Inverse_ = 1.0 / edge;
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Counts_[axis] = 1 + static_cast<std::size_t>(size[axis] * this->Inverse_);
    }
  }

  std::size_t Count() const
  {
    return Ways * this->Counts_[0] * this->Counts_[1] * this->Counts_[2];
  }

  std::size_t Of(const Vec3& place, const Vec3& normal) const
  {
    std::size_t number = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double along = (place[axis] - this->Lower_[axis]) * this->Inverse_;
      number = number * this->Counts_[axis] +
               std::min(this->Counts_[axis] - 1, static_cast<std::size_t>(std::max(0.0, along)));
    }
    const Vec3 size = glm::abs(normal);
    const std::size_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    return Ways * number + 2 * axis + (normal[static_cast<int>(axis)] < 0.0 ? 1 : 0);
  }

private:
  Vec3 Lower_;
  double Inverse_ = 0.0;
  std::array<std::size_t, 3> Counts_{};
};

/// Two surfaces that a line joins, and what comes to the other of what each of them gets.
struct Way
{
  std::size_t First, Second;
  double Weight, FromFirst, FromSecond;
};

/// What one line, or all of them, meet; ends see nothing but what is outside of the scene.
struct Met
{
  std::vector<Way> Ways;
  std::vector<std::pair<std::size_t, double>> Ends;
};

/// Share of the light of each surface that is still there a sweep later, in the long run.
std::vector<double> Persistences(Met met, std::size_t surfaces)
{
  std::vector<int> hits(surfaces, 0);
  for (const Way& way : met.Ways)
  {
    ++hits[way.First];
    ++hits[way.Second];
  }
  std::erase_if(met.Ways,
    [&](const Way& way) { return hits[way.First] < FewestHits || hits[way.Second] < FewestHits; });
  std::vector<double> weights(surfaces, 0.0);
  for (const Way& way : met.Ways)
  {
    weights[way.First] += way.Weight;
    weights[way.Second] += way.Weight;
  }
  for (const auto& [surface, weight] : met.Ends)
  {
    weights[surface] += weight;
  }
  std::vector<double> left(surfaces, 1.0);
  std::vector<double> first;
  for (int sweep = 0; sweep < Sweeps; ++sweep)
  {
    if (sweep == FirstSweeps)
    {
      first = left;
    }
    std::vector<double> arriving(surfaces, 0.0);
    for (const Way& way : met.Ways)
    {
      arriving[way.Second] += way.Weight * way.FromFirst * left[way.First];
      arriving[way.First] += way.Weight * way.FromSecond * left[way.Second];
    }
    for (std::size_t surface = 0; surface < surfaces; ++surface)
    {
      left[surface] = weights[surface] > 0.0 ? arriving[surface] / weights[surface] : 0.0;
    }
  }
  for (std::size_t surface = 0; surface < surfaces; ++surface)
  {
    left[surface] = first[surface] > 0.0
                      ? std::pow(left[surface] / first[surface], 1.0 / (Sweeps - FirstSweeps))
                      : 0.0;
  }
  return left;
}

} // namespace

double LongestPersistence(
  const Scene& scene, const GlobalLines& lines, int band, const std::vector<bool>& lit)
{
  const Numbering numbering(lines.Outer());
  std::vector<GlobalLines::Draw> draws;
  do
  {
    draws.emplace_back(lines, DrawKey + draws.size());
  } while (draws.size() * lines.Count() < FewestLines);
  std::vector<Met> all(draws.size() * lines.Count());
  tbb::parallel_for(std::size_t{0}, all.size(),
    [&](std::size_t index)
    {
      const GlobalLines::Line line = draws[index / lines.Count()].Get(index % lines.Count());
      std::vector<Crossing> crossings;
      scene.Shapes().Cross(line.Origin, line.Direction, 0.0, line.Length, crossings);
      Met& own = all[index];
      // What the line met last.
      std::size_t surface = 0;
      double reflectance = 0.0;
      const auto meet = [&](const Hit& hit, double distance)
      {
        const std::size_t patch = scene.Patch(hit);
        reflectance = lit[2 * patch + hit.Side] ? scene.PatchReflectance(patch)[band] : 0.0;
        const Vec3 normal = scene.Shapes().Normal(hit);
        surface =
          numbering.Of(line.Origin + distance * line.Direction, hit.Side == 0 ? normal : -normal);
      };
      for (std::size_t i = 0; i < crossings.size(); ++i)
      {
        Way way{surface, 0, line.Weight, reflectance, 0.0};
        const double distance = crossings[i].Arrive.Distance;
        meet(crossings[i].Arrive, distance);
        if (i == 0)
        {
          own.Ends.emplace_back(surface, line.Weight);
        }
        else
        {
          const double transmittance =
            std::exp(-(1.0 - scene.Albedo()) * scene.ExtinctionScale(band) *
                     scene.Smoke().OpticalDepth(
                       line.Origin, line.Direction, crossings[i - 1].Arrive.Distance, distance));
          way.Second = surface;
          way.FromFirst *= transmittance;
          way.FromSecond = transmittance * reflectance;
          own.Ways.push_back(way);
        }
        meet(crossings[i].Leave, distance);
      }
      if (!crossings.empty())
      {
        own.Ends.emplace_back(surface, line.Weight);
      }
    });
  Met met;
  for (const Met& own : all)
  {
    met.Ways.insert(met.Ways.end(), own.Ways.begin(), own.Ways.end());
    met.Ends.insert(met.Ends.end(), own.Ends.begin(), own.Ends.end());
  }
  const std::vector<double> persistences = Persistences(std::move(met), numbering.Count());
  return *std::max_element(persistences.begin(), persistences.end());
}

} // namespace smokevis
