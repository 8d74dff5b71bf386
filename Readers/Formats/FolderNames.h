// Finds files whose names differ from those asked for in capital and small letters alone.
#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace smokevis
{

/// The names of what lies in folders. Windows does not tell capital from small letters, so that a
/// run from there may call its files otherwise than the disk it was copied to. Each folder is
/// listed once; threads may share an object.
class FolderNames
{
public:
  /// What @p relative, a path below @p folder, stands for: each part as it is there, or the only
  /// one there that differs from it in the case of ASCII letters alone. Nothing where a part has no
  /// such name, or several.
  std::optional<std::filesystem::path> Find(
    const std::filesystem::path& folder, const std::filesystem::path& relative) const;

private:
  /// Names by what they are in small letters.
  using Names = std::map<std::string, std::vector<std::string>>;
  const Names& List(const std::filesystem::path& folder) const;

  mutable std::mutex mutex_;
  mutable std::map<std::filesystem::path, Names> folders_;
};

} // namespace smokevis
