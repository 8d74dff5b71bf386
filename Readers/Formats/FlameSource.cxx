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
      field.File().NoteDamage(field.Of().Label.LongLabel, damages_);
      text << (text.tellp() > 0 ? "; " : "") << "mesh '" << index.Meshes[mesh].Name
           << "': " << field.Of().Label.LongLabel << " [" << field.Of().Label.Unit << "], "
           << std::filesystem::path(field.File().Path()).filename().string();
      fields.push_back(std::move(field));
    }
    catch (const Error& error)
    {
      std::string& said = failures[mesh];
      said += (said.empty() ? "" : "; ") + std::string(error.what());
    }
  }
  for (const auto& [mesh, error] : failures)
  {
    const std::string flames = "The flames of mesh '" + index.Meshes[mesh].Name + "' ";
    warnings_.push_back(
      flames +
      (fields_[mesh].empty() ? "are left out. "
                             : "come from the next best source where this is missing: ") +
      error);
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
std::string FlameSource::MissingFrame(int mesh, double time, TimeInterpolation interpolation) const
{
  std::ostringstream text;
  for (const VolumeField& field : fields_[mesh])
  {
    const std::vector<double>& times = field.File().FrameTimes();
    const auto [first, last] = std::minmax_element(times.begin(), times.end());
    const double spacing = times.size() > 1 ? (*last - *first) / (times.size() - 1.0) : 0.0;
    // Flames may be written at other times than smoke; both times are rounded to 4 bytes.
    const double near = spacing * 1.01 + 1e-4 * std::max(1.0, std::abs(time));
    const double shown = field.Times().At(time, interpolation).Time;
    if (std::abs(shown - time) > near)
    {
      text << (text.tellp() > 0 ? "\n" : "") << field.File().Path() << ": "
           << field.Of().Label.LongLabel << " of mesh '" << index_.Meshes[mesh].Name
           << "' has no frame near " << time << " s: the flames of " << shown << " s are shown.";
    }
  }
  return text.str();
}

//------------------------------------------------------------------------------------------------
std::uint64_t FlameSource::BytesRead() const
{
  std::uint64_t bytes = 0;
  for (const std::vector<VolumeField>& fields : fields_)
  {
    for (const VolumeField& field : fields)
    {
      bytes += field.File().BytesRead();
    }
  }
  return bytes;
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
