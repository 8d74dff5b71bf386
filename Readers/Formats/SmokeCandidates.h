// Which files of a run hold a quantity in 3-D, and how good they are for the smoke's extinction.
#pragma once

#include "FrameFile.h"
#include "SmvFile.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace smokevis
{

/// What a file's values are, and so how they become extinction.
enum class SmokeQuantity
{
  Extinction,
  OpticalDensity,
  Density,
  MassFraction,
  Visibility,
  /// Something else, e.g. temperature.
  Other
};

/// Kinds of sources of extinction; Automatic stands for the best there is, see
/// FindSmokeCandidates().
enum class SmokeSourceKind
{
  Automatic,
  ExtinctionSlice,
  OpticalDensitySlice,
  DensitySlice,
  MassFractionSlice,
  DensitySmoke3D,
  Plot3D,
  VisibilitySlice,
  OpacitySmoke3D
};

/// How extinction is made of what the run wrote.
struct SmokeOptions
{
  /// C of K = C/S, 3 for light-reflecting signs unless the run said otherwise.
  double VisibilityFactor = 3.0;
  /// Km [m2/kg] to take instead of the run's own; 0 for the run's own.
  double MassExtinction = 0.0;
  SmokeSourceKind Source = SmokeSourceKind::Automatic;

  bool operator==(const SmokeOptions&) const = default;
};

/// A file, or for Plot3D a file a time, with one quantity on one mesh.
struct SmokeCandidate
{
  enum class Format
  {
    Slice,
    Smoke3D,
    Plot3D
  };

  int Mesh = 0;
  /// In upper case; empty where the label names none.
  std::string Species;
  Format Kind = Format::Slice;
  SmokeQuantity Quantity = SmokeQuantity::Extinction;
  bool CellCentred = false;
  /// Nodes of the range covered, and whether that is the whole mesh.
  IndexRange Range{};
  bool WholeMesh = true;
  /// Km of the species [m2/kg], as the run has it, and whether its index says so.
  double MassExtinction = 0.0;
  bool StatesMassExtinction = false;
  /// K = Factor times the value; for VISIBILITY K = Factor / value.
  double Factor = 1.0;
  /// Scale of 8-bit files other than smoke.
  std::array<double, 2> ByteRange{};
  SmvQuantity Label;
  /// Times [s] (0 unless Plot3D) and names of the files.
  std::vector<std::pair<double, std::string>> Files;
  /// Which of Plot3D's five quantities.
  int Component = 0;
  /// Where Quantity is MassFraction: the gas density, by which the values are to be multiplied.
  std::vector<SmokeCandidate> Density;
  SmokeSourceKind Source = SmokeSourceKind::Automatic;
};

/// Everything 3-D that gives extinction, by mesh, species and worth. From the best:
///  1. cell-centred slices of EXTINCTION COEFFICIENT, OPTICAL DENSITY, DENSITY of a smoke species,
///     MASS FRACTION of one with the gas DENSITY: what FDS computed, but for rounding. DENSITY and
///     MASS FRACTION only where Km is known, from the index or the options;
///  2. the same of nodes, from which a cell gets the mean over itself and its 26 neighbours, and
///     DENSITY and MASS FRACTION where FDS's default of Km has to be taken;
///  3. 8-bit smoke (.s3d) that holds density: of nodes, and rounded to 1/254 of the largest;
///  4. Plot3D: of nodes, and of few times;
///  5. slices of VISIBILITY, which is capped, cell-centred before node-centred;
///  6. 8-bit smoke that holds opacity, which is coarse.
std::vector<SmokeCandidate> FindSmokeCandidates(const SmvFile& index, const SmokeOptions& options);

/// Everything 3-D with one of these long labels (in upper case), by mesh and worth: earlier labels
/// before later ones; of each cell-centred slices, node-centred slices, 8-bit files, which have
/// more frames, and Plot3D.
std::vector<SmokeCandidate> FindFieldCandidates(
  const SmvFile& index, const std::vector<std::string>& labels);

/// Opens the files of @p candidate; throws Error when they are missing or damaged.
std::unique_ptr<FrameFile> OpenCandidate(const SmvFile& index, const SmokeCandidate& candidate);

/// What a kind of source is called in messages.
const char* NameOf(SmokeSourceKind kind);

} // namespace smokevis
