// Gathers the blocks of a scene from VTK data.
#include "SceneBlocks.h"

#include "ErrorCollector.h"
#include "Errors.h"

#include <vtkCellData.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataObjectTree.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkMatrix3x3.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSet.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPointData.h>
#include <vtkRectilinearGrid.h>
#include <vtkUnsignedCharArray.h>

#include <functional>

namespace smokevis
{
namespace
{

using LeafVisitor = std::function<void(vtkDataSet*, const std::string&)>;

void ForEachLeaf(vtkDataObject* object, const std::string& name, const LeafVisitor& visit)
{
  if (!object)
  {
    return;
  }
  if (auto* const leaf = vtkDataSet::SafeDownCast(object))
  {
    visit(leaf, name);
    return;
  }
  if (!vtkDataObjectTree::SafeDownCast(object))
  {
    throw Error("block '" + name + "'",
      std::string("a ") + object->GetClassName() +
        " is neither a data set nor a collection of them",
      "Give grids or surfaces, or collections of them");
  }
  const std::vector<Child> children = Children(object);
  for (std::size_t i = 0; i < children.size(); ++i)
  {
    ForEachLeaf(children[i].Object,
      children[i].Name       ? std::string(children[i].Name)
      : children.size() == 1 ? name
                             : name + "[" + std::to_string(i) + "]",
      visit);
  }
}

void CheckGrid(vtkDataSet& grid, const std::string& name)
{
  const std::string where = "smoke block '" + name + "'";
  auto* const image = vtkImageData::SafeDownCast(&grid);
  auto* const rectilinear = vtkRectilinearGrid::SafeDownCast(&grid);
  if (!image && !rectilinear)
  {
    throw Error(where, std::string("a ") + grid.GetClassName() + " cannot hold smoke",
      "Resample it to an image or give a rectilinear grid");
  }
  int dimensions[3];
  image ? image->GetDimensions(dimensions) : rectilinear->GetDimensions(dimensions);
  for (int axis = 0; axis < 3; ++axis)
  {
    if (dimensions[axis] < 2)
    {
      throw Error(where,
        "the grid has a single node along " + std::string(1, static_cast<char>('x' + axis)) +
          ", smoke fills a volume",
        "Give a 3-D grid with at least two nodes along each axis");
    }
  }
  if (image && !image->GetDirectionMatrix()->IsIdentity())
  {
    throw Error(where, "the image is turned (its direction matrix is not the identity)",
      "Resample it to an axis-aligned image");
  }
  if (image)
  {
    for (const double spacing :
      {image->GetSpacing()[0], image->GetSpacing()[1], image->GetSpacing()[2]})
    {
      if (!(spacing > 0.0))
      {
        throw Error(where, "the image's spacing is not positive", "Give a spacing in metres");
      }
    }
  }
}

/// Mean over the nodes of each cell.
vtkSmartPointer<vtkDoubleArray> AverageToCells(vtkDataSet& grid, vtkDataArray& values)
{
  auto result = vtkSmartPointer<vtkDoubleArray>::New();
  result->SetName(values.GetName());
  result->SetNumberOfTuples(grid.GetNumberOfCells());
  vtkNew<vtkIdList> nodes;
  for (vtkIdType cell = 0; cell < grid.GetNumberOfCells(); ++cell)
  {
    grid.GetCellPoints(cell, nodes);
    double sum = 0.0;
    for (vtkIdType i = 0; i < nodes->GetNumberOfIds(); ++i)
    {
      sum += values.GetComponent(nodes->GetId(i), 0);
    }
    result->SetValue(cell, sum / static_cast<double>(nodes->GetNumberOfIds()));
  }
  return result;
}

/// Where a quantity is given at points only, adds its cell averages.
void MoveToCells(vtkDataSet& grid, const std::string& name, const char* array)
{
  if (grid.GetCellData()->HasArray(array) || !grid.GetPointData()->HasArray(array))
  {
    return;
  }
  vtkDataArray* const values = grid.GetPointData()->GetArray(array);
  if (!values || values->GetNumberOfComponents() != 1)
  {
    throw Error("point array " + std::string(array) + " of block '" + name + "'",
      "it does not hold one number a point", "Give a scalar array");
  }
  grid.GetCellData()->AddArray(AverageToCells(grid, *values));
}

} // namespace

//------------------------------------------------------------------------------
std::vector<SmokeBlock> CollectSmoke(vtkDataObject* input, const std::string& name)
{
  std::vector<SmokeBlock> blocks;
  ForEachLeaf(input, name,
    [&](vtkDataSet* leaf, const std::string& leafName)
    {
      if (leaf->GetNumberOfPoints() == 0)
      {
        return;
      }
      CheckGrid(*leaf, leafName);
      auto grid = vtkSmartPointer<vtkDataSet>::Take(leaf->NewInstance());
      grid->ShallowCopy(leaf);
      MoveToCells(*grid, leafName, "Extinction");
      MoveToCells(*grid, leafName, "EmittedLuminance");
      if (!grid->GetCellData()->HasArray("Extinction"))
      {
        throw Error("smoke block '" + leafName + "'", "it has no array Extinction",
          "Give the extinction coefficient [1/m] at 633 nm, on cells or points, under that name");
      }
      blocks.push_back({leafName, grid, {}});
    });
  return blocks;
}

//------------------------------------------------------------------------------
std::vector<SurfaceBlock> CollectSurfaces(vtkDataObject* input, const std::string& name)
{
  std::vector<SurfaceBlock> blocks;
  ForEachLeaf(input, name,
    [&](vtkDataSet* leaf, const std::string& leafName)
    {
      if (leaf->GetNumberOfCells() == 0)
      {
        return;
      }
      auto mesh = vtkSmartPointer<vtkPolyData>::New();
      if (auto* const polydata = vtkPolyData::SafeDownCast(leaf))
      {
        mesh->ShallowCopy(polydata);
      }
      else
      {
        auto copy = vtkSmartPointer<vtkDataSet>::Take(leaf->NewInstance());
        copy->ShallowCopy(leaf);
        vtkNew<vtkDataSetSurfaceFilter> surface;
        vtkNew<ErrorCollector> errors;
        surface->AddObserver(vtkCommand::ErrorEvent, errors);
        surface->SetInputData(copy);
        surface->Update();
        if (!errors->Text().empty())
        {
          throw Error("block '" + leafName + "'", "its surface cannot be found", "Give polydata");
        }
        mesh->ShallowCopy(surface->GetOutput());
      }
      blocks.push_back({leafName, mesh});
    });
  return blocks;
}

//------------------------------------------------------------------------------
std::vector<Child> Children(vtkDataObject* object)
{
  std::vector<Child> children;
  const auto add = [&](vtkDataObject* child, vtkInformation* meta)
  {
    const bool named = meta && meta->Has(vtkCompositeDataSet::NAME());
    children.push_back({child, named ? meta->Get(vtkCompositeDataSet::NAME()) : nullptr});
  };
  if (auto* const blocks = vtkMultiBlockDataSet::SafeDownCast(object))
  {
    for (unsigned int i = 0; i < blocks->GetNumberOfBlocks(); ++i)
    {
      add(blocks->GetBlock(i), blocks->HasMetaData(i) ? blocks->GetMetaData(i) : nullptr);
    }
  }
  else if (auto* const collection = vtkPartitionedDataSetCollection::SafeDownCast(object))
  {
    for (unsigned int i = 0; i < collection->GetNumberOfPartitionedDataSets(); ++i)
    {
      add(collection->GetPartitionedDataSet(i),
        collection->HasMetaData(i) ? collection->GetMetaData(i) : nullptr);
    }
  }
  else if (auto* const partitions = vtkPartitionedDataSet::SafeDownCast(object))
  {
    for (unsigned int i = 0; i < partitions->GetNumberOfPartitions(); ++i)
    {
      add(partitions->GetPartitionAsDataObject(i),
        partitions->HasMetaData(i) ? partitions->GetMetaData(i) : nullptr);
    }
  }
  return children;
}

//------------------------------------------------------------------------------
vtkDataObject* FindBlock(vtkDataObject* collection, const std::string& name)
{
  for (const Child& child : Children(collection))
  {
    if (child.Name && name == child.Name)
    {
      return child.Object;
    }
  }
  return nullptr;
}

//------------------------------------------------------------------------------
vtkDataArray* CellArray(
  vtkDataSet& block, const std::string& blockName, const char* array, bool threeAllowed)
{
  if (!block.GetCellData()->HasArray(array))
  {
    return nullptr;
  }
  const std::string where = "cell array " + std::string(array) + " of block '" + blockName + "'";
  vtkDataArray* const values = block.GetCellData()->GetArray(array);
  if (!values)
  {
    throw Error(where, "it is not numeric", "Give numbers");
  }
  const int components = values->GetNumberOfComponents();
  if (components != 1 && !(threeAllowed && components == 3))
  {
    throw Error(where, "it has " + std::to_string(components) + " components",
      threeAllowed ? "Give 1, or 3 for red, green and blue" : "Give one number a cell");
  }
  return values;
}

//------------------------------------------------------------------------------
void MatchComponents(const std::vector<SurfaceBlock*>& blocks, const char* array)
{
  std::vector<SurfaceBlock*> narrow;
  bool wide = false;
  for (SurfaceBlock* const block : blocks)
  {
    if (vtkDataArray* const values = CellArray(*block->Mesh, block->Name, array, true))
    {
      if (values->GetNumberOfComponents() == 3)
      {
        wide = true;
      }
      else
      {
        narrow.push_back(block);
      }
    }
  }
  if (!wide)
  {
    return;
  }
  for (SurfaceBlock* const block : narrow)
  {
    vtkCellData* const cells = block->Mesh->GetCellData();
    vtkDataArray* const values = cells->GetArray(array);
    auto expanded = vtkSmartPointer<vtkDataArray>::Take(values->NewInstance());
    expanded->SetName(array);
    expanded->SetNumberOfComponents(3);
    expanded->SetNumberOfTuples(values->GetNumberOfTuples());
    for (int component = 0; component < 3; ++component)
    {
      expanded->CopyComponent(component, values, 0);
    }
    cells->AddArray(expanded);
  }
}

//------------------------------------------------------------------------------
bool HiddenCell(vtkDataSet& block, vtkIdType cell)
{
  vtkUnsignedCharArray* const ghosts = block.GetCellGhostArray();
  return ghosts && (ghosts->GetValue(cell) & vtkDataSetAttributes::HIDDENCELL) != 0;
}

} // namespace smokevis
