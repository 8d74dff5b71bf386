// The extinction coefficient in every cell of every mesh, from the best of what a run wrote.
#pragma once

#include "FrameFile.h"
#include "SmokeCandidates.h"
#include "SmvFile.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace smokevis
{

/// Chooses, for each mesh and smoke species, the files that give its extinction best (see
/// FindSmokeCandidates()), and reads them. Where the best covers only a part of the mesh, the next
/// ones complete it. Species add. The values become K [1/m] so: OPTICAL DENSITY by K = 2.3 OD, as
/// FDS divides by 2.3; DENSITY by K = Km rho; VISIBILITY by K = C/S; and a cell gets the mean of
/// its eight nodes.
class ExtinctionSource
{
public:
  /// @param index            the run; must outlive this object
  /// @param visibilityFactor C of K = C/S, 3 for light-reflecting signs unless the run said
  /// otherwise Throws Error when the run wrote no 3-D smoke, or a file that is needed is missing or
  /// damaged.
  ExtinctionSource(const SmvFile& index, double visibilityFactor);

  /// Frame times over all meshes [s], increasing.
  const std::vector<double>& Times() const { return times_; }

  /// The one of Times() that is nearest to @p time, the earlier of two equally near.
  double NearestTime(double time) const;

  /// Which quantities and files are used.
  const std::string& Description() const { return description_; }

  /// What is incomplete, e.g. frames cut short or parts of a mesh without data.
  const std::vector<std::string>& Warnings() const { return warnings_; }

  /// Reads @p mesh at its frame nearest to @p time into @p values, K [1/m] a cell, x fastest: 0 in
  /// solids and where no file has data. @p solid marks the solid cells (see SolidCells()), empty
  /// for none. Returns the time of the frame [s]. Throws Error at a value that is no extinction
  /// coefficient.
  double Read(
    int mesh, double time, const std::vector<unsigned char>& solid, std::span<float> values);

private:
  /// One chosen candidate, opened.
  struct Term
  {
    SmokeCandidate Of;
    std::unique_ptr<FrameFile> File;
  };

  void Choose();
  void WarnOfGaps();
  void CollectTimes();
  void Describe();
  [[noreturn]] void FailWithoutSmoke() const;
  void Add(const Term& term, std::size_t frame, const std::vector<unsigned char>& solid,
    std::vector<unsigned char>* covered, std::span<float> sum);
  void Convert(
    const Term& term, const std::vector<unsigned char>& solid, std::vector<float>& values) const;

  const SmvFile& index_;
  double visibilityFactor_;
  std::string description_;
  std::vector<std::string> warnings_;
  std::vector<double> times_;
  /// The last frame's values: kept, as fresh memory costs more than reading into it.
  std::vector<float> frame_;
  /// The chosen terms of each mesh, those of one species side by side.
  std::vector<std::vector<Term>> terms_;
};

} // namespace smokevis
