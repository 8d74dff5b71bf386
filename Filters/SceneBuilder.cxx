// Turns VTK data into a scene description.
#include "SceneBuilder.h"

#include "Errors.h"
#include "PhotometricArrays.h"
#include "SurfaceRefiner.h"

#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkImageData.h>
#include <vtkRectilinearGrid.h>

#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

namespace smokevis
{
namespace
{

/// A cell array whose values are checked as they are read.
class CheckedArray
{
public:
  /// @param what   names the quantity and its unit in the remedy
  /// @param upper  largest value allowed
  CheckedArray(vtkDataSet& block, const std::string& blockName, const char* array,
    bool threeAllowed, double lower, double upper, const char* remedy)
      : Values_(CellArray(block, blockName, array, threeAllowed)),
        Where_("cell array " + std::string(array) + " of block '" + blockName + "'"), Lower_(lower),
        Upper_(upper), Remedy_(remedy)
  {
  }

  explicit operator bool() const { return this->Values_ != nullptr; }

  double Value(vtkIdType cell, int component = 0) const
  {
    const double value = this->Values_->GetComponent(cell, component);
    if (!(value >= this->Lower_ && value <= this->Upper_))
    {
      std::ostringstream what;
      what << "the value of cell " << cell << " is " << value;
      throw Error(this->Where_, what.str(), this->Remedy_);
    }
    return value;
  }

  /// One value a band.
  Spectrum Bands(vtkIdType cell, int bands) const
  {
    Spectrum value{};
    const int components = this->Values_->GetNumberOfComponents();
    for (int i = 0; i < components; ++i)
    {
      value[i] = this->Value(cell, i);
    }
    if (components == 1)
    {
      value[1] = value[2] = value[0];
    }
    else if (bands == 1)
    {
      value = {Luminance(value, 3), 0.0, 0.0};
    }
    return value;
  }

private:
  vtkDataArray* Values_;
  std::string Where_;
  double Lower_;
  double Upper_;
  const char* Remedy_;
};

constexpr double Largest = std::numeric_limits<float>::max();

CheckedArray Reflectance(const SurfaceBlock& block)
{
  return {*block.Mesh, block.Name, "Reflectance", true, 0.0, 1.0,
    "Give a diffuse reflectance from 0 to 1"};
}

std::vector<double> Nodes(vtkDataSet& grid, int axis)
{
  std::vector<double> nodes;
  if (auto* const image = vtkImageData::SafeDownCast(&grid))
  {
    int extent[6];
    image->GetExtent(extent);
    for (int i = extent[2 * axis]; i <= extent[2 * axis + 1]; ++i)
    {
      nodes.push_back(image->GetOrigin()[axis] + i * image->GetSpacing()[axis]);
    }
    return nodes;
  }
  auto* const rectilinear = vtkRectilinearGrid::SafeDownCast(&grid);
  vtkDataArray* const coordinates = axis == 0   ? rectilinear->GetXCoordinates()
                                    : axis == 1 ? rectilinear->GetYCoordinates()
                                                : rectilinear->GetZCoordinates();
  for (vtkIdType i = 0; i < coordinates->GetNumberOfTuples(); ++i)
  {
    nodes.push_back(coordinates->GetComponent(i, 0));
  }
  return nodes;
}

SmokeGrid BuildGrid(const SmokeBlock& block)
{
  SmokeGrid result;
  result.Name = block.Name;
  vtkDataSet& grid = *block.Grid;
  for (int axis = 0; axis < 3; ++axis)
  {
    result.Nodes[axis] = Nodes(grid, axis);
  }
  const CheckedArray extinction(grid, block.Name, "Extinction", false, 0.0, Largest,
    "Extinction is a finite number of 1/m from 0; smoke in solid cells is 0");
  const CheckedArray emitted(
    grid, block.Name, "EmittedLuminance", false, 0.0, Largest, "Give a luminance in cd/m2 from 0");
  const vtkIdType cells = grid.GetNumberOfCells();
  result.Extinction.resize(cells);
  result.EmittedLuminance.resize(emitted ? cells : 0);
  for (vtkIdType i = 0; i < cells; ++i)
  {
    const bool hidden = HiddenCell(grid, i);
    result.Extinction[i] = hidden ? 0.0F : static_cast<float>(extinction.Value(i));
    if (emitted)
    {
      result.EmittedLuminance[i] = hidden ? 0.0F : static_cast<float>(emitted.Value(i));
    }
  }
  return result;
}

/// Calls visit(cell, corner points) for every polygon of a block.
template <class Visit> void ForEachPolygon(const SurfaceBlock& block, Visit&& visit)
{
  vtkPolyData& mesh = *block.Mesh;
  if (mesh.GetNumberOfCells() != mesh.GetNumberOfPolys())
  {
    throw Error("block '" + block.Name + "'", "it holds cells other than polygons",
      "Give the output of SmokeLightField");
  }
  const auto iterator = vtk::TakeSmartPointer(mesh.GetPolys()->NewIterator());
  std::vector<std::array<double, 3>> points;
  vtkIdType cell = 0;
  for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell())
  {
    vtkIdType count;
    const vtkIdType* ids;
    iterator->GetCurrentCell(count, ids);
    points.resize(count);
    for (vtkIdType i = 0; i < count; ++i)
    {
      mesh.GetPoint(ids[i], points[i].data());
    }
    visit(cell++, points);
  }
}

void AddSurface(const SurfaceBlock& block, int bands, SurfaceMesh& mesh)
{
  const CheckedArray reflectance = Reflectance(block);
  ForEachPolygon(block,
    [&](vtkIdType cell, const std::vector<std::array<double, 3>>& points)
    {
      if (mesh.Points.size() + points.size() > std::numeric_limits<std::uint32_t>::max())
      {
        throw Error("surfaces", "they have more points than can be numbered", "Raise PatchSize");
      }
      const auto first = static_cast<std::uint32_t>(mesh.Points.size());
      const auto index = static_cast<std::uint32_t>(mesh.CellReflectance.size());
      for (const auto& point : points)
      {
        mesh.Points.emplace_back(point[0], point[1], point[2]);
      }
      for (const auto& triangle : TriangulatePolygon(points))
      {
        mesh.Triangles.push_back({first + triangle[0], first + triangle[1], first + triangle[2]});
        mesh.TriangleCell.push_back(index);
      }
      mesh.CellReflectance.push_back(reflectance ? reflectance.Bands(cell, bands) : Spectrum{});
    });
}

void AddEmitters(const SurfaceBlock& block, int bands, std::vector<EmitterCell>& emitters)
{
  const CheckedArray luminance(
    *block.Mesh, block.Name, "Luminance", true, 0.0, Largest, "Give a luminance in cd/m2 from 0");
  if (!luminance)
  {
    throw Error("emitter block '" + block.Name + "'", "it has no cell array Luminance",
      "Give the luminance [cd/m2] of each cell, or connect the block to Surfaces");
  }
  const CheckedArray exponent(*block.Mesh, block.Name, "EmissionExponent", false, 0.0, 1e6,
    "Give the exponent n of cos^n from 0, 0 for a Lambertian emitter");
  const CheckedArray signId(*block.Mesh, block.Name, "SignId", false, -1.0,
    std::numeric_limits<int>::max(), "Give a whole number from 0, or -1 for a lamp");
  const CheckedArray part(*block.Mesh, block.Name, "SignPart", false, -1.0, 1.0,
    "Give 1 for the parts of a sign that are to be bright, 0 for the others, -1 for unknown");
  const CheckedArray reflectance = Reflectance(block);
  const PhotometricArrays photometry(*block.Mesh, block.Name);
  ForEachPolygon(block,
    [&](vtkIdType cell, const std::vector<std::array<double, 3>>& points)
    {
      EmitterCell emitter;
      for (const auto& point : points)
      {
        emitter.Vertices.emplace_back(point[0], point[1], point[2]);
      }
      emitter.Luminance = luminance.Bands(cell, bands);
      emitter.Exponent = exponent ? exponent.Value(cell) : 0.0;
      emitter.Reflectance = reflectance ? reflectance.Bands(cell, bands) : Spectrum{};
      emitter.Table = photometry.Table(cell);
      emitter.TableAxis = photometry.Axis(cell);
      emitter.SignId = signId ? static_cast<int>(signId.Value(cell)) : -1;
      emitter.Part = part ? static_cast<int>(part.Value(cell)) : -1;
      emitters.push_back(std::move(emitter));
    });
}

bool Equal(const Spectrum& value)
{
  return value[0] == value[1] && value[0] == value[2];
}

} // namespace

