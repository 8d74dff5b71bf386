// Hands the fuzzer's bytes to parsers that take files, and lets pass what a parser may do: refuse
// them with an Error.
#pragma once

#include "Errors.h"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

namespace smokevis::fuzz
{

/// A folder of this process in memory.
inline const std::filesystem::path& Folder()
{
  static const std::filesystem::path folder = []
  {
    const bool memory = std::filesystem::exists("/dev/shm");
    const auto base = memory ? "/dev/shm" : std::filesystem::temp_directory_path();
    auto path = base / ("smokevis-fuzz-" + std::to_string(::getpid()));
    std::filesystem::create_directories(path);
    std::atexit([] { std::filesystem::remove_all(Folder()); });
    return path;
  }();
  return folder;
}

/// Writes bytes to a file of the folder and returns its path.
inline std::string Write(const std::string& name, const void* data, std::size_t size)
{
  const std::string path = (Folder() / name).string();
  std::ofstream stream(path, std::ios::binary | std::ios::trunc);
  stream.write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
  return path;
}

/// Runs a parser. Anything but success or an Error with a place and words gets through to the
/// fuzzer.
template <class Action> int Try(Action&& action)
{
  try
  {
    action();
  }
  catch (const Error& error)
  {
    if (std::string(error.what()).find(": ") == std::string::npos)
    {
      std::fprintf(stderr, "%s\n", error.what());
      std::abort();
    }
  }
  return 0;
}

} // namespace smokevis::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
