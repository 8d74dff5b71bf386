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
// FDS computes OPTICAL DENSITY as K / 2.3.
constexpr double ExtinctionPerOpticalDensity = 2.3;
// The density of the gas as a whole.
constexpr const char* GasDensity = "DENSITY";

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

// K = Factor * value for what the run's own Km gave, and for an override of it.
void SetFactor(SmokeCandidate& candidate, const SmokeOptions& options)
{
  const double override = options.MassExtinction;
  const double change = override > 0.0 ? override / candidate.MassExtinction : 1.0;
  switch (candidate.Quantity)
  {
  case SmokeQuantity::OpticalDensity:
    candidate.Factor = ExtinctionPerOpticalDensity * change;
    break;
  case SmokeQuantity::Density:
  case SmokeQuantity::MassFraction:
    candidate.Factor = override > 0.0 ? override : candidate.MassExtinction;
    break;
  case SmokeQuantity::Visibility:
    candidate.Factor = options.VisibilityFactor * change;
    break;
  default:
    candidate.Factor = change;
  }
}

SmokeSourceKind SourceOf(const SmokeCandidate& candidate)
{
  if (candidate.Kind == Format::Plot3D)
  {
    return SmokeSourceKind::Plot3D;
  }
  const bool bytes = candidate.Kind == Format::Smoke3D;
  switch (candidate.Quantity)
  {
  case SmokeQuantity::OpticalDensity:
    return SmokeSourceKind::OpticalDensitySlice;
  case SmokeQuantity::Density:
    return bytes ? SmokeSourceKind::DensitySmoke3D : SmokeSourceKind::DensitySlice;
  case SmokeQuantity::MassFraction:
    return SmokeSourceKind::MassFractionSlice;
  case SmokeQuantity::Visibility:
    return SmokeSourceKind::VisibilitySlice;
  default:
    return bytes ? SmokeSourceKind::OpacitySmoke3D : SmokeSourceKind::ExtinctionSlice;
  }
}

// How exact a candidate is, the least the best: see FindSmokeCandidates().
std::tuple<int, SmokeSourceKind, bool> Worth(
  const SmokeCandidate& candidate, const SmokeOptions& options)
{
  const bool mass = candidate.Source == SmokeSourceKind::DensitySlice ||
                    candidate.Source == SmokeSourceKind::MassFractionSlice;
  const bool slice = mass || candidate.Source == SmokeSourceKind::ExtinctionSlice ||
                     candidate.Source == SmokeSourceKind::OpticalDensitySlice;
  const bool ofCells =
    candidate.CellCentred && std::all_of(candidate.Density.begin(), candidate.Density.end(),
                               [](const SmokeCandidate& density) { return density.CellCentred; });
  const bool known = !mass || candidate.StatesMassExtinction || options.MassExtinction > 0.0;
  const int level = !slice ? 2 : ofCells && known ? 0 : 1;
  return {level, candidate.Source, !candidate.CellCentred};
}

// What 8-bit smoke calls its species: the label without its quantity.
std::string Smoke3DSpecies(const std::string& label)
{
  for (const std::string_view quantity : {"DENSITY", "MASS FRACTION"})
  {
    if (label.ends_with(quantity))
    {
      return SpeciesOf(label, quantity);
    }
  }
  return label;
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
        massExtinction_[Smoke3DSpecies(UpperCase(smoke.Quantity.LongLabel))] = {
          smoke.MassExtinction, smoke.StatesMassExtinction};
      }
    }
  }

  std::optional<SmokeCandidate> operator()(const SmvQuantity& quantity) const
  {
    // DENSITY ends OPTICAL DENSITY, too, and so comes behind it.
    static constexpr std::array<std::pair<std::string_view, SmokeQuantity>, 5> quantities{
      {{"EXTINCTION COEFFICIENT", SmokeQuantity::Extinction},
        {"OPTICAL DENSITY", SmokeQuantity::OpticalDensity},
        {"VISIBILITY", SmokeQuantity::Visibility}, {"DENSITY", SmokeQuantity::Density},
        {"MASS FRACTION", SmokeQuantity::MassFraction}}};
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
    const auto known = massExtinction_.find(candidate.Species);
    std::tie(candidate.MassExtinction, candidate.StatesMassExtinction) =
      known == massExtinction_.end() ? std::pair(SootMassExtinction, false) : known->second;
    const bool mass = candidate.Quantity == SmokeQuantity::Density ||
                      candidate.Quantity == SmokeQuantity::MassFraction;
    const bool soot = candidate.Species.find("SOOT") != std::string::npos;
    if (mass && known == massExtinction_.end() && !soot)
    {
      return std::nullopt; // the density of the gas or of a species that is not smoke
    }
    return candidate;
  }

