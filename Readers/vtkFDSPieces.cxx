#include "vtkFDSPieces.h"

#include "FlameLight.h"
#include "RankReport.h"
#include "Ranks.h"
#include "SmvFile.h"

#include "vtkCommunicator.h"
#include "vtkDataObjectTypes.h"
#include "vtkDataSet.h"
#include "vtkInformation.h"
#include "vtkMultiProcessController.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cstdint>

namespace smokevis
{

//------------------------------------------------------------------------------------------------
FDSPieces::FDSPieces(const SmvFile& index, vtkInformation* output)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  int pieces = 1;
  if (output->Has(Pipeline::UPDATE_NUMBER_OF_PIECES()))
  {
    pieces = std::max(1, output->Get(Pipeline::UPDATE_NUMBER_OF_PIECES()));
    piece_ = std::clamp(output->Get(Pipeline::UPDATE_PIECE_NUMBER()), 0, pieces - 1);
  }
  const Ranks ranks;
  int share = piece_;
  if (ranks.Count() > 1 && (pieces == 1 || pieces == ranks.Count()))
  {
    processes_ = ranks.Count();
    exchanges_ = pieces == 1;
    pieces = processes_;
    share = ranks.Rank();
  }

  // Meshes in their order, as many cells each as can be.
  const int meshes = static_cast<int>(index.Meshes.size());
  std::vector<double> cellsBefore(1, 0.0);
  for (const SmvMesh& mesh : index.Meshes)
  {
    cellsBefore.push_back(
      cellsBefore.back() + static_cast<double>(mesh.Cells(0)) * mesh.Cells(1) * mesh.Cells(2));
  }
  int mesh = 0;
  for (int piece = 0; piece < pieces; ++piece)
  {
    begins_.push_back(mesh);
    const double end = cellsBefore.back() * (piece + 1) / pieces;
    // A mesh goes where its middle lies.
    while (mesh < meshes && 0.5 * (cellsBefore[mesh] + cellsBefore[mesh + 1]) <= end)
    {
      ++mesh;
    }
  }
  begins_.push_back(meshes);
  first_ = begins_[share];
  end_ = begins_[share + 1];
}

//------------------------------------------------------------------------------------------------
FDSPieces::Outcome FDSPieces::Agree(Outcome own) const
{
  const int number = static_cast<int>(own);
  return static_cast<Outcome>(processes_ > 1 ? Ranks().Most(number) : number);
}

//------------------------------------------------------------------------------------------------
FlameLight FDSPieces::Sum(const std::vector<FlameLight>& meshes) const
{
  std::vector<double> sent;
  for (const FlameLight& one : meshes)
  {
    sent.insert(sent.end(), {one.HeatRelease, one.LumensAsked, one.LumensPlaced});
  }
  std::vector<double> received = sent;
  if (processes_ > 1)
  {
    // Each number is zero but for one process.
    vtkMultiProcessController::GetGlobalController()->AllReduce(
      sent.data(), received.data(), static_cast<vtkIdType>(sent.size()), vtkCommunicator::SUM_OP);
  }
  FlameLight sum;
  for (std::size_t i = 0; i < received.size(); i += 3)
  {
    sum += {received[i], received[i + 1], received[i + 2]};
  }
  return sum;
}

//------------------------------------------------------------------------------------------------
std::vector<double> FDSPieces::Each(double own) const
{
  return processes_ > 1 ? Ranks().Each(own) : std::vector<double>(1, own);
}

//------------------------------------------------------------------------------------------------
void FDSPieces::ReportShares(const ReadingShare& own, vtkFieldData* fields) const
{
  ReportRanks(*fields,
    {{"seconds", this->Each(own.Seconds()), "each process reads its share of the meshes"},
      {"bytes", this->Each(static_cast<double>(own.Bytes())), "what it read of the run's files"}});
}

//------------------------------------------------------------------------------------------------
int FDSPieces::Owner(int mesh) const
{
  return static_cast<int>(
           std::upper_bound(begins_.begin(), begins_.end() - 1, mesh) - begins_.begin()) -
         1;
}

//------------------------------------------------------------------------------------------------
void FDSPieces::Complete(
  vtkPartitionedDataSetCollection* blocks, const std::vector<int>& meshOfBlock) const
{
  if (!exchanges_)
  {
    return;
  }
  vtkMultiProcessController* const controller = vtkMultiProcessController::GetGlobalController();
  for (unsigned int block = 0; block < meshOfBlock.size(); ++block)
  {
    const int owner = this->Owner(meshOfBlock[block]);
    vtkSmartPointer<vtkDataSet> grid = blocks->GetPartition(block, 0);
    // A file that is missing leaves a block empty on its owner.
    constexpr int nothing = -1;
    int type = grid ? grid->GetDataObjectType() : nothing;
    controller->Broadcast(&type, 1, owner);
    if (type == nothing)
    {
      continue;
    }
    if (!grid)
    {
      grid.TakeReference(vtkDataSet::SafeDownCast(vtkDataObjectTypes::NewDataObject(type)));
    }
    controller->Broadcast(grid, owner);
    blocks->SetPartition(block, 0, grid);
  }
}

} // namespace smokevis
