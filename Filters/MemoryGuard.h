// Refuses work for which there is not enough memory, before the machine swaps.
#pragma once

#include "ControlGroup.h"
#include "Errors.h"

#include <vtksys/SystemInformation.hxx>

#include <algorithm>
#include <cmath>
#include <string>

namespace smokevis
{

/// Memory that this process may still take without driving others out of theirs [bytes]; less where
/// a limit is set on the process (ulimit) or on its group (containers, batch systems).
inline double FreeMemory()
{
  constexpr double kibibyte = 1024.0;
  vtksys::SystemInformation system;
  const long long host = system.GetHostMemoryTotal() - system.GetHostMemoryUsed();
  const long long process = system.GetProcMemoryAvailable() - system.GetProcMemoryUsed();
  return std::min(kibibyte * static_cast<double>(std::min(host, process)), FreeMemoryOfGroup());
}

/// Throws Error where work takes more memory than is free.
/// @param where the property or file that asks for it
/// @param bytes what is about to be allocated
inline void RequireMemory(
  const std::string& where, const std::string& what, double bytes, const std::string& remedy)
{
  // Small wishes are not worth asking the system.
  constexpr double small = 64.0 * 1024.0 * 1024.0;
  constexpr double mebibyte = 1024.0 * 1024.0;
  const double free = bytes > small ? FreeMemory() : bytes;
  if (bytes > free)
  {
    throw Error(where,
      what + " would take " + std::to_string(std::llround(bytes / mebibyte)) +
        " MiB of memory, and " + std::to_string(std::llround(std::max(0.0, free) / mebibyte)) +
        " MiB are free",
      remedy);
  }
}

} // namespace smokevis
