// The view-independent light of a scene: fluence in the smoke, illuminance on surfaces.
#pragma once

#include "Progress.h"
#include "Scene.h"

#include <string>
#include <vector>

namespace smokevis
{

class Team;

/// One thing that the solver did or left out, for the WorkReport.
struct WorkItem
{
  std::string What;
  double Count = 0.0;
  std::string Why;
};

/// What rays leap over in a smoke.
WorkItem LeaptAir(const Medium& smoke);

struct LightFieldOptions
{
  /// Relative standard error that veil luminances are to have.
  double Tolerance = 0.01;
  std::uint64_t Seed = 1;
  /// Most worker threads; 0: as many as the machine has. The result does not depend on it.
  int Threads = 0;
  /// Leaves out what the scene does not need; off: does everything, to measure what that saves.
  bool Skips = true;
  /// The processes that solve it together, all with the same scene and options; null: this one
  /// alone. The result does not depend on how many they are.
  Team* Colleagues = nullptr;
};

/// Plain result of the solver. Patches are surface cells, then emitter cells; sides are front,
/// back.
struct LightField
{
  int Bands = 1;
  std::size_t Cells = 0;
  std::size_t Patches = 0;
  /// What it was solved to: see LightFieldOptions. 0: not known, and taken for a small one.
  double Tolerance = 0.0;
  /// Mean over each cell of the fluence [lx] that comes straight from emitters: [band][cell].
  std::vector<float> DirectFluence;
  /// The rest of the fluence [lx], a value a batch: [band][cell].
  std::vector<Lanes> MultipleFluence;
  /// Mean illuminance of each patch straight from emitters [lx]: [band][patch][side].
  std::vector<float> DirectIlluminance;
  /// The rest of it, a value a batch: [band][patch][side].
  std::vector<Lanes> MultipleIlluminance;
  /// Gradient of that over the front of each emitter cell, over its mean there [1/m]:
  /// [band][emitter cell]. Empty: it is even.
  std::vector<glm::vec3> MultipleGradient;
  /// What was done and what was left out.
  std::vector<WorkItem> Report;
  /// Cells in which light is scattered more than once on a mean way through them, of the band that
  /// has most: too coarse to tell how it varies there.
  std::size_t CoarseCells = 0;

  std::size_t CellIndex(int band, std::int64_t cell) const { return band * this->Cells + cell; }
  std::size_t PatchIndex(int band, std::size_t patch, int side) const
  {
    return (band * this->Patches + patch) * 2 + side;
  }
  /// MultipleGradient of the front of any patch [1/m].
  Vec3 GradientOn(int band, std::size_t patch) const
  {
    const std::size_t emitters = this->MultipleGradient.size() / this->Bands;
    const std::size_t surfaces = this->Patches - emitters;
    return patch < surfaces ? Vec3(0.0)
                            : Vec3(this->MultipleGradient[band * emitters + patch - surfaces]);
  }
};

/// Solves the radiative transfer equation for the scene. Throws Error, also when stopped.
LightField SolveLightField(
  const Scene& scene, const LightFieldOptions& options, Progress& progress);

} // namespace smokevis
