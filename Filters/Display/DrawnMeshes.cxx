#include "DrawnMeshes.h"

#include <vtkCellData.h>
#include <vtkCompositeDataIterator.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkImageData.h>
#include <vtkMath.h>
#include <vtkMatrix3x3.h>
#include <vtkMultiProcessController.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointDataToCellData.h>
#include <vtkRectilinearGrid.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>

namespace smokevis
{

namespace
{

constexpr const char* ExtinctionName = "Extinction";

std::array<std::vector<double>, 3> NodesOf(vtkImageData& image)
{
  std::array<std::vector<double>, 3> nodes;
  int extent[6];
  image.GetExtent(extent);
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int i = extent[2 * axis]; i <= extent[2 * axis + 1]; ++i)
    {
      nodes[axis].push_back(image.GetOrigin()[axis] + i * image.GetSpacing()[axis]);
    }
  }
  return nodes;
}

std::array<std::vector<double>, 3> NodesOf(vtkRectilinearGrid& grid)
{
  std::array<std::vector<double>, 3> nodes;
  vtkDataArray* const coordinates[] = {
    grid.GetXCoordinates(), grid.GetYCoordinates(), grid.GetZCoordinates()};
  for (int axis = 0; axis < 3; ++axis)
  {
    const vtkIdType count = coordinates[axis] ? coordinates[axis]->GetNumberOfTuples() : 0;
    for (vtkIdType i = 0; i < count; ++i)
    {
      nodes[axis].push_back(coordinates[axis]->GetComponent(i, 0));
    }
  }
  return nodes;
}

// The extinction of a grid's cells, from its points where need be; null where it has none.
vtkSmartPointer<vtkDataArray> ExtinctionOf(vtkDataSet& grid)
{
  const auto usable = [&](vtkDataArray* array, vtkIdType tuples)
  { return array && array->GetNumberOfComponents() == 1 && array->GetNumberOfTuples() == tuples; };
  vtkDataArray* const ofCells = grid.GetCellData()->GetArray(ExtinctionName);
  if (usable(ofCells, grid.GetNumberOfCells()))
  {
    return ofCells;
  }
  if (!usable(grid.GetPointData()->GetArray(ExtinctionName), grid.GetNumberOfPoints()))
  {
    return nullptr;
  }
  vtkNew<vtkPointDataToCellData> mean;
  mean->SetInputData(&grid);
  mean->ProcessAllArraysOff();
  mean->AddPointDataArray(ExtinctionName);
  mean->Update();
  return mean->GetOutput()->GetCellData()->GetArray(ExtinctionName);
}

// Whether a grid's nodes make cells, along all three axes.
bool HasCells(const std::array<std::vector<double>, 3>& nodes)
{
  return std::all_of(nodes.begin(), nodes.end(),
    [](const std::vector<double>& along)
    {
      return along.size() > 1 && std::isfinite(along.front()) && std::isfinite(along.back()) &&
             std::is_sorted(along.begin(), along.end(), std::less_equal<>());
    });
}

void AddSmoke(vtkDataSet& grid, DrawnMesh& mesh)
{
  const vtkSmartPointer<vtkDataArray> extinction = ExtinctionOf(grid);
  std::array<std::vector<double>, 3> nodes;
  auto* const image = vtkImageData::SafeDownCast(&grid);
  auto* const rectilinear = vtkRectilinearGrid::SafeDownCast(&grid);
  if (extinction && image && image->GetDirectionMatrix()->IsIdentity())
  {
    nodes = NodesOf(*image);
  }
  else if (extinction && rectilinear)
  {
    nodes = NodesOf(*rectilinear);
  }
  if (!HasCells(nodes))
  {
    return;
  }
  mesh.Nodes = std::move(nodes);
  mesh.Extinction.resize(grid.GetNumberOfCells());
  constexpr unsigned char hidden =
    vtkDataSetAttributes::HIDDENCELL | vtkDataSetAttributes::DUPLICATECELL;
  vtkUnsignedCharArray* const ghosts = grid.GetCellGhostArray();
  for (vtkIdType i = 0; i < grid.GetNumberOfCells(); ++i)
  {
    const double value = extinction->GetComponent(i, 0);
    const bool shown = !(ghosts && (ghosts->GetValue(i) & hidden));
    mesh.Extinction[i] =
      shown && value > 0.0 && std::isfinite(value) ? static_cast<float>(value) : 0.0F;
  }
}

