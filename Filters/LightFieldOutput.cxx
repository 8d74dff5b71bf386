// Puts a light field together as VTK data.
#include "LightFieldOutput.h"

#include "LightField.h"
#include "LightFieldInput.h"
#include "RankReport.h"
#include "Ranks.h"
#include "SmokeLightArrays.h"

#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSet.h>
#include <vtkPartitionedDataSetCollection.h>

#include <string>
#include <type_traits>

namespace smokevis
{
namespace
{

template <class Block>
void AddPartitions(vtkPartitionedDataSetCollection& output, unsigned int index, const char* name,
  const std::vector<Block>& blocks)
{
  vtkNew<vtkPartitionedDataSet> partitions;
  partitions->SetNumberOfPartitions(static_cast<unsigned int>(blocks.size()));
  for (unsigned int i = 0; i < blocks.size(); ++i)
  {
    if constexpr (std::is_same_v<Block, SmokeBlock>)
    {
      partitions->SetPartition(i, blocks[i].Grid);
    }
    else
    {
      partitions->SetPartition(i, blocks[i].Mesh);
    }
    partitions->GetMetaData(i)->Set(vtkCompositeDataSet::NAME(), blocks[i].Name.c_str());
  }
  output.SetPartitionedDataSet(index, partitions);
  output.GetMetaData(index)->Set(vtkCompositeDataSet::NAME(), name);
}

void AddFieldsTo(vtkDataObject& target, vtkDataObject& smoke, const LightFieldRecord& record,
  const std::vector<WorkItem>& report)
{
  vtkNew<vtkFieldData> fields;
  fields->PassData(smoke.GetFieldData());
  // Smoke may be what an earlier light field gave.
  RemoveSmokeLight(*fields);
  fields->PassData(target.GetFieldData());
  target.SetFieldData(fields);
  const SceneOptions& options = record.Options;
  AddFieldNumber(target, "Albedo", {options.Albedo});
  AddFieldNumber(target, "AngstromExponent", {record.AngstromExponent});
  AddFieldNumber(target, "Bands", {static_cast<double>(options.Bands)});
  const Spectrum& scale = options.ExtinctionScale;
  if (options.Bands == 3)
  {
    AddFieldNumber(target, "ExtinctionScale", {scale[0], scale[1], scale[2]});
  }
  else
  {
    AddFieldNumber(target, "ExtinctionScale", {scale[0]});
  }
  AddFieldNumber(target, "SkyLuminance", {options.Sky});
  AddFieldNumber(target, "Tolerance", {record.Tolerance});
  AddFieldNumber(target, "Seed", {static_cast<double>(record.Seed)});
  vtkInformation* const info = smoke.GetInformation();
  if (info->Has(vtkDataObject::DATA_TIME_STEP()))
  {
    const double time = info->Get(vtkDataObject::DATA_TIME_STEP());
    AddFieldNumber(target, "Time", {time});
    target.GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
  }
  AddWorkReport(target, report);
}

} // namespace

//------------------------------------------------------------------------------
void AddBlocks(vtkPartitionedDataSetCollection& output, const SceneBlocks& blocks)
{
  output.SetNumberOfPartitionedDataSets(3);
  AddPartitions(output, 0, "Smoke", blocks.Smoke);
  AddPartitions(output, 1, "Surfaces", blocks.Surfaces);
  AddPartitions(output, 2, "Emitters", blocks.Emitters);
}

//------------------------------------------------------------------------------
void AddFields(vtkPartitionedDataSetCollection& output, vtkDataObject& smoke,
  const LightFieldRecord& record, const std::vector<WorkItem>& report)
{
  AddFieldsTo(output, smoke, record, report);
  for (unsigned int i = 0; i < output.GetNumberOfPartitionedDataSets(); ++i)
  {
    if (output.GetNumberOfPartitions(i) > 0)
    {
      AddFieldsTo(*output.GetPartitionAsDataObject(i, 0), smoke, record, report);
    }
  }
}

//------------------------------------------------------------------------------
void ReportRanks(
  const Ranks& ranks, vtkPartitionedDataSetCollection& output, double seconds, double waited)
{
  if (ranks.Count() > 1)
  {
    constexpr double kibibyte = 1024.0;
    const double bytes = kibibyte * static_cast<double>(output.GetActualMemorySize());
    ReportRanks(*output.GetFieldData(),
      {{"seconds", ranks.Each(seconds), "its share of the light field, and what all do alike"},
        {"seconds of waiting", ranks.Each(waited), "for what the other processes worked out"},
        {"bytes", ranks.Each(bytes), "each process holds the whole light field"}});
  }
}

//------------------------------------------------------------------------------
void DivideBlocks(vtkPartitionedDataSetCollection& output, const std::pair<int, int>& piece)
{
  for (unsigned int i = 0; i < output.GetNumberOfPartitionedDataSets(); ++i)
  {
    for (unsigned int j = 0; j < output.GetNumberOfPartitions(i); ++j)
    {
      if (static_cast<int>(j) % piece.second != piece.first)
      {
        output.SetPartition(i, j, static_cast<vtkDataObject*>(nullptr));
      }
    }
  }
}

} // namespace smokevis
