#include "vtkFDSRun.h"

#include "vtkFDSDeviceTable.h"
#include "vtkFDSPieces.h"
#include "vtkFDSWalls.h"

#include "Errors.h"

#include <algorithm>
#include <cmath>
#include <system_error>

namespace smokevis
{

namespace
{

// Most files that a message lists.
constexpr std::size_t MostListed = 10;

// Which of the things that change while the run goes are there at a time.
std::vector<bool> ChangesAt(const SmvFile& index, double time)
{
  std::vector<bool> state;
  const auto append = [&](const auto& things)
  {
    for (const auto& thing : things)
    {
      if (!thing.Events.empty())
      {
        state.push_back(IsOn(thing.Events, time));
      }
    }
  };
  for (const SmvMesh& mesh : index.Meshes)
  {
    append(mesh.Obstructions);
    append(mesh.Vents);
  }
  return state;
}

} // namespace

//------------------------------------------------------------------------------------------------
void FDSRun::Load(const Choice& choice)
{
  std::error_code problem;
  const auto stamp = std::filesystem::last_write_time(choice.FileName, problem);
  if (index_ && !problem && stamp == stamp_ && choice == choice_)
  {
    return;
  }
  *this = FDSRun();
  auto index = std::make_unique<SmvFile>(choice.FileName);
  try
  {
    smoke_ = std::make_unique<ExtinctionSource>(*index, choice.Smoke);
  }
  catch (const Error& error)
  {
    smokeProblem_ = error.what();
  }
  if (smoke_ && choice.Flames)
  {
    flames_ = std::make_unique<FlameSource>(*index, *choice.Flames);
    if (*choice.Flames == FlameModel::BlackBody)
    {
      heat_ = std::make_unique<FlameSource>(*index, FlameModel::LuminousEfficacy);
    }
  }
  slices_ = std::make_unique<FDSPlaneSlices>(*index);
  boundary_ = std::make_unique<FDSBoundary>(*index);
  index_ = std::move(index);
  choice_ = choice;
  stamp_ = stamp;
}

//------------------------------------------------------------------------------------------------
std::vector<double> FDSRun::Times() const
{
  if (smoke_)
  {
    return smoke_->Times();
  }
  std::set<double> times{index_->Times[0]};
  for (const SmvMesh& mesh : index_->Meshes)
  {
    for (const SmvObstruction& obstruction : mesh.Obstructions)
    {
      for (const SmvEvent& event : obstruction.Events)
      {
        times.insert(event.Time);
      }
    }
  }
  return {times.begin(), times.end()};
}

//------------------------------------------------------------------------------------------------
double FDSRun::SceneTime(std::optional<double> asked, TimeInterpolation interpolation) const
{
  if (!smoke_)
  {
    return asked.value_or(index_->Times[0]);
  }
  const std::vector<double>& times = smoke_->Times();
  if (!asked || std::isnan(*asked))
  {
    return times.front();
  }
  return interpolation == TimeInterpolation::Linear
           ? std::clamp(*asked, times.front(), times.back())
           : smoke_->NearestTime(*asked);
}

//------------------------------------------------------------------------------------------------
std::vector<std::string> FDSRun::NotSaidYet(const std::vector<std::string>& warnings)
{
  std::vector<std::string> fresh;
  std::copy_if(warnings.begin(), warnings.end(), std::back_inserter(fresh),
    [this](const std::string& warning) { return said_.insert(warning).second; });
  return fresh;
}

//------------------------------------------------------------------------------------------------
std::string FDSRun::NotWhole(const FDSPieces& pieces, bool slices, bool boundary)
{
  const auto collect = [&](bool opens)
  {
    std::vector<std::string> lines;
    const auto append = [&lines](const std::vector<std::string>& more)
    { lines.insert(lines.end(), more.begin(), more.end()); };
    if (smoke_)
    {
      append(smoke_->Damages());
    }
    if (flames_)
    {
      append(flames_->Damages());
    }
    append(slices_->Damages(pieces, opens && slices));
    append(boundary_->Damages(pieces, opens && boundary));
    return lines;
  };
  if (saidNotWhole_)
  {
    return {};
  }
  // Files that are not open yet are opened once it is clear that there is something to say.
  std::vector<std::string> lines =
    pieces.IsFirstPiece() ? DeviceTableDamages(*index_) : std::vector<std::string>();
  if (lines.empty() && collect(false).empty())
  {
    return {};
  }
  saidNotWhole_ = true;
  const std::vector<std::string> others = collect(true);
  lines.insert(lines.begin(), others.begin(), others.end());
  std::string text = index_->Path + ": " + std::to_string(lines.size()) +
                     (lines.size() == 1 ? " file of the run is" : " files of the run are") +
                     " not whole, as while it still goes or after it was stopped. The frames and "
                     "lines before are used; \"Reload Files\" reads what was written since:";
  for (std::size_t i = 0; i < lines.size() && i < MostListed; ++i)
  {
    text += "\n" + lines[i];
  }
  if (lines.size() > MostListed)
  {
    text += "\nand " + std::to_string(lines.size() - MostListed) + " more";
  }
  return text;
}

//------------------------------------------------------------------------------------------------
vtkPolyData* FDSRun::Geometry(double time, double leastOpacity, std::vector<std::string>& warnings)
{
  const std::vector<bool> changes = ChangesAt(*index_, time);
  if (!geometry_ || geometryMoves_ || geometryChanges_ != changes ||
      geometryOpacity_ != leastOpacity)
  {
    geometry_ = vtkSmartPointer<vtkPolyData>::New();
    WallReport report = BuildWalls(*index_, time, leastOpacity, geometry_);
    warnings = std::move(report.Warnings);
    if (report.Mirrors)
    {
      warnings.emplace_back("The run has MIRROR boundaries: they are taken as diffuse walls, and "
                            "what they would mirror is missing from images.");
    }
    geometryMoves_ = report.Moves;
    geometryChanges_ = changes;
    geometryOpacity_ = leastOpacity;
  }
  return geometry_;
}

} // namespace smokevis
