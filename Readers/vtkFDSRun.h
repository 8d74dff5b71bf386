// What the FDS reader keeps of the run that it has open, from one request to the next.
#ifndef vtkFDSRun_h
#define vtkFDSRun_h

#include "ExtinctionSource.h"
#include "FlameSource.h"
#include "SmvFile.h"
#include "vtkFDSBoundary.h"
#include "vtkFDSPlaneSlices.h"

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace smokevis
{
class FDSPieces;

/// An FDS run: its index, the files chosen from it, and the walls as they were built last.
class FDSRun
{
public:
  /// What decides which files are opened.
  struct Choice
  {
    std::string FileName;
    SmokeOptions Smoke;
    /// Nothing for no light of flames.
    std::optional<FlameModel> Flames;

    bool operator==(const Choice&) const = default;
  };

  /// Reads the index and opens the files, unless @p choice and the index are those of last time.
  /// Throws Error when the index is unreadable; what is wrong with the smoke's files waits in
  /// SmokeProblem().
  void Load(const Choice& choice);

  /// Whether a run is open; those below must not be called before.
  bool IsOpen() const { return index_ != nullptr; }

  const SmvFile& Index() const { return *index_; }

  /// Null where the run has no smoke that can be read; SmokeProblem() then says why.
  ExtinctionSource* Smoke() const { return smoke_.get(); }
  const std::string& SmokeProblem() const { return smokeProblem_; }

  /// Null without smoke, and where no flames are wanted.
  FlameSource* Flames() const { return flames_.get(); }

  /// What tells the heat release where the light of flames comes from their temperature; else null.
  FlameSource* Heat() const { return heat_.get(); }

  FDSPlaneSlices& Slices() const { return *slices_; }
  FDSBoundary& Boundary() const { return *boundary_; }

  /// The time steps [s], increasing: the smoke's frames or, without any, changes of the walls.
  std::vector<double> Times() const;

  /// The time [s] that is shown for the one that is asked for, if any: walls and smoke are of the
  /// same moment.
  double SceneTime(std::optional<double> asked, TimeInterpolation interpolation) const;

  /// Those of @p warnings that this did not return before.
  std::vector<std::string> NotSaidYet(const std::vector<std::string>& warnings);

  /// One text a run about its files that are not whole, which of those that are read for this piece
  /// it names: a run that still goes cuts most of them. Empty where none of those read so far is
  /// cut, and once it was said.
  /// @param slices, boundary whether these files are read, too
  std::string NotWhole(const FDSPieces& pieces, bool slices, bool boundary);

  /// The walls at a time; built anew only when something changed since the last call.
  /// @param leastOpacity obstructions less opaque (0 to 1) are left out
  /// @param warnings what is to be said about them, empty unless they were built anew
  vtkPolyData* Geometry(double time, double leastOpacity, std::vector<std::string>& warnings);

private:
  Choice choice_;
  std::filesystem::file_time_type stamp_;
  std::unique_ptr<SmvFile> index_;
  std::unique_ptr<ExtinctionSource> smoke_;
  std::string smokeProblem_;
  std::unique_ptr<FlameSource> flames_;
  std::unique_ptr<FlameSource> heat_;
  std::unique_ptr<FDSPlaneSlices> slices_;
  std::unique_ptr<FDSBoundary> boundary_;
  std::set<std::string> said_;
  bool saidNotWhole_ = false;
  vtkSmartPointer<vtkPolyData> geometry_;
  std::vector<bool> geometryChanges_;
  bool geometryMoves_ = false;
  double geometryOpacity_ = 0.0;
};

} // namespace smokevis

#endif
