// Light that is not direct: the second part of a light field's solution.
#pragma once

#include "LightField.h"

#include <memory>
#include <string>

#include <tbb/task_arena.h>

namespace smokevis
{

class BatchSweeps;
class DirectField;
class LineSweep;
class PowerBalance;
class VeilProbes;

/// Works out, band by band, what smoke and surfaces send on of the direct light and of each
/// other's, and the light of what is left to random lines. Needs the direct light of all cells and
/// patches.
class MultipleSolve
{
public:
  /// @param from share of the progress bar at which this begins
  /// @param field holds the direct light; receives the rest, and what was done and left out
  MultipleSolve(const Scene& scene, const LightFieldOptions& options, Team& team,
    Progress& progress, tbb::task_arena& arena, double from, LightField& field);
  ~MultipleSolve();

  /// Throws Error where light does not settle, and when it is stopped.
  void Band(int band);

private:
  /// Why the band has nothing but direct light; empty where it may have some.
  std::string WhyNone(int band) const;
  /// Bound of the share of the direct light along lines of sight that all other light is.
  /// @param toSigns lines of sight to signs, or anywhere where there are none
  double LargestShare(int band, const VeilProbes& toSigns) const;
  /// Draws a sweep, and more lines from now on where they bring most of the noise; returns through
  /// how many boxes.
  std::size_t Aim(const std::string& name, BatchSweeps& sweeps, const VeilProbes& probes);
  /// Draws sweeps until the error of the veil meets the tolerance; sources' shapes follow them.
  void Refine(const std::string& name, BatchSweeps& sweeps, const VeilProbes& probes);
  /// Keeps the means of the sums. Where diffusion took away more light than there was, which is
  /// where next to none comes, none is left.
  void Keep(int band, const std::string& name, const BatchSweeps& sweeps);
  /// Lets plates gather light that lines would rarely bring. Where no light leaves the scene, all
  /// is scaled to be in balance with them.
  void Gather(
    int band, const std::string& name, const PowerBalance& balance, const BatchSweeps& sweeps);
  void Tell(const std::string& name, const BatchSweeps& sweeps, int settling, double error);
  void Say(const std::string& what, double count, const std::string& why)
  {
    this->Field_.Report.push_back({what, count, why});
  }

  const Scene& Scene_;
  const LightFieldOptions& Options_;
  Team& Team_;
  Progress& Progress_;
  tbb::task_arena& Arena_;
  double From_;
  LightField& Field_;
  /// Made when a band needs it.
  std::unique_ptr<DirectField> Inside_;
};

} // namespace smokevis
