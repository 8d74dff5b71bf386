#include "SmvFile.h"

#include "SmvParser.h"

#include <algorithm>
#include <filesystem>

namespace smokevis
{

//------------------------------------------------------------------------------------------------
bool IsOn(const std::vector<SmvEvent>& events, double time)
{
  if (events.empty())
  {
    return true;
  }
  bool on = !events.front().On;
  for (const SmvEvent& event : events)
  {
    if (event.Time > time)
    {
      break;
    }
    on = event.On;
  }
  return on;
}

//------------------------------------------------------------------------------------------------
SmvFile::SmvFile(const std::string& path) : Path(path)
{
  SmvParser(*this).Run();
}

//------------------------------------------------------------------------------------------------
std::string SmvFile::Resolve(const std::string& name) const
{
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(Path).parent_path();
  const fs::path asWritten = folder / name;
  std::error_code problem;
  if (fs::exists(asWritten, problem))
  {
    return asWritten.string();
  }
  std::string slashes = name;
  std::replace(slashes.begin(), slashes.end(), '\\', '/');
  const fs::path asSlashes = folder / slashes;
  // A run that was moved since, perhaps from another machine, lies beside its index.
  const fs::path beside = folder / fs::path(slashes).filename();
  for (const fs::path& there : {asSlashes, beside})
  {
    if (fs::exists(there, problem))
    {
      return there.string();
    }
  }
  std::optional<fs::path> found;
  if (fs::path(slashes).is_relative())
  {
    found = names_->Find(folder, slashes);
  }
  if (!found)
  {
    found = names_->Find(folder, beside.filename());
  }
  return found.value_or(asSlashes).string();
}

//------------------------------------------------------------------------------------------------
int SmvFile::DefaultSurface() const
{
  const auto found = std::find_if(Surfaces.begin(), Surfaces.end(),
    [this](const SmvSurface& surface) { return surface.Name == DefaultSurfaceName; });
  return found == Surfaces.end() ? 0 : static_cast<int>(found - Surfaces.begin());
}

} // namespace smokevis
