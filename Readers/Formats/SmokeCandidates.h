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

/// Kinds of sources of extinction, from the best; Automatic stands for the best there is.
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
  /// Km of the species [m2/kg], as the run has it.
  double MassExtinction = 0.0;
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

/// Everything 3-D that gives extinction, by mesh, species and worth. The kinds of sources are, from
/// the best: slices of EXTINCTION COEFFICIENT, OPTICAL DENSITY, DENSITY of a smoke species, MASS
/// FRACTION of one with the gas DENSITY; 8-bit smoke (.s3d) that holds density; Plot3D; slices of
/// VISIBILITY, which is capped; and 8-bit smoke that holds opacity, which is coarse. Of each kind
/// cell-centred comes before node-centred.
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
