// Indirect light on the plates of signs, gathered along rays through the solved light field.
#pragma once

#include "LightField.h"
#include "PlateCourse.h"
#include "Scene.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace smokevis
{

class DirectField;
class IndirectLight;
class Team;

/// Gathers the indirect illuminance of small signs that reflect. Random lines meet them too rarely,
/// and the cells of their pattern more rarely still, so that noise would pass for a pattern.
/// Indirect light varies smoothly over a plate that is small against the scene, so that the cells
/// of a sign that only reflects share one value, and a course over the plate. Smoke glows before
/// what is lit: each cell of a luminous sign has a value of its own, or of one of many cells those
/// that are to be bright have one and the others another.
class PlateGather
{
public:
  /// @param direct is the direct light in the smoke
  /// @param field holds all light of the band; receives the new illuminances of fronts
  PlateGather(const Scene& scene, const LightFieldOptions& options, const DirectField& direct,
    LightField& field, int band);

  /// All plates, in parallel. Returns how many were gathered, and how many rays that took. Throws
  /// Error when it is stopped.
  std::pair<std::size_t, std::size_t> Run(Team& team, const Progress& progress);

private:
  /// Cells of a sign that share a value.
  struct Task
  {
    std::size_t Sign;
    std::vector<std::size_t> Cells;
    /// Whether these are all of a sign that only reflects.
    bool Whole;
  };
  bool Wanted(const Sign& sign) const;
  /// Of the random numbers of a sign.
  std::uint64_t Key(std::size_t sign, std::uint64_t stream, int batch) const;
  void AddTasks(std::size_t index, std::vector<Task>& tasks) const;
  /// Whether backs of surfaces are all that is seen from before a place: it is in a solid that a
  /// part of the sign is sunk into.
  bool Sunk(const Sign& sign, const Vec3& place) const;
  /// Whether the light at all places of its course is that on the sign: its cells are in one plane,
  /// and nowhere in the rectangle around it is there a solid.
  bool SeesAll(const Sign& sign) const;
  struct Result
  {
    Lanes Illuminance;
    /// Over the whole sign.
    PlateCourse Course;
    std::size_t Rays = 0;
  };
  Result Gather(const Task& task, const IndirectLight& indirect, const Progress& progress) const;
  PlateCourse FindCourse(
    std::size_t sign, const IndirectLight& indirect, int rays, const Progress& progress) const;
  void Keep(const Task& task, const Result& result);

  const Scene& Scene_;
  const LightFieldOptions& Options_;
  const DirectField& Direct_;
  LightField& Field_;
  int Band_;
  /// A sign whose area is larger is a wall [m2].
  double LargestPlate_;
};

} // namespace smokevis
