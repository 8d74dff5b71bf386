#include "vtkFDSPlaneSlices.h"

#include "Errors.h"
#include "SliceFile.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkRectilinearGrid.h"

#include <algorithm>
#include <array>
#include <sstream>
#include <utility>

namespace smokevis
{

namespace
{

// The axis that a plane is normal to.
int NormalOf(const IndexRange& range)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    if (range[2 * axis] == range[2 * axis + 1])
    {
      return axis;
    }
  }
  return -1;
}

} // namespace

//------------------------------------------------------------------------------------------------
FDSPlaneSlices::FDSPlaneSlices(const SmvFile& index) : FDSFileBlocks(index)
{
  for (std::size_t i = 0; i < index.Slices.size(); ++i)
  {
    const SmvSlice& slice = index.Slices[i];
    const int axis = NormalOf(slice.Range);
    if (axis < 0)
    {
      continue;
    }
    std::ostringstream name;
    name << slice.Quantity.LongLabel << " " << index.Meshes[slice.Mesh].Name << " "
         << static_cast<char>('x' + axis) << "=" << this->Position(slice, axis);
    Part part;
    part.Mesh = slice.Mesh;
    part.Name = name.str();
    part.Quantity = &slice.Quantity;
    part.FileName = slice.File;
    part.Entry = i;
    this->Add(std::move(part));
  }
}

//------------------------------------------------------------------------------------------------
double FDSPlaneSlices::Position(const SmvSlice& slice, int axis) const
{
  const std::vector<double>& nodes = this->Index().Meshes[slice.Mesh].Nodes[axis];
  const int node = slice.Range[2 * axis];
  // A plane of cells is that below the node.
  return slice.CellCentred && node > 0 ? 0.5 * (nodes[node - 1] + nodes[node]) : nodes[node];
}

//------------------------------------------------------------------------------------------------
std::unique_ptr<TimedFile> FDSPlaneSlices::OpenFile(const Part& part) const
{
  const SmvSlice& slice = this->Index().Slices[part.Entry];
  auto file = std::make_unique<SliceFile>(
    this->Index().Resolve(slice.File), slice.CellCentred, "slice of " + slice.Quantity.LongLabel);
  if (file->Range() != slice.Range)
  {
    throw Error(file->Path(), "its index range is not the one that the index gives",
      "The two are of different runs: copy both from the same one");
  }
  return file;
}

//------------------------------------------------------------------------------------------------
vtkSmartPointer<vtkDataSet> FDSPlaneSlices::Build(
  const Part& part, std::span<const float> values, double) const
{
  const SmvSlice& slice = this->Index().Slices[part.Entry];
  const SmvMesh& mesh = this->Index().Meshes[slice.Mesh];
  std::array<vtkSmartPointer<vtkDoubleArray>, 3> coordinates;
  std::array<int, 3> nodes{};
  for (int axis = 0; axis < 3; ++axis)
  {
    const bool flat = slice.Range[2 * axis] == slice.Range[2 * axis + 1];
    coordinates[axis] = vtkSmartPointer<vtkDoubleArray>::New();
    for (int node = slice.Range[2 * axis]; node <= slice.Range[2 * axis + 1]; ++node)
    {
      coordinates[axis]->InsertNextValue(
        flat ? this->Position(slice, axis) : mesh.Nodes[axis][node]);
    }
    nodes[axis] = static_cast<int>(coordinates[axis]->GetNumberOfValues());
  }
  auto grid = vtkSmartPointer<vtkRectilinearGrid>::New();
  grid->SetDimensions(nodes.data());
  grid->SetXCoordinates(coordinates[0]);
  grid->SetYCoordinates(coordinates[1]);
  grid->SetZCoordinates(coordinates[2]);
  vtkNew<vtkFloatArray> array;
  array->SetName(slice.Quantity.LongLabel.c_str());
  array->SetNumberOfValues(static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  vtkDataSetAttributes* const attributes =
    slice.CellCentred ? static_cast<vtkDataSetAttributes*>(grid->GetCellData())
                      : static_cast<vtkDataSetAttributes*>(grid->GetPointData());
  attributes->SetScalars(array);
  return grid;
}

} // namespace smokevis
