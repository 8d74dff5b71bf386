#include "vtkFDSSmokeMeshes.h"

#include "ExtinctionSource.h"
#include "FlameSource.h"
#include "SmvFile.h"
#include "SolidCells.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkUnsignedCharArray.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <span>
#include <thread>

namespace smokevis
{

namespace
{

vtkSmartPointer<vtkDoubleArray> Coordinates(const std::vector<double>& nodes)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetNumberOfValues(static_cast<vtkIdType>(nodes.size()));
  std::copy(nodes.begin(), nodes.end(), array->GetPointer(0));
  return array;
}

template <class Array> vtkSmartPointer<Array> CellArray(const char* name, vtkIdType cells)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfValues(cells);
  return array;
}

std::span<float> Span(vtkFloatArray* array)
{
  return {array->GetPointer(0), static_cast<std::size_t>(array->GetNumberOfValues())};
}

// A grid with its arrays, not filled yet.
SmokeMesh Prepare(const SmvMesh& mesh, bool emits)
{
  SmokeMesh result;
  result.Grid = vtkSmartPointer<vtkRectilinearGrid>::New();
  result.Grid->SetDimensions(mesh.Cells(0) + 1, mesh.Cells(1) + 1, mesh.Cells(2) + 1);
  result.Grid->SetXCoordinates(Coordinates(mesh.Nodes[0]));
  result.Grid->SetYCoordinates(Coordinates(mesh.Nodes[1]));
  result.Grid->SetZCoordinates(Coordinates(mesh.Nodes[2]));
  const vtkIdType cells = result.Grid->GetNumberOfCells();
  vtkCellData* const data = result.Grid->GetCellData();
  data->SetScalars(CellArray<vtkFloatArray>("Extinction", cells));
  data->AddArray(CellArray<vtkUnsignedCharArray>("Solid", cells));
  if (emits)
  {
    data->AddArray(CellArray<vtkFloatArray>("EmittedLuminance", cells));
  }
  return result;
}

void Fill(const SmokeRequest& request, int number, SmokeMesh& result)
{
  const SmvMesh& mesh = request.Index->Meshes[number];
  vtkCellData* const data = result.Grid->GetCellData();
  const std::vector<unsigned char> solid =
    SolidCells(mesh, PresentObstructions(*request.Index, number, request.Time, 0.0));
  auto* const solids = vtkUnsignedCharArray::SafeDownCast(data->GetArray("Solid"));
  if (solid.empty())
  {
    std::fill_n(solids->GetPointer(0), solids->GetNumberOfValues(), static_cast<unsigned char>(0));
  }
  else
  {
    std::copy(solid.begin(), solid.end(), solids->GetPointer(0));
  }
  const std::span<float> extinction = Span(vtkFloatArray::SafeDownCast(data->GetScalars()));
  result.Time = request.Smoke->Read(number, request.Time, request.Interpolation, solid, extinction);
  if (request.Flames)
  {
    const std::span<float> luminance =
      Span(vtkFloatArray::SafeDownCast(data->GetArray("EmittedLuminance")));
    std::vector<float> values(luminance.size());
    request.Flames->Read(number, request.Time, request.Interpolation, solid, values);
    result.Light = request.Glow ? GlowOfSmoke(mesh, values, extinction, request.Albedo, luminance)
                                : SpreadFlameLight(mesh, values, extinction, request.Albedo,
                                    request.Efficacy, luminance);
    if (request.Heat)
    {
      request.Heat->Read(number, request.Time, request.Interpolation, solid, values);
      result.Light.HeatRelease = TotalHeatRelease(mesh, values);
    }
  }
}

} // namespace

//------------------------------------------------------------------------------------------------
std::vector<SmokeMesh> ReadSmokeMeshes(
  const SmokeRequest& request, int first, int end, Progress& progress)
{
  std::vector<SmokeMesh> meshes;
  for (int i = first; i < end; ++i)
  {
    meshes.push_back(Prepare(request.Index->Meshes[i], request.Flames != nullptr));
  }
  std::vector<std::exception_ptr> problems(meshes.size());
  std::atomic<std::size_t> done = 0;
  const std::thread::id caller = std::this_thread::get_id();
  tbb::parallel_for(std::size_t{0}, meshes.size(),
    [&](std::size_t i)
    {
      if (progress.ShouldStop())
      {
        return;
      }
      try
      {
        Fill(request, first + static_cast<int>(i), meshes[i]);
      }
      catch (...)
      {
        problems[i] = std::current_exception();
      }
      ++done;
      if (std::this_thread::get_id() == caller)
      {
        progress.Report(static_cast<double>(done) / static_cast<double>(meshes.size()));
      }
    });
  if (progress.ShouldStop())
  {
    return {};
  }
  for (const std::exception_ptr& problem : problems)
  {
    if (problem)
    {
      std::rethrow_exception(problem);
    }
  }
  return meshes;
}

} // namespace smokevis
