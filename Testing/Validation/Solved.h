// A solved scene and the numbers that tests read from it, with their standard errors.
#pragma once

#include "ReferenceIntegrator.h"
#include "RisingProgress.h"
#include "View.h"
#include "WorkCount.h"

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace smokevis
{

class Solved
{
public:
  explicit Solved(
    SceneDescription description, double tolerance = 0.01, std::uint64_t seed = 1, int threads = 0)
      : TheScene(std::make_shared<const Scene>(std::move(description)))
  {
    LightFieldOptions options;
    options.Tolerance = tolerance;
    options.Seed = seed;
    options.Threads = threads;
    RisingProgress progress;
    this->Field =
      std::make_shared<const LightField>(SolveLightField(*this->TheScene, options, progress));
    this->TheView = std::make_unique<const View>(this->TheScene, this->Field);
  }

  /// Fluence [lx], averaged over cells of equal volume.
  Estimate Fluence(const std::vector<std::int64_t>& cells, int band = 0) const
  {
    double direct = 0.0;
    Average multiple;
    for (const std::int64_t cell : cells)
    {
      const std::size_t index = this->Field->CellIndex(band, cell);
      direct += this->Field->DirectFluence[index];
      multiple.Add(this->Field->MultipleFluence[index], 1.0);
    }
    return multiple.Result(direct, static_cast<double>(cells.size()));
  }

  Estimate Fluence(const Vec3& point) const
  {
    return this->Fluence(std::vector<std::int64_t>{this->TheScene->Smoke().Locate(point)});
  }

  /// Illuminance [lx], averaged over patches of equal area.
  Estimate Illuminance(const std::vector<std::size_t>& patches, int side, int band = 0) const
  {
    double direct = 0.0;
    Average multiple;
    for (const std::size_t patch : patches)
    {
      const std::size_t index = this->Field->PatchIndex(band, patch, side);
      direct += this->Field->DirectIlluminance[index];
      multiple.Add(this->Field->MultipleIlluminance[index], 1.0);
    }
    return multiple.Result(direct, static_cast<double>(patches.size()));
  }

  /// Power that smoke and surfaces absorb, but for what was made up for of direct light in a closed
  /// room [lm]: as quadratures tell it.
  double PowerBeforeBalance() const
  {
    return this->AbsorbedInSmoke().Mean + this->AbsorbedOnSurfaces().Mean -
           WorkCount(this->Field->Report, "band 0: direct light made up for") *
             this->TheScene->Lights().Flux(0);
  }

  /// Power that the smoke absorbs [lm].
  Estimate AbsorbedInSmoke() const
  {
    const Medium& smoke = this->TheScene->Smoke();
    double direct = 0.0;
    Average multiple;
    for (std::size_t i = 0; i < smoke.Cells(); ++i)
    {
      const auto cell = static_cast<std::int64_t>(i);
      const double weight = (1.0 - this->TheScene->Albedo()) * this->TheScene->ExtinctionScale(0) *
                            smoke.Extinction(cell) * smoke.OwnVolume(cell);
      const std::size_t index = this->Field->CellIndex(0, cell);
      direct += weight * this->Field->DirectFluence[index];
      multiple.Add(this->Field->MultipleFluence[index], weight);
    }
    return multiple.Result(direct, 1.0);
  }

  /// Power that surfaces and plates absorb on both their sides [lm].
  Estimate AbsorbedOnSurfaces() const
  {
    double direct = 0.0;
    Average multiple;
    for (std::size_t patch = 0; patch < this->TheScene->Patches(); ++patch)
    {
      for (int side = 0; side < 2; ++side)
      {
        const double weight = (1.0 - this->TheScene->PatchReflectance(patch)[0]) *
                              this->TheScene->ExposedArea(patch, side);
        const std::size_t index = this->Field->PatchIndex(0, patch, side);
        direct += weight * this->Field->DirectIlluminance[index];
        multiple.Add(this->Field->MultipleIlluminance[index], weight);
      }
    }
    return multiple.Result(direct, 1.0);
  }

  /// Luminance along a ray.
  Estimate Luminance(const Ray& ray) const
  {
    const Lanes lanes = this->Trace(ray).TotalLanes();
    return {Mean(lanes), StandardError(lanes)};
  }

  RayLight Trace(const Ray& ray) const
  {
    const Hit hit = this->TheView->FirstHit(ray.Origin, ray.Direction);
    return this->TheView->Trace(ray.Origin, ray.Direction, hit, 0);
  }

  std::shared_ptr<const Scene> TheScene;
  std::shared_ptr<const LightField> Field;
  std::unique_ptr<const View> TheView;

private:
  /// Sums batch by batch, in double precision.
  class Average
  {
  public:
    void Add(const Lanes& lanes, double weight)
    {
      for (int batch = 0; batch < Batches; ++batch)
      {
        this->Sum_[batch] += weight * lanes[batch];
      }
    }

    Estimate Result(double direct, double count) const
    {
      return {(direct + Mean(this->Sum_)) / count, StandardError(this->Sum_) / count};
    }

  private:
    DoubleLanes Sum_{};
  };
};

} // namespace smokevis
