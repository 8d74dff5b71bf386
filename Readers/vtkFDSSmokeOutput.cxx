#include "vtkFDSSmokeOutput.h"

#include "vtkFDSBlocks.h"
#include "vtkFDSPieces.h"
#include "vtkFDSSmokeMeshes.h"

#include "Errors.h"
#include "ExtinctionSource.h"
#include "FlameSource.h"
#include "MemoryGuard.h"
#include "PipelineProgress.h"
#include "SmvFile.h"

#include "vtkAlgorithm.h"
#include "vtkFieldData.h"
#include "vtkNew.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <sstream>
#include <stdexcept>

namespace smokevis
{

namespace
{

// Memory that a mesh's arrays and the buffers for reading them take [bytes a cell].
constexpr double CellBytes = 24.0;
// Share of the flames' light that may go astray before it is worth a warning.
constexpr double TolerableLoss = 0.01;

std::uint64_t BytesRead(const SmokeRequest& request)
{
  return request.Smoke->BytesRead() + (request.Flames ? request.Flames->BytesRead() : 0) +
         (request.Heat ? request.Heat->BytesRead() : 0);
}

// The meshes that are this process's to read.
std::vector<SmokeMesh> ReadShare(
  const SmokeRequest& request, const FDSPieces& pieces, vtkAlgorithm* reader)
{
  std::vector<SmokeMesh> meshes;
  std::string problem;
  FDSPieces::Outcome own = FDSPieces::Outcome::Good;
  try
  {
    double cells = 0.0;
    for (int i = pieces.First(); i < pieces.End(); ++i)
    {
      const SmvMesh& mesh = request.Index->Meshes[i];
      cells += static_cast<double>(mesh.Cells(0)) * mesh.Cells(1) * mesh.Cells(2);
    }
    RequireMemory("run '" + request.Index->Path + "'", "its smoke", CellBytes * cells,
      "Check that the file is whole, or read the run on more machines");
    RunWithProgress(reader, 0.0, 0.9,
      [&](Progress& progress)
      { meshes = ReadSmokeMeshes(request, pieces.First(), pieces.End(), progress); });
  }
  catch (const std::exception& error)
  {
    problem = error.what();
    own = reader->GetAbortOutput() ? FDSPieces::Outcome::Aborted : FDSPieces::Outcome::Failed;
  }
  // All processes go on, or none.
  const FDSPieces::Outcome all = pieces.Agree(own);
  if (all == FDSPieces::Outcome::Failed)
  {
    throw std::runtime_error(problem.empty()
                               ? "Another process could not read its meshes; its message says why."
                               : problem);
  }
  if (all == FDSPieces::Outcome::Aborted)
  {
    // Perhaps by another process only.
    reader->SetAbortOutput(true);
    throw Error("FDS reader", "reading was stopped", "Update again to have it done");
  }
  return meshes;
}

// Which meshes show another time than the one that was asked for: a line each, as those of a run
// that still goes may do so all together.
std::string OtherTimes(const SmokeRequest& request, int first, const std::vector<SmokeMesh>& meshes)
{
  std::string lines;
  const auto add = [&lines](const std::string& line)
  { lines += (lines.empty() || line.empty() ? "" : "\n") + line; };
  for (std::size_t i = 0; i < meshes.size(); ++i)
  {
    const int mesh = first + static_cast<int>(i);
    // Meshes write their frames at the same time step, so times agree to rounding.
    if (std::abs(meshes[i].Time - request.Time) > 1e-4 * std::max(1.0, std::abs(request.Time)))
    {
      std::ostringstream text;
      text << "Mesh '" << request.Index->Meshes[mesh].Name << "' has no frame at " << request.Time
           << " s: its frame at " << meshes[i].Time << " s is shown.";
      add(text.str());
    }
    if (request.Flames)
    {
      add(request.Flames->MissingFrame(mesh, request.Time, request.Interpolation));
    }
  }
  return lines;
}

// The light of all flames, which all processes know then.
void AddFlames(const SmokeRequest& request, const FDSPieces& pieces,
  const std::vector<SmokeMesh>& meshes, vtkFieldData* fields, std::vector<std::string>& warnings)
{
  std::vector<FlameLight> lights(request.Index->Meshes.size());
  std::transform(meshes.begin(), meshes.end(), lights.begin() + pieces.First(),
    [](const SmokeMesh& mesh) { return mesh.Light; });
  const FlameLight light = pieces.Sum(lights);
  AddField(fields, "FlameSource",
    (request.Glow ? "black body at the temperature of " : "luminous efficacy times ") +
      request.Flames->Description());
  if (!request.Glow || request.Heat)
  {
    AddField(fields, "FlameHeatRelease", light.HeatRelease);
  }
  AddField(fields, "FlameLumens", light.LumensAsked);
  AddField(fields, "FlameLumensPlaced", light.LumensPlaced);
  if (light.LumensPlaced < (1.0 - TolerableLoss) * light.LumensAsked && pieces.IsFirstPiece())
  {
    std::ostringstream text;
    text << "At " << request.Time << " s the flames give " << light.LumensAsked << " lm, but only "
         << light.LumensPlaced << " lm are shown: in some meshes no burning cell has smoke that "
         << "could emit it. Put a Luminaire of the missing light there.";
    warnings.push_back(text.str());
  }
}

} // namespace

//------------------------------------------------------------------------------------------------
std::vector<std::string> ReadSmokeOutput(
  const SmokeRequest& request, vtkAlgorithm* reader, vtkInformation* output)
{
  const SmvFile& index = *request.Index;
  const FDSPieces pieces(index, output);
  ReadingShare share(BytesRead(request));
  const std::vector<SmokeMesh> meshes = ReadShare(request, pieces, reader);
  share.End(BytesRead(request));

  std::vector<std::string> warnings;
  if (const std::string times = OtherTimes(request, pieces.First(), meshes); !times.empty())
  {
    warnings.push_back(times);
  }
  vtkNew<vtkFieldData> fields;
  AddField(fields, "ExtinctionSource", request.Smoke->Description());
  AddField(fields, "Albedo", request.Albedo);
  AddField(fields, "Time", request.Time);
  AddField(fields, "CHID", index.Chid);
  if (request.Flames)
  {
    AddFlames(request, pieces, meshes, fields, warnings);
  }
  FDSBlocks blocks;
  for (int mesh = 0; mesh < static_cast<int>(index.Meshes.size()); ++mesh)
  {
    const bool here = mesh >= pieces.First() && mesh < pieces.End();
    vtkRectilinearGrid* const grid = here ? meshes[mesh - pieces.First()].Grid.Get() : nullptr;
    if (grid)
    {
      grid->GetFieldData()->ShallowCopy(fields);
    }
    blocks.Add(index.Meshes[mesh].Name, mesh, grid);
  }
  pieces.ReportShares(share, fields);
  blocks.Publish(pieces, fields, request.Time, output);
  return warnings;
}

} // namespace smokevis
