#include "vtkFDSFileBlocks.h"

#include "vtkFDSBlocks.h"
#include "vtkFDSPieces.h"

#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkNew.h"

#include <exception>
#include <filesystem>
#include <system_error>

namespace smokevis
{

//------------------------------------------------------------------------------------------------
FDSFileBlocks::Report FDSFileBlocks::Publish(
  double time, TimeInterpolation interpolation, vtkInformation* output)
{
  const FDSPieces pieces(index_, output);
  ReadingShare share(this->BytesRead());
  FDSBlocks blocks;
  Report report;
  for (Part& part : parts_)
  {
    vtkSmartPointer<vtkDataSet> data;
    std::error_code missing;
    if (part.Mesh >= pieces.First() && part.Mesh < pieces.End() &&
        std::filesystem::exists(index_.Resolve(part.FileName), missing))
    {
      try
      {
        data = this->Read(part, time, interpolation);
        if (!part.File->Damage().empty())
        {
          report.Damages.push_back(
            part.File->Path() + ": " + part.File->Damage() + "; the other frames are used.");
        }
      }
      catch (const std::exception& error)
      {
        report.LeftOut += (report.LeftOut.empty() ? "" : "\n") + std::string(error.what());
      }
    }
    blocks.Add(part.Name, part.Mesh, data);
  }
  share.End(this->BytesRead());
  vtkNew<vtkFieldData> fields;
  AddField(fields, "Time", time);
  AddField(fields, "CHID", index_.Chid);
  pieces.ReportShares(share, fields);
  blocks.Publish(pieces, fields, time, output);
  return report;
}

//------------------------------------------------------------------------------------------------
vtkSmartPointer<vtkDataSet> FDSFileBlocks::Read(
  Part& part, double time, TimeInterpolation interpolation) const
{
  if (!part.File)
  {
    part.File = this->Open(part);
    part.Times = std::make_unique<FrameTimes>(part.File->FrameTimes());
  }
  const FrameMix mix = part.Times->At(time, interpolation);
  std::vector<float> values;
  part.File->ReadFrame(mix.Frame[0], values);
  if (mix.Weight[1] > 0.0)
  {
    std::vector<float> later;
    part.File->ReadFrame(mix.Frame[1], later);
    Mix(mix, later, values);
  }
  vtkSmartPointer<vtkDataSet> data = this->Build(part, values, time);
  AddField(data->GetFieldData(), "Quantity", part.Quantity->LongLabel);
  AddField(data->GetFieldData(), "Unit", part.Quantity->Unit);
  AddField(data->GetFieldData(), "File", part.FileName);
  AddField(data->GetFieldData(), "Time", mix.Time);
  return data;
}

//------------------------------------------------------------------------------------------------
std::uint64_t FDSFileBlocks::BytesRead() const
{
  std::uint64_t bytes = 0;
  for (const Part& part : parts_)
  {
    bytes += part.File ? part.File->BytesRead() : 0;
  }
  return bytes;
}

} // namespace smokevis
