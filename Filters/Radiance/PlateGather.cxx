#include "PlateGather.h"

#include "IndirectLight.h"
#include "MultipleShape.h"
#include "Sampler.h"
#include "SignFacets.h"
#include "Team.h"
#include "Triangle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include <glm/gtc/constants.hpp>
#include <tbb/parallel_for.h>

namespace smokevis
{

namespace
{

/// Share of the surface of the box around the scene.
constexpr double LargestShare = 0.02;
/// Rays of a batch: first, and most.
constexpr int FirstRays = 32;
constexpr int MostRays = 2048;
/// Of a batch from each place of a course: most.
constexpr int MostCourseRays = 128;
/// A sign of more cells gathers for those that are to be bright and for the others alone.
constexpr std::size_t MostOwnCells = 16;
/// How far before a plate its rays begin: the smoke between is missing, where its light is
/// brightest.
constexpr double LiftTolerances = 2.0;
/// Streams of random numbers.
constexpr std::uint64_t FirstStream = 0;
constexpr std::uint64_t WholeStream = 1;
constexpr std::uint64_t CourseStream = 2;
/// Places by which it is told whether any of a plate is free.
constexpr int Trials = 64;

/// Cells of a sign, as triangles.
class PlatePlaces
{
public:
  PlatePlaces(const EmitterSet& lights, const std::vector<std::size_t>& cells)
  {
    for (const std::size_t cell : cells)
    {
      const std::vector<Vec3>& vertices = lights.Cells()[cell].Vertices;
      for (std::size_t v = 1; v + 1 < vertices.size(); ++v)
      {
        this->Parts_.push_back({vertices[0], vertices[v], vertices[v + 1]});
        this->Areas_.push_back(
          (this->Areas_.empty() ? 0.0 : this->Areas_.back()) + AreaOf(this->Parts_.back()));
      }
    }
  }