void AddMesh(vtkDataObject* object, std::vector<DrawnMesh>& meshes)
{
  auto* const data = vtkDataSet::SafeDownCast(object);
  if (!data || data->GetNumberOfPoints() == 0)
  {
    return;
  }
  double bounds[6];
  data->GetBounds(bounds);
  if (!vtkMath::AreBoundsInitialized(bounds))
  {
    return;
  }
  DrawnMesh mesh;
  for (int axis = 0; axis < 3; ++axis)
  {
    mesh.Nodes[axis] = {bounds[2 * axis], bounds[2 * axis + 1]};
  }
  AddSmoke(*data, mesh);
  meshes.push_back(std::move(mesh));
}

// What all processes have, in the order of their ranks.
template <class Value>
std::vector<Value> Gather(const std::vector<Value>& own, vtkMultiProcessController& controller)
{
  const int processes = controller.GetNumberOfProcesses();
  const vtkIdType length = static_cast<vtkIdType>(own.size());
  std::vector<vtkIdType> lengths(processes);
  controller.AllGather(&length, lengths.data(), 1);
  std::vector<vtkIdType> offsets(processes, 0);
  for (int i = 1; i < processes; ++i)
  {
    offsets[i] = offsets[i - 1] + lengths[i - 1];
  }
  std::vector<Value> all(offsets.back() + lengths.back());
  controller.AllGatherV(own.data(), all.data(), length, lengths.data(), offsets.data());
  return all;
}

} // namespace

//------------------------------------------------------------------------------
double DrawnMesh::CellVolume() const
{
  double volume = 1.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    volume *= this->Length(axis) / this->Cells(axis);
  }
  return volume;
}

//------------------------------------------------------------------------------
std::vector<DrawnMesh> CollectMeshes(vtkDataObject* object)
{
  std::vector<DrawnMesh> meshes;
  auto* const collection = vtkCompositeDataSet::SafeDownCast(object);
  if (!collection)
  {
    AddMesh(object, meshes);
    return meshes;
  }
  const auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(collection->NewIterator());
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
  {
    AddMesh(iterator->GetCurrentDataObject(), meshes);
  }
  return meshes;
}

//------------------------------------------------------------------------------
std::vector<DrawnMesh> ShareMeshes(
  const std::vector<DrawnMesh>& own, vtkMultiProcessController* controller)
{
  if (!controller || controller->GetNumberOfProcesses() < 2)
  {
    return own;
  }
  std::vector<vtkIdType> sizes;
  std::vector<double> nodes;
  std::vector<float> extinction;
  for (const DrawnMesh& mesh : own)
  {
    for (const std::vector<double>& along : mesh.Nodes)
    {
      sizes.push_back(static_cast<vtkIdType>(along.size()));
      nodes.insert(nodes.end(), along.begin(), along.end());
    }
    sizes.push_back(static_cast<vtkIdType>(mesh.Extinction.size()));
    extinction.insert(extinction.end(), mesh.Extinction.begin(), mesh.Extinction.end());
  }
  sizes = Gather(sizes, *controller);
  nodes = Gather(nodes, *controller);
  extinction = Gather(extinction, *controller);

  std::vector<DrawnMesh> all(sizes.size() / 4);
  auto size = sizes.begin();
  auto node = nodes.begin();
  auto value = extinction.begin();
  for (DrawnMesh& mesh : all)
  {
    for (std::vector<double>& along : mesh.Nodes)
    {
      along.assign(node, node + *size);
      node += *size++;
    }
    mesh.Extinction.assign(value, value + *size);
    value += *size++;
  }
  return all;
}

} // namespace smokevis
