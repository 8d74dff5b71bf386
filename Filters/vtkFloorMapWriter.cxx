#include "vtkFloorMapWriter.h"

#include "Errors.h"
#include "FloorMapFile.h"
#include "Ranks.h"
#include "StepWalk.h"

#include <vtkErrorCode.h>
#include <vtkExecutive.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkObjectFactory.h>

#include <filesystem>
#include <optional>

vtkStandardNewMacro(vtkFloorMapWriter);

//------------------------------------------------------------------------------
vtkFloorMapWriter::~vtkFloorMapWriter()
{
  this->SetFileName(nullptr);
}

//------------------------------------------------------------------------------
int vtkFloorMapWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

//------------------------------------------------------------------------------
void vtkFloorMapWriter::WriteSteps(vtkInformationVector* input)
{
  if (!this->FileName || !*this->FileName)
  {
    throw smokevis::Error("floor map writer", "there is no file name", "Give a FileName");
  }
  vtkImageData* const map = vtkImageData::GetData(input);
  std::vector<double> steps = smokevis::TimeSteps(input->GetInformationObject(0));
  const bool steady = steps.empty();
  if (steady)
  {
    vtkInformation* const info = map->GetInformation();
    const bool known = info->Has(vtkDataObject::DATA_TIME_STEP());
    steps.push_back(known ? info->Get(vtkDataObject::DATA_TIME_STEP()) : 0.0);
  }
  steps = smokevis::ChooseSteps(steps, this->TimeRange, this->Stride);
  // All processes make the maps together; the first one writes them.
  const smokevis::Ranks ranks;
  const bool writes = ranks.Rank() == 0;
  std::optional<smokevis::FloorMapNetcdf> file;
  std::optional<smokevis::FloorMapTable> table;
  const auto write = [&](double time)
  {
    if (!file)
    {
      file.emplace(this->FileName, map);
    }
    file->Add(time, map);
    if (this->Table)
    {
      if (!table)
      {
        table.emplace(std::filesystem::path(this->FileName).replace_extension(".csv"), map);
      }
      table->Add(time, map);
    }
  };
  for (std::size_t i = 0; i < steps.size(); ++i)
  {
    if (!steady)
    {
      smokevis::UpdateToTime(input, steps[i]);
    }
    ranks.Together(this,
      [&]
      {
        if (writes)
        {
          write(steps[i]);
        }
        this->UpdateProgress(static_cast<double>(i + 1) / static_cast<double>(steps.size()));
        if (this->CheckAbort())
        {
          throw smokevis::Error("floor map writer", "it was stopped", "No file was written");
        }
      });
  }
  ranks.Together(this,
    [&]
    {
      if (file)
      {
        file->Finish();
      }
      if (table)
      {
        table->Finish();
      }
    });
}

//------------------------------------------------------------------------------
void vtkFloorMapWriter::WriteData()
{
  try
  {
    this->WriteSteps(this->GetExecutive()->GetInputInformation(0));
  }
  catch (const std::exception& error)
  {
    this->SetErrorCode(vtkErrorCode::CannotOpenFileError);
    vtkErrorMacro(<< error.what());
  }
}

//------------------------------------------------------------------------------
void vtkFloorMapWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "TimeRange: (" << this->TimeRange[0] << ", " << this->TimeRange[1] << ")\n";
  os << indent << "Stride: " << this->Stride << "\n";
  os << indent << "Table: " << this->Table << "\n";
}
