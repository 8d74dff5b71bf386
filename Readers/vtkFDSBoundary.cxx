#include "vtkFDSBoundary.h"

#include "BoundaryFile.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <array>
#include <utility>

namespace smokevis
{

namespace
{

// Walls in the making.
class Patches
{
public:
  Patches(const SmvMesh& mesh, const SmvBoundary& entry) : mesh_(mesh), ofCells_(entry.CellCentred)
  {
    points_->SetDataTypeToDouble();
    values_->SetName(entry.Quantity.LongLabel.c_str());
  }

  // Adds a patch with a value a node.
  void Add(const BoundaryPatch& patch, const float* values)
  {
    const IndexRange& r = patch.Range;
    const vtkIdType first = points_->GetNumberOfPoints();
    for (int k = r[4]; k <= r[5]; ++k)
    {
      for (int j = r[2]; j <= r[3]; ++j)
      {
        for (int i = r[0]; i <= r[1]; ++i)
        {
          points_->InsertNextPoint(mesh_.Nodes[0][i], mesh_.Nodes[1][j], mesh_.Nodes[2][k]);
        }
      }
    }
    // The two axes along the patch, the first of which is fastest.
    const int b = patch.Axis == 0 ? 1 : 0;
    const int d = patch.Axis == 2 ? 1 : 2;
    const vtkIdType nb = r[2 * b + 1] - r[2 * b] + 1;
    const vtkIdType nd = r[2 * d + 1] - r[2 * d] + 1;
    for (vtkIdType y = 0; y + 1 < nd; ++y)
    {
      for (vtkIdType x = 0; x + 1 < nb; ++x)
      {
        const vtkIdType corner = first + y * nb + x;
        quads_->InsertNextCell({corner, corner + 1, corner + nb + 1, corner + nb});
        if (ofCells_)
        {
          values_->InsertNextValue(values[y * nb + x]);
        }
      }
    }
    for (vtkIdType node = 0; node < nb * nd && !ofCells_; ++node)
    {
      values_->InsertNextValue(values[node]);
    }
  }

  void MoveTo(vtkPolyData* output)
  {
    output->SetPoints(points_);
    output->SetPolys(quads_);
    auto* const attributes = ofCells_ ? static_cast<vtkDataSetAttributes*>(output->GetCellData())
                                      : static_cast<vtkDataSetAttributes*>(output->GetPointData());
    attributes->SetScalars(values_);
  }

private:
  const SmvMesh& mesh_;
  bool ofCells_;
  vtkNew<vtkPoints> points_;
  vtkNew<vtkCellArray> quads_;
  vtkNew<vtkFloatArray> values_;
};

} // namespace

//------------------------------------------------------------------------------------------------
FDSBoundary::FDSBoundary(const SmvFile& index) : FDSFileBlocks(index)
{
  for (std::size_t i = 0; i < index.Boundaries.size(); ++i)
  {
    const SmvBoundary& entry = index.Boundaries[i];
    Part part;
    part.Mesh = entry.Mesh;
    part.Name = entry.Quantity.LongLabel + " " + index.Meshes[entry.Mesh].Name;
    part.Quantity = &entry.Quantity;
    part.FileName = entry.File;
    part.Entry = i;
    this->Add(std::move(part));
  }
}

//------------------------------------------------------------------------------------------------
std::unique_ptr<TimedFile> FDSBoundary::OpenFile(const Part& part) const
{
  const SmvMesh& mesh = this->Index().Meshes[part.Mesh];
  return std::make_unique<BoundaryFile>(this->Index().Resolve(part.FileName), mesh,
    "boundary file of " + part.Quantity->LongLabel + " of mesh '" + mesh.Name + "'");
}

//------------------------------------------------------------------------------------------------
vtkSmartPointer<vtkDataSet> FDSBoundary::Build(
  const Part& part, std::span<const float> values, double time) const
{
  const SmvMesh& mesh = this->Index().Meshes[part.Mesh];
  Patches patches(mesh, this->Index().Boundaries[part.Entry]);
  for (const BoundaryPatch& patch : static_cast<const BoundaryFile&>(*part.File).Patches())
  {
    const auto obstruction = static_cast<std::size_t>(patch.Obstruction);
    const bool known = patch.Obstruction >= 0 && obstruction < mesh.Obstructions.size();
    if (!known || IsOn(mesh.Obstructions[obstruction].Events, time))
    {
      patches.Add(patch, values.data());
    }
    values = values.subspan(patch.Nodes());
  }
  auto walls = vtkSmartPointer<vtkPolyData>::New();
  patches.MoveTo(walls);
  return walls;
}

} // namespace smokevis
