#include "Scene.h"

#include "Bodies.h"
#include "CutCells.h"
#include "Errors.h"
#include "LightSight.h"
#include "NearLights.h"
#include "OpenFaces.h"
#include "SmokeBorders.h"
#include "SurfaceCuts.h"

#include <cmath>
#include <limits>
#include <set>
#include <string>

namespace smokevis
{

namespace
{

/// A light whose area is a larger share of the surface of the box around the scene is left to the
/// random lines: one line in fifty meets it.
constexpr double LargeLight = 0.05;
/// Share of a sign's shorter edge to which places must be known.
constexpr double LeastKnownShare = 0.25;

void CheckDescription(const SceneDescription& description)
{
  if (description.Bands != 1 && description.Bands != MaxBands)
  {
    throw Error("scene", "there are " + std::to_string(description.Bands) + " bands",
      "Ask for 1 (luminance) or 3");
  }
  for (int band = 0; band < description.Bands; ++band)
  {
    const double scale = description.ExtinctionScale[band];
    if (!(scale >= 0.0) || !std::isfinite(scale))
    {
      throw Error("scene",
        "the extinction of band " + std::to_string(band) + " is scaled by " + std::to_string(scale),
        "Check the wavelengths and the Angstrom exponent");
    }
  }
  if (!(description.Albedo >= 0.0 && description.Albedo <= 1.0))
  {
    throw Error("scene", "the single-scattering albedo is " + std::to_string(description.Albedo),
      "It must lie between 0 and 1");
  }
  if (!(description.Sky >= 0.0) || !std::isfinite(description.Sky))
  {
    throw Error("scene",
      "the luminance of the sky is " + std::to_string(description.Sky) + " cd/m2",
      "It must be finite and not negative");
  }
  const SurfaceMesh& mesh = description.Surfaces;
  if (mesh.TriangleCell.size() != mesh.Triangles.size())
  {
    throw Error("surfaces", "the triangles' cells are not given", "Give one cell a triangle");
  }
  for (std::size_t i = 0; i < mesh.Triangles.size(); ++i)
  {
    for (const std::uint32_t corner : mesh.Triangles[i])
    {
      if (corner >= mesh.Points.size())
      {
        throw Error("surface triangle " + std::to_string(i), "a corner has no point",
          "Check the geometry that is put in");
      }
    }
    if (mesh.TriangleCell[i] >= mesh.CellReflectance.size())
    {
      throw Error("surface triangle " + std::to_string(i), "its cell has no reflectance",
        "Give one reflectance a cell");
    }
  }
  for (std::size_t cell = 0; cell < mesh.CellReflectance.size(); ++cell)
  {
    for (int band = 0; band < description.Bands; ++band)
    {
      const double value = mesh.CellReflectance[cell][band];
      if (!(value >= 0.0 && value <= 1.0))
      {
        throw Error("surface cell " + std::to_string(cell),
          "the reflectance is " + std::to_string(value), "It must lie between 0 and 1");
      }
    }
  }
}

SurfaceMesh MeshOf(const std::vector<EmitterCell>& cells)
{
  SurfaceMesh mesh;
  for (std::size_t cell = 0; cell < cells.size(); ++cell)
  {
    const auto first = static_cast<std::uint32_t>(mesh.Points.size());
    const std::vector<Vec3>& vertices = cells[cell].Vertices;
    mesh.Points.insert(mesh.Points.end(), vertices.begin(), vertices.end());
    for (std::uint32_t v = 2; v < vertices.size(); ++v)
    {
      mesh.Triangles.push_back({first, first + v - 1, first + v});
      mesh.TriangleCell.push_back(static_cast<std::uint32_t>(cell));
    }
    mesh.CellReflectance.push_back(cells[cell].Reflectance);
  }
  return mesh;
}

/// Throws Error where a sign is so small against all that lies around it that rays cannot tell it
/// from what it hangs on.
void CheckSigns(const std::vector<Sign>& signs, const Geometry& shapes)
{
  for (const Sign& sign : signs)
  {
    const double edge = std::min(glm::length(sign.Corners[1] - sign.Corners[0]),
      glm::length(sign.Corners[3] - sign.Corners[0]));
    if (shapes.Rounding() > LeastKnownShare * edge)
    {
      throw Error("sign " + std::to_string(sign.Id),
        "it is " + std::to_string(edge) + " m wide or high, and rays know places to " +
          std::to_string(shapes.Rounding()) + " m only, so large is the scene",
        "Leave out surfaces and emitters that lie far from the smoke, or the sign, and check the "
        "units of length");
    }
  }
}

/// Leaves one of triangles with the same corners.
void RemoveRepeats(std::vector<Triangle>& triangles)
{
  if (triangles.size() < 2)
  {
    return;
  }
  std::set<std::array<std::array<double, 3>, 3>> known;
  std::erase_if(triangles,
    [&known](const Triangle& corners)
    {
      std::array<std::array<double, 3>, 3> sorted;
      std::transform(corners.begin(), corners.end(), sorted.begin(),
        [](const Vec3& corner) {
          return std::array{corner.x, corner.y, corner.z};
        });
      std::sort(sorted.begin(), sorted.end());
      return !known.insert(sorted).second;
    });
}

} // namespace

Scene::Scene(SceneDescription description, const Scene* earlier)
    : Description_(std::move(description))
{
  CheckDescription(this->Description_);
  this->EmitterMesh_ = MeshOf(this->Description_.Emitters);
  this->Smoke_ = Medium(std::move(this->Description_.Grids), this->Description_.LeapsClearAir);
  this->PatchReflectance_ = this->Description_.Surfaces.CellReflectance;
  this->PatchReflectance_.insert(this->PatchReflectance_.end(),
    this->EmitterMesh_.CellReflectance.begin(), this->EmitterMesh_.CellReflectance.end());
  this->PatchArea_.assign(this->PatchReflectance_.size(), 0.0);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  this->Lower_ = Vec3(infinity);
  this->Upper_ = Vec3(-infinity);
  this->ForEachTriangle(
    [this](std::size_t patch, const Triangle& corners)
    {
      this->PatchArea_[patch] += AreaOf(corners);
      for (const Vec3& corner : corners)
      {
        this->Lower_ = glm::min(this->Lower_, corner);
        this->Upper_ = glm::max(this->Upper_, corner);
      }
    });
  if (!this->Smoke_.Empty())
  {
    this->Lower_ = glm::min(this->Lower_, this->Smoke_.Lower());
    this->Upper_ = glm::max(this->Upper_, this->Smoke_.Upper());
  }
  if (!(this->Lower_.x <= this->Upper_.x))
  {
    throw Error("scene", "it is empty", "Give smoke, surfaces or emitters");
  }
  const Vec3 size = this->Upper_ - this->Lower_;
  this->Lights_ = EmitterSet(std::move(this->Description_.Emitters), this->Description_.Bands);
  this->SharesShapes_ = earlier && earlier->Lower_ == this->Lower_ &&
                        earlier->Upper_ == this->Upper_ &&
                        earlier->Smoke_.Lower() == this->Smoke_.Lower() &&
                        earlier->Smoke_.Upper() == this->Smoke_.Upper() &&
                        earlier->Description_.Surfaces == this->Description_.Surfaces &&
                        earlier->EmitterMesh_ == this->EmitterMesh_;
  if (this->SharesShapes_)
  {
    this->Shapes_ = earlier->Shapes_;
    this->Exposure_ = earlier->Exposure_;
  }
  else
  {
    this->FindShapes(glm::length(size));
  }
  CheckSigns(this->Lights_.Signs(), *this->Shapes_);
  const SmokeBorders borders(this->Smoke_, this->LargestScale());
  const SurfaceCuts cuts(*this->Shapes_);
  this->Lights_.FormLights(LargeLight * BoxSurface(size), &borders, &cuts);
  this->Lights_.MarkCrossed(LightSight(*this->Shapes_));
  if (!this->Smoke_.Empty())
  {
    this->Smoke_.Divide(FindCellParts(*this));
  }
}

Scene::~Scene() = default;

void Scene::FindShapes(double size)
{
  const SurfaceMesh& surfaces = this->Description_.Surfaces;
  const auto shapes = std::make_shared<Geometry>(
    surfaces, this->EmitterMesh_, size, glm::length(this->Smoke_.Upper() - this->Smoke_.Lower()));
  const Bodies bodies(*shapes, surfaces, this->EmitterMesh_);
  this->Exposure_ = FindExposure(*shapes, bodies, surfaces, this->EmitterMesh_);
  if (this->Exposure_.AnyEnclosed())
  {
    shapes->TellBodies(bodies.OfTriangles());
  }
  this->Shapes_ = shapes;
}

const NearLights& Scene::Near(double tolerance) const
{
  const bool coarse = tolerance > DirectLight::FineTolerance;
  tbb::collaborative_call_once(this->NearFound_[coarse],
    [&] { this->Near_[coarse] = std::make_unique<const NearLights>(*this, coarse); });
  return *this->Near_[coarse];
}

const OpenFaces& Scene::Open() const
{
  tbb::collaborative_call_once(
    this->OpenFound_, [this] { this->Open_ = std::make_unique<const OpenFaces>(*this); });
  return *this->Open_;
}

std::vector<std::vector<Triangle>> TrianglesOfPatches(const Scene& scene)
{
  std::vector<std::vector<Triangle>> patches(scene.Patches());
  scene.ForEachTriangle(
    [&](std::size_t patch, const Triangle& corners)
    {
      if (AreaOf(corners) > 0.0)
      {
        patches[patch].push_back(corners);
      }
    });
  for (std::vector<Triangle>& triangles : patches)
  {
    RemoveRepeats(triangles);
  }
  return patches;
}

bool Scene::SendsOn(int band) const
{
  bool any = this->Albedo() > 0.0 && this->Smoke().MaximumExtinction() > 0.0F &&
             this->ExtinctionScale(band) > 0.0;
  for (std::size_t patch = 0; patch < this->Patches() && !any; ++patch)
  {
    any = this->PatchReflectance(patch)[band] > 0.0;
  }
  return any;
}

} // namespace smokevis
