#include "FlameSource.h"

#include "Errors.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>

namespace smokevis
{

//------------------------------------------------------------------------------------------------
FlameSource::FlameSource(const SmvFile& index, FlameModel model)
    : index_(index), fields_(index.Meshes.size())
{
  const std::vector<std::string> labels =
    model == FlameModel::LuminousEfficacy
      ? std::vector<std::string>{"HRRPUV", "HEAT RELEASE RATE PER UNIT VOLUME"}
      : std::vector<std::string>{"EFFECTIVE FLAME TEMPERATURE", "TEMPERATURE"};
  std::ostringstream text;
  std::map<int, std::string> failures;
  for (SmokeCandidate& candidate : FindFieldCandidates(index, labels))
  {
    const int mesh = candidate.Mesh;
    std::vector<VolumeField>& fields = fields_[mesh];
    if (!fields.empty() && fields.back().Of().WholeMesh)
    {
      continue;
    }
    try
    {
      VolumeField field(index, std::move(candidate));
      if (!field.File().Damage().empty())
      {
        warnings_.push_back(field.File().Path() + ": " + field.File().Damage() + " (" +
                            field.Of().Label.LongLabel + "); the other frames are used.");
      }
      text << (text.tellp() > 0 ? "; " : "") << "mesh '" << index.Meshes[mesh].Name
           << "': " << field.Of().Label.LongLabel << " [" << field.Of().Label.Unit << "], "
           << std::filesystem::path(field.File().Path()).filename().string();
      fields.push_back(std::move(field));
    }
    catch (const Error& error)
    {
      failures.try_emplace(mesh, error.what());
    }
  }
  for (const auto& [mesh, error] : failures)
  {
    if (fields_[mesh].empty())
    {
      warnings_.push_back(
        "The flames of mesh '" + index.Meshes[mesh].Name + "' are left out. " + error);
    }
  }
  description_ = text.str();
}

//------------------------------------------------------------------------------------------------
bool FlameSource::HasData() const
{
  return std::any_of(
    fields_.begin(), fields_.end(), [](const auto& fields) { return !fields.empty(); });
}

//------------------------------------------------------------------------------------------------
double FlameSource::Read(int mesh, double time, TimeInterpolation interpolation,
  const std::vector<unsigned char>& solid, std::span<float> values)
{
  std::fill(values.begin(), values.end(), 0.0F);
  double readTime = time;
  // The better ones come last, over the others.
  for (auto field = fields_[mesh].rbegin(); field != fields_[mesh].rend(); ++field)
  {
    const double fieldTime = field->ReadCells(time, interpolation, solid, scratch_.local(), values);
    if (std::abs(fieldTime - time) > std::abs(readTime - time))
    {
      readTime = fieldTime;
    }
  }
  const auto bad = std::find_if_not(
    values.begin(), values.end(), [](float value) { return std::isfinite(value); });
  if (bad != values.end())
  {
    const VolumeField& field = fields_[mesh].front();
    throw Error(field.File().Path(),
      field.Of().Label.LongLabel + " is not a finite number in cell " +
        std::to_string(bad - values.begin()) + " of mesh '" + index_.Meshes[mesh].Name + "' at " +
        std::to_string(readTime) + " s",
      "The run went numerically unstable or the file is damaged: read an earlier time, or turn the "
      "light of flames off");
  }
  return readTime;
}

} // namespace smokevis