private:
  // And whether the index says it.
  std::map<std::string, std::pair<double, bool>> massExtinction_;
};

void SetSlice(const SmvFile& index, const SmvSlice& slice, SmokeCandidate& candidate)
{
  candidate.Mesh = slice.Mesh;
  candidate.CellCentred = slice.CellCentred;
  candidate.Range = slice.Range;
  candidate.WholeMesh = slice.Range == WholeRange(index.Meshes[slice.Mesh]);
  candidate.Files.emplace_back(0.0, slice.File);
}

// Finds the slice of gas density that goes with one of a mass fraction: of the same range, and
// preferably centred alike.
bool AddDensity(const SmvFile& index, const SmvSlice& slice, SmokeCandidate& candidate)
{
  const SmvSlice* best = nullptr;
  for (const SmvSlice& other : index.Slices)
  {
    if (other.Mesh == slice.Mesh && other.Range == slice.Range &&
        UpperCase(other.Quantity.LongLabel) == GasDensity &&
        (!best || other.CellCentred == slice.CellCentred))
    {
      best = &other;
    }
  }
  if (best)
  {
    SmokeCandidate density;
    density.Quantity = SmokeQuantity::Other;
    density.Label = best->Quantity;
    SetSlice(index, *best, density);
    candidate.Density.push_back(std::move(density));
  }
  return best != nullptr;
}

