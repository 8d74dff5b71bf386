#include "ExtinctionSource.h"

#include "Errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <set>
#include <sstream>

namespace smokevis
{

namespace
{

// FDS computes OPTICAL DENSITY as K / 2.3.
constexpr float ExtinctionPerOpticalDensity = 2.3F;
// More negative than this [1/m] is no rounding of a transport scheme but not smoke at all.
constexpr float MostNegative = -1e-3F;

double NearestOf(const std::vector<double>& times, double time)
{
  return *std::min_element(times.begin(), times.end(),
    [time](double a, double b) { return std::abs(a - time) < std::abs(b - time); });
}

// The offsets of a cell's eight nodes from its first one.
std::array<std::size_t, 8> CornerOffsets(const std::array<int, 3>& nodes)
{
  const auto row = static_cast<std::size_t>(nodes[0]);
  const std::size_t layer = row * static_cast<std::size_t>(nodes[1]);
  return {0, 1, row, row + 1, layer, layer + 1, layer + row, layer + row + 1};
}

// FDS averages .s3d over all eight cells of a node, solid ones counting as clear. This takes them
// out again: times eight over the number of gas cells. Beyond the mesh's ends the cells are taken
// to be like those within.
void TakeSolidsOut(
  const SmvMesh& mesh, const std::vector<unsigned char>& solid, std::vector<float>& nodes)
{
  if (solid.empty())
  {
    return;
  }
  const std::array<int, 3> cells{mesh.Cells(0), mesh.Cells(1), mesh.Cells(2)};
  std::size_t node = 0;
  for (int k = 0; k <= cells[2]; ++k)
  {
    for (int j = 0; j <= cells[1]; ++j)
    {
      for (int i = 0; i <= cells[0]; ++i, ++node)
      {
        int gas = 0;
        for (int corner = 0; corner < 8; ++corner)
        {
          const auto x = static_cast<std::size_t>(std::clamp(i - (corner & 1), 0, cells[0] - 1));
          const auto y =
            static_cast<std::size_t>(std::clamp(j - (corner >> 1 & 1), 0, cells[1] - 1));
          const auto z = static_cast<std::size_t>(std::clamp(k - (corner >> 2), 0, cells[2] - 1));
          gas += solid[(z * cells[1] + y) * cells[0] + x] == 0 ? 1 : 0;
        }
        nodes[node] *= gas == 0 ? 0.0F : 8.0F / static_cast<float>(gas);
      }
    }
  }
}

} // namespace

//------------------------------------------------------------------------------------------------
ExtinctionSource::ExtinctionSource(const SmvFile& index, double visibilityFactor)
    : index_(index), visibilityFactor_(visibilityFactor), terms_(index.Meshes.size())
{
  this->Choose();
  this->WarnOfGaps();
  this->CollectTimes();
  this->Describe();
}

//------------------------------------------------------------------------------------------------
void ExtinctionSource::Choose()
{
  std::vector<SmokeCandidate> candidates = FindSmokeCandidates(index_);
  if (candidates.empty())
  {
    this->FailWithoutSmoke();
  }
  for (SmokeCandidate& candidate : candidates)
  {
    std::vector<Term>& chosen = terms_[candidate.Mesh];
    const bool first = chosen.empty() || chosen.back().Of.Species != candidate.Species;
    if (!first && chosen.back().Of.WholeMesh)
    {
      continue;
    }
    try
    {
      std::unique_ptr<FrameFile> file = OpenCandidate(index_, candidate);
      if (!file->Damage().empty())
      {
        warnings_.push_back(file->Path() + ": " + file->Damage() + "; the other frames are used.");
      }
      chosen.push_back({std::move(candidate), std::move(file)});
    }
    catch (const Error& error)
    {
      if (first)
      {
        throw;
      }
      warnings_.push_back(std::string("A part of the smoke cannot be completed: ") + error.what());
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
      species.insert(term.Of.Species);
    }
  }
  for (std::size_t mesh = 0; mesh < terms_.size(); ++mesh)
  {
    const std::string& name = index_.Meshes[mesh].Name;
    for (const std::string& one : species)
    {
      const auto last = std::find_if(terms_[mesh].rbegin(), terms_[mesh].rend(),
        [&one](const Term& term) { return term.Of.Species == one; });
      if (last == terms_[mesh].rend())
      {
        warnings_.push_back("Mesh '" + name + "' has no 3-D output of the smoke" +
                            (one.empty() ? "" : " " + one) + ": it is taken as clear air there.");
      }
      else if (!last->Of.WholeMesh)
      {
        warnings_.push_back("The 3-D slices of " + last->Of.Label.LongLabel +
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
      times_.insert(times_.end(), term.File->FrameTimes().begin(), term.File->FrameTimes().end());
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
    for (const auto& [of, file] : terms_[mesh])
    {
      static constexpr std::array<const char*, 3> formats{"3-D slice", "8-bit 3-D smoke", "Plot3D"};
      text << (text.tellp() > 0 ? "; " : "") << "mesh '" << index_.Meshes[mesh].Name
           << "': " << of.Label.LongLabel << " [" << of.Label.Unit << "], "
           << (of.CellCentred ? "cell-centred " : "node-centred ")
           << formats[static_cast<std::size_t>(of.Kind)];
      if (of.Kind == SmokeCandidate::Format::Smoke3D)
      {
        // Maybe the twin of the file that the index names.
        text << " " << std::filesystem::path(file->Path()).filename().string();
      }
      else
      {
        for (const auto& [time, name] : of.Files)
        {
          text << " " << name;
        }
      }
      if (of.MassExtinction > 0.0)
      {
        text << ", Km = " << of.MassExtinction << " m2/kg";
      }
      else if (of.Quantity == SmokeQuantity::OpticalDensity)
      {
        text << ", K = 2.3 OD";
      }
      else if (of.Quantity == SmokeQuantity::Visibility)
      {
        text << ", K = C/S with C = " << visibilityFactor_;
        visibility = true;
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
  throw Error(index_.Path,
    "the run wrote no smoke in 3-D. It wrote: " + (list.empty() ? "none" : list),
    "Add &SLCF XB=(the whole domain), QUANTITY='EXTINCTION COEFFICIENT', SPEC_ID='SOOT', "
    "CELL_CENTERED=.TRUE. / to the FDS input and run it again");
}

//------------------------------------------------------------------------------------------------
double ExtinctionSource::NearestTime(double time) const
{
  return NearestOf(times_, time);
}

//------------------------------------------------------------------------------------------------
double ExtinctionSource::Read(
  int mesh, double time, const std::vector<unsigned char>& solid, std::span<float> values)
{
  std::fill(values.begin(), values.end(), 0.0F);
  double readTime = time;
  std::vector<unsigned char> covered;
  const std::vector<Term>& terms = terms_[mesh];
  for (std::size_t i = 0; i < terms.size(); ++i)
  {
    const std::vector<double>& times = terms[i].File->FrameTimes();
    const double frameTime = NearestOf(times, time);
    // A restarted run writes some times again: the later writing holds.
    const auto last = std::find(times.rbegin(), times.rend(), frameTime);
    const std::size_t frame = static_cast<std::size_t>(times.rend() - last) - 1;
    // Where a mesh lacks the frame, the frame farthest from the wish is the one to tell of.
    if (std::abs(frameTime - time) > std::abs(readTime - time))
    {
      readTime = frameTime;
    }
    const bool begins = i == 0 || terms[i - 1].Of.Species != terms[i].Of.Species;
    const bool ends = i + 1 == terms.size() || terms[i + 1].Of.Species != terms[i].Of.Species;
    if (begins && !ends)
    {
      covered.assign(values.size(), 0);
    }
    this->Add(terms[i], frame, solid, begins && ends ? nullptr : &covered, values);
  }
  return readTime;
}

//------------------------------------------------------------------------------------------------
void ExtinctionSource::Convert(
  const Term& term, const std::vector<unsigned char>& solid, std::vector<float>& values) const
{
  if (term.Of.Kind == SmokeCandidate::Format::Smoke3D)
  {
    TakeSolidsOut(index_.Meshes[term.Of.Mesh], solid, values);
  }
  else if (term.Of.Quantity == SmokeQuantity::Visibility)
  {
    const auto factor = static_cast<float>(visibilityFactor_);
    std::transform(
      values.begin(), values.end(), values.begin(), [factor](float s) { return factor / s; });
  }
  else if (term.Of.Quantity != SmokeQuantity::Extinction)
  {
    const float factor = term.Of.Quantity == SmokeQuantity::Density
                           ? static_cast<float>(term.Of.MassExtinction)
                           : ExtinctionPerOpticalDensity;
    std::transform(
      values.begin(), values.end(), values.begin(), [factor](float v) { return factor * v; });
  }
}

//------------------------------------------------------------------------------------------------
void ExtinctionSource::Add(const Term& term, std::size_t frame,
  const std::vector<unsigned char>& solid, std::vector<unsigned char>* covered,
  std::span<float> sum)
{
  std::vector<float>& values = frame_;
  term.File->ReadFrame(frame, values);
  this->Convert(term, solid, values);
  const SmvMesh& mesh = index_.Meshes[term.Of.Mesh];
  const IndexRange& r = term.Of.Range;
  const auto nx = static_cast<std::size_t>(mesh.Cells(0));
  const auto ny = static_cast<std::size_t>(mesh.Cells(1));
  const std::array<std::size_t, 8> corners = CornerOffsets(term.File->Dimensions());
  const std::size_t rowLength = corners[2];
  const std::size_t layerLength = corners[4];
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
        float extinction = *value;
        if (!term.Of.CellCentred)
        {
          // FDS gives a node the mean over its gas cells, and 0 without any. All eight nodes of a
          // gas cell have one: the cell itself.
          extinction = 0.0F;
          for (const std::size_t corner : corners)
          {
            extinction += 0.125F * value[corner];
          }
        }
        if (!std::isfinite(extinction) || extinction < MostNegative)
        {
          std::ostringstream what;
          what << term.Of.Label.LongLabel << " gives the extinction coefficient " << extinction
               << " 1/m in cell (" << i << ", " << j << ", " << k << ") of mesh '" << mesh.Name
               << "' at " << term.File->FrameTimes()[frame] << " s";
          throw Error(term.File->Path(), what.str(),
            "The run went numerically unstable or the file is damaged: read an earlier time");
        }
        sum[cell] += std::max(extinction, 0.0F);
        if (covered)
        {
          (*covered)[cell] = 1;
        }
      }
    }
  }
}

} // namespace smokevis
