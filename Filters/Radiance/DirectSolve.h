// Direct light of all cells and patches: the first part of a light field's solution.
#pragma once

#include "LightField.h"
#include "Medium.h"

#include <array>
#include <memory>
#include <vector>

#include <tbb/task_arena.h>

namespace smokevis
{

class DirectBalance;
class DirectLight;

/// Works out the light that comes straight from the emitters, in parallel: blocks of cells and
/// patches do not depend on each other.
class DirectSolve
{
public:
  /// @param share of the progress bar, from 0, that this takes
  /// @param field receives the direct fluence and illuminance, and what was left out
  DirectSolve(const Scene& scene, const LightFieldOptions& options, Team& team, Progress& progress,
    tbb::task_arena& arena, double share, LightField& field);

  ~DirectSolve();

  // In this order. Throw Error when it is stopped.
  void Cells();
  void Patches();
  /// Holds the light to the conservation of power and keeps it.
  void Finish();

private:
  /// Lights in the order of what they would send to a block through clear air.
  std::vector<std::size_t> StrongestFirst(const Medium::Block& block) const;
  /// Works out the means over cells of the lights near to them.
  void NearCells();
  /// Adds the light in the parts of cells that walls cut.
  void AddParts(const DirectLight& direct);
  /// Sums over the cells of a block, if a light is held to its power.
  std::vector<Spectrum> SumsIn(std::size_t block, std::size_t light) const;
  /// Notes what a light added to these.
  void Note(std::size_t block, std::size_t light, const std::vector<Spectrum>& before);
  /// Runs body(i) for this process's items of so many, in steps between which progress is reported.
  /// @param grain how many of them are worth a task
  template <class Body>
  void ForOwn(std::size_t count, std::size_t grain, double from, double to, Body&& body);

  const Scene& Scene_;
  const LightFieldOptions& Options_;
  Team& Team_;
  Progress& Progress_;
  tbb::task_arena& Arena_;
  double Share_;
  LightField& Field_;
  std::unique_ptr<DirectBalance> Balance_;
  std::vector<Medium::Block> Blocks_;
  /// Sums over the lights, of cells and of both sides of patches.
  std::vector<Spectrum> CellSums_;
  std::vector<std::array<Spectrum, 2>> PatchSums_;
};

} // namespace smokevis