//------------------------------------------------------------------------------
SceneDescription BuildScene(const SceneBlocks& blocks, const SceneOptions& options)
{
  SceneDescription scene;
  scene.Bands = options.Bands;
  scene.ExtinctionScale = options.ExtinctionScale;
  scene.Albedo = options.Albedo;
  scene.Sky = options.Sky;
  for (const SmokeBlock& block : blocks.Smoke)
  {
    SmokeGrid grid = BuildGrid(block);
    scene.Grids.push_back(
      block.Refinement.None() ? std::move(grid) : Refined(grid, block.Refinement));
  }
  for (const SurfaceBlock& block : blocks.Surfaces)
  {
    AddSurface(block, options.Bands, scene.Surfaces);
  }
  for (const SurfaceBlock& block : blocks.Emitters)
  {
    AddEmitters(block, options.Bands, scene.Emitters);
  }
  return scene;
}

//------------------------------------------------------------------------------
bool BandsAreEqual(const SceneDescription& scene)
{
  if (scene.Bands == 1)
  {
    return true;
  }
  bool equal = Equal(scene.ExtinctionScale);
  for (const Spectrum& reflectance : scene.Surfaces.CellReflectance)
  {
    equal = equal && Equal(reflectance);
  }
  for (const EmitterCell& emitter : scene.Emitters)
  {
    equal = equal && Equal(emitter.Luminance) && Equal(emitter.Reflectance);
  }
  return equal;
}

} // namespace smokevis
