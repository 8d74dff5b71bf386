// Which files of a run could give its smoke's extinction, best first.
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
  Visibility
};

/// A file, or for Plot3D a file a time, with one smoke species on one mesh.
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
  /// Km [m2/kg], where Quantity is Density and for Smoke3D.
  double MassExtinction = 0.0;
  SmvQuantity Label;
  /// Times [s] (0 unless Plot3D) and names of the files.
  std::vector<std::pair<double, std::string>> Files;
  /// Which of Plot3D's five quantities.
  int Component = 0;
  /// Less is better, see FindSmokeCandidates().
  int Rank = 0;
};

/// Everything 3-D that gives extinction, by mesh, species and rank. The ranks are, from the best:
/// slices of EXTINCTION COEFFICIENT, OPTICAL DENSITY, DENSITY of a smoke species, each cell-centred
/// before node-centred; 8-bit smoke (.s3d) that holds density; Plot3D; slices of VISIBILITY; and
/// 8-bit smoke that holds opacity.
std::vector<SmokeCandidate> FindSmokeCandidates(const SmvFile& index);

/// Opens the files of @p candidate; throws Error when they are missing or damaged.
std::unique_ptr<FrameFile> OpenCandidate(const SmvFile& index, const SmokeCandidate& candidate);

} // namespace smokevis
