#include "vtkFDSPlaneSlices.h"

#include "vtkFDSBlocks.h"

#include "Errors.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <array>
#include <sstream>

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
FDSPlaneSlices::FDSPlaneSlices(const SmvFile& index) : index_(index)
{
  for (const SmvSlice& slice : index.Slices)
  {
    const int axis = NormalOf(slice.Range);
    if (axis < 0)
    {
      continue;
    }
    std::ostringstream name;
    name << slice.Quantity.LongLabel << " " << index.Meshes[slice.Mesh].Name << " "
         << static_cast<char>('x' + axis) << "=" << this->Position(slice, axis);
    planes_.push_back({&slice, name.str(), nullptr, nullptr});
  }
}

//------------------------------------------------------------------------------------------------
double FDSPlaneSlices::Position(const SmvSlice& slice, int axis) const
{
  const std::vector<double>& nodes = index_.Meshes[slice.Mesh].Nodes[axis];
  const int node = slice.Range[2 * axis];
  // A plane of cells is that below the node.
  return slice.CellCentred && node > 0 ? 0.5 * (nodes[node - 1] + nodes[node]) : nodes[node];
}

//------------------------------------------------------------------------------------------------
vtkSmartPointer<vtkRectilinearGrid> FDSPlaneSlices::Read(
  Plane& plane, double time, TimeInterpolation interpolation) const
{
  const SmvSlice& slice = *plane.Slice;
  if (!plane.File)
  {
    auto file = std::make_unique<SliceFile>(
      index_.Resolve(slice.File), slice.CellCentred, "slice of " + slice.Quantity.LongLabel);
    if (file->Range() != slice.Range)
    {
      throw Error(file->Path(), "its index range is not the one that the index gives",
        "The two are of different runs: copy both from the same one");
    }
    plane.Times = std::make_unique<FrameTimes>(file->FrameTimes());
    plane.File = std::move(file);
  }
  const FrameMix mix = plane.Times->At(time, interpolation);
  std::vector<float> values;
  plane.File->ReadFrame(mix.Frame[0], values);
  if (mix.Weight[1] > 0.0)
  {
    std::vector<float> later;
    plane.File->ReadFrame(mix.Frame[1], later);
    Mix(mix, later, values);
  }

  const SmvMesh& mesh = index_.Meshes[slice.Mesh];
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
  AddField(grid->GetFieldData(), "Quantity", slice.Quantity.LongLabel);
  AddField(grid->GetFieldData(), "Unit", slice.Quantity.Unit);
  AddField(grid->GetFieldData(), "File", slice.File);
  AddField(grid->GetFieldData(), "Time", mix.Time);
  return grid;
}

} // namespace smokevis
