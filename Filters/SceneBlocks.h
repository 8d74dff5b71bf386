// The smoke grids, surfaces and emitters of a scene as VTK data, gathered from any mix of data sets
// and collections of them.
#pragma once

#include "GridRefinement.h"

#include <vtkDataSet.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <string>
#include <vector>

class vtkDataArray;
class vtkDataObject;

namespace smokevis
{

/// A smoke grid: vtkImageData or vtkRectilinearGrid with the cell array Extinction.
struct SmokeBlock
{
  std::string Name;
  vtkSmartPointer<vtkDataSet> Grid;
  /// Of its cells, for the scene.
  GridRefinement Refinement;
};

/// Surface or emitter cells: polydata that holds polygons only.
struct SurfaceBlock
{
  std::string Name;
  vtkSmartPointer<vtkPolyData> Mesh;
};

struct SceneBlocks
{
  std::vector<SmokeBlock> Smoke;
  std::vector<SurfaceBlock> Surfaces;
  std::vector<SurfaceBlock> Emitters;
};

/// The smoke grids in a data object, shallow copies of the input. Extinction that is given at
/// points is averaged to cells. Throws Error for anything that is not an axis-aligned 3-D grid with
/// an Extinction. Empty blocks are left out.
/// @param name what to call blocks that have no name of their own
std::vector<SmokeBlock> CollectSmoke(vtkDataObject* input, const std::string& name);

/// The surfaces in a data object; of anything but polydata the outer surface. Empty blocks are left
/// out.
std::vector<SurfaceBlock> CollectSurfaces(vtkDataObject* input, const std::string& name);

/// A member of a collection and its name, null where it has none.
struct Child
{
  vtkDataObject* Object;
  const char* Name;
};

/// The members of a multiblock, a partitioned data set or a collection of those, one level down;
/// nothing for any other object.
std::vector<Child> Children(vtkDataObject* object);

/// Child of a collection by name, or null.
vtkDataObject* FindBlock(vtkDataObject* collection, const std::string& name);

/// A numeric cell array by name, or null. Throws Error where the array is not numeric or has a
/// number of components other than 1 or (where allowed) 3.
vtkDataArray* CellArray(
  vtkDataSet& block, const std::string& blockName, const char* array, bool threeAllowed);

/// Gives a cell array three components in all blocks where it has three in one of them: ParaView
/// expects one number of components for all arrays of a name.
void MatchComponents(const std::vector<SurfaceBlock*>& blocks, const char* array);

/// Whether a cell is marked as hidden.
bool HiddenCell(vtkDataSet& block, vtkIdType cell);

} // namespace smokevis
