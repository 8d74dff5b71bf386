#include "vtkFDSBlocks.h"

#include "vtkFDSPieces.h"

#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkStringArray.h"

namespace smokevis
{

//------------------------------------------------------------------------------------------------
void AddField(vtkFieldData* fields, const char* name, double value)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->InsertNextValue(value);
  fields->AddArray(array);
}

//------------------------------------------------------------------------------------------------
void AddField(vtkFieldData* fields, const char* name, const std::string& value)
{
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  array->InsertNextValue(value);
  fields->AddArray(array);
}

//------------------------------------------------------------------------------------------------
void FDSBlocks::Add(std::string name, int mesh, vtkDataSet* data)
{
  const auto block = static_cast<unsigned int>(names_.size());
  names_.push_back(std::move(name));
  meshes_.push_back(mesh);
  blocks_->SetNumberOfPartitionedDataSets(block + 1);
  if (data)
  {
    blocks_->SetPartition(block, 0, data);
  }
}

//------------------------------------------------------------------------------------------------
void FDSBlocks::Publish(
  const FDSPieces& pieces, vtkFieldData* fields, double time, vtkInformation* output)
{
  pieces.Complete(blocks_, meshes_);
  for (unsigned int block = 0; block < names_.size(); ++block)
  {
    blocks_->GetMetaData(block)->Set(vtkCompositeDataSet::NAME(), names_[block].c_str());
  }
  blocks_->GetFieldData()->ShallowCopy(fields);
  vtkDataObject* const data = output->Get(vtkDataObject::DATA_OBJECT());
  data->ShallowCopy(blocks_);
  data->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
}

} // namespace smokevis
