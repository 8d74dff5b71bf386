// The extinction coefficient in every cell of every mesh, from the best of what a run wrote.
#pragma once

#include "FrameTimes.h"
#include "SmokeCandidates.h"
#include "SmvFile.h"
#include "VolumeField.h"

#include <tbb/enumerable_thread_specific.h>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace smokevis
{

/// Chooses, for each mesh and smoke species, the files that give its extinction best (see
/// FindSmokeCandidates()), and reads them. Where the best covers only a part of the mesh, the next
/// ones complete it. Species add. The values become K [1/m] so: OPTICAL DENSITY by K = 2.3 OD, as
/// FDS divides by 2.3; DENSITY by K = Km rho; MASS FRACTION by K = Km Y rho with the gas density;
/// VISIBILITY by K = C/S; and a cell gets the mean of its eight nodes. Another Km than the run's
/// scales all of them.
class ExtinctionSource
{
public:
  /// @param index the run; must outlive this object
  /// Throws Error when the run wrote no 3-D smoke (of the kind asked for), or a file that is needed
  /// is missing or damaged.
  ExtinctionSource(const SmvFile& index, const SmokeOptions& options);

  /// Frame times over all meshes [s], increasing.
  const std::vector<double>& Times() const { return times_; }

  /// The one of Times() that is nearest to @p time, the earlier of two equally near.
  double NearestTime(double time) const;

  /// Which quantities and files are used.
  const std::string& Description() const { return description_; }

  /// What is missing, e.g. parts of a mesh without data.
  const std::vector<std::string>& Warnings() const { return warnings_; }

  /// Files that are not whole, a line each; their other frames are used.
  const std::vector<std::string>& Damages() const { return damages_; }

  /// Reads @p mesh at @p time into @p values, K [1/m] a cell, x fastest: 0 in solids and where no
  /// file has data. @p solid marks the solid cells (see SolidCells()), empty for none. Returns the
  /// time that the values are of [s]. Throws Error at a value that is no extinction coefficient.
  /// Threads may read different meshes at once.
  double Read(int mesh, double time, TimeInterpolation interpolation,
    const std::vector<unsigned char>& solid, std::span<float> values);

  /// Bytes that were read so far, those of opening the files included; not while a thread reads.
  std::uint64_t BytesRead() const;

private:
  /// A chosen field, and what a mass fraction is to be multiplied by.
  struct Term
  {
    VolumeField Field;
    std::unique_ptr<VolumeField> Density;
  };

  /// Working space of a thread: kept, as fresh memory costs more than reading into it.
  struct Scratch
  {
    std::vector<float> Values;
    std::vector<float> Density;
    std::vector<float> Row;
    std::vector<unsigned char> Covered;
  };

  void Choose();
  void WarnOfGaps();
  void CollectTimes();
  void Describe();
  [[noreturn]] void FailWithoutSmoke() const;
  /// How a term goes into the values.
  struct Mode
  {
    /// Added to what is there, rather than written over it.
    bool Sums = true;
    /// Only where no earlier term of the species was.
    bool UsesCovered = false;
  };
  void Add(Term& term, const FrameMix& mix, const std::vector<unsigned char>& solid,
    const Mode& mode, Scratch& scratch, std::span<float> sum);
  [[noreturn]] void FailAt(
    const VolumeField& field, double time, std::span<const float> row, int j, int k) const;

  const SmvFile& index_;
  SmokeOptions options_;
  std::string description_;
  std::vector<std::string> warnings_;
  std::vector<std::string> damages_;
  std::vector<double> times_;
  tbb::enumerable_thread_specific<Scratch> scratch_;
  /// The chosen terms of each mesh, those of one species side by side.
  std::vector<std::vector<Term>> terms_;
};

} // namespace smokevis
