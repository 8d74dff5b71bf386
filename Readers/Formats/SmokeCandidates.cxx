#include "SmokeCandidates.h"

#include "Errors.h"
#include "Plot3DSeries.h"
#include "SliceFile.h"
#include "Smoke3DFile.h"
#include "TextFields.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <functional>
#include <map>
#include <optional>
#include <string_view>
#include <tuple>

namespace smokevis
{

namespace
{

// FDS's mass extinction coefficient of soot at 633 nm [m2/kg].
constexpr double SootMassExtinction = 8700.0;

using Format = SmokeCandidate::Format;

std::string UpperCase(std::string_view text)
{
  std::string upper(text);
  std::transform(upper.begin(), upper.end(), upper.begin(),
    [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return upper;
}

// The label without its quantity: the species.
std::string SpeciesOf(const std::string& label, std::string_view quantity)
{
  return std::string(Trim(std::string_view(label).substr(0, label.size() - quantity.size())));
}

std::array<int, 3> NodesOf(const SmvMesh& mesh)
{
  return {mesh.Cells(0) + 1, mesh.Cells(1) + 1, mesh.Cells(2) + 1};
}

IndexRange WholeRange(const SmvMesh& mesh)
{
  return {0, mesh.Cells(0), 0, mesh.Cells(1), 0, mesh.Cells(2)};
}

int RankOf(const SmvFile& index, const SmokeCandidate& candidate)
{
  enum
  {
    Slices = 0,
    SmokeDensity = 10,
    Plot3D = 11,
    Visibility = 12,
    SmokeOpacity = 14
  };
  if (candidate.Kind == Format::Plot3D)
  {
    return Plot3D;
  }
  if (candidate.Kind == Format::Smoke3D)
  {
    return Smoke3DFile::HoldsDensity(index.Resolve(candidate.Files.front().second)) ? SmokeDensity
                                                                                    : SmokeOpacity;
  }
  const int node = candidate.CellCentred ? 0 : 1;
  if (candidate.Quantity == SmokeQuantity::Visibility)
  {
    return Visibility + node;
  }
  return Slices + 2 * static_cast<int>(candidate.Quantity) + node;
}

// Recognizes smoke by its long label, whatever the species is called.
class Recognizer
{
public:
  explicit Recognizer(const SmvFile& index)
  {
    // What the run itself calls smoke, with its Km.
    for (const SmvSmoke3D& smoke : index.Smoke3D)
    {
      if (smoke.MassExtinction > 0.0)
      {
        massExtinction_[UpperCase(smoke.Quantity.LongLabel)] = smoke.MassExtinction;
      }
    }
  }

  std::optional<SmokeCandidate> operator()(const SmvQuantity& quantity) const
  {
    // DENSITY ends OPTICAL DENSITY, too, and so comes behind it.
    static constexpr std::array<std::pair<std::string_view, SmokeQuantity>, 4> quantities{
      {{"EXTINCTION COEFFICIENT", SmokeQuantity::Extinction},
        {"OPTICAL DENSITY", SmokeQuantity::OpticalDensity},
        {"VISIBILITY", SmokeQuantity::Visibility}, {"DENSITY", SmokeQuantity::Density}}};
    const std::string label = UpperCase(quantity.LongLabel);
    const auto found = std::find_if(quantities.begin(), quantities.end(),
      [&label](const auto& known) { return label.ends_with(known.first); });
    if (found == quantities.end())
    {
      return std::nullopt;
    }
    SmokeCandidate candidate;
    candidate.Quantity = found->second;
    candidate.Species = SpeciesOf(label, found->first);
    candidate.Label = quantity;
    if (candidate.Quantity == SmokeQuantity::Density)
    {
      const auto known = massExtinction_.find(label);
      const bool soot = candidate.Species.find("SOOT") != std::string::npos;
      if (known == massExtinction_.end() && !soot)
      {
        return std::nullopt; // the density of the gas or of a species that is not smoke
      }
      candidate.MassExtinction =
        known == massExtinction_.end() ? SootMassExtinction : known->second;
    }
    return candidate;
  }

private:
  std::map<std::string, double> massExtinction_;
};

void AddSlices(
  const SmvFile& index, const Recognizer& recognize, std::vector<SmokeCandidate>& candidates)
{
  for (const SmvSlice& slice : index.Slices)
  {
    std::optional<SmokeCandidate> candidate = recognize(slice.Quantity);
    if (candidate && slice.IsVolume())
    {
      candidate->Mesh = slice.Mesh;
      candidate->CellCentred = slice.CellCentred;
      candidate->Range = slice.Range;
      candidate->WholeMesh = slice.Range == WholeRange(index.Meshes[slice.Mesh]);
      candidate->Files.emplace_back(0.0, slice.File);
      candidates.push_back(std::move(*candidate));
    }
  }
}

void AddPlot3D(
  const SmvFile& index, const Recognizer& recognize, std::vector<SmokeCandidate>& candidates)
{
  // The files of one mesh, species and quantity are one series.
  std::map<std::tuple<int, std::string, int>, SmokeCandidate> series;
  for (const SmvPlot3D& plot : index.Plot3D)
  {
    for (std::size_t component = 0; component < plot.Quantities.size(); ++component)
    {
      std::optional<SmokeCandidate> candidate = recognize(plot.Quantities[component]);
      if (candidate)
      {
        candidate->Mesh = plot.Mesh;
        candidate->Kind = Format::Plot3D;
        candidate->Range = WholeRange(index.Meshes[plot.Mesh]);
        candidate->Component = static_cast<int>(component);
        SmokeCandidate& whole =
          series
            .try_emplace({plot.Mesh, candidate->Label.LongLabel, candidate->Component}, *candidate)
            .first->second;
        whole.Files.emplace_back(plot.Time, plot.File);
      }
    }
  }
  for (auto& [key, candidate] : series)
  {
    candidates.push_back(std::move(candidate));
  }
}

void AddSmoke3D(const SmvFile& index, std::vector<SmokeCandidate>& candidates)
{
  for (const SmvSmoke3D& smoke : index.Smoke3D)
  {
    if (smoke.MassExtinction > 0.0)
    {
      const std::string label = UpperCase(smoke.Quantity.LongLabel);
      SmokeCandidate candidate;
      candidate.Mesh = smoke.Mesh;
      candidate.Species = label;
      for (const std::string_view quantity : {"DENSITY", "MASS FRACTION"})
      {
        if (label.ends_with(quantity))
        {
          candidate.Species = SpeciesOf(label, quantity);
        }
      }
      candidate.Kind = Format::Smoke3D;
      candidate.Range = WholeRange(index.Meshes[smoke.Mesh]);
      candidate.MassExtinction = smoke.MassExtinction;
      candidate.Label = smoke.Quantity;
      candidate.Files.emplace_back(0.0, smoke.File);
      candidates.push_back(std::move(candidate));
    }
  }
}

} // namespace

//------------------------------------------------------------------------------------------------
std::vector<SmokeCandidate> FindSmokeCandidates(const SmvFile& index)
{
  const Recognizer recognize(index);
  std::vector<SmokeCandidate> candidates;
  AddSlices(index, recognize, candidates);
  AddPlot3D(index, recognize, candidates);
  // A label without a species is the sum or one of the named ones: it must not count twice.
  const auto named = [](const SmokeCandidate& one) { return !one.Species.empty(); };
  if (std::any_of(candidates.begin(), candidates.end(), named))
  {
    std::erase_if(candidates, std::not_fn(named));
  }
  if (candidates.empty() || named(candidates.front()))
  {
    AddSmoke3D(index, candidates);
  }
  for (SmokeCandidate& candidate : candidates)
  {
    candidate.Rank = RankOf(index, candidate);
  }
  std::stable_sort(candidates.begin(), candidates.end(),
    [](const SmokeCandidate& a, const SmokeCandidate& b)
    { return std::tie(a.Mesh, a.Species, a.Rank) < std::tie(b.Mesh, b.Species, b.Rank); });
  return candidates;
}

//------------------------------------------------------------------------------------------------
std::unique_ptr<FrameFile> OpenCandidate(const SmvFile& index, const SmokeCandidate& candidate)
{
  if (candidate.Kind == Format::Smoke3D)
  {
    const SmvMesh& mesh = index.Meshes[candidate.Mesh];
    return std::make_unique<Smoke3DFile>(index.Resolve(candidate.Files.front().second),
      NodesOf(mesh), mesh.Nodes[0][1] - mesh.Nodes[0][0], candidate.MassExtinction);
  }
  if (candidate.Kind == Format::Plot3D)
  {
    std::vector<std::pair<double, std::string>> files;
    for (const auto& [time, name] : candidate.Files)
    {
      files.emplace_back(time, index.Resolve(name));
    }
    return std::make_unique<Plot3DSeries>(
      files, candidate.Component, NodesOf(index.Meshes[candidate.Mesh]));
  }
  auto slice = std::make_unique<SliceFile>(
    index.Resolve(candidate.Files.front().second), candidate.CellCentred);
  if (slice->Range() != candidate.Range)
  {
    throw Error(slice->Path(),
      "its index range is not the one that the index " + index.Path + " gives",
      "The two are of different runs: copy both from the same one");
  }
  return slice;
}

} // namespace smokevis
