// An output with a block a mesh, or a slice of one, in the making.
#ifndef vtkFDSBlocks_h
#define vtkFDSBlocks_h

#include "vtkNew.h"
#include "vtkPartitionedDataSetCollection.h"

#include <string>
#include <vector>

class vtkDataSet;
class vtkFieldData;
class vtkInformation;

namespace smokevis
{

class FDSPieces;

/// Adds a number or a text as field data.
void AddField(vtkFieldData* fields, const char* name, double value);
void AddField(vtkFieldData* fields, const char* name, const std::string& value);

/// Blocks of which each process has those of its meshes.
class FDSBlocks
{
public:
  /// Adds a block; every process adds all.
  /// @param data null where another process reads it or its file is missing
  void Add(std::string name, int mesh, vtkDataSet* data);

  /// Fetches the blocks that other processes read, names them, and hands them over as the output.
  /// @param time of the data [s]
  void Publish(const FDSPieces& pieces, vtkFieldData* fields, double time, vtkInformation* output);

private:
  vtkNew<vtkPartitionedDataSetCollection> blocks_;
  std::vector<std::string> names_;
  std::vector<int> meshes_;
};

} // namespace smokevis

#endif
