// What of a run tells where its flames are: heat release rate or temperature in 3-D.
#pragma once

#include "FrameTimes.h"
#include "SmvFile.h"
#include "VolumeField.h"

#include <tbb/enumerable_thread_specific.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace smokevis
{

/// How the light of flames is found.
enum class FlameModel
{
  /// Light in proportion to the heat release rate.
  LuminousEfficacy,
  /// Smoke that glows at its temperature.
  BlackBody
};

/// HRRPUV [kW/m3], or temperature [C]: of 8-bit files EFFECTIVE FLAME TEMPERATURE, which allows for
/// flames thinner than a cell, before any TEMPERATURE. Of each mesh the best that the run wrote in
/// 3-D.
class FlameSource
{
public:
  /// @param index the run; must outlive this object
  /// Files that are missing or damaged make warnings: smoke can be seen without flames.
  FlameSource(const SmvFile& index, FlameModel model);

  /// Whether any mesh has data.
  bool HasData() const;
  /// Which files are used; empty without data.
  const std::string& Description() const { return description_; }
  const std::vector<std::string>& Warnings() const { return warnings_; }
  /// Files that are not whole, a line each; their other frames are used.
  const std::vector<std::string>& Damages() const { return damages_; }

  /// What to say where a file of @p mesh has no frame near @p time [s], as one cut short has none
  /// towards the end: the file, and the time of the frame that stands in. Empty where all have.
  std::string MissingFrame(int mesh, double time, TimeInterpolation interpolation) const;

  /// Reads @p mesh at @p time, x fastest: no heat, or no temperature, in solids and where there is
  /// no data. Returns the time that the values are of [s]. Threads may read different meshes at
  /// once.
  double Read(int mesh, double time, TimeInterpolation interpolation,
    const std::vector<unsigned char>& solid, std::span<float> values);

  /// Bytes that were read so far, those of opening the files included; not while a thread reads.
  std::uint64_t BytesRead() const;

private:
  const SmvFile& index_;
  std::string description_;
  std::vector<std::string> warnings_;
  std::vector<std::string> damages_;
  /// Best first, of each mesh.
  std::vector<std::vector<VolumeField>> fields_;
  tbb::enumerable_thread_specific<std::vector<float>> scratch_;
};

} // namespace smokevis
