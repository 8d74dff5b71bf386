// Keeps libraries that follow null pointers in damaged files from ending the process.
#pragma once

#include <array>
#include <csignal>
#include <functional>
#include <mutex>
#include <string>

namespace smokevis
{

/// While one is alive no other thread has one, and the signals of invalid addresses and numbers are
/// turned into failures of Run.
class CrashGuard
{
public:
  CrashGuard();
  ~CrashGuard();
  CrashGuard(const CrashGuard&) = delete;
  CrashGuard& operator=(const CrashGuard&) = delete;

  /// Does the work. Returns what failed in it, blank where nothing did: an invalid address or a
  /// failure of Open CASCADE. After an invalid address, objects that the work was busy with are in
  /// no state to be used or deleted. Other exceptions pass.
  std::string Run(const std::function<void()>& work) const;

private:
  std::unique_lock<std::mutex> Lock_;
  std::array<struct sigaction, 8> Actions_{};
};

} // namespace smokevis
