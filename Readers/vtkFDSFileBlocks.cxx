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
std::string FDSFileBlocks::Publish(
  double time, TimeInterpolation interpolation, vtkInformation* output)
{
  const FDSPieces pieces(index_, output);
  ReadingShare share(this->BytesRead());
  FDSBlocks blocks;
  std::string leftOut;
  for (Part& part : parts_)
  {
    vtkSmartPointer<vtkDataSet> data;
    if (this->Has(part, pieces))
    {
      try
      {
        data = this->Read(part, time, interpolation);
      }
      catch (const std::exception& error)
      {
        leftOut += (leftOut.empty() ? "" : "\n") + std::string(error.what());
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
  return leftOut;
}

//------------------------------------------------------------------------------------------------
std::vector<std::string> FDSFileBlocks::Damages(const FDSPieces& pieces, bool opens)
{
  std::vector<std::string> lines;
  for (Part& part : parts_)
  {
    try
    {
      if (opens && this->Has(part, pieces))
      {
        this->Open(part);
      }
    }
    catch (const std::exception&)
    {
      // Publish() says so, should it be read.
      continue;
    }
    if (part.File)
    {
      part.File->NoteDamage(part.Quantity->LongLabel, lines);
    }
  }
  return lines;
}

//------------------------------------------------------------------------------------------------
bool FDSFileBlocks::Has(const Part& part, const FDSPieces& pieces) const
{
  std::error_code missing;
  return part.Mesh >= pieces.First() && part.Mesh < pieces.End() &&
         std::filesystem::exists(index_.Resolve(part.FileName), missing);
}

//------------------------------------------------------------------------------------------------
void FDSFileBlocks::Open(Part& part) const
{
  if (!part.File)
  {
    part.File = this->OpenFile(part);
    part.Times = std::make_unique<FrameTimes>(part.File->FrameTimes());
  }
}

//------------------------------------------------------------------------------------------------
vtkSmartPointer<vtkDataSet> FDSFileBlocks::Read(
  Part& part, double time, TimeInterpolation interpolation) const
{
  this->Open(part);
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