void AddSlices(
  const SmvFile& index, const Recognizer& recognize, std::vector<SmokeCandidate>& candidates)
{
  for (const SmvSlice& slice : index.Slices)
  {
    std::optional<SmokeCandidate> candidate =
      slice.IsVolume() ? recognize(slice.Quantity) : std::nullopt;
    if (candidate && (candidate->Quantity != SmokeQuantity::MassFraction ||
                       AddDensity(index, slice, *candidate)))
    {
      SetSlice(index, slice, *candidate);
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
    const auto density = std::find_if(plot.Quantities.begin(), plot.Quantities.end(),
      [](const SmvQuantity& one) { return UpperCase(one.LongLabel) == GasDensity; });
    for (std::size_t component = 0; component < plot.Quantities.size(); ++component)
    {
      std::optional<SmokeCandidate> candidate = recognize(plot.Quantities[component]);
      const bool fraction = candidate && candidate->Quantity == SmokeQuantity::MassFraction;
      if (!candidate || (fraction && density == plot.Quantities.end()))
      {
        continue;
      }
      candidate->Mesh = plot.Mesh;
      candidate->Kind = Format::Plot3D;
      candidate->Range = WholeRange(index.Meshes[plot.Mesh]);
      candidate->Component = static_cast<int>(component);
      if (fraction)
      {
        candidate->Density.push_back(*candidate);
        candidate->Density[0].Quantity = SmokeQuantity::Other;
        candidate->Density[0].Component = static_cast<int>(density - plot.Quantities.begin());
      }
      SmokeCandidate& whole =
        series
          .try_emplace({plot.Mesh, candidate->Label.LongLabel, candidate->Component}, *candidate)
          .first->second;
      whole.Files.emplace_back(plot.Time, plot.File);
      for (SmokeCandidate& one : whole.Density)
      {
        one.Files.emplace_back(plot.Time, plot.File);
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
      SmokeCandidate candidate;
      candidate.Mesh = smoke.Mesh;
      candidate.Species = Smoke3DSpecies(UpperCase(smoke.Quantity.LongLabel));
      candidate.Kind = Format::Smoke3D;
      candidate.Quantity = Smoke3DFile::HoldsDensity(index.Resolve(smoke.File))
                             ? SmokeQuantity::Density
                             : SmokeQuantity::Extinction;
      candidate.Range = WholeRange(index.Meshes[smoke.Mesh]);
      candidate.MassExtinction = smoke.MassExtinction;
      candidate.StatesMassExtinction = smoke.StatesMassExtinction;
      candidate.Label = smoke.Quantity;
      candidate.Files.emplace_back(0.0, smoke.File);
      candidates.push_back(std::move(candidate));
    }
  }
}

} // namespace

//------------------------------------------------------------------------------------------------
std::vector<SmokeCandidate> FindSmokeCandidates(const SmvFile& index, const SmokeOptions& options)
{
  const Recognizer recognize(index);
  std::vector<SmokeCandidate> candidates;
  AddSlices(index, recognize, candidates);
  AddPlot3D(index, recognize, candidates);
  AddSmoke3D(index, candidates);
  for (SmokeCandidate& candidate : candidates)
  {
    SetFactor(candidate, options);
    candidate.Source = SourceOf(candidate);
  }
  if (options.Source != SmokeSourceKind::Automatic)
  {
    std::erase_if(
      candidates, [&options](const SmokeCandidate& one) { return one.Source != options.Source; });
  }
  // A label without a species is the sum or one of the named ones: it must not count twice. Where
  // the better files name none, 8-bit smoke, which always does, must not add to them.
  const auto unnamed = [](const SmokeCandidate& one) { return one.Species.empty(); };
  const auto better = [](const SmokeCandidate& one) { return one.Kind != Format::Smoke3D; };
  if (!std::all_of(candidates.begin(), candidates.end(),
        [&](const SmokeCandidate& one) { return unnamed(one) || !better(one); }))
  {
    std::erase_if(candidates, unnamed);
  }
  else if (std::any_of(candidates.begin(), candidates.end(), unnamed))
  {
    std::erase_if(candidates, std::not_fn(unnamed));
  }
  std::stable_sort(candidates.begin(), candidates.end(),
    [&options](const SmokeCandidate& a, const SmokeCandidate& b)
    {
      return std::make_tuple(a.Mesh, std::cref(a.Species), Worth(a, options)) <
             std::make_tuple(b.Mesh, std::cref(b.Species), Worth(b, options));
    });
  return candidates;
}

//------------------------------------------------------------------------------------------------
std::vector<SmokeCandidate> FindFieldCandidates(
  const SmvFile& index, const std::vector<std::string>& labels)
{
  // Worth, less being better, and candidate.
  std::vector<std::pair<int, SmokeCandidate>> found;
  const auto add = [&](const SmvQuantity& quantity, int mesh, Format kind) -> SmokeCandidate*
  {
    const auto label = std::find(labels.begin(), labels.end(), UpperCase(quantity.LongLabel));
    if (label == labels.end())
    {
      return nullptr;
    }
    SmokeCandidate candidate;
    candidate.Mesh = mesh;
    candidate.Kind = kind;
    candidate.Quantity = SmokeQuantity::Other;
    candidate.Label = quantity;
    candidate.Range = WholeRange(index.Meshes[mesh]);
    found.emplace_back(4 * static_cast<int>(label - labels.begin()), std::move(candidate));
    return &found.back().second;
  };
  for (const SmvSlice& slice : index.Slices)
  {
    SmokeCandidate* candidate =
      slice.IsVolume() ? add(slice.Quantity, slice.Mesh, Format::Slice) : nullptr;
    if (candidate)
    {
      SetSlice(index, slice, *candidate);
      found.back().first += slice.CellCentred ? 0 : 1;
    }
  }
  for (const SmvSmoke3D& smoke : index.Smoke3D)
  {
    if (SmokeCandidate* candidate = add(smoke.Quantity, smoke.Mesh, Format::Smoke3D))
    {
      const bool heat = UpperCase(smoke.Quantity.LongLabel).find("HRR") != std::string::npos;
      candidate->ByteRange = heat ? index.HeatReleaseRange : index.TemperatureRange;
      candidate->Files.emplace_back(0.0, smoke.File);
      found.back().first += 2;
    }
  }
  std::map<std::tuple<int, std::string>, std::size_t> series;
  for (const SmvPlot3D& plot : index.Plot3D)
  {
    for (std::size_t component = 0; component < plot.Quantities.size(); ++component)
    {
      const SmvQuantity& quantity = plot.Quantities[component];
      const auto known = series.find({plot.Mesh, quantity.LongLabel});
      if (known != series.end())
      {
        found[known->second].second.Files.emplace_back(plot.Time, plot.File);
      }
      else if (SmokeCandidate* candidate = add(quantity, plot.Mesh, Format::Plot3D))
      {
        candidate->Component = static_cast<int>(component);
        candidate->Files.emplace_back(plot.Time, plot.File);
        found.back().first += 3;
        series[{plot.Mesh, quantity.LongLabel}] = found.size() - 1;
      }
    }
  }
  std::stable_sort(found.begin(), found.end(),
    [](const auto& a, const auto& b)
    { return std::tie(a.second.Mesh, a.first) < std::tie(b.second.Mesh, b.first); });
  std::vector<SmokeCandidate> candidates;
  for (auto& [worth, candidate] : found)
  {
    candidates.push_back(std::move(candidate));
  }
  return candidates;
}

//------------------------------------------------------------------------------------------------
std::unique_ptr<FrameFile> OpenCandidate(const SmvFile& index, const SmokeCandidate& candidate)
{
  const SmvMesh& mesh = index.Meshes[candidate.Mesh];
  const std::string what = candidate.Label.LongLabel + " of mesh '" + mesh.Name + "'";
  if (candidate.Kind == Format::Smoke3D)
  {
    const std::string path = index.Resolve(candidate.Files.front().second);
    const std::string bytes = "8-bit file of " + what;
    return candidate.Quantity == SmokeQuantity::Other
             ? std::make_unique<Smoke3DFile>(path, NodesOf(mesh), candidate.ByteRange, bytes)
             : std::make_unique<Smoke3DFile>(
                 path, NodesOf(mesh), mesh.Nodes[0][1] - mesh.Nodes[0][0], bytes);
  }
  if (candidate.Kind == Format::Plot3D)
  {
    std::vector<std::pair<double, std::string>> files;
    for (const auto& [time, name] : candidate.Files)
    {
      files.emplace_back(time, index.Resolve(name));
    }
    return std::make_unique<Plot3DSeries>(files, candidate.Component, NodesOf(mesh), what);
  }
  auto slice = std::make_unique<SliceFile>(
    index.Resolve(candidate.Files.front().second), candidate.CellCentred, "slice of " + what);
  if (slice->Range() != candidate.Range)
  {
    throw Error(slice->Path(),
      "the index range of the slice of " + what + " is not the one that the index " + index.Path +
        " gives",
      "The two are of different runs: copy both from the same one");
  }
  return slice;
}

//------------------------------------------------------------------------------------------------
const char* NameOf(SmokeSourceKind kind)
{
  static constexpr std::array<const char*, 9> names{"any source", "3-D slices of extinction",
    "3-D slices of optical density", "3-D slices of the smoke's density",
    "3-D slices of the smoke's mass fraction with those of the gas density",
    "8-bit 3-D smoke that holds density", "Plot3D files with smoke", "3-D slices of visibility",
    "8-bit 3-D smoke that holds opacity"};
  return names[static_cast<std::size_t>(kind)];
}

} // namespace smokevis