  /// A place for two numbers from 0 to 1, even over the area.
  Vec3 At(double u, double v) const
  {
    const double area = u * this->Areas_.back();
    const auto found = std::upper_bound(this->Areas_.begin(), this->Areas_.end() - 1, area);
    const double before = found == this->Areas_.begin() ? 0.0 : *(found - 1);
    const double share = *found > before ? (area - before) / (*found - before) : 0.0;
    const Triangle& part = this->Parts_[found - this->Areas_.begin()];
    // Even over a triangle: the root spreads from its first corner.
    const double root = std::sqrt(share);
    return (1.0 - root) * part[0] + root * ((1.0 - v) * part[1] + v * part[2]);
  }

private:
  std::vector<Triangle> Parts_;
  /// Of each and all before it.
  std::vector<double> Areas_;
};

} // namespace

PlateGather::PlateGather(const Scene& scene, const LightFieldOptions& options,
  const DirectField& direct, LightField& field, int band)
    : Scene_(scene), Options_(options), Direct_(direct), Field_(field), Band_(band)
{
  this->LargestPlate_ = LargestShare * BoxSurface(scene.Upper() - scene.Lower());
}

std::pair<std::size_t, std::size_t> PlateGather::Run(Team& team, const Progress& progress)
{
  std::vector<Task> tasks;
  std::size_t plates = 0;
  for (std::size_t sign = 0; sign < this->Scene_.Lights().Signs().size(); ++sign)
  {
    if (this->Wanted(this->Scene_.Lights().Signs()[sign]))
    {
      ++plates;
      this->AddTasks(sign, tasks);
    }
  }
  if (tasks.empty())
  {
    return {0, 0};
  }
  const CellShape shape =
    ShapeOfMultiple(this->Scene_, this->Band_, WellKnownMeans(this->Field_, this->Band_));
  const IndirectLight indirect(this->Scene_, this->Field_, this->Direct_, shape, this->Band_,
    IndirectLight::Reflection::OfPlaces);
  // Signs see each other as the lines left them, whichever is gathered first.
  std::vector<Result> results(tasks.size());
  tbb::parallel_for(std::size_t{0}, team.OwnCount(tasks.size()),
    [&](std::size_t i)
    {
      const std::size_t own = team.OwnItem(i);
      results[own] = this->Gather(tasks[own], indirect, progress);
    });
  progress.ThrowIfStopped("light field");
  team.Complete<Result>(results.size(), [&](std::size_t i, auto&& take) { take(results[i]); });
  std::size_t rays = 0;
  for (std::size_t i = 0; i < tasks.size(); ++i)
  {
    rays += results[i].Rays;
    this->Keep(tasks[i], results[i]);
  }
  return {plates, rays};
}

void PlateGather::AddTasks(std::size_t index, std::vector<Task>& tasks) const
{
  const Sign& sign = this->Scene_.Lights().Signs()[index];
  const bool emits = std::any_of(sign.Cells.begin(), sign.Cells.end(),
    [&](std::size_t cell)
    { return this->Scene_.Lights().Cells()[cell].Luminance[this->Band_] > 0.0; });
  if (!emits)
  {
    tasks.push_back({index, sign.Cells, true});
    return;
  }
  if (sign.Cells.size() <= MostOwnCells)
  {
    for (const std::size_t cell : sign.Cells)
    {
      tasks.push_back({index, {cell}, false});
    }
    return;
  }
  const std::vector<bool> lit = LitCells(this->Scene_.Lights(), sign);
  for (const bool bright : {true, false})
  {
    Task task{index, {}, false};
    std::copy_if(sign.Cells.begin(), sign.Cells.end(), std::back_inserter(task.Cells),
      [&](std::size_t cell) { return lit[cell] == bright; });
    if (!task.Cells.empty())
    {
      tasks.push_back(std::move(task));
    }
  }
}

bool PlateGather::Wanted(const Sign& sign) const
{
  const EmitterSet& lights = this->Scene_.Lights();
  double area = 0.0;
  bool plane = true;
  bool reflects = false;
  for (const std::size_t cell : sign.Cells)
  {
    area += lights.CellArea(cell);
    plane = plane && glm::dot(lights.CellNormal(cell), sign.Normal) > 1.0 - 1e-6;
    reflects = reflects || lights.Cells()[cell].Reflectance[this->Band_] > 0.0;
  }
  return plane && reflects && area <= this->LargestPlate_;
}

bool PlateGather::Sunk(const Sign& sign, const Vec3& place) const
{
  const Vec3 u = glm::normalize(sign.Corners[1] - sign.Corners[0]);
  const Vec3 v = glm::cross(sign.Normal, u);
  // Slightly askew, so that no ray runs along edges.
  std::array<Vec3, 5> directions = {
    0.0137 * u, u + 0.31 * v, v - 0.29 * u, -u - 0.27 * v, 0.33 * u - v};
  for (Vec3& direction : directions)
  {
    direction = glm::normalize(sign.Normal + direction);
  }
  return this->Scene_.Shapes().SeesBacks(place, directions);
}

bool PlateGather::SeesAll(const Sign& sign) const
{
  const Vec3 lift = LiftTolerances * this->Scene_.Shapes().Tolerance() * sign.Normal;
  bool free = std::all_of(sign.Cells.begin(), sign.Cells.end(),
    [&](std::size_t cell) { return this->Scene_.Lights().InOnePlane(cell, sign.Cells.front()); });
  for (std::size_t place = 0; place < PlateCourse::Places && free; ++place)
  {
    free = !this->Sunk(sign, PlateCourse::Place(sign, place) + lift);
  }
  return free;
}

PlateGather::Result PlateGather::Gather(
  const Task& task, const IndirectLight& indirect, const Progress& progress) const
{
  const std::size_t index = task.Sign;
  const Sign& sign = this->Scene_.Lights().Signs()[index];
  const Vec3 tangent = glm::normalize(sign.Corners[1] - sign.Corners[0]);
  const Vec3 lift = LiftTolerances * this->Scene_.Shapes().Tolerance() * sign.Normal;
  const PlatePlaces places(this->Scene_.Lights(), task.Cells);
  const EvenPoints trials(Mix(index));
  int free = 0;
  for (int trial = 0; trial < Trials; ++trial)
  {
    const auto random = trials.Point(trial);
    free += this->Sunk(sign, places.At(random[0], random[1]) + lift) ? 0 : 1;
  }
  // Where no place is free, surfaces may be inside out.
  const bool partly = free > 0 && free < Trials;
  double direct = 0.0;
  double area = 0.0;
  for (const std::size_t cell : task.Cells)
  {
    const double own = this->Scene_.Lights().CellArea(cell);
    direct += own * this->Field_.DirectIlluminance[this->Field_.PatchIndex(
                      this->Band_, this->Scene_.SurfacePatches() + cell, 0)];
    area += own;
  }
  direct /= area;

  Result result;
  const auto gather = [&](std::uint64_t stream, int rays)
  {
    Lanes illuminance;
    for (int batch = 0; batch < Batches && !progress.ShouldStop(); ++batch)
    {
      // Even over what is free of the plate, and over directions by their cosine. All cells of a
      // sign draw the same, so that their noise is much the same and no pattern.
      const std::uint64_t key = this->Key(index, stream, batch);
      const EvenPoints points(key);
      double sum = 0.0;
      int used = 0;
      for (int ray = 0; ray < rays || (used == 0 && ray < MostRays); ++ray)
      {
        const auto random = points.Point(ray);
        const Vec3 place = places.At(random[0], random[1]) + lift;
        if (partly && this->Sunk(sign, place))
        {
          continue;
        }
        const Vec3 direction = LambertianDirection(sign.Normal, tangent, random[2], random[3]);
        sum +=
          glm::pi<double>() * indirect.Radiance(place, direction, ToUnit(Mix(key + ray)), batch);
        ++used;
      }
      illuminance[batch] = static_cast<float>(sum / std::max(1, used));
    }
    result.Rays += static_cast<std::size_t>(Batches) * rays;
    return illuminance;
  };
  // The first rays only tell how many it takes: to stop where batches happen to agree would favour
  // those that missed what is rare and bright.
  const Lanes first = gather(FirstStream, FirstRays);
  const double wanted = this->Options_.Tolerance * (Mean(first) + direct);
  const double error = StandardError(first);
  const double rays = error > wanted ? FirstRays * std::pow(error / wanted, 2) : FirstRays;
  const int used = static_cast<int>(std::min<double>(rays, MostRays));
  result.Illuminance = gather(WholeStream, used);
  if (!partly && task.Whole && this->SeesAll(sign))
  {
    const int own = std::min(used, MostCourseRays);
    result.Course = this->FindCourse(index, indirect, own, progress);
    result.Rays += Batches * PlateCourse::Places * own;
  }
  return result;
}

PlateCourse PlateGather::FindCourse(
  std::size_t index, const IndirectLight& indirect, int rays, const Progress& progress) const
{
  const Sign& sign = this->Scene_.Lights().Signs()[index];
  const Vec3 tangent = glm::normalize(sign.Corners[1] - sign.Corners[0]);
  const Vec3 lift = LiftTolerances * this->Scene_.Shapes().Tolerance() * sign.Normal;
  std::array<DoubleLanes, PlateCourse::Places> light{};
  for (int batch = 0; batch < Batches && !progress.ShouldStop(); ++batch)
  {
    // From all places the same way, so that their noise is much the same.
    const std::uint64_t key = this->Key(index, CourseStream, batch);
    const EvenPoints points(key);
    for (int ray = 0; ray < rays; ++ray)
    {
      const auto random = points.Point(ray);
      const Vec3 direction = LambertianDirection(sign.Normal, tangent, random[2], random[3]);
      for (std::size_t place = 0; place < PlateCourse::Places; ++place)
      {
        light[place][batch] += indirect.Radiance(
          PlateCourse::Place(sign, place) + lift, direction, ToUnit(Mix(key + ray)), batch);
      }
    }
  }
  return PlateCourse(light);
}

void PlateGather::Keep(const Task& task, const Result& result)
{
  const Sign& sign = this->Scene_.Lights().Signs()[task.Sign];
  std::vector<PlateCourse::CellLight> lights;
  if (task.Whole)
  {
    lights = result.Course.Cells(this->Scene_.Lights(), sign);
  }
  for (std::size_t i = 0; i < task.Cells.size(); ++i)
  {
    Lanes& illuminance = this->Field_.MultipleIlluminance[this->Field_.PatchIndex(
      this->Band_, this->Scene_.SurfacePatches() + task.Cells[i], 0)];
    illuminance = result.Illuminance;
    if (!task.Whole)
    {
      continue;
    }
    for (int batch = 0; batch < Batches; ++batch)
    {
      illuminance[batch] = static_cast<float>(lights[i].Share[batch] * illuminance[batch]);
    }
    const std::size_t emitters = this->Scene_.Lights().Cells().size();
    this->Field_.MultipleGradient[this->Band_ * emitters + task.Cells[i]] =
      glm::vec3(lights[i].Gradient);
  }
}

std::uint64_t PlateGather::Key(std::size_t sign, std::uint64_t stream, int batch) const
{
  return Mix(Mix(this->Options_.Seed + 0x51A7EULL * (sign + 1)) + Batches * stream + batch);
}

} // namespace smokevis
