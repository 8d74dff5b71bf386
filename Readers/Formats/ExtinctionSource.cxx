#include "ExtinctionSource.h"

#include "TextFields.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <sstream>
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
// More negative than this [1/m] is no rounding of a transport scheme but not smoke at all.
constexpr float MostNegative = -1e-3F;

std::string UpperCase(std::string_view text)
{
  std::string upper(text);
  std::transform(upper.begin(), upper.end(), upper.begin(),
    [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return upper;
}

double NearestOf(const std::vector<double>& times, double time)
{
  return *std::min_element(times.begin(), times.end(),
    [time](double a, double b) { return std::abs(a - time) < std::abs(b - time); });
}

} // namespace

//------------------------------------------------------------------------------------------------
ExtinctionSource::ExtinctionSource(const SmvFile& index, double visibilityFactor)
    : index_(index), visibilityFactor_(visibilityFactor), terms_(index.Meshes.size())
{
  std::vector<Term> candidates = this->Candidates();
  if (candidates.empty())
  {
    this->FailWithoutSmoke();
  }
  this->Choose(std::move(candidates));
  this->CollectTimes();
  this->Describe();
}

//------------------------------------------------------------------------------------------------
std::vector<ExtinctionSource::Term> ExtinctionSource::Candidates() const
{
  static constexpr std::array<std::pair<std::string_view, Quantity>, 4> labels{
    {{"EXTINCTION COEFFICIENT", Quantity::Extinction},
      {"OPTICAL DENSITY", Quantity::OpticalDensity}, {"VISIBILITY", Quantity::Visibility},
      {"DENSITY", Quantity::Density}}};
  // What the run itself calls smoke, with its Km.
  std::map<std::string, double> massExtinction;
  for (const SmvSmoke3D& smoke : index_.Smoke3D)
  {
    if (smoke.MassExtinction > 0.0)
    {
      massExtinction[UpperCase(smoke.Quantity.LongLabel)] = smoke.MassExtinction;
    }
  }
  std::vector<Term> candidates;
  bool named = false;
  for (const SmvSlice& slice : index_.Slices)
  {
    const std::string label = UpperCase(slice.Quantity.LongLabel);
    const auto found = std::find_if(labels.begin(), labels.end(),
      [&label](const auto& known) { return label.ends_with(known.first); });
    if (found == labels.end() || !slice.IsVolume())
    {
      continue;
    }
    Term term;
    term.Slice = &slice;
    term.Kind = found->second;
    term.Species =
      std::string(Trim(std::string_view(label).substr(0, label.size() - found->first.size())));
    if (term.Kind == Quantity::Density)
    {
      const auto known = massExtinction.find(label);
      const bool soot = term.Species.find("SOOT") != std::string::npos;
      if (known == massExtinction.end() && !soot)
      {
        continue; // the density of the gas or of a species that is not smoke
      }
      term.MassExtinction = known == massExtinction.end() ? SootMassExtinction : known->second;
    }
    const SmvMesh& mesh = index_.Meshes[slice.Mesh];
    term.WholeMesh =
      slice.Range == IndexRange{0, mesh.Cells(0), 0, mesh.Cells(1), 0, mesh.Cells(2)};
    named = named || !term.Species.empty();
    candidates.push_back(std::move(term));
  }
  if (named)
  {
    // A label without a species is the sum or one of the named ones: it must not count twice.
    std::erase_if(candidates, [](const Term& term) { return term.Species.empty(); });
  }
  return candidates;
}

//------------------------------------------------------------------------------------------------
void ExtinctionSource::Choose(std::vector<Term> candidates)
{
  // Of one mesh and species: whole meshes first, then the better quantity, then cell-centred.
  const auto rank = [](const Term& term)
  { return std::make_tuple(!term.WholeMesh, term.Kind, !term.Slice->CellCentred); };
  std::stable_sort(candidates.begin(), candidates.end(),
    [&rank](const Term& a, const Term& b)
    {
      return std::tie(a.Slice->Mesh, a.Species) < std::tie(b.Slice->Mesh, b.Species) ||
             (std::tie(a.Slice->Mesh, a.Species) == std::tie(b.Slice->Mesh, b.Species) &&
               rank(a) < rank(b));
    });
  std::set<std::string> species;
  for (Term& term : candidates)
  {
    species.insert(term.Species);
    std::vector<Term>& chosen = terms_[term.Slice->Mesh];
    const bool first = chosen.empty() || chosen.back().Species != term.Species;
    // One slice over the whole mesh is enough; parts of the same kind complete each other.
    const bool part = !first && !chosen.back().WholeMesh && rank(chosen.back()) == rank(term);
    if (first || part)
    {
      this->Open(term);
      chosen.push_back(std::move(term));
    }
  }
  for (std::size_t mesh = 0; mesh < terms_.size(); ++mesh)
  {
    const std::string& name = index_.Meshes[mesh].Name;
    for (const std::string& one : species)
    {
      const auto found = std::find_if(terms_[mesh].begin(), terms_[mesh].end(),
        [&one](const Term& term) { return term.Species == one; });
      if (found == terms_[mesh].end())
      {
        warnings_.push_back("Mesh '" + name + "' has no 3-D slice of the smoke" +
                            (one.empty() ? "" : " " + one) + ": it is taken as clear air there.");
      }
      else if (!found->WholeMesh)
      {
        warnings_.push_back("The 3-D slices of " + found->Slice->Quantity.LongLabel +
                            " cover only a part of mesh '" + name +
                            "': its other cells are taken as clear air.");
      }
    }
  }
}

//------------------------------------------------------------------------------------------------
void ExtinctionSource::Open(Term& term)
{
  const SmvSlice& slice = *term.Slice;
  term.File = std::make_unique<SliceFile>(index_.Resolve(slice.File), slice.CellCentred);
  if (term.File->Range() != slice.Range)
  {
    throw Error(term.File->Path(),
      "its index range is not the one that the index " + index_.Path + " gives",
      "The two are of different runs: copy both from the same one");
  }
  if (!term.File->Damage().empty())
  {
    warnings_.push_back(
      term.File->Path() + ": " + term.File->Damage() + "; the frames before it are used.");
  }
}

//------------------------------------------------------------------------------------------------
void ExtinctionSource::CollectTimes()
{
  for (const std::vector<Term>& terms : terms_)
  {
    for (const Term& term : terms)
    {
      times_.insert(times_.end(), term.File->FrameTimes().begin(), term.File->FrameTimes().end());
    }
  }
  std::sort(times_.begin(), times_.end());
  times_.erase(std::unique(times_.begin(), times_.end()), times_.end());
}

//------------------------------------------------------------------------------------------------
void ExtinctionSource::Describe()
{
  std::ostringstream text;
  for (std::size_t mesh = 0; mesh < terms_.size(); ++mesh)
  {
    for (const Term& term : terms_[mesh])
    {
      static constexpr std::array<const char*, 4> formulas{
        "K", "K = 2.3 OD", "K = Km rho", "K = C/S"};
      text << (text.tellp() > 0 ? "; " : "") << "mesh '" << index_.Meshes[mesh].Name
           << "': " << term.Slice->Quantity.LongLabel << " [" << term.Slice->Quantity.Unit << "], "
           << (term.Slice->CellCentred ? "cell-centred" : "node-centred") << " 3-D slice "
           << term.Slice->File << ", " << formulas[static_cast<std::size_t>(term.Kind)];
      if (term.Kind == Quantity::Density)
      {
        text << " with Km = " << term.MassExtinction << " m2/kg";
      }
      if (term.Kind == Quantity::Visibility)
      {
        text << " with C = " << visibilityFactor_;
      }
    }
  }
  description_ = text.str();
  const bool visibility = description_.find("K = C/S") != std::string::npos;
  if (visibility)
  {
    warnings_.push_back("The extinction comes from VISIBILITY, which FDS caps (at 30 m unless told "
                        "otherwise): where it is at the cap, the most smoke that this allows is "
                        "taken. Write a 3-D slice of EXTINCTION COEFFICIENT instead.");
  }
}

//------------------------------------------------------------------------------------------------
void ExtinctionSource::FailWithoutSmoke() const
{
  std::set<std::string> present;
  for (const SmvSlice& slice : index_.Slices)
  {
    present.insert(
      (slice.IsVolume() ? "3-D slice of " : "2-D slice of ") + slice.Quantity.LongLabel);
  }
  for (const SmvSmoke3D& smoke : index_.Smoke3D)
  {
    present.insert("8-bit smoke of " + smoke.Quantity.LongLabel);
  }
  for (const SmvPlot3D& plot : index_.Plot3D)
  {
    for (const SmvQuantity& quantity : plot.Quantities)
    {
      present.insert("Plot3D of " + quantity.LongLabel);
    }
  }
  std::string list;
  for (const std::string& one : present)
  {
    list += (list.empty() ? "" : ", ") + one;
  }
  throw Error(index_.Path,
    "the run wrote no 3-D slice of a smoke quantity. It wrote: " + (list.empty() ? "none" : list),
    "Add &SLCF XB=(the whole domain), QUANTITY='EXTINCTION COEFFICIENT', SPEC_ID='SOOT', "
    "CELL_CENTERED=.TRUE. / to the FDS input and run it again");
}

//------------------------------------------------------------------------------------------------
double ExtinctionSource::NearestTime(double time) const
{
  return NearestOf(times_, time);
}

//------------------------------------------------------------------------------------------------
MeshExtinction ExtinctionSource::Read(
  int mesh, double time, const std::vector<unsigned char>& solid)
{
  const SmvMesh& grid = index_.Meshes[mesh];
  const std::size_t cells = static_cast<std::size_t>(grid.Cells(0)) * grid.Cells(1) * grid.Cells(2);
  MeshExtinction result;
  result.Values.assign(cells, 0.0F);
  result.Time = time;
  std::vector<unsigned char> covered;
  std::vector<Term>& terms = terms_[mesh];
  for (std::size_t i = 0; i < terms.size(); ++i)
  {
    const std::vector<double>& times = terms[i].File->FrameTimes();
    const double frameTime = NearestOf(times, time);
    // A restarted run writes some times again: the later writing holds.
    const auto last = std::find(times.rbegin(), times.rend(), frameTime);
    const std::size_t frame = static_cast<std::size_t>(times.rend() - last) - 1;
    // Where a mesh lacks the frame, the frame farthest from the wish is the one to tell of.
    if (std::abs(frameTime - time) > std::abs(result.Time - time))
    {
      result.Time = frameTime;
    }
    const bool sharesSpecies = (i > 0 && terms[i - 1].Species == terms[i].Species) ||
                               (i + 1 < terms.size() && terms[i + 1].Species == terms[i].Species);
    if (sharesSpecies && (i == 0 || terms[i - 1].Species != terms[i].Species))
    {
      covered.assign(cells, 0);
    }
    this->Add(terms[i], frame, solid, sharesSpecies ? &covered : nullptr, result.Values);
  }
  return result;
}

//------------------------------------------------------------------------------------------------
double ExtinctionSource::Convert(const Term& term, double value) const
{
  switch (term.Kind)
  {
  case Quantity::OpticalDensity:
    return ExtinctionPerOpticalDensity * value;
  case Quantity::Density:
    return term.MassExtinction * value;
  case Quantity::Visibility:
    return visibilityFactor_ / value;
  case Quantity::Extinction:
    break;
  }
  return value;
}

//------------------------------------------------------------------------------------------------
void ExtinctionSource::Add(Term& term, std::size_t frame, const std::vector<unsigned char>& solid,
  std::vector<unsigned char>* covered, std::vector<float>& sum) const
{
  std::vector<float> values;
  term.File->ReadFrame(frame, values);
  const SmvMesh& mesh = index_.Meshes[term.Slice->Mesh];
  const IndexRange& r = term.Slice->Range;
  const auto nx = static_cast<std::size_t>(mesh.Cells(0));
  const auto ny = static_cast<std::size_t>(mesh.Cells(1));
  const auto rowLength = static_cast<std::size_t>(term.File->Dimensions()[0]);
  const std::size_t layerLength = rowLength * term.File->Dimensions()[1];
  const bool plain = term.Kind == Quantity::Extinction;
  for (int k = r[4]; k < r[5]; ++k)
  {
    for (int j = r[2]; j < r[3]; ++j)
    {
      const float* row = values.data() + (k - r[4]) * layerLength + (j - r[2]) * rowLength;
      const std::size_t first = (static_cast<std::size_t>(k) * ny + j) * nx;
      for (int i = r[0]; i < r[1]; ++i)
      {
        const std::size_t cell = first + i;
        if ((!solid.empty() && solid[cell] != 0) || (covered && (*covered)[cell] != 0))
        {
          continue;
        }
        const float* value = row + (i - r[0]);
        double extinction = 0.0;
        if (term.Slice->CellCentred)
        {
          extinction = plain ? *value : this->Convert(term, *value);
        }
        else
        {
          // FDS gives a node the mean over its gas cells, and 0 without any. All eight nodes of a
          // gas cell have one: the cell itself.
          for (const std::size_t corner :
            {std::size_t{0}, std::size_t{1}, rowLength, rowLength + 1, layerLength, layerLength + 1,
              layerLength + rowLength, layerLength + rowLength + 1})
          {
            extinction += 0.125 * (plain ? value[corner] : this->Convert(term, value[corner]));
          }
        }
        if (!std::isfinite(extinction) || extinction < MostNegative)
        {
          std::ostringstream what;
          what << term.Slice->Quantity.LongLabel << " gives the extinction coefficient "
               << extinction << " 1/m in cell (" << i << ", " << j << ", " << k << ") of mesh '"
               << mesh.Name << "' at " << term.File->FrameTimes()[frame] << " s";
          throw Error(term.File->Path(), what.str(),
            "The run went numerically unstable or the file is damaged: read an earlier time");
        }
        sum[cell] += static_cast<float>(std::max(extinction, 0.0));
        if (covered)
        {
          (*covered)[cell] = 1;
        }
      }
    }
  }
}

} // namespace smokevis
