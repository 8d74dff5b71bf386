// What is to be solved: smoke, surfaces, emitters, and what they prepare for the solver.
#pragma once

#include "Emitters.h"
#include "Exposure.h"
#include "Geometry.h"
#include "Medium.h"
#include "Triangle.h"
#include "Types.h"

#include <algorithm>
#include <memory>
#include <vector>

#include <tbb/collaborative_call_once.h>

namespace smokevis
{

class NearLights;
class OpenFaces;

/// Plain description of a scene. Lengths in m, extinction in 1/m, luminance in cd/m2.
struct SceneDescription
{
  /// Colour bands that are solved: 1 (luminance) or 3.
  int Bands = 1;
  /// Extinction of each band relative to the given one, (633 nm / wavelength)^alpha.
  Spectrum ExtinctionScale = {1.0, 1.0, 1.0};
  /// Single-scattering albedo of the smoke, 0 to 1.
  double Albedo = 0.3;
  /// Luminance that comes in from all directions where nothing is met, in all bands [cd/m2].
  double Sky = 0.0;
  /// Smoke grids; where they overlap the one with the smaller cells counts.
  std::vector<SmokeGrid> Grids;
  /// Walls, floors, obstructions.
  SurfaceMesh Surfaces;
  /// Plates of signs and lamps.
  std::vector<EmitterCell> Emitters;
  /// Whether rays leap over bricks of clear cells; off: to measure what that saves.
  bool LeapsClearAir = true;

  bool operator==(const SceneDescription&) const = default;
};

/// A scene made ready: search structures built, input checked. To all appearances immutable, and
/// safe to share between threads. The radiating elements ("patches") are the surface cells followed
/// by the emitter cells; each has a front side (0) and a back side (1).
class Scene
{
public:
  /// Throws Error where the description is not usable (what, where, what to do).
  /// @param earlier a scene whose search structures are taken over where its shapes are the same
  explicit Scene(SceneDescription description, const Scene* earlier = nullptr);
  ~Scene();

  /// Whether they were.
  bool SharesShapes() const { return this->SharesShapes_; }

  int Bands() const { return this->Description_.Bands; }
  double Albedo() const { return this->Description_.Albedo; }
  double Sky() const { return this->Description_.Sky; }
  double ExtinctionScale(int band) const { return this->Description_.ExtinctionScale[band]; }
  /// Whether in a band smoke scatters or any surface reflects.
  bool SendsOn(int band) const;
  /// Of the band that the smoke dims most.
  double LargestScale() const
  {
    const auto& scale = this->Description_.ExtinctionScale;
    return *std::max_element(scale.begin(), scale.begin() + this->Description_.Bands);
  }
  /// Of the band that the smoke dims least.
  double SmallestScale() const
  {
    const auto& scale = this->Description_.ExtinctionScale;
    return *std::min_element(scale.begin(), scale.begin() + this->Description_.Bands);
  }
  const Medium& Smoke() const { return this->Smoke_; }
  const Geometry& Shapes() const { return *this->Shapes_; }
  const EmitterSet& Lights() const { return this->Lights_; }
  /// Lights near to smoke cells, as exactly as a tolerance asks for; found when they are first
  /// asked for, by all threads of the caller's arena.
  const NearLights& Near(double tolerance) const;
  /// Which cells light passes between; found likewise.
  const OpenFaces& Open() const;

  /// Surface cells come first among the patches.
  std::size_t SurfacePatches() const { return this->Description_.Surfaces.CellReflectance.size(); }
  std::size_t Patches() const { return this->PatchArea_.size(); }
  double PatchArea(std::size_t patch) const { return this->PatchArea_[patch]; }
  /// Area of one side of a patch that nothing touches and covers [m2]; side 0 is the front.
  double ExposedArea(std::size_t patch, int side) const
  {
    return this->Exposure_.Exposed[2 * patch + side];
  }
  /// Area of one side of a patch that a closed solid stands on, which is dark [m2].
  double EnclosedArea(std::size_t patch, int side) const
  {
    return this->Exposure_.Enclosed[2 * patch + side];
  }
  const Spectrum& PatchReflectance(std::size_t patch) const
  {
    return this->PatchReflectance_[patch];
  }
  /// The patch that was hit.
  std::size_t Patch(const Hit& hit) const
  {
    return this->Shapes_->Cell(hit) + (hit.Emitter ? this->SurfacePatches() : 0);
  }
  /// Triangles of surfaces and of emitters; a triangle's cell counts within its mesh.
  const SurfaceMesh& Surfaces() const { return this->Description_.Surfaces; }
  const SurfaceMesh& EmitterMesh() const { return this->EmitterMesh_; }

  /// Calls visit(patch, corners) for all of them.
  template <class Visit> void ForEachTriangle(Visit&& visit) const;

  /// The corner with the smallest and the one with the largest coordinates of all there is.
  const Vec3& Lower() const { return this->Lower_; }
  const Vec3& Upper() const { return this->Upper_; }

private:
  /// @param size diagonal of the scene [m]
  void FindShapes(double size);

  /// Without its grids and emitters, which move into Smoke_ and Lights_.
  SceneDescription Description_;
  SurfaceMesh EmitterMesh_;
  Medium Smoke_;
  EmitterSet Lights_;
  std::shared_ptr<const Geometry> Shapes_;
  bool SharesShapes_ = false;
  mutable tbb::collaborative_once_flag OpenFound_;
  /// Fine ones, then coarse ones.
  mutable std::array<tbb::collaborative_once_flag, 2> NearFound_;
  mutable std::array<std::unique_ptr<const NearLights>, 2> Near_;
  mutable std::unique_ptr<const OpenFaces> Open_;
  std::vector<double> PatchArea_;
  Exposure Exposure_;
  std::vector<Spectrum> PatchReflectance_;
  Vec3 Lower_{0.0};
  Vec3 Upper_{0.0};
};

/// Triangles of each patch that have an area, without those that repeat another of the patch.
std::vector<std::vector<Triangle>> TrianglesOfPatches(const Scene& scene);

template <class Visit> void Scene::ForEachTriangle(Visit&& visit) const
{
  std::size_t first = 0;
  for (const SurfaceMesh* mesh : {&this->Surfaces(), &this->EmitterMesh()})
  {
    for (std::size_t i = 0; i < mesh->Triangles.size(); ++i)
    {
      const auto& triangle = mesh->Triangles[i];
      visit(first + mesh->TriangleCell[i],
        Triangle{mesh->Points[triangle[0]], mesh->Points[triangle[1]], mesh->Points[triangle[2]]});
    }
    first += mesh->CellReflectance.size();
  }
}

} // namespace smokevis
