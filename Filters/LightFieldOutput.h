// The collection that SmokeLightField puts out: the blocks of the scene, field data that describe
// them, and what each process of a parallel run shows of them.
#pragma once

#include "SceneBuilder.h"

#include <utility>
#include <vector>

class vtkPartitionedDataSetCollection;

namespace smokevis
{

struct WorkItem;
class Ranks;

/// What a light field was solved for, besides its scene.
struct LightFieldRecord
{
  SceneOptions Options;
  double AngstromExponent = 1.0;
  double Tolerance = 0.01;
  int Seed = 1;
};

/// Fills the collection with the partitioned data sets Smoke, Surfaces and Emitters.
void AddBlocks(vtkPartitionedDataSetCollection& output, const SceneBlocks& blocks);

/// Adds the record, the work report and what the smoke has of field data and time. File formats
/// drop the field data of a collection, so a block of each kind has them as well.
void AddFields(vtkPartitionedDataSetCollection& output, vtkDataObject& smoke,
  const LightFieldRecord& record, const std::vector<WorkItem>& report);

/// Adds to the work report what each process of a parallel run did.
/// @param seconds,waited that this process worked, and that it spent on the others [s]
void ReportRanks(
  const Ranks& ranks, vtkPartitionedDataSetCollection& output, double seconds, double waited);

/// Leaves every so many-th block, which a view of a parallel run is to draw.
/// @param piece number of the piece that is asked for, and number of pieces
void DivideBlocks(vtkPartitionedDataSetCollection& output, const std::pair<int, int>& piece);

} // namespace smokevis
