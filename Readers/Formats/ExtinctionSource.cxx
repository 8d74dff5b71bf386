#include "ExtinctionSource.h"

#include "Errors.h"
#include "RowLoops.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>

namespace smokevis
{

namespace
{

// Sets values to 0 where a mask, empty for none, is not 0.
void ClearMasked(std::span<float> values, std::size_t first, const std::vector<unsigned char>& mask)
{
  if (mask.empty())
  {
    return;
  }
  const unsigned char* const marks = mask.data() + first;
  std::size_t i = 0;
  // Eight at a time: most are not marked.
  for (; i + 8 <= values.size(); i += 8)
  {
    std::uint64_t eight = 0;
    std::memcpy(&eight, marks + i, sizeof(eight));
    for (std::size_t n = i; eight != 0 && n < i + 8; ++n)
    {
      values[n] = marks[n] != 0 ? 0.0F : values[n];
    }
  }
  for (; i < values.size(); ++i)
  {
    values[i] = marks[i] != 0 ? 0.0F : values[i];
  }
}

// Whether two terms are of one species.
bool Alike(const SmokeCandidate& a, const SmokeCandidate& b)
{
  return a.Species == b.Species;
}

} // namespace

//------------------------------------------------------------------------------------------------
ExtinctionSource::ExtinctionSource(const SmvFile& index, const SmokeOptions& options)
    : index_(index), options_(options), terms_(index.Meshes.size())
{
  this->Choose();
  this->WarnOfGaps();
  this->CollectTimes();
  this->Describe();
}

//------------------------------------------------------------------------------------------------
void ExtinctionSource::Choose()
{
  std::vector<SmokeCandidate> candidates = FindSmokeCandidates(index_, options_);
  if (candidates.empty())
  {
    this->FailWithoutSmoke();
  }
  const auto noteDamage = [this](const VolumeField& field)
  { field.File().NoteDamage(field.Of().Label.LongLabel, damages_); };
  // What could not be opened, by mesh and species: an error unless something else can be.
  std::map<std::pair<int, std::string>, std::vector<Error>> failures;
  for (SmokeCandidate& candidate : candidates)
  {
    std::vector<Term>& chosen = terms_[candidate.Mesh];
    const bool first = chosen.empty() || !Alike(chosen.back().Field.Of(), candidate);
    if (!first && chosen.back().Field.Of().WholeMesh)
    {
      continue;
    }
    const std::pair<int, std::string> key(candidate.Mesh, candidate.Species);
    try
    {
      Term term{VolumeField(index_, std::move(candidate)), nullptr};
      for (const SmokeCandidate& density : term.Field.Of().Density)
      {
        term.Density = std::make_unique<VolumeField>(index_, density);
      }
      noteDamage(term.Field);
      if (term.Density)
      {
        noteDamage(*term.Density);
      }
      chosen.push_back(std::move(term));
    }
    catch (const Error& error)
    {
      failures[key].push_back(error);
    }
  }
  for (const auto& [key, errors] : failures)
  {
    const std::vector<Term>& chosen = terms_[key.first];
    if (std::none_of(chosen.begin(), chosen.end(),
          [species = key.second](const Term& term) { return term.Field.Of().Species == species; }))
    {
      // A mesh shown without its smoke would let signs be seen that are not.
      throw errors.front();
    }
    for (const Error& error : errors)
    {
      warnings_.push_back(
        std::string("The next best source of smoke is used where this is missing: ") +
        error.what());
    }
  }
}

//------------------------------------------------------------------------------------------------
void ExtinctionSource::WarnOfGaps()
{
  std::set<std::string> species;
  for (const std::vector<Term>& terms : terms_)
  {
    for (const Term& term : terms)
    {
      species.insert(term.Field.Of().Species);
    }
  }
  for (std::size_t mesh = 0; mesh < terms_.size(); ++mesh)
  {
    const std::string& name = index_.Meshes[mesh].Name;
    for (const std::string& one : species)
    {
      const auto last = std::find_if(terms_[mesh].rbegin(), terms_[mesh].rend(),
        [&one](const Term& term) { return term.Field.Of().Species == one; });
      if (last == terms_[mesh].rend())
      {
        warnings_.push_back("Mesh '" + name + "' has no 3-D output of the smoke" +
                            (one.empty() ? "" : " " + one) + ": it is taken as clear air there.");
      }
      else if (!last->Field.Of().WholeMesh)
      {
        warnings_.push_back("The 3-D slices of " + last->Field.Of().Label.LongLabel +
                            " cover only a part of mesh '" + name +
                            "': its other cells are taken as clear air.");
      }
    }
  }
}

//------------------------------------------------------------------------------------------------
void ExtinctionSource::CollectTimes()
{
  for (const std::vector<Term>& terms : terms_)
  {
    for (const Term& term : terms)
    {
      const std::vector<double>& times = term.Field.File().FrameTimes();
      times_.insert(times_.end(), times.begin(), times.end());
    }
  }
  std::sort(times_.begin(), times_.end());
  times_.erase(std::unique(times_.begin(), times_.end()), times_.end());
}

//------------------------------------------------------------------------------------------------
void ExtinctionSource::Describe()
{
  bool visibility = false;
  std::ostringstream text;
  for (std::size_t mesh = 0; mesh < terms_.size(); ++mesh)
  {
    for (const Term& term : terms_[mesh])
    {
      const SmokeCandidate& of = term.Field.Of();
      static constexpr std::array<const char*, 3> formats{"3-D slice", "8-bit 3-D smoke", "Plot3D"};
      text << (text.tellp() > 0 ? "; " : "") << "mesh '" << index_.Meshes[mesh].Name
           << "': " << of.Label.LongLabel << " [" << of.Label.Unit << "], "
           << (of.CellCentred ? "cell-centred " : "node-centred ")
           << formats[static_cast<std::size_t>(of.Kind)];
      if (of.Kind == SmokeCandidate::Format::Smoke3D)
      {
        // Maybe the twin of the file that the index names.
        text << " " << std::filesystem::path(term.Field.File().Path()).filename().string();
      }
      else
      {
        for (const auto& [time, name] : of.Files)
        {
          text << " " << name;
        }
      }
      for (const SmokeCandidate& density : of.Density)
      {
        text << " times " << density.Label.LongLabel << " " << density.Files.front().second;
      }
      if (of.Quantity == SmokeQuantity::Density || of.Quantity == SmokeQuantity::MassFraction)
      {
        text << ", Km = " << of.Factor << " m2/kg";
      }
      else
      {
        if (of.Quantity == SmokeQuantity::OpticalDensity)
        {
          text << ", K = 2.3 OD";
        }
        else if (of.Quantity == SmokeQuantity::Visibility)
        {
          text << ", K = C/S with C = " << options_.VisibilityFactor;
          visibility = true;
        }
        if (options_.MassExtinction > 0.0)
        {
          text << ", scaled from Km = " << of.MassExtinction << " to " << options_.MassExtinction
               << " m2/kg";
        }
      }
    }
  }
  description_ = text.str();
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
  const bool any = options_.Source == SmokeSourceKind::Automatic;
  throw Error(index_.Path,
    "the run wrote no " + std::string(any ? "smoke in 3-D" : NameOf(options_.Source)) +
      ". It wrote: " + (list.empty() ? "none" : list),
    std::string(any ? "" : "Let the source be chosen automatically, or: ") +
      "Add &SLCF XB=(the whole domain), QUANTITY='EXTINCTION COEFFICIENT', SPEC_ID='SOOT', "
      "CELL_CENTERED=.TRUE. / to the FDS input and run it again");
}

//------------------------------------------------------------------------------------------------
double ExtinctionSource::NearestTime(double time) const
{
  return times_[NearestOf(times_, time)];
}

//------------------------------------------------------------------------------------------------
std::uint64_t ExtinctionSource::BytesRead() const
{
  std::uint64_t bytes = 0;
  for (const std::vector<Term>& terms : terms_)
  {
    for (const Term& term : terms)
    {
      bytes += term.Field.File().BytesRead();
      bytes += term.Density ? term.Density->File().BytesRead() : 0;
    }
  }
  return bytes;
}

//------------------------------------------------------------------------------------------------
double ExtinctionSource::Read(int mesh, double time, TimeInterpolation interpolation,
  const std::vector<unsigned char>& solid, std::span<float> values)
{
  Scratch& scratch = scratch_.local();
  double readTime = time;
  std::vector<Term>& terms = terms_[mesh];
  // A single whole frame is written over whatever is there.
  const bool sums = terms.size() != 1 || !terms[0].Field.Of().WholeMesh ||
                    interpolation != TimeInterpolation::Nearest;
  if (sums)
  {
    std::fill(values.begin(), values.end(), 0.0F);
  }
  for (std::size_t i = 0; i < terms.size(); ++i)
  {
    const SmokeCandidate& of = terms[i].Field.Of();
    const FrameMix mix = terms[i].Field.Times().At(time, interpolation);
    // Where a mesh lacks the frame, the frame farthest from the wish is the one to tell of.
    if (std::abs(mix.Time - time) > std::abs(readTime - time))
    {
      readTime = mix.Time;
    }
    const bool begins = i == 0 || !Alike(terms[i - 1].Field.Of(), of);
    const bool ends = i + 1 == terms.size() || !Alike(terms[i + 1].Field.Of(), of);
    if (begins && !ends)
    {
      scratch.Covered.assign(values.size(), 0);
    }
    this->Add(terms[i], mix, solid, {sums, !(begins && ends)}, scratch, values);
  }
  return readTime;
}

//------------------------------------------------------------------------------------------------
void ExtinctionSource::Add(Term& term, const FrameMix& mix, const std::vector<unsigned char>& solid,
  const Mode& mode, Scratch& scratch, std::span<float> sum)
{
  VolumeField& field = term.Field;
  const SmokeCandidate& of = field.Of();
  const auto factor = static_cast<float>(of.Factor);
  static const std::vector<unsigned char> none;
  const std::size_t parts = mix.Weight[1] > 0.0 ? 2 : 1;
  for (std::size_t part = 0; part < parts; ++part)
  {
    const std::size_t frame = mix.Frame[part];
    const double frameTime = field.File().FrameTimes()[frame];
    const auto invert = [&](std::span<float> values)
    {
      if (of.Quantity == SmokeQuantity::Visibility)
      {
        std::transform(values.begin(), values.end(), values.begin(),
          [factor](float visibility) { return factor / visibility; });
      }
    };
    if (term.Density)
    {
      scratch.Density.assign(sum.size(), 0.0F);
      // ReadCells() needs space of its own.
      std::vector<float> space;
      term.Density->ReadCells(frameTime, TimeInterpolation::Nearest, solid, space, scratch.Density);
    }
    const auto weight = static_cast<float>(mix.Weight[part]);
    const bool scaled = of.Quantity != SmokeQuantity::Visibility && factor != 1.0F;
    const bool last = part + 1 == parts;
    const bool changes = scaled || of.Quantity == SmokeQuantity::Visibility || term.Density ||
                         !solid.empty() || mode.UsesCovered;
    if (!changes && !mode.Sums && field.CopyFrame(frame, scratch.Values, sum))
    {
      continue;
    }
    field.ForEachRow(frame, solid, scratch.Values, invert,
      [&](std::size_t cell, int j, int k, std::span<const float> row)
      {
        float* const target = sum.data() + cell;
        if (changes)
        {
          scratch.Row.resize(row.size());
          const std::span<float> own(scratch.Row);
          const float times = scaled ? factor : 1.0F;
          std::transform(
            row.begin(), row.end(), own.begin(), [times](float value) { return times * value; });
          for (std::size_t i = 0; i < own.size() && term.Density; ++i)
          {
            own[i] *= scratch.Density[cell + i];
          }
          ClearMasked(own, cell, solid);
          ClearMasked(own, cell, mode.UsesCovered ? scratch.Covered : none);
          row = own;
        }
        if (!(mode.Sums ? AddExtinction(row, weight, target) : CopyExtinction(row, target)))
        {
          this->FailAt(field, frameTime, row, j, k);
        }
        if (mode.UsesCovered && last)
        {
          std::fill_n(scratch.Covered.data() + cell, row.size(), static_cast<unsigned char>(1));
        }
      });
  }
}

//------------------------------------------------------------------------------------------------
void ExtinctionSource::FailAt(
  const VolumeField& field, double time, std::span<const float> row, int j, int k) const
{
  const auto bad = std::find_if_not(row.begin(), row.end(), IsExtinction);
  const SmokeCandidate& of = field.Of();
  std::ostringstream what;
  what << of.Label.LongLabel << " gives the extinction coefficient " << *bad << " 1/m in cell ("
       << bad - row.begin() + of.Range[0] << ", " << j << ", " << k << ") of mesh '"
       << index_.Meshes[of.Mesh].Name << "' at " << time << " s";
  throw Error(field.File().Path(), what.str(),
    "The run went numerically unstable or the file is damaged: read an earlier time");
}

} // namespace smokevis
