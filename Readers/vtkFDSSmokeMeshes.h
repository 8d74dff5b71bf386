// Reads the smoke of several meshes at a time into grids, by several threads.
#ifndef vtkFDSSmokeMeshes_h
#define vtkFDSSmokeMeshes_h

#include "FlameLight.h"
#include "FrameTimes.h"
#include "Progress.h"

#include "vtkRectilinearGrid.h"
#include "vtkSmartPointer.h"

#include <string>
#include <vector>

namespace smokevis
{

class ExtinctionSource;
class FlameSource;
class SmvFile;

/// What is to be read, and how.
struct SmokeRequest
{
  const SmvFile* Index = nullptr;
  ExtinctionSource* Smoke = nullptr;
  /// Null for no light of flames; then Glow says whether Flames gives a temperature rather than a
  /// heat release rate, and Efficacy is the light per heat release [lm/W].
  FlameSource* Flames = nullptr;
  bool Glow = false;
  /// Where Flames gives a temperature: what tells the heat release rate, null for nothing.
  FlameSource* Heat = nullptr;
  double Efficacy = 0.0;
  double Albedo = 0.0;
  /// [s]
  double Time = 0.0;
  TimeInterpolation Interpolation = TimeInterpolation::Nearest;
};

/// One mesh, read.
struct SmokeMesh
{
  vtkSmartPointer<vtkRectilinearGrid> Grid;
  /// What the smoke's values are of [s].
  double Time = 0.0;
  FlameLight Light;
};

/// Reads meshes [first, end). When @p progress says so it stops, and what comes back is empty.
/// Throws the error of the first mesh that has one.
std::vector<SmokeMesh> ReadSmokeMeshes(
  const SmokeRequest& request, int first, int end, Progress& progress);

} // namespace smokevis

#endif
