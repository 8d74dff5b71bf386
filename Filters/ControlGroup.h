// Memory that the system grants the group of processes that this one runs in.
#pragma once

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace smokevis
{

/// Memory that is left of what containers and batch systems allow [bytes]; infinity where nothing
/// is limited. A limit binds all groups below the one it is set on. What files are cached in counts
/// as left, since the system gives it back first. (Linux control groups, versions 1 and 2:
/// Documentation/admin-guide/cgroup-v1/memory.rst and cgroup-v2.rst of the kernel.)
/// @param membership file that says which groups this process is in
/// @param root folder that shows the groups
inline double FreeMemoryOfGroup(
  const std::string& membership = "/proc/self/cgroup", const std::string& root = "/sys/fs/cgroup")
{
  constexpr double unlimited = std::numeric_limits<double>::infinity();
  const auto number = [](const std::string& path)
  {
    // "max" stands for no limit.
    std::ifstream file(path);
    double value = 0.0;
    return file >> value ? value : unlimited;
  };
  const auto cache = [](const std::string& path, const std::string& prefix)
  {
    std::ifstream file(path);
    double sum = 0.0;
    std::string name;
    for (double value = 0.0; file >> name >> value;)
    {
      sum += name == prefix + "inactive_file" || name == prefix + "active_file" ? value : 0.0;
    }
    return sum;
  };
  const auto left =
    [&](const std::string& folder, const char* limit, const char* usage, const char* prefix)
  {
    const double used = number(folder + "/" + usage);
    return used == unlimited ? unlimited
                             : number(folder + "/" + limit) -
                                 std::max(0.0, used - cache(folder + "/memory.stat", prefix));
  };
  double free = unlimited;
  // Lines "4:memory:/group" of version 1 and "0::/group" of version 2.
  std::ifstream groups(membership);
  for (std::string line; std::getline(groups, line);)
  {
    const std::size_t first = line.find(':');
    const std::size_t second = first == std::string::npos ? first : line.find(':', first + 1);
    if (second == std::string::npos)
    {
      continue;
    }
    const std::string controllers = ',' + line.substr(first + 1, second - first - 1) + ',';
    const bool isFirst = controllers.find(",memory,") != std::string::npos;
    if (!isFirst && controllers != ",,")
    {
      continue;
    }
    // Inside a container the group may be shown as the root.
    std::string group = line.substr(second + 1);
    for (;; group.resize(group.rfind('/')))
    {
      free = std::min(free, isFirst ? left(root + "/memory" + group, "memory.limit_in_bytes",
                                        "memory.usage_in_bytes", "total_")
                                    : left(root + group, "memory.max", "memory.current", ""));
      if (group.find('/') == std::string::npos)
      {
        break;
      }
    }
  }
  return free;
}

} // namespace smokevis
